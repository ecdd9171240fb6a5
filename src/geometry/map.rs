// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bodies seen through a map of space that is no placement: the value comes from the child's at the mapped
//! point.

use super::linear::Linear;
use super::properties::Kind;
use super::summary::{Summary, grown};
use super::twist::Twist;
use crate::math::{Aabb, Interval, Vec3};

/// From a point of space to a point of the child.
#[derive(Clone, Copy, Debug)]
pub(super) enum Map {
    Linear(Linear),
    /// Stretched apart: p - clamp(p, -e, e).
    Elongate(Vec3),
    /// Turned about the z axis, the more the higher.
    Twist(Twist),
}

impl Map {
    /// The child's point.
    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        match self {
            Map::Linear(linear) => linear.point(p),
            Map::Elongate(e) => p - p.clamp(-*e, *e),
            Map::Twist(twist) => twist.point(p),
        }
    }

    /// The value at `p`, from the child's at the mapped point.
    pub(super) fn value(&self, p: Vec3, f: f64) -> f64 {
        match self {
            Map::Linear(linear) => linear.factor() * f,
            Map::Elongate(_) => f,
            Map::Twist(twist) => twist.value(p, f),
        }
    }

    /// The gradient at `p`, from the child's value and gradient at the mapped point: by the transpose of the
    /// derivative.
    pub(super) fn gradient(&self, p: Vec3, f: f64, g: Vec3) -> Vec3 {
        match self {
            Map::Linear(linear) => linear.gradient(g),
            Map::Elongate(e) => Vec3::select(p.abs().cmpgt(*e), g, Vec3::ZERO),
            Map::Twist(twist) => twist.gradient(p, f, g),
        }
    }

    /// The values of a box `b`, from the child's in the mapped one. Multiplication by a positive factor is
    /// monotone, rounding included.
    pub(super) fn range(&self, b: Aabb, f: Interval) -> Interval {
        match self {
            Map::Linear(linear) => Interval::new(linear.factor() * f.lo, linear.factor() * f.hi),
            Map::Elongate(_) => f,
            Map::Twist(twist) => twist.range(b, f),
        }
    }

    /// Whether straight lines stay straight.
    pub(super) fn is_linear(&self) -> bool {
        matches!(self, Map::Linear(_))
    }

    /// A box around the mapped points of a box, rounding included.
    pub(super) fn box_of(&self, b: Aabb) -> Aabb {
        match self {
            Map::Linear(linear) => linear.box_of(b),
            // Monotone along each axis, rounding included.
            Map::Elongate(_) => Aabb::new(self.point(b.lo), self.point(b.hi)),
            Map::Twist(twist) => twist.box_of(b),
        }
    }

    /// Of the node over a child of which `s` is known.
    pub(super) fn summary(&self, s: Summary) -> Summary {
        let kind = if s.kind != Kind::SignOnly && s.lipschitz <= 1.0 { Kind::LowerBound } else { Kind::SignOnly };
        let base = Summary { reach_outward: 0.0, reach_inward: 0.0, ..s };
        let steep = s.steepness();
        match self {
            Map::Linear(linear) => linear.summary(base, kind),
            Map::Elongate(e) => Summary {
                bounds: grown(s.bounds, *e),
                rest: grown(s.rest, *e),
                kind,
                rounding: (s.rounding.0 + 4.0 * f64::EPSILON * steep, s.rounding.1),
                ..base
            },
            Map::Twist(twist) => twist.summary(s),
        }
    }

    pub(super) fn words(&self, add: &mut dyn FnMut(u64)) {
        let mut number = |x: f64| add((x + 0.0).to_bits());
        match self {
            Map::Linear(linear) => {
                number(1.0);
                linear.numbers().for_each(number);
            }
            Map::Elongate(e) => {
                number(2.0);
                e.to_array().into_iter().for_each(number);
            }
            Map::Twist(twist) => {
                number(3.0);
                twist.numbers().for_each(number);
            }
        }
    }
}
