// SPDX-License-Identifier: MIT OR Apache-2.0
//! The half space behind a plane.

use super::pack::{PLANE, unit};
use super::support::{UNIT, numbers};
use super::{Facts, Shape};
use crate::error::Result;
use crate::geometry::build::{direction, finite};
use crate::math::{Aabb, Interval, Vec3};
use crate::store::{Packer, Unpacker};

pub(in crate::geometry) struct Plane {
    point: Vec3,
    normal: Vec3,
}

impl Plane {
    /// The normal points out of the body.
    pub(in crate::geometry) fn new(point: [f64; 3], normal: [f64; 3]) -> Result<Plane> {
        Ok(Plane { point: finite("point", point)?, normal: direction("normal", normal)? })
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Plane> {
        Ok(Plane { point: from.vector()?, normal: unit(from)? })
    }

    /// Where the plane crosses axis `k`, for a normal along it: the computed value's sign is exact there.
    fn half_spaces(&self) -> (Aabb, Aabb) {
        let (mut body, mut rest) = (Aabb::ALL, Aabb::ALL);
        for k in 0..3 {
            if self.normal[k] == 1.0 {
                (body.hi[k], rest.lo[k]) = (self.point[k], self.point[k]);
            } else if self.normal[k] == -1.0 {
                (body.lo[k], rest.hi[k]) = (self.point[k], self.point[k]);
            }
        }
        (body, rest)
    }
}

impl Shape for Plane {
    fn value(&self, p: Vec3) -> f64 {
        (p - self.point).dot(self.normal)
    }

    fn gradient(&self, _p: Vec3) -> Vec3 {
        self.normal
    }

    fn facts(&self) -> Facts {
        let exactly = self.normal.abs().max_element() == 1.0 && self.normal.abs().dot(Vec3::ONE) == 1.0;
        let (bounds, rest) = if exactly { self.half_spaces() } else { (Aabb::ALL, Aabb::ALL) };
        let size = self.point.abs().max_element();
        Facts { rest, reach_inward: f64::INFINITY, rounding: (UNIT, UNIT * size), ..Facts::convex(bounds, size) }
    }

    /// At the corners along the normal.
    fn range(&self, b: Aabb) -> Interval {
        let rising = self.normal.cmpgt(Vec3::ZERO);
        let error = UNIT * (b.lo.abs().max(b.hi.abs()).max_element() + self.point.abs().max_element());
        let (least, most) = (Vec3::select(rising, b.lo, b.hi), Vec3::select(rising, b.hi, b.lo));
        Interval::new(self.value(least) - error, self.value(most) + error)
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(PLANE);
        numbers(add, self.point.to_array().into_iter().chain(self.normal.to_array()));
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(PLANE);
        out.vector(self.point);
        out.vector(self.normal);
    }

    fn bytes(&self) -> usize {
        size_of::<Plane>()
    }
}
