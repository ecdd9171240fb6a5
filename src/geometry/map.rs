// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bodies seen through a map of space that is no rigid placement: the value is that of the child at the
//! mapped point, times a factor.

use super::linear::Linear;
use super::properties::Kind;
use super::summary::{Summary, grown};
use crate::math::{Aabb, Vec3, length};

/// From a point of space to a point of the child.
#[derive(Clone, Copy, Debug)]
pub(super) enum Map {
    Linear(Linear),
    /// Stretched apart: p - clamp(p, -e, e).
    Elongate(Vec3),
    /// Turned about the z axis by so many radians a unit of height.
    Twist(f64),
}

impl Map {
    /// The child's point.
    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        match self {
            Map::Linear(linear) => linear.point(p),
            Map::Elongate(e) => p - p.clamp(-*e, *e),
            Map::Twist(rate) => {
                let (s, c) = turn(*rate * p.z);
                Vec3::new(c * p.x + s * p.y, c * p.y - s * p.x, p.z)
            }
        }
    }

    /// What the child's value is multiplied by.
    pub(super) fn factor(&self) -> f64 {
        match self {
            Map::Linear(linear) => linear.factor(),
            Map::Elongate(_) | Map::Twist(_) => 1.0,
        }
    }

    /// The gradient at `p` from the child's at the mapped point: by the transpose of the derivative.
    pub(super) fn gradient(&self, p: Vec3, g: Vec3) -> Vec3 {
        match self {
            Map::Linear(linear) => linear.gradient(g),
            Map::Elongate(e) => Vec3::select(p.abs().cmpgt(*e), g, Vec3::ZERO),
            Map::Twist(rate) => {
                let (s, c) = turn(*rate * p.z);
                let q = self.point(p);
                Vec3::new(c * g.x - s * g.y, s * g.x + c * g.y, g.z + rate * (g.x * q.y - g.y * q.x))
            }
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
            Map::Twist(rate) => {
                let corner = b.lo.abs().max(b.hi.abs());
                let radius = length(Vec3::new(corner.x, corner.y, 0.0)) * (1.0 + 1e-12);
                let half = (0.5 * (b.hi.z - b.lo.z) * rate).abs();
                let middle = self.point(b.center());
                let reach =
                    length((b.hi - b.lo).with_z(0.0)) * 0.5 + radius * (half + 1e-12 * (1.0 + (rate * corner.z).abs()));
                let reach = if reach < 2.0 * radius { reach } else { 2.0 * radius };
                let reach = Vec3::new(reach, reach, 0.0) * (1.0 + 1e-12);
                Aabb::new((middle - reach).with_z(b.lo.z), (middle + reach).with_z(b.hi.z))
            }
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
            Map::Twist(_) => Summary {
                bounds: turned_about_z(s.bounds),
                rest: turned_about_z(s.rest),
                kind: Kind::SignOnly,
                lipschitz: f64::INFINITY,
                spread: f64::INFINITY,
                spread_rest: f64::INFINITY,
                spread_axis: f64::INFINITY,
                rounding: (s.rounding.0 + 64.0 * f64::EPSILON * steep, s.rounding.1),
                ..base
            },
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
            Map::Twist(rate) => {
                number(3.0);
                number(*rate);
            }
        }
    }
}

fn turn(angle: f64) -> (f64, f64) {
    (libm::sin(angle), libm::cos(angle))
}

/// Around a box turned about the z axis by any angle.
fn turned_about_z(b: Aabb) -> Aabb {
    let corner = b.lo.abs().max(b.hi.abs());
    let radius = length(Vec3::new(corner.x, corner.y, 0.0)) * (1.0 + 1e-12);
    if radius.is_finite() && b.lo.cmple(b.hi).all() {
        Aabb::new(Vec3::new(-radius, -radius, b.lo.z), Vec3::new(radius, radius, b.hi.z))
    } else if b.is_empty() && b == Aabb::EMPTY {
        b
    } else {
        Aabb::ALL
    }
}
