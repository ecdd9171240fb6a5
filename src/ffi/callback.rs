// SPDX-License-Identifier: MIT OR Apache-2.0
//! What callers hand in to be called: functions with a `user` pointer, and the end of that pointer.

use super::constants::{EMB_EXACT, EMB_LOWER_BOUND, EMB_SIGN_ONLY};
use super::versioned::Versioned;
use crate::error::{Error, Result};
use crate::geometry::{Function, FunctionOptions, Kind};
use crate::math::{Aabb, Vec3};
use crate::parallel::Executor;
use crate::simd::environment;
use std::ffi::c_void;
use std::mem::{offset_of, size_of};
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

/// What the caller knows of a function; fill it with emb_callback_options_init.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_callback_options {
    /// sizeof(emb_callback_options)
    pub struct_size: usize,
    /// Lower corner of a box around the body; -INFINITY by default. The caller vouches for it.
    pub lo: [f64; 3],
    /// Upper corner of that box; +INFINITY by default.
    pub hi: [f64; 3],
    /// A constant L with |f(p) - f(q)| <= L |p - q|; 0, the default: unknown. Boxes are classified, and
    /// fills pruned, only where it is known.
    pub lipschitz: f64,
    /// Step of the centred differences that give the gradient; 0, the default: 1e-6 of the diagonal of the
    /// box, or 1e-6 where that is infinite.
    pub gradient_step: f64,
    /// EMB_EXACT, EMB_LOWER_BOUND or EMB_SIGN_ONLY, the default.
    pub kind: i32,
    /// Nonzero: several threads may call the function at once. 0, the default: only the thread that makes
    /// a call, so the call does not share its work.
    pub thread_safe: i32,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_callback_options {
    const FIRST_SIZE: usize = offset_of!(emb_callback_options, thread_safe) + size_of::<i32>();
    const DEFAULT: emb_callback_options = emb_callback_options {
        struct_size: size_of::<emb_callback_options>(),
        lo: [f64::NEG_INFINITY; 3],
        hi: [f64::INFINITY; 3],
        lipschitz: 0.0,
        gradient_step: 0.0,
        kind: EMB_SIGN_ONLY,
        thread_safe: 0,
    };
}

impl emb_callback_options {
    pub(super) fn convert(&self) -> Result<FunctionOptions> {
        let kind = match self.kind {
            EMB_EXACT => Kind::Exact,
            EMB_LOWER_BOUND => Kind::LowerBound,
            EMB_SIGN_ONLY => Kind::SignOnly,
            other => return Err(Error::invalid(format!("options.kind: {other} is not an EMB_EXACT, ..."))),
        };
        Ok(FunctionOptions {
            bounds: Aabb::new(Vec3::from(self.lo), Vec3::from(self.hi)),
            lipschitz: self.lipschitz,
            gradient_step: self.gradient_step,
            kind,
            thread_safe: self.thread_safe != 0,
        })
    }
}

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

/// A user's implicit function.
pub(super) struct UserFunction {
    pub(super) value: unsafe extern "C" fn(*mut c_void, f64, f64, f64) -> f64,
    pub(super) keepsake: Arc<Keepsake>,
}

impl Function for UserFunction {
    fn value(&self, p: Vec3) -> f64 {
        // SAFETY: the caller vouches for the function and gave the pointer with it.
        environment::as_caller(|| unsafe { (self.value)(self.keepsake.user.get(), p.x, p.y, p.z) })
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
            (self.function)(self.keepsake.user.get(), tasks, Some(run_task), (&raw mut context).cast());
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
