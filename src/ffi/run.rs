// SPDX-License-Identifier: MIT OR Apache-2.0
//! How a call runs: pool, progress, cancellation.

use super::callback::{User, emb_progress_fn};
use super::handle::lend;
use super::pool::emb_pool;
use super::versioned::{self, Versioned};
use crate::error::Result;
use crate::parallel::Run;
use crate::simd::environment;
use std::ffi::c_void;
use std::mem::{offset_of, size_of};
use std::ptr;

/// How a call runs. NULL in its place, or a struct of zeros after struct_size: on the calling thread,
/// silently. The results have the same bits however a call runs.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_run {
    /// sizeof(emb_run)
    pub struct_size: usize,
    /// Threads to share the work with; NULL: the calling thread alone. One pool may serve many calls at once.
    pub pool: *const emb_pool,
    /// Told the fraction done, or NULL. See emb_progress_fn.
    pub progress: emb_progress_fn,
    /// Handed to progress.
    pub user: *mut c_void,
}

// SAFETY: repr(C), size first, pointers.
unsafe impl Versioned for emb_run {
    const FIRST_SIZE: usize = offset_of!(emb_run, user) + size_of::<*mut c_void>();
    const DEFAULT: emb_run =
        emb_run { struct_size: size_of::<emb_run>(), pool: ptr::null(), progress: None, user: ptr::null_mut() };
}

/// Calls `work` with the run that a caller asks for.
///
/// # Safety
/// `run` is NULL or points to a struct of the size that it states, with a live pool.
pub(super) unsafe fn with_run(run: *const emb_run, work: impl FnOnce(&Run) -> Result<()>) -> Result<()> {
    // SAFETY: the caller's promise.
    let run = unsafe { versioned::read_or_default("run", run) }?;
    let pool = match run.pool.is_null() {
        true => None,
        // SAFETY: the caller's promise.
        false => Some(unsafe { lend("run.pool", run.pool) }?),
    };
    let Some(progress) = run.progress else {
        return work(&Run { pool, progress: None });
    };
    let user = User(run.user);
    // SAFETY: the caller vouches for the function; only the calling thread calls it.
    let tell = move |fraction| environment::as_caller(|| unsafe { progress(user.get(), fraction) }) != 0;
    work(&Run { pool, progress: Some(&tell) })
}
