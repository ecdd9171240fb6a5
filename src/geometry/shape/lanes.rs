// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shapes at eight points side by side: the bits of each alone.

use super::Sphere;
use crate::geometry::points::Points;
use crate::math::{Aabb, Vec3};
use crate::primitive::{cuboid, sphere};
use crate::simd::Kernel;
use crate::simd::float8::Simd;
use crate::simd::lanes::{F64s, F64x8, Lanes, WIDTH};

/// A ball at many points.
pub(super) struct BallValues<'a> {
    pub(super) ball: &'a Sphere,
    pub(super) points: Points<'a>,
    pub(super) out: &'a mut [f64],
}

impl Kernel for BallValues<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let BallValues { ball, points: Points(at), out } = self;
        let whole = out.len() / WIDTH * WIDTH;
        for from in (0..whole).step_by(WIDTH) {
            let x = load(at[0], from) - F64x8::splat(ball.center.x);
            let y = load(at[1], from) - F64x8::splat(ball.center.y);
            let z = load(at[2], from) - F64x8::splat(ball.center.z);
            let squared = x * x + y * y + z * z;
            let out = &mut out[from..from + WIDTH];
            if is_common(squared, F64x8::splat(1.0)) {
                out.copy_from_slice(&(squared.sqrt() - F64x8::splat(ball.radius)).0);
            } else {
                each(at, from, out, |p| sphere::value(ball.center, ball.radius, p));
            }
        }
        each(at, whole, &mut out[whole..], |p| sphere::value(ball.center, ball.radius, p));
    }
}

/// A box at many points.
pub(super) struct BoxValues<'a> {
    pub(super) b: Aabb,
    pub(super) points: Points<'a>,
    pub(super) out: &'a mut [f64],
}

impl Kernel for BoxValues<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let BoxValues { b, points: Points(at), out } = self;
        let (lo, hi) = (b.lo.to_array(), b.hi.to_array());
        let zero = F64x8::splat(0.0);
        let whole = out.len() / WIDTH * WIDTH;
        for from in (0..whole).step_by(WIDTH) {
            let mut q = [zero; 3];
            for k in 0..3 {
                let c = load(at[k], from);
                q[k] = max(F64x8::splat(lo[k]) - c, c - F64x8::splat(hi[k]));
            }
            let inside = max(max(q[0], q[1]), q[2]);
            let [x, y, z] = [max(q[0], zero), max(q[1], zero), max(q[2], zero)];
            let squared = x * x + y * y + z * z;
            let out = &mut out[from..from + WIDTH];
            if is_common(squared, inside) {
                out.copy_from_slice(&F64x8::select(inside.le(zero), inside, squared.sqrt()).0);
            } else {
                each(at, from, out, |p| cuboid::value(b, p));
            }
        }
        each(at, whole, &mut out[whole..], |p| cuboid::value(b, p));
    }
}

#[inline(always)]
fn load(from: &[f64], at: usize) -> F64x8 {
    let mut lanes = [0.0; WIDTH];
    lanes.copy_from_slice(&from[at..at + WIDTH]);
    F64s(lanes)
}

#[inline(always)]
fn max(a: F64x8, b: F64x8) -> F64x8 {
    F64x8::select(a.lt(b), b, a)
}

/// Whether no square that counts (where `sign` is positive) overflows or underflows: the root is the length.
#[inline(always)]
fn is_common(squared: F64x8, sign: F64x8) -> bool {
    let mut all = true;
    for k in 0..WIDTH {
        all &= (squared.0[k] > 1e-280 && squared.0[k] < 1e300) | (sign.0[k] <= 0.0);
    }
    all
}

/// One after another from `from` on.
#[inline(never)]
fn each(at: [&[f64]; 3], from: usize, out: &mut [f64], value: impl Fn(Vec3) -> f64) {
    for (k, out) in out.iter_mut().enumerate() {
        *out = value(Vec3::new(at[0][from + k], at[1][from + k], at[2][from + k]));
    }
}
