// SPDX-License-Identifier: MIT OR Apache-2.0
//! The processors that the process may use, as its first thread has them. A thread that an OpenMP
//! runtime has bound to one processor hands that binding to every thread it starts; a pool's workers
//! must not inherit it.

use crate::error::{Error, Result, Status};
use std::thread;

#[cfg(target_os = "linux")]
mod linux {
    use std::ffi::{c_int, c_ulong};

    /// 8192 processors.
    const WORDS: usize = 1024 / size_of::<c_ulong>();

    unsafe extern "C" {
        fn sched_getaffinity(pid: c_int, size: usize, mask: *mut c_ulong) -> c_int;
        fn sched_setaffinity(pid: c_int, size: usize, mask: *const c_ulong) -> c_int;
    }

    /// Gives the present thread the affinity of the process's first thread. Where the system refuses,
    /// the thread keeps the one it has, which is right but may be slow.
    pub(super) fn adopt() {
        let mut mask: [c_ulong; WORDS] = [0; WORDS];
        let size = size_of_val(&mask);
        // SAFETY: the mask holds `size` bytes; on Linux the process id is the id of its first thread.
        unsafe {
            if sched_getaffinity(std::process::id() as c_int, size, mask.as_mut_ptr()) == 0 {
                sched_setaffinity(0, size, mask.as_ptr());
            }
        }
    }
}

/// Gives the present thread the affinity of the process.
pub(super) fn adopt_process_affinity() {
    #[cfg(target_os = "linux")]
    linux::adopt();
}

/// How many threads the process may run at once: its affinity and its control group's share.
pub(super) fn processors() -> Result<usize> {
    // Counted on a thread of its own, because only the present thread's affinity can be counted.
    let counted = thread::Builder::new().name("embound".into()).spawn(|| {
        adopt_process_affinity();
        thread::available_parallelism().map_or(1, usize::from)
    });
    let counter = counted.map_err(|e| Error::new(Status::Memory, format!("threads: cannot start a thread: {e}")))?;
    counter.join().map_err(|_| Error::new(Status::Internal, "threads: counting the processors failed"))
}
