// SPDX-License-Identifier: MIT OR Apache-2.0
//! The ball.

use super::{Crossings, Facts, Shape};
use crate::geometry::summary::grown;
use crate::math::{Aabb, Vec3};
use crate::primitive::sphere;

#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct Sphere {
    pub(in crate::geometry) center: Vec3,
    pub(in crate::geometry) radius: f64,
}

impl Shape for Sphere {
    #[inline]
    fn value(&self, p: Vec3) -> f64 {
        sphere::value(self.center, self.radius, p)
    }

    fn gradient(&self, p: Vec3) -> Vec3 {
        sphere::gradient(self.center, p)
    }

    fn facts(&self) -> Facts {
        let bounds = grown(Aabb::new(self.center, self.center), Vec3::splat(self.radius));
        let unit = 16.0 * f64::EPSILON;
        let rounding = (unit, unit * (self.center.abs().max_element() + self.radius));
        Facts { reach_inward: self.radius, rounding, ..Facts::convex(bounds, 0.0) }
    }

    fn crossings(&self, a: Vec3, b: Vec3) -> Crossings {
        match sphere::interval(self.center, self.radius, a, b) {
            Some((enter, leave)) => {
                let normal = |t: f64| sphere::gradient(self.center, a + (b - a) * t);
                Crossings::Between((enter, normal(enter)), (leave, normal(leave)))
            }
            None => Crossings::Misses,
        }
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(1);
        self.center.to_array().iter().chain([&self.radius]).for_each(|x| add((x + 0.0).to_bits()));
    }

    fn bytes(&self) -> usize {
        size_of::<Sphere>()
    }
}
