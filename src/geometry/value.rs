// SPDX-License-Identifier: MIT OR Apache-2.0
//! The value at a point. It depends on the point and the geometry alone.

use super::Geometry;
use super::node::Node;
use crate::math::{Vec3, positive_zero};
use crate::primitive::{cuboid, sphere};

impl Geometry {
    /// The value at a point; NaN where a coordinate is not finite or a user's function failed. Never
    /// -0.0.
    pub fn value(&self, p: Vec3) -> f64 {
        if p.is_finite() { positive_zero(self.raw_value(p)) } else { f64::NAN }
    }

    /// The value; the sign of zero is not settled yet.
    pub(super) fn raw_value(&self, p: Vec3) -> f64 {
        match self.node() {
            Node::Sphere { center, radius } => sphere::value(*center, *radius, p),
            Node::Cuboid(b) => cuboid::value(*b, p),
            Node::Surface(surface) if p.is_finite() => surface.value(p),
            Node::Surface(_) => f64::NAN,
            Node::Function { function, .. } => function.value(p),
            Node::Union(parts) => extreme(parts, p, |a, b| a < b, f64::INFINITY),
            Node::Intersection(parts) => extreme(parts, p, |a, b| a > b, f64::NEG_INFINITY),
            Node::Complement(g) => 0.0 - g.raw_value(p),
            Node::Translate(g, shift) => g.raw_value(p - *shift),
            Node::Place(g, placement) => g.raw_value(placement.to_body(p)),
            Node::Part(g, _) => g.raw_value(p),
        }
    }

    /// The part whose value wins, the first of several.
    pub(super) fn winner(parts: &[Geometry], p: Vec3, wins: fn(f64, f64) -> bool) -> Option<&Geometry> {
        let mut best: Option<(f64, &Geometry)> = None;
        for part in parts {
            let value = part.raw_value(p);
            if value.is_nan() {
                return Some(part);
            }
            if best.is_none_or(|(least, _)| wins(value, least)) {
                best = Some((value, part));
            }
        }
        best.map(|(_, part)| part)
    }
}

/// The winning value; NaN where any is.
fn extreme(parts: &[Geometry], p: Vec3, wins: fn(f64, f64) -> bool, none: f64) -> f64 {
    let mut best = none;
    for part in parts {
        let value = part.raw_value(p);
        if value.is_nan() {
            return value;
        }
        if wins(value, best) {
            best = value;
        }
    }
    best
}
