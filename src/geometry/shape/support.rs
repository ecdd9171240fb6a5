// SPDX-License-Identifier: MIT OR Apache-2.0
//! What several shapes share: boxes rounded outward, a direction across another, words of a fingerprint.

use crate::math::{Aabb, Vec3, unit};

/// Bound on the rounding of a value, relative to the numbers that go into it; as in `Facts::convex`.
pub(super) const UNIT: f64 = 64.0 * f64::EPSILON;

/// From `origin - below` to `origin + above`, widened by what rounding brings to the surface of a body whose
/// points near `origin` are at most `size` off.
pub(super) fn box_around(origin: Vec3, below: Vec3, above: Vec3, size: f64) -> Aabb {
    // Where everything underflows a point may lie on the surface of a body it is not in.
    let pad = Vec3::splat(UNIT * size + 1e-300);
    let rounding = |reach: Vec3| (origin.abs() + reach.abs()) * (4.0 * f64::EPSILON) + pad;
    Aabb::new(origin - below - rounding(below), origin + above + rounding(above))
}

/// The box `b` of a body, widened likewise.
pub(super) fn widened(b: Aabb, size: f64) -> Aabb {
    box_around(Vec3::ZERO, -b.lo, b.hi, size)
}

/// A direction across the unit vector `v`.
pub(super) fn across(v: Vec3) -> Vec3 {
    let size = v.abs();
    let axis = if size.x <= size.y && size.x <= size.z {
        Vec3::X
    } else if size.y <= size.z {
        Vec3::Y
    } else {
        Vec3::Z
    };
    unit(axis - v * v.dot(axis)) + Vec3::ZERO
}

/// Numbers as words, -0.0 as 0.0.
pub(super) fn numbers(add: &mut dyn FnMut(u64), all: impl IntoIterator<Item = f64>) {
    all.into_iter().for_each(|x| add((x + 0.0).to_bits()));
}
