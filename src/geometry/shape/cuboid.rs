// SPDX-License-Identifier: MIT OR Apache-2.0
//! The axis-aligned box.

use super::lanes::BoxValues;
use super::pack::{CUBOID, pack_box};
use super::support::numbers;
use super::{Crossings, Facts, Shape};
use crate::error::{Error, Result};
use crate::geometry::build::finite;
use crate::geometry::points::Points;
use crate::math::{Aabb, Interval, Vec3};
use crate::primitive::cuboid;
use crate::simd::dispatch;
use crate::store::Packer;

pub(in crate::geometry) struct Cuboid(pub Aabb);

impl Cuboid {
    pub(in crate::geometry) fn new(lo: [f64; 3], hi: [f64; 3]) -> Result<Cuboid> {
        let b = Aabb::new(finite("lo", lo)?, finite("hi", hi)?);
        match (0..3).find(|&k| b.lo[k] >= b.hi[k]) {
            Some(k) => Err(Error::invalid(format!("hi[{k}]: {} is not above lo[{k}] = {}", b.hi[k], b.lo[k]))),
            None => Ok(Cuboid(b)),
        }
    }
}

impl Shape for Cuboid {
    fn value(&self, p: Vec3) -> f64 {
        cuboid::value(self.0, p)
    }

    fn values(&self, points: Points, out: &mut [f64]) {
        dispatch(BoxValues { b: self.0, points, out });
    }

    fn gradient(&self, p: Vec3) -> Vec3 {
        cuboid::gradient(self.0, p)
    }

    /// The sign of the value is exact, and so is the box.
    fn facts(&self) -> Facts {
        let size = self.0.lo.abs().max(self.0.hi.abs()).max_element();
        let unit = 16.0 * f64::EPSILON;
        Facts { rounding: (unit, unit * size), ..Facts::convex(self.0, size) }
    }

    /// The value rises with the excess over each pair of faces: least nearest to the middle, most at a corner.
    fn range(&self, b: Aabb) -> Interval {
        let nearest = self.0.center().clamp(b.lo, b.hi);
        let lower = self.0.center().cmpge(b.center());
        let (by_extent, fixed) = self.facts().rounding;
        let error = by_extent * b.lo.abs().max(b.hi.abs()).max_element() + fixed;
        let most = cuboid::value(self.0, Vec3::select(lower, b.lo, b.hi));
        Interval::new(cuboid::value(self.0, nearest) - error, most + error)
    }

    fn crossings(&self, a: Vec3, b: Vec3) -> Crossings {
        cuboid::interval(self.0, a, b).map_or(Crossings::Misses, |(enter, leave)| Crossings::Between(enter, leave))
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(CUBOID);
        numbers(add, self.0.lo.to_array().into_iter().chain(self.0.hi.to_array()));
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(CUBOID);
        pack_box(self.0, out);
    }

    fn bytes(&self) -> usize {
        size_of::<Cuboid>()
    }
}
