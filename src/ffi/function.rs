// SPDX-License-Identifier: MIT OR Apache-2.0
//! Geometries that are a caller's function: its value, and what else the caller knows of it.

use super::callback::{Keepsake, emb_drop_fn, emb_value_fn};
use super::constants::{EMB_EXACT, EMB_LOWER_BOUND, EMB_SIGN_ONLY};
use super::error::{emb_status, guard};
use super::geometry::{construct, emb_geom};
use super::handle::null;
use super::versioned::{self, Versioned};
use crate::error::{Error, Result};
use crate::geometry::{Function, FunctionOptions, Geometry, Kind};
use crate::math::{Aabb, Interval, Vec3};
use crate::simd::environment;
use std::ffi::c_void;
use std::mem::{offset_of, size_of};
use std::sync::Arc;

/// A user's implicit function at many points: out_values[i] is that at (x[i], y[i], z[i]), i < count, to the bit
/// what the emb_value_fn beside it gives there; NaN, which stands there before, where it fails. The arrays are the
/// library's, live during the call only and do not overlap. It must not throw.
pub type emb_values_fn = Option<
    unsafe extern "C" fn(
        user: *mut c_void,
        count: usize,
        x: *const f64,
        y: *const f64,
        z: *const f64,
        out_values: *mut f64,
    ),
>;

/// The gradient of a user's function: 3 numbers to out_gradient. Nonzero says that it failed, and the gradient is
/// NaN. It must not throw.
pub type emb_gradient_fn =
    Option<unsafe extern "C" fn(user: *mut c_void, x: f64, y: f64, z: f64, out_gradient: *mut f64) -> i32>;

/// Numbers between which every value of a user's function in the closed box from lo to hi (3 numbers each, finite)
/// lies, rounding included: to *out_lo and *out_hi. Nonzero, NaN or *out_lo > *out_hi: not known. Boxes are
/// classified by it, so an untrue answer makes wrong ones. It must not throw.
pub type emb_range_fn = Option<
    unsafe extern "C" fn(user: *mut c_void, lo: *const f64, hi: *const f64, out_lo: *mut f64, out_hi: *mut f64) -> i32,
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
    /// A constant L with |f(p) - f(q)| <= L |p - q|; 0, the default: unknown. Boxes are classified
    /// only where it or a range is known.
    pub lipschitz: f64,
    /// Step of the centred differences that give the gradient; 0, the default: 1e-6 of the diagonal of the
    /// box, or 1e-6 where that is infinite.
    pub gradient_step: f64,
    /// EMB_EXACT, EMB_LOWER_BOUND or EMB_SIGN_ONLY, the default.
    pub kind: i32,
    /// Nonzero: several threads may call the function at once. 0, the default: only the thread that makes
    /// a call, so the call does not share its work.
    pub thread_safe: i32,
    /// The function at many points at once; NULL, the default: it is called point by point.
    pub values: emb_values_fn,
    /// Its gradient; NULL, the default: centred differences of the value.
    pub gradient: emb_gradient_fn,
    /// Its range over a box; NULL, the default: not known.
    pub range: emb_range_fn,
}

// SAFETY: repr(C), size first, no padding before the members added later, numbers and functions or NULL.
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
        values: None,
        gradient: None,
        range: None,
    };
}

impl emb_callback_options {
    fn convert(&self) -> Result<FunctionOptions> {
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

/// More points than that are handed over in pieces.
const BLOCK: usize = 128;

/// A user's implicit function.
struct UserFunction {
    value: unsafe extern "C" fn(*mut c_void, f64, f64, f64) -> f64,
    values: emb_values_fn,
    gradient: emb_gradient_fn,
    range: emb_range_fn,
    keepsake: Arc<Keepsake>,
}

impl Function for UserFunction {
    fn value(&self, p: Vec3) -> f64 {
        // SAFETY: the caller vouches for the function and gave the pointer with it.
        environment::as_caller(|| unsafe { (self.value)(self.keepsake.user(), p.x, p.y, p.z) })
    }

    fn values(&self, points: &[Vec3], out: &mut [f64]) {
        let Some(values) = self.values else {
            points.iter().zip(out).for_each(|(p, value)| *value = self.value(*p));
            return;
        };
        let (mut x, mut y, mut z) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
        for (points, out) in points.chunks(BLOCK).zip(out.chunks_mut(BLOCK)) {
            for (i, p) in points.iter().enumerate() {
                (x[i], y[i], z[i]) = (p.x, p.y, p.z);
            }
            out.fill(f64::NAN);
            let (axes, out) = ([&x, &y, &z].map(|axis| axis.as_ptr()), out.as_mut_ptr());
            // SAFETY: the caller vouches for the function; each array holds as many numbers as there are points.
            environment::as_caller(|| unsafe {
                values(self.keepsake.user(), points.len(), axes[0], axes[1], axes[2], out);
            });
        }
    }

    fn is_batched(&self) -> bool {
        self.values.is_some()
    }

    fn gradient(&self, p: Vec3) -> Option<Vec3> {
        let function = self.gradient?;
        let mut gradient = [f64::NAN; 3];
        let out = gradient.as_mut_ptr();
        // SAFETY: the caller vouches for the function, which writes three numbers.
        let failed = environment::as_caller(|| unsafe { function(self.keepsake.user(), p.x, p.y, p.z, out) });
        Some(if failed == 0 { Vec3::from_array(gradient) } else { Vec3::NAN })
    }

    fn range(&self, b: Aabb) -> Option<Interval> {
        let function = self.range?;
        let (lo, hi) = (b.lo.to_array(), b.hi.to_array());
        let (mut least, mut most) = (f64::NAN, f64::NAN);
        // SAFETY: the caller vouches for the function, which reads three numbers each and writes one each.
        let failed = environment::as_caller(|| unsafe {
            function(self.keepsake.user(), lo.as_ptr(), hi.as_ptr(), &raw mut least, &raw mut most)
        });
        (failed == 0 && least <= most).then(|| Interval::new(least, most))
    }
}

/// Fills options with defaults. `size` is sizeof *options, as the caller knows it; nothing is written beyond.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_callback_options_init(options: *mut emb_callback_options, size: usize) -> emb_status {
    // SAFETY: the size is what the caller says, as the header asks.
    guard(|| unsafe { versioned::init("options", options, size) })
}

/// A user's function as a geometry. `value` is called with `user` in the floating-point environment of the thread
/// that made the call, and only with finite coordinates; where it returns NaN, emb_geom_value gives NaN and batches
/// give EMB_ERROR_CALLBACK. The functions in `options` are called with the same `user`, in the same environment and
/// by the same threads. `drop` (may be NULL) ends `user` with the last geometry that uses it. `options` may be
/// NULL. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT; then drop is not run. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_callback(
    value: emb_value_fn,
    user: *mut c_void,
    drop: emb_drop_fn,
    options: *const emb_callback_options,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    let build = || {
        let value = value.ok_or_else(|| null("value"))?;
        // SAFETY: pointers as the header asks.
        let options = unsafe { versioned::read_or_default("options", options) }?;
        let known = options.convert()?;
        let keepsake = Keepsake::new(user, drop);
        let emb_callback_options { values, gradient, range, .. } = options;
        let function = UserFunction { value, values, gradient, range, keepsake: Arc::clone(&keepsake) };
        let geometry = Geometry::function(Arc::new(function), &known)?;
        keepsake.keep();
        Ok(geometry)
    };
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, build) }
}
