// SPDX-License-Identifier: MIT OR Apache-2.0
//! The axis-aligned box: signed distance exact inside and outside, gradient, crossings of a segment.

use crate::math::{Aabb, Vec3, length, unit};

/// How far `p` is outside each pair of faces (negative inside); its sign is exact.
fn excess(b: Aabb, p: Vec3) -> Vec3 {
    (b.lo - p).max(p - b.hi)
}

/// Signed distance.
pub(crate) fn value(b: Aabb, p: Vec3) -> f64 {
    let q = excess(b, p);
    let inside = q.x.max(q.y).max(q.z);
    if inside <= 0.0 { inside } else { length(q.max(Vec3::ZERO)) }
}

/// Gradient of the distance; inside, the normal of the nearest face, the first in the order x, y, z
/// where several are.
pub(crate) fn gradient(b: Aabb, p: Vec3) -> Vec3 {
    let q = excess(b, p);
    let side = (p - b.hi).cmpge(b.lo - p);
    let outward = Vec3::select(side, Vec3::ONE, Vec3::NEG_ONE);
    let inside = q.x.max(q.y).max(q.z);
    if inside > 0.0 {
        return unit(q.max(Vec3::ZERO)) * outward;
    }
    let axis = if q.x == inside {
        Vec3::X
    } else if q.y == inside {
        Vec3::Y
    } else {
        Vec3::Z
    };
    axis * outward
}

/// Where the line a + t (b - a) enters and leaves, with the outward normals there; none where it
/// misses. Touching a face, edge or corner without entering is a miss.
pub(crate) fn interval(b: Aabb, from: Vec3, to: Vec3) -> Option<((f64, Vec3), (f64, Vec3))> {
    let mut enter = (f64::NEG_INFINITY, Vec3::ZERO);
    let mut leave = (f64::INFINITY, Vec3::ZERO);
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    for (k, axis) in axes.into_iter().enumerate() {
        let (a, d) = (from[k], to[k] - from[k]);
        if d == 0.0 {
            if a < b.lo[k] || a > b.hi[k] {
                return None;
            }
            continue;
        }
        let (mut near, mut far) = (((b.lo[k] - a) / d, -axis), ((b.hi[k] - a) / d, axis));
        if d < 0.0 {
            std::mem::swap(&mut near, &mut far);
        }
        if near.0 > enter.0 {
            enter = near;
        }
        if far.0 < leave.0 {
            leave = far;
        }
    }
    (enter.0 < leave.0).then_some((enter, leave))
}
