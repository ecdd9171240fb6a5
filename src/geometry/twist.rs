// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bodies twisted about the z axis. A twist stretches without limit with the distance from the axis; but a body
//! within bounds is twisted within bounds. There its value is divided by the most by which they are stretched,
//! and beyond them it is at least the distance to them, with the body seen from their nearest point. Both are
//! then as steep as the body's value is, and so is the greater of them.

use super::properties::Kind;
use super::shape::{Cuboid, Shape};
use super::summary::Summary;
use crate::error::Result;
use crate::math::{Aabb, Interval, Vec3, length};
use crate::primitive::cuboid;
use crate::store::{Packer, Unpacker, wrong};

#[derive(Clone, Copy, Debug)]
pub(super) struct Twist {
    /// Radians a unit of height.
    rate: f64,
    /// Bounds of the twisted body, and one over the stretch within them; none where they are not known.
    within: Option<(Aabb, f64)>,
}

impl Twist {
    /// Of a child of which `s` is known.
    pub(super) fn new(rate: f64, s: &Summary) -> Twist {
        let b = turned_about_z(s.bounds);
        // At the corners of the bounds: a rotation and a shear by the speed along the height.
        let shear = rate.abs() * length(Vec3::new(b.hi.x, b.hi.y, 0.0));
        let stretch = 0.5 * (shear + (shear * shear + 4.0).sqrt()) * (1.0 + 1e-9);
        let is_known = b.is_finite() && b.lo.cmplt(b.hi).all() && s.lipschitz.is_finite() && stretch.is_finite();
        Twist { rate, within: is_known.then_some((b, 1.0 / stretch)) }
    }

    /// With the bounds, which may be those of a larger child that this one was cut out of.
    pub(super) fn pack(&self, out: &mut Packer) {
        out.number(self.rate);
        out.word(u64::from(self.within.is_some()));
        let (b, factor) = self.within.unwrap_or((Aabb::new(Vec3::ZERO, Vec3::ZERO), 1.0));
        out.vector(b.lo);
        out.vector(b.hi);
        out.number(factor);
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Twist> {
        let (rate, is_known) = (from.finite()?, from.flag()?);
        let (b, factor) = (Aabb::new(from.vector()?, from.vector()?), from.finite()?);
        let is_fit = !b.is_empty() && factor > 0.0 && factor <= 1.0;
        if is_fit { Ok(Twist { rate, within: is_known.then_some((b, factor)) }) } else { Err(wrong("a twist is none")) }
    }

    /// The child's point.
    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        let p = self.nearest(p);
        let (s, c) = turn(self.rate * p.z);
        Vec3::new(c * p.x + s * p.y, c * p.y - s * p.x, p.z)
    }

    fn nearest(&self, p: Vec3) -> Vec3 {
        self.within.map_or(p, |(b, _)| p.clamp(b.lo, b.hi))
    }

    /// The value, from the child's at the mapped point.
    pub(super) fn value(&self, p: Vec3, f: f64) -> f64 {
        let Some((b, factor)) = self.within else { return f };
        let (own, around) = (f * factor, cuboid::value(b, p));
        if own < around { around } else { own }
    }

    /// The gradient, from the child's value and gradient at the mapped point.
    pub(super) fn gradient(&self, p: Vec3, f: f64, g: Vec3) -> Vec3 {
        let near = self.nearest(p);
        let (s, c) = turn(self.rate * near.z);
        let q = self.point(p);
        let own = Vec3::new(c * g.x - s * g.y, s * g.x + c * g.y, g.z + self.rate * (g.x * q.y - g.y * q.x));
        match self.within {
            None => own,
            Some((b, factor)) if f * factor < cuboid::value(b, p) => cuboid::gradient(b, p),
            // The nearest point does not move along where it is on the border.
            Some((_, factor)) => Vec3::select(near.cmpeq(p), own * factor, Vec3::ZERO),
        }
    }

    /// A box around the mapped points of a box, rounding included.
    pub(super) fn box_of(&self, b: Aabb) -> Aabb {
        let b = Aabb::new(self.nearest(b.lo), self.nearest(b.hi));
        let corner = b.lo.abs().max(b.hi.abs());
        let radius = length(Vec3::new(corner.x, corner.y, 0.0)) * (1.0 + 1e-12);
        let half = (0.5 * (b.hi.z - b.lo.z) * self.rate).abs();
        let middle = self.point(b.center());
        let rounding = 1e-12 * (1.0 + (self.rate * corner.z).abs());
        let reach = length((b.hi - b.lo).with_z(0.0)) * 0.5 + radius * (half + rounding);
        let reach = if reach < 2.0 * radius { reach } else { 2.0 * radius };
        let reach = Vec3::new(reach, reach, 0.0) * (1.0 + 1e-12);
        Aabb::new((middle - reach).with_z(b.lo.z), (middle + reach).with_z(b.hi.z))
    }

    /// The values of a box, from the child's in the mapped one.
    pub(super) fn range(&self, b: Aabb, f: Interval) -> Interval {
        let Some((bounds, factor)) = self.within else { return f };
        Interval::new(f.lo * factor, f.hi * factor).max(Cuboid(bounds).range(b))
    }

    /// Of the node over a child of which `s` is known.
    pub(super) fn summary(&self, s: Summary) -> Summary {
        let base = Summary { reach_outward: 0.0, reach_inward: 0.0, ..s };
        let steep = s.steepness();
        let Some((b, factor)) = self.within else {
            return Summary {
                bounds: turned_about_z(s.bounds),
                rest: turned_about_z(s.rest),
                kind: Kind::SignOnly,
                lipschitz: f64::INFINITY,
                spread: f64::INFINITY,
                spread_rest: f64::INFINITY,
                spread_axis: f64::INFINITY,
                rounding: (s.rounding.0 + 64.0 * f64::EPSILON * steep, s.rounding.1),
                ..base
            };
        };
        let size = length(b.lo.abs().max(b.hi.abs()));
        // The angle is rounded, and turns the farthest point by so much.
        let turned = 16.0 * f64::EPSILON * (1.0 + (self.rate * b.lo.z.abs().max(b.hi.z.abs())).abs()) * size;
        let own = s.rounding.0 * size + s.rounding.1 + turned * steep;
        let unit = 16.0 * f64::EPSILON;
        Summary {
            bounds: b,
            rest: Aabb::ALL,
            kind: if s.lipschitz <= 1.0 { Kind::LowerBound } else { Kind::SignOnly },
            lipschitz: s.lipschitz.max(1.0),
            // It is at least the distance to its bounds.
            spread: 1.0,
            spread_rest: 1.0,
            spread_axis: 1.0,
            rounding: (unit, own * factor.min(1.0) + unit * size),
            magnitude: s.magnitude + steep * size,
            ..base
        }
    }

    /// The numbers that define it, with the child.
    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> {
        [self.rate].into_iter()
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
    } else if b == Aabb::EMPTY {
        b
    } else {
        Aabb::ALL
    }
}
