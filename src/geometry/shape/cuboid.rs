// SPDX-License-Identifier: MIT OR Apache-2.0
//! The axis-aligned box.

use super::{Crossings, Facts, Shape};
use crate::math::{Aabb, Vec3};
use crate::primitive::cuboid;

#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct Cuboid(pub(in crate::geometry) Aabb);

impl Shape for Cuboid {
    fn value(&self, p: Vec3) -> f64 {
        cuboid::value(self.0, p)
    }

    fn gradient(&self, p: Vec3) -> Vec3 {
        cuboid::gradient(self.0, p)
    }

    fn facts(&self) -> Facts {
        let unit = 16.0 * f64::EPSILON;
        let size = self.0.lo.abs().max(self.0.hi.abs()).max_element();
        Facts { rounding: (unit, unit * size), ..Facts::convex(self.0, size) }
    }

    fn crossings(&self, a: Vec3, b: Vec3) -> Crossings {
        match cuboid::interval(self.0, a, b) {
            Some((enter, leave)) => Crossings::Between(enter, leave),
            None => Crossings::Misses,
        }
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(2);
        let corners = self.0.lo.to_array().into_iter().chain(self.0.hi.to_array());
        corners.for_each(|x| add((x + 0.0).to_bits()));
    }

    fn bytes(&self) -> usize {
        size_of::<Cuboid>()
    }
}
