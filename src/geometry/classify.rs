// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether a box is wholly inside or outside, from numbers between which the values in it lie. Never a lie:
//! -1 and +1 mean that the value, rounding included, has that strict sign at every double of the closed box.

use super::Geometry;
use super::node::Node;
use super::properties::Kind;
use super::shape::Shape;
use super::summary::extent;
use crate::math::{Aabb, Interval, Vec3, length};

/// Some number above, or below, zero.
pub(super) const POSITIVE: Interval = Interval { lo: LEAST, hi: f64::INFINITY };
const NEGATIVE: Interval = Interval { lo: f64::NEG_INFINITY, hi: -LEAST };

/// The least positive number.
pub(super) const LEAST: f64 = f64::from_bits(1);

impl Geometry {
    /// -1 inside, +1 outside, 0 mixed, not known, or not a box (NaN, lo > hi).
    pub fn classify(&self, b: Aabb) -> i32 {
        if b.is_empty() {
            return 0;
        }
        if b.lo == b.hi {
            return Interval::point(self.value(b.lo)).sign();
        }
        if let Some(side) = self.side(b) {
            return side;
        }
        if self.summary().may_fail || b.is_finite() {
            return if b.is_finite() { self.range(b).sign() } else { 0 };
        }
        i32::from(self.is_apart(self.summary().bounds, b)) - i32::from(self.is_apart(self.summary().rest, b))
    }

    /// The class of a box that is not a point, where it takes no numbers to know: of a mesh.
    fn side(&self, b: Aabb) -> Option<i32> {
        match self.node() {
            Node::Surface(surface) => surface.side(b),
            Node::Complement(g) => g.side(b).map(|side| -side),
            Node::Translate(g, shift) => g.side(Aabb::new(b.lo - *shift, b.hi - *shift)),
            Node::Part(g, _) => g.side(b),
            _ => None,
        }
    }

    /// Whether a box keeps clear of bounds of this body by more than rounding.
    fn is_apart(&self, bounds: Aabb, b: Aabb) -> bool {
        if bounds == Aabb::EMPTY {
            return true;
        }
        let s = self.summary();
        let margin = s.error(extent(b)) + s.error(extent(bounds));
        (0..3).any(|k| b.lo[k] - bounds.hi[k] > margin || bounds.lo[k] - b.hi[k] > margin)
    }

    /// From the bounds alone, of what has a value everywhere.
    pub(super) fn range_from_bounds(&self, b: Aabb) -> Interval {
        let s = self.summary();
        match (self.is_apart(s.bounds, b), self.is_apart(s.rest, b)) {
            (true, _) => POSITIVE,
            (_, true) => NEGATIVE,
            _ => Interval::ALL,
        }
    }

    /// Numbers between which the value lies at every double of a finite box, as computed.
    pub(super) fn range(&self, b: Aabb) -> Interval {
        if b.lo == b.hi {
            let value = self.raw_value(b.lo);
            return if value.is_nan() { Interval::ALL } else { Interval::point(value) };
        }
        let s = self.summary();
        // What may have no value has it within its bounds at most, unless the user vouches for its distance.
        let is_known = !s.may_fail || s.kind == Kind::Exact || s.functions;
        if is_known && self.is_apart(s.bounds, b) {
            return POSITIVE;
        }
        if is_known && self.is_apart(s.rest, b) {
            return NEGATIVE;
        }
        let middle = self.range_from_middle(b);
        if middle.sign() != 0 { middle } else { middle.intersection(self.range_from_parts(b)) }
    }

    /// From the value in the middle: by the Lipschitz constant, and because a distance's sign is the same
    /// within it.
    pub(super) fn range_from_middle(&self, b: Aabb) -> Interval {
        let s = self.summary();
        if s.kind == Kind::SignOnly && !s.lipschitz.is_finite() {
            return Interval::ALL;
        }
        let center = b.center();
        let half = length(Vec3::max(b.hi - center, center - b.lo)) * (1.0 + 1e-9);
        let value = self.raw_value(center);
        if !value.is_finite() {
            return Interval::ALL;
        }
        let error = 2.0 * s.error(extent(b));
        if s.jumps && self.side(b).unwrap_or(0) == 0 {
            // Of a mesh alone, either sign of what the value can be; of what is made of several, another of them counts.
            let most = if self.has_blocks() { value.abs() + s.lipschitz * half + error } else { f64::INFINITY };
            return Interval::around(0.0, most);
        }
        let range = match s.lipschitz.is_finite() {
            true => Interval::around(value, s.lipschitz * half + error),
            false => Interval::ALL,
        };
        match value > 0.0 {
            _ if s.kind > Kind::LowerBound || value.abs() <= half + error => range,
            true => range.intersection(POSITIVE),
            false => range.intersection(NEGATIVE),
        }
    }

    /// From what the leaves below know, by the logic of the tree.
    fn range_from_parts(&self, b: Aabb) -> Interval {
        match self.node() {
            Node::Sphere(sphere) => sphere.range(b),
            Node::Shape(shape) => shape.range(b),
            Node::Surface(surface) => match surface.side(b) {
                Some(1) => POSITIVE,
                Some(-1) => NEGATIVE,
                _ => Interval::ALL,
            },
            Node::Function { options, .. } if options.bounds.intersection(b).is_empty() => POSITIVE,
            Node::Function { function, .. } => function.range(b).unwrap_or(Interval::ALL),
            Node::Union(parts) => parts.range(b, 0.0),
            Node::Intersection(parts) => -parts.range(b, 0.0),
            Node::Smooth(smooth) => smooth.range(b),
            Node::Repeat(repeat) => repeat.range(b),
            Node::Complement(g) => -g.range(b),
            // Subtraction is monotone: the shifted box holds every shifted point, rounding included.
            Node::Translate(g, shift) => g.range(Aabb::new(b.lo - *shift, b.hi - *shift)),
            Node::Place(g, placement) => scaled(g.range(placement.box_to_body(b)), placement.scale()),
            Node::Map(g, map) => map.range(b, g.range(map.box_of(b))),
            Node::Level(g, level) => level.range(g.range(b)),
            Node::Stencil(g, stencil) => stencil.range(g, b),
            Node::Part(g, _) => g.range(b),
        }
    }
}

/// Multiplication by a positive factor is monotone, rounding included; what underflows may be zero.
pub(super) fn scaled(range: Interval, factor: f64) -> Interval {
    Interval::new(range.lo * factor, range.hi * factor)
}
