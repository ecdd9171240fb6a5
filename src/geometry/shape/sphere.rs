// SPDX-License-Identifier: MIT OR Apache-2.0
//! The ball.

use super::lanes::BallValues;
use super::pack::SPHERE;
use super::support::{box_around, numbers};
use super::{Crossings, Facts, Shape};
use crate::error::Result;
use crate::geometry::build::{finite, positive};
use crate::geometry::points::Points;
use crate::math::{Aabb, Interval, Vec3, length};
use crate::primitive::sphere;
use crate::simd::dispatch;
use crate::store::Packer;

#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct Sphere {
    pub center: Vec3,
    pub radius: f64,
}

impl Sphere {
    pub(in crate::geometry) fn new(center: [f64; 3], radius: f64) -> Result<Sphere> {
        Ok(Sphere { center: finite("center", center)?, radius: positive("radius", radius)? })
    }
}

impl Shape for Sphere {
    #[inline]
    fn value(&self, p: Vec3) -> f64 {
        sphere::value(self.center, self.radius, p)
    }

    fn values(&self, points: Points, out: &mut [f64]) {
        dispatch(BallValues { ball: self, points, out });
    }

    fn gradient(&self, p: Vec3) -> Vec3 {
        sphere::gradient(self.center, p)
    }

    fn facts(&self) -> Facts {
        let reach = Vec3::splat(self.radius);
        let unit = 16.0 * f64::EPSILON;
        Facts {
            reach_inward: self.radius,
            rounding: (unit, unit * (self.center.abs().max_element() + self.radius)),
            ..Facts::convex(box_around(self.center, reach, reach, 0.0), 0.0)
        }
    }

    /// From the nearest to the farthest point of the box.
    fn range(&self, b: Aabb) -> Interval {
        let (below, above) = (b.lo - self.center, b.hi - self.center);
        let least = length(below.max(-above).max(Vec3::ZERO)) - self.radius;
        let most = length(below.abs().max(above.abs())) - self.radius;
        let (by_extent, fixed) = self.facts().rounding;
        let error = by_extent * b.lo.abs().max(b.hi.abs()).max_element() + fixed;
        Interval::new(least - error, most + error)
    }

    fn crossings(&self, a: Vec3, b: Vec3) -> Crossings {
        match sphere::interval(self.center, self.radius, a, b) {
            None => Crossings::Misses,
            Some((enter, leave)) => {
                let at = |t: f64| (t, sphere::gradient(self.center, a + (b - a) * t));
                Crossings::Between(at(enter), at(leave))
            }
        }
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(SPHERE);
        numbers(add, self.center.to_array().into_iter().chain([self.radius]));
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(SPHERE);
        out.vector(self.center);
        out.number(self.radius);
    }

    fn bytes(&self) -> usize {
        size_of::<Sphere>()
    }
}
