// SPDX-License-Identifier: MIT OR Apache-2.0
//! What callers hand in to be called: functions with a `user` pointer, and the end of that pointer.

use crate::parallel::Executor;
use crate::simd::environment;
use std::ffi::c_void;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Ends the life of `user`: run exactly once, on any thread, when the library lets go of what it was
/// given with, and not if that construction failed. May be NULL.
pub type emb_drop_fn = Option<unsafe extern "C" fn(user: *mut c_void)>;

/// A user's implicit function: negative inside the body, positive outside, zero on the surface; NaN
/// where it fails. It must give the same value for the same point every time, and it must not throw.
pub type emb_value_fn = Option<unsafe extern "C" fn(user: *mut c_void, x: f64, y: f64, z: f64) -> f64>;

/// Told the fraction done, rising from 0 to 1; nonzero stops the call with EMB_ERROR_CANCELLED. Only ever
/// called on the thread that made the call. It must not throw.
pub type emb_progress_fn = Option<unsafe extern "C" fn(user: *mut c_void, fraction: f64) -> i32>;

/// A caller's executor: calls task(context, index) for each index below `tasks`, on any threads, in any
/// order, and returns when all of them have returned. `task` may itself call embound, and does not throw;
/// the executor must not throw either, and must not call a task after it has returned.
pub type emb_parallel_for_fn = Option<
    unsafe extern "C" fn(
        user: *mut c_void,
        tasks: usize,
        task: Option<unsafe extern "C" fn(context: *mut c_void, index: usize)>,
        context: *mut c_void,
    ),
>;

/// A user's pointer, which travels between threads as the caller allows.
#[derive(Clone, Copy)]
pub(super) struct User(pub(super) *mut c_void);

// SAFETY: the library only hands the pointer to the functions that came with it, from the threads that
// their documentation names.
unsafe impl Send for User {}
// SAFETY: as above.
unsafe impl Sync for User {}

impl User {
    /// The pointer; a method, so that closures capture the whole `User`.
    pub(super) fn get(self) -> *mut c_void {
        self.0
    }
}

/// Runs the drop function once, when the last owner goes, but only if construction succeeded.
pub(super) struct Keepsake {
    user: User,
    drop: emb_drop_fn,
    kept: AtomicBool,
}

impl Keepsake {
    pub(super) fn new(user: *mut c_void, drop: emb_drop_fn) -> Arc<Keepsake> {
        Arc::new(Keepsake { user: User(user), drop, kept: AtomicBool::new(false) })
    }

    /// The pointer.
    pub(super) fn user(&self) -> *mut c_void {
        self.user.get()
    }

    /// The construction succeeded: the pointer is the library's now.
    pub(super) fn keep(&self) {
        self.kept.store(true, Ordering::Release);
    }
}

impl Drop for Keepsake {
    fn drop(&mut self) {
        if let Some(end) = self.drop
            && *self.kept.get_mut()
        {
            // SAFETY: the caller gave both together, and this is the only call.
            environment::as_caller(|| unsafe { end(self.user.get()) });
        }
    }
}

/// A user's executor.
pub(super) struct UserExecutor {
    pub(super) function:
        unsafe extern "C" fn(*mut c_void, usize, Option<unsafe extern "C" fn(*mut c_void, usize)>, *mut c_void),
    pub(super) keepsake: Arc<Keepsake>,
}

impl Executor for UserExecutor {
    fn run(&self, tasks: usize, task: &(dyn Fn(usize) + Sync)) {
        let mut context = Context { task };
        // SAFETY: the caller vouches for the function; the context outlives the call.
        environment::as_caller(|| unsafe {
            (self.function)(self.keepsake.user(), tasks, Some(run_task), (&raw mut context).cast());
        });
    }
}

struct Context<'a> {
    task: &'a (dyn Fn(usize) + Sync),
}

/// What an executor calls.
unsafe extern "C" fn run_task(context: *mut c_void, index: usize) {
    // SAFETY: the context that `run` made, which waits for the executor; tasks only read it.
    let context = unsafe { &*context.cast::<Context>() };
    // A task catches what happens in its chunks, so there is nothing to report here.
    super::error::plain((), || (context.task)(index));
}
