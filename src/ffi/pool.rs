// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pools.

use super::affinity;
use super::callback::{Keepsake, UserExecutor, emb_drop_fn, emb_parallel_for_fn};
use super::error::{emb_status, guard, plain};
use super::handle::{Handle, give, null, release, share, writable};
use crate::parallel::Pool;
use std::ffi::c_void;
use std::sync::Arc;

/// Threads that calls may share: see emb_run. One pool may serve many calling threads at once, and calls
/// from within its own tasks, without deadlock.
pub struct emb_pool {
    _opaque: (),
}

impl Handle for emb_pool {
    type Target = Pool;
}

/// A pool of own workers. `threads` threads work on a call, the calling thread among them, so the pool
/// starts threads - 1 workers, which live until the last reference to it is freed; they have the affinity
/// of the process's first thread, whatever the calling thread is bound to. 0: as many threads as the
/// process may use; at most 65536. On success *out_pool is the caller's, to be freed with emb_pool_free.
/// Nothing but this function starts lasting threads.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (threads), EMB_ERROR_MEMORY (a thread could
/// not be started).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_pool_new(threads: usize, out_pool: *mut *mut emb_pool) -> emb_status {
    guard(|| {
        writable("out_pool", out_pool)?;
        let threads = if threads == 0 { affinity::processors()? } else { threads };
        let pool = Pool::new(threads, affinity::adopt_process_affinity)?;
        // SAFETY: checked above.
        unsafe { give(out_pool, pool) };
        Ok(())
    })
}

/// A pool over the caller's own executor (OpenMP, TBB, a task runtime): a call hands it `width` tasks,
/// 1 to 65536. An executor that runs its tasks one after another, or some of them late, is answered
/// correctly: every task takes pieces of work until none is left. `fn` is called in the calling thread's
/// floating-point environment, possibly from several threads at once. `drop` (may be NULL) ends `user` with
/// the last reference to the pool. On success *out_pool is the caller's, to be freed with emb_pool_free.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (width); then drop is not run.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_pool_from_callback(
    width: usize,
    r#fn: emb_parallel_for_fn,
    user: *mut c_void,
    drop: emb_drop_fn,
    out_pool: *mut *mut emb_pool,
) -> emb_status {
    guard(|| {
        writable("out_pool", out_pool)?;
        let function = r#fn.ok_or_else(|| null("fn"))?;
        let keepsake = Keepsake::new(user, drop);
        let executor = UserExecutor { function, keepsake: Arc::clone(&keepsake) };
        let pool = Pool::from_executor(width, Box::new(executor))?;
        keepsake.keep();
        // SAFETY: checked above.
        unsafe { give(out_pool, pool) };
        Ok(())
    })
}

/// How many threads or tasks a call is shared between; 1 for NULL. Any thread, any time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_pool_width(pool: *const emb_pool) -> usize {
    // SAFETY: a handle or NULL, as the header asks.
    plain(1, || unsafe { super::handle::lend("pool", pool) }.map_or(1, Pool::width))
}

/// One more reference to the same pool, to be freed like the first; NULL for NULL. O(1). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_pool_clone(pool: *const emb_pool) -> *mut emb_pool {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { share(pool) }
}

/// Gives up a reference; with the last one the workers end and drop is run. NULL is fine. Not while a
/// call uses this reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_pool_free(pool: *mut emb_pool) {
    // SAFETY: a handle or NULL that is not used again, as the header asks.
    plain((), || unsafe { release(pool) });
}
