// SPDX-License-Identifier: MIT OR Apache-2.0
//! Prisms: a polygon drawn along the third axis of a frame.

use super::outline::Outline;
use super::pack::EXTRUDED;
use super::rounded_box::placement;
use super::support::{UNIT, numbers, widened};
use super::{Facts, Shape};
use crate::error::{Error, Result, try_with_capacity};
use crate::geometry::build::{between, direction, finite, finite_number, positive};
use crate::geometry::placement::Placement;
use crate::math::{Aabb, Vec3, length, unit};
use crate::primitive::profile::length2;
use crate::store::{Packer, Unpacker, wrong};

/// Most sides of a regular prism; a cylinder is the better answer beyond.
const MAX_SIDES: u32 = 1000;

/// How far off the axis the first corner must be, relative to its direction.
const LEAST_SINE: f64 = 1e-9;

pub(in crate::geometry) struct Extruded {
    place: Placement,
    outline: Outline,
    lo: f64,
    hi: f64,
}

impl Extruded {
    /// From `a` to `b` over a regular polygon; `toward` points to its first corner, as far as it is across.
    pub(in crate::geometry) fn prism(
        a: [f64; 3],
        b: [f64; 3],
        toward: [f64; 3],
        sides: u32,
        radius: f64,
    ) -> Result<Extruded> {
        let (axis, hi) = between(["a", "b", "b - a"], a, b)?;
        let wish = direction("toward", toward)?;
        let across = wish - axis * wish.dot(axis);
        if length(across) < LEAST_SINE {
            let [x, y, z] = toward;
            return Err(Error::invalid(format!("toward: ({x}, {y}, {z}) is along b - a")));
        }
        // A second time: what is left of the axis after cancellation.
        let first = unit(across);
        let first = unit(first - axis * first.dot(axis));
        let second = axis.cross(first);
        if !(3..=MAX_SIDES).contains(&sides) {
            return Err(Error::invalid(format!("sides: {sides} is not between 3 and {MAX_SIDES}")));
        }
        let radius = positive("radius", radius)?;
        let mut points = try_with_capacity("corners", sides as usize)?;
        points.extend((0..sides).map(|k| {
            let angle = 2.0 * std::f64::consts::PI * (f64::from(k) / f64::from(sides));
            [radius * libm::cos(angle), radius * libm::sin(angle)]
        }));
        let [u, v, w] = [first, second, axis];
        let place = Placement::new([u.x, v.x, w.x, u.y, v.y, w.y, u.z, v.z, w.z], finite("a", a)?)?;
        Ok(Extruded { place, outline: Outline::of(&points, |_, _| true)?, lo: 0.0, hi })
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Extruded> {
        let (place, [lo, hi]) = (Placement::unpack(from)?, from.numbers()?);
        let outline = Outline::unpack(from)?;
        if lo < hi { Ok(Extruded { place, outline, lo, hi }) } else { Err(wrong("a prism ends before it begins")) }
    }

    pub(in crate::geometry) fn polygon(
        origin: [f64; 3],
        rotation: Option<[f64; 9]>,
        points: &[[f64; 2]],
        z_lo: f64,
        z_hi: f64,
    ) -> Result<Extruded> {
        let place = placement(origin, "origin", rotation)?;
        let (lo, hi) = (finite_number("z_lo", z_lo)?, finite_number("z_hi", z_hi)?);
        if lo >= hi {
            return Err(Error::invalid(format!("z_hi: {hi} is not above z_lo = {lo}")));
        }
        Ok(Extruded { place, outline: Outline::new(points)?, lo, hi })
    }

    fn beyond(&self, z: f64) -> f64 {
        (self.lo - z).max(z - self.hi)
    }

    fn box_of_body(&self) -> Aabb {
        let ([x0, y0], [x1, y1]) = (self.outline.lo(), self.outline.hi());
        Aabb::new(Vec3::new(x0, y0, self.lo), Vec3::new(x1, y1, self.hi))
    }
}

impl Shape for Extruded {
    fn value(&self, p: Vec3) -> f64 {
        let q = self.place.to_body(p);
        let (side, end) = (self.outline.signed([q.x, q.y]).0, self.beyond(q.z));
        let inside = side.max(end);
        if inside <= 0.0 { inside } else { length2(side.max(0.0), end.max(0.0)) }
    }

    /// On the medial axis: the side first, then the upper end.
    fn gradient(&self, p: Vec3) -> Vec3 {
        let q = self.place.to_body(p);
        let (side, [x, y]) = self.outline.signed([q.x, q.y]);
        let end = self.beyond(q.z);
        let up = if q.z - self.hi >= self.lo - q.z { 1.0 } else { -1.0 };
        let (across, along) = if side.max(end) > 0.0 {
            (side.max(0.0), end.max(0.0))
        } else if side >= end {
            (1.0, 0.0)
        } else {
            (0.0, 1.0)
        };
        let sum = unit(Vec3::new(across, along, 0.0));
        self.place.direction(Vec3::new(x * sum.x, y * sum.x, up * sum.y))
    }

    fn facts(&self) -> Facts {
        let b = self.box_of_body();
        let size = b.lo.abs().max(b.hi.abs()).dot(Vec3::ONE);
        let bounds = self.place.box_to_space(widened(b, size));
        let rounding = (UNIT, UNIT * (self.place.shift().abs().max_element() + size));
        let facts = if self.outline.is_convex() { Facts::convex(bounds, size) } else { Facts::exact(bounds, size) };
        Facts { rounding, ..facts }
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(EXTRUDED);
        numbers(add, self.place.numbers().chain([self.lo, self.hi]).chain(self.outline.corners().flatten()));
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(EXTRUDED);
        self.place.pack(out);
        out.numbers([self.lo, self.hi]);
        self.outline.pack(out);
    }

    fn bytes(&self) -> usize {
        size_of::<Extruded>() + self.outline.heap()
    }
}
