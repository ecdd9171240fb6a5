// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vectors, boxes and outward rounding. The only place that names glam; allocates nothing.
//!
//! Nothing here uses `mul_add`, the platform's libm or reciprocal estimates: results have the same
//! bits on every machine.

mod aabb;
mod double_double;
mod expansion;
mod interval;
mod interval_functions;
mod morton;
mod rounding;

pub use aabb::Aabb;
pub use double_double::{cross_of_differences, plane_and_ray, volumes_of_differences};
pub use expansion::{Expansion, difference, product};
pub use glam::{DMat3 as Mat3, DVec3 as Vec3, Vec3Swizzles as Swizzles};
pub use interval::Interval;
pub use interval_functions::power;
pub use morton::{MORTON_BITS, morton};
pub use rounding::{f32_above, f32_below, f32_same_sign, positive_zero};

/// Euclidean length that neither overflows nor underflows where the result is representable.
pub fn length(v: Vec3) -> f64 {
    let d2 = v.x * v.x + v.y * v.y + v.z * v.z;
    if d2 > 1e-280 && d2 < 1e300 {
        return d2.sqrt();
    }
    let m = v.x.abs().max(v.y.abs()).max(v.z.abs());
    if m == 0.0 || !m.is_finite() {
        return m;
    }
    let (x, y, z) = (v.x / m, v.y / m, v.z / m);
    m * (x * x + y * y + z * z).sqrt()
}

/// `v` scaled to unit length; zero stays zero.
pub fn unit(v: Vec3) -> Vec3 {
    let m = v.x.abs().max(v.y.abs()).max(v.z.abs());
    if m == 0.0 || !m.is_finite() {
        return Vec3::ZERO;
    }
    // Scaling first keeps denormal and huge vectors exact enough to normalise.
    let w = v / m;
    w / (w.x * w.x + w.y * w.y + w.z * w.z).sqrt()
}
