// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether a box is wholly inside or outside. Never a lie: -1 and +1 mean that the value, rounding
//! included, has that strict sign at every double of the closed box.

use super::Geometry;
use super::node::Node;
use super::properties::Kind;
use crate::math::{Aabb, Vec3};
use crate::primitive::triangle::RELATIVE_ERROR;

impl Geometry {
    /// -1 inside, +1 outside, 0 mixed, not known, or not a box (NaN, lo > hi).
    pub fn classify(&self, b: Aabb) -> i32 {
        if b.is_empty() {
            return 0;
        }
        if b.lo == b.hi {
            return sign(self.value(b.lo));
        }
        if !self.summary().functions && self.is_beyond(b) {
            return 1;
        }
        if !b.is_finite() {
            return 0;
        }
        self.classify_finite(b)
    }

    /// Whether the box keeps clear of the body's bounds by more than rounding.
    fn is_beyond(&self, b: Aabb) -> bool {
        let bounds = self.summary().bounds;
        if bounds.is_empty() {
            // Parts that miss each other by less than rounding may still have a point in common.
            return match self.node() {
                Node::Union(parts) => parts.iter().all(|part| part.is_beyond(b)),
                Node::Intersection(parts) => parts.iter().any(|part| part.is_beyond(b)),
                Node::Complement(_) | Node::Function { .. } => false,
                Node::Part(g, _) => g.is_beyond(b),
                Node::Translate(g, shift) => g.is_beyond(Aabb::new(b.lo - *shift, b.hi - *shift)),
                Node::Place(g, placement) => b.is_finite() && g.is_beyond(placement.box_to_body(b)),
                Node::Sphere { .. } | Node::Cuboid(_) | Node::Surface(_) => false,
            };
        }
        if !bounds.intersection(b).is_empty() {
            return false;
        }
        let margin = self.value_error(extent(b)) + self.value_error(extent(bounds));
        (0..3).any(|k| b.lo[k] - bounds.hi[k] > margin || bounds.lo[k] - b.hi[k] > margin)
    }

    fn classify_finite(&self, b: Aabb) -> i32 {
        let by_center = self.classify_by_center(b);
        if by_center != 0 {
            return by_center;
        }
        match self.node() {
            Node::Union(parts) => combine(parts, b, -1),
            Node::Intersection(parts) => combine(parts, b, 1),
            Node::Complement(g) => -g.classify_finite(b),
            // Subtraction is monotone: the shifted box holds every shifted point, rounding included.
            Node::Translate(g, shift) => g.classify_finite(Aabb::new(b.lo - *shift, b.hi - *shift)),
            Node::Place(g, placement) => g.classify_finite(placement.box_to_body(b)),
            Node::Part(g, _) => g.classify_finite(b),
            Node::Function { options, .. } if options.bounds.intersection(b).is_empty() => 1,
            _ => 0,
        }
    }

    /// The value at the centre against the half diagonal.
    fn classify_by_center(&self, b: Aabb) -> i32 {
        let s = self.summary();
        let center = b.center();
        let half = Vec3::max(b.hi - center, center - b.lo);
        let reach = crate::math::length(half) * (1.0 + 1e-9);
        let room = |value: f64| {
            if s.kind <= Kind::LowerBound { value.abs() } else { value.abs() / s.lipschitz }
        };
        if s.kind == Kind::SignOnly && !s.lipschitz.is_finite() {
            return 0;
        }
        let value = self.value(center);
        if room(value) > reach + 2.0 * self.value_error(extent(b)) { sign(value) } else { 0 }
    }

    /// Bound on how far a computed value can be from the true one, for coordinates up to `extent`. Of a
    /// user's function nothing is known: a thousand roundings of the coordinates are allowed.
    fn value_error(&self, extent: f64) -> f64 {
        let eps = f64::EPSILON;
        match self.node() {
            Node::Sphere { center, radius } => 16.0 * eps * (extent + center.abs().max_element() + radius),
            Node::Cuboid(b) => 16.0 * eps * (extent + b.lo.abs().max(b.hi.abs()).max_element()),
            Node::Surface(surface) => 2.0 * RELATIVE_ERROR * (extent + surface.reach() + surface.diagonal()),
            Node::Function { .. } => 1000.0 * eps * extent,
            Node::Union(parts) | Node::Intersection(parts) => {
                parts.iter().map(|g| g.value_error(extent)).fold(0.0, f64::max)
            }
            Node::Complement(g) | Node::Part(g, _) => g.value_error(extent),
            Node::Translate(g, shift) => {
                let moved = extent + shift.abs().max_element();
                g.value_error(moved) + 2.0 * eps * moved
            }
            Node::Place(g, placement) => {
                let rounding = placement.rounding(extent);
                g.value_error(rounding / (16.0 * eps) * 2.0) + 2.0 * rounding
            }
        }
    }
}

/// Tri-state logic: `sure` (-1 for a union) as soon as one part is sure, the opposite when all parts are.
fn combine(parts: &[Geometry], b: Aabb, sure: i32) -> i32 {
    let mut all = -sure;
    for part in parts {
        match part.classify_finite(b) {
            c if c == sure => return sure,
            c if c != -sure => all = 0,
            _ => {}
        }
    }
    all
}

fn sign(value: f64) -> i32 {
    i32::from(value > 0.0) - i32::from(value < 0.0)
}

/// Largest magnitude of a finite coordinate. (Towards infinity a value grows faster than its rounding.)
fn extent(b: Aabb) -> f64 {
    let coordinates = b.lo.to_array().into_iter().chain(b.hi.to_array());
    coordinates.filter(|c| c.is_finite()).fold(0.0, |m, c| m.max(c.abs()))
}
