// SPDX-License-Identifier: MIT OR Apache-2.0
//! How smooth set operations blend two values.

use super::callback::{Keepsake, emb_drop_fn};
use super::constants::{EMB_BLEND_CUSTOM, EMB_BLEND_EXPONENTIAL, EMB_BLEND_SMOOTH};
use super::error::{emb_status, guard};
use super::handle::null;
use super::versioned::{self, Versioned};
use crate::error::{Error, Result};
use crate::geometry::{Blend, BlendFunction, CustomBlend, Geometry};
use crate::simd::environment;
use std::ffi::c_void;
use std::mem::{offset_of, size_of};
use std::ptr;
use std::sync::Arc;

/// A user's blend of two values a <= b: what stands for the lesser of them in a union. It must rise with either, never
/// be above a, and be a where they are further apart than emb_blend.support. Its derivatives by a and by b go to *out_by_a and
/// *out_by_b; left as they are (NaN), centred differences are taken. NaN says that it failed. It must give the same
/// blend of the same values every time, and must not throw.
pub type emb_blend_fn =
    Option<unsafe extern "C" fn(user: *mut c_void, a: f64, b: f64, out_by_a: *mut f64, out_by_b: *mut f64) -> f64>;

/// How values that are close are blended into one; fill it with emb_blend_init, then set kind and width, or kind and
/// the members from blend on.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_blend {
    /// sizeof(emb_blend)
    pub struct_size: usize,
    /// EMB_BLEND_SMOOTH, the default, or another EMB_BLEND_*.
    pub kind: i32,
    /// EMB_BLEND_CUSTOM: nonzero: several threads may call `blend` at once. 0, the default: only the thread that
    /// makes a call, so the call does not share its work.
    pub thread_safe: i32,
    /// EMB_BLEND_SMOOTH, EMB_BLEND_EXPONENTIAL: finite and > 0, in units of the values; to be set.
    pub width: f64,
    /// EMB_BLEND_CUSTOM: the function, called with `user` in the floating-point environment of the thread that made
    /// the call. The members below belong to it, and are ignored where kind is another.
    pub blend: emb_blend_fn,
    /// Handed to `blend` and `drop`.
    pub user: *mut c_void,
    /// Ends `user`, once for each geometry made with this blend, with the last that uses that one; may be NULL. Not
    /// run where the construction failed.
    pub drop: emb_drop_fn,
    /// Values further apart than this leave the lesser alone; INFINITY, the default: there is no such distance, and
    /// every part is asked for every value. The caller vouches for this and the next two.
    pub support: f64,
    /// The most by which blending any number of values goes below the least of them; INFINITY, the default: not
    /// known, and the bounds of what is made are infinite.
    pub depth: f64,
    /// |blend(a, b) - blend(c, d)| <= lipschitz max(|a - c|, |b - d|); INFINITY, the default: not known.
    pub lipschitz: f64,
}

// SAFETY: repr(C), size first, numbers, pointers, functions or NULL.
unsafe impl Versioned for emb_blend {
    const FIRST_SIZE: usize = offset_of!(emb_blend, lipschitz) + size_of::<f64>();
    const DEFAULT: emb_blend = emb_blend {
        struct_size: size_of::<emb_blend>(),
        kind: EMB_BLEND_SMOOTH,
        thread_safe: 0,
        width: 0.0,
        blend: None,
        user: ptr::null_mut(),
        drop: None,
        support: f64::INFINITY,
        depth: f64::INFINITY,
        lipschitz: f64::INFINITY,
    };
}

impl emb_blend {
    /// Builds with the blend that a caller describes; its `user` is the library's where that succeeds.
    ///
    /// # Safety
    /// `given` is NULL or points to a struct of the size that it states.
    pub(super) unsafe fn lend(
        given: *const emb_blend,
        build: impl FnOnce(&Blend) -> Result<Geometry>,
    ) -> Result<Geometry> {
        // SAFETY: the caller's promise.
        let given = unsafe { versioned::read("blend", given) }?;
        match given.kind {
            EMB_BLEND_SMOOTH => build(&Blend::Smooth(given.width)),
            EMB_BLEND_EXPONENTIAL => build(&Blend::Exponential(given.width)),
            EMB_BLEND_CUSTOM => {
                let function = given.blend.ok_or_else(|| null("blend.blend"))?;
                let keepsake = Keepsake::new(given.user, given.drop);
                let function = UserBlend { function, keepsake: Arc::clone(&keepsake) };
                let geometry = build(&Blend::Custom(CustomBlend {
                    function: Arc::new(function),
                    support: given.support,
                    depth: given.depth,
                    lipschitz: given.lipschitz,
                    thread_safe: given.thread_safe != 0,
                }))?;
                keepsake.keep();
                Ok(geometry)
            }
            other => Err(Error::invalid(format!("blend.kind: {other} is not an EMB_BLEND_*"))),
        }
    }
}

/// A user's blend.
struct UserBlend {
    function: unsafe extern "C" fn(*mut c_void, f64, f64, *mut f64, *mut f64) -> f64,
    keepsake: Arc<Keepsake>,
}

impl BlendFunction for UserBlend {
    fn blend(&self, a: f64, b: f64) -> (f64, f64, f64) {
        let (mut by_a, mut by_b) = (f64::NAN, f64::NAN);
        // SAFETY: the caller vouches for the function, which writes two numbers, and gave the pointer with it.
        let value = environment::as_caller(|| unsafe {
            (self.function)(self.keepsake.user(), a, b, &raw mut by_a, &raw mut by_b)
        });
        (value, by_a, by_b)
    }
}

/// Fills a blend with defaults. `size` is sizeof *blend, as the caller knows it; nothing is written beyond.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_blend_init(blend: *mut emb_blend, size: usize) -> emb_status {
    // SAFETY: the size is what the caller says, as the header asks.
    guard(|| unsafe { versioned::init("blend", blend, size) })
}
