// SPDX-License-Identifier: MIT OR Apache-2.0
//! Statuses, the thread's last message, and the guard that every entry goes through.

use super::constants::{EMB_OK, EMB_VERSION_MAJOR, EMB_VERSION_MINOR, EMB_VERSION_PATCH};
use crate::error::{self, Error, Result};
use crate::simd::environment;
use std::cell::RefCell;
use std::ffi::{CString, c_char};

/// What a fallible function returns: EMB_OK or a negative EMB_ERROR_*.
pub type emb_status = i32;

thread_local!(static LAST: RefCell<Option<CString>> = const { RefCell::new(None) });

/// Runs an entry's work in the default floating-point environment; an error or a panic becomes a
/// status and the thread's last message.
pub(super) fn guard(work: impl FnOnce() -> Result<()>) -> emb_status {
    match environment::enter(|| error::catch(work)) {
        Ok(()) => EMB_OK,
        Err(error) => {
            remember(&error);
            error.status() as emb_status
        }
    }
}

/// The guard of entries that cannot fail: `fallback` where even so a defect showed, and no message.
pub(super) fn quiet<R>(fallback: R, work: impl FnOnce() -> R) -> R {
    environment::enter(|| error::catch(|| Ok(work()))).unwrap_or(fallback)
}

/// [`quiet`] where no callback can be reached, which would have to run in the caller's environment.
#[inline]
pub(super) fn quiet_alone<R>(fallback: R, work: impl FnOnce() -> R) -> R {
    environment::with_default(|| error::catch(|| Ok(work()))).unwrap_or(fallback)
}

/// The guard of entries that compute nothing: the environment stays the caller's.
pub(super) fn plain<R>(fallback: R, work: impl FnOnce() -> R) -> R {
    error::catch(|| Ok(work())).unwrap_or(fallback)
}

fn remember(error: &Error) {
    let message = CString::new(error.message()).unwrap_or_default();
    // A thread that is being torn down has no last message any more.
    let _ = LAST.try_with(|last| last.replace(Some(message)));
}

/// Version of the library: major * 10000 + minor * 100 + patch. Compare with the EMB_VERSION_* macros
/// of the header. Any thread, any time.
#[unsafe(no_mangle)]
pub extern "C" fn emb_version_number() -> u32 {
    EMB_VERSION_MAJOR * 10000 + EMB_VERSION_MINOR * 100 + EMB_VERSION_PATCH
}

/// The message of the last call that failed on this thread: one line, naming the argument and the
/// offending value or index. Never NULL; "" where none failed yet. The text belongs to the library and
/// is valid until the thread's next failing call, or its end; a call that succeeds leaves it alone, and
/// emb_geom_value never sets it. What went wrong on a pool's worker reaches the thread that made the call.
#[unsafe(no_mangle)]
pub extern "C" fn emb_last_error() -> *const c_char {
    let text = LAST.try_with(|last| last.borrow().as_ref().map(|message| message.as_ptr()));
    text.ok().flatten().unwrap_or(c"".as_ptr())
}

/// The instruction set that this process uses: "scalar", "avx2", "avx512" or "neon". Found once, when
/// first needed; the environment variable EMBOUND_ISA caps it. Results have the same bits with each.
/// The text is static. Any thread, any time.
#[unsafe(no_mangle)]
pub extern "C" fn emb_isa() -> *const c_char {
    let name = match plain("scalar", crate::simd::isa) {
        "avx2" => c"avx2",
        "avx512" => c"avx512",
        "neon" => c"neon",
        _ => c"scalar",
    };
    name.as_ptr()
}
