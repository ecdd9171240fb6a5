// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which faces of a mesh are in a place.

use crate::error::{Error, Result};
use crate::geometry::Geometry;
use crate::math::{Aabb, Vec3};

/// The input faces of one mesh (moved, labelled or complemented) that have a point in common with a closed box:
/// exactly, in order. The box may be infinite.
pub fn faces_overlapping(g: &Geometry, b: Aabb) -> Result<Vec<i64>> {
    if b.lo.is_nan() || b.hi.is_nan() || b.is_empty() {
        let ([a, b, c], [d, e, f]) = (b.lo.to_array(), b.hi.to_array());
        return Err(Error::invalid(format!("lo, hi: ({a}, {b}, {c}) to ({d}, {e}, {f}) is no box")));
    }
    g.faces_overlapping(b)
}

/// The input faces of such a mesh whose distance from a point is at most `radius`, which may be infinite: the
/// distance to each as [`super::closest`] computes it, in order.
pub fn faces_within(g: &Geometry, p: Vec3, radius: f64) -> Result<Vec<i64>> {
    if !p.is_finite() {
        return Err(Error::invalid(format!("point: ({}, {}, {}) is not finite", p.x, p.y, p.z)));
    }
    if radius.is_nan() || radius < 0.0 {
        return Err(Error::invalid(format!("radius: {radius} is not at least 0")));
    }
    g.faces_within(p, radius)
}
