// SPDX-License-Identifier: MIT OR Apache-2.0
//! The profiles of `primitive::profile` and polygons, as solids of revolution see them.

use super::outline::Outline;
use super::revolved::Profile;
use crate::primitive::profile::{Cone, Ring, Slab, Wedge, length2};
use crate::store::Packer;

impl Profile for Ring {
    const KIND: u64 = 21;

    fn value(&self, r: f64, z: f64) -> f64 {
        Ring::value(self, r, z)
    }

    fn gradient(&self, r: f64, z: f64) -> [f64; 2] {
        Ring::gradient(self, r, z)
    }

    fn support(&self, s: f64, _c: f64) -> f64 {
        self.major * s + self.minor
    }

    fn size(&self) -> f64 {
        self.major + self.minor
    }

    fn reach(&self) -> (f64, f64) {
        (self.major - self.minor, self.minor)
    }

    fn numbers(&self, add: &mut dyn FnMut(f64)) {
        [self.major, self.minor].into_iter().for_each(add);
    }
}

impl Profile for Slab {
    const KIND: u64 = 22;

    fn value(&self, r: f64, z: f64) -> f64 {
        Slab::value(self, r, z)
    }

    fn gradient(&self, r: f64, z: f64) -> [f64; 2] {
        Slab::gradient(self, r, z)
    }

    fn support(&self, s: f64, c: f64) -> f64 {
        let along = if c > 0.0 {
            self.hi * c
        } else if c < 0.0 {
            self.lo * c
        } else {
            0.0
        };
        self.radius * s + along + self.rounding
    }

    fn size(&self) -> f64 {
        let ends = [self.lo, self.hi].map(|z| if z.is_finite() { z.abs() } else { 0.0 });
        self.radius + self.rounding + ends[0].max(ends[1])
    }

    fn reach(&self) -> (f64, f64) {
        (f64::INFINITY, self.rounding)
    }

    fn numbers(&self, add: &mut dyn FnMut(f64)) {
        [self.radius, self.lo, self.hi, self.rounding].into_iter().for_each(add);
    }
}

impl Profile for Wedge {
    const KIND: u64 = 23;

    fn value(&self, r: f64, z: f64) -> f64 {
        Wedge::value(self, r, z)
    }

    fn gradient(&self, r: f64, z: f64) -> [f64; 2] {
        Wedge::gradient(self, r, z)
    }

    fn support(&self, s: f64, c: f64) -> f64 {
        // Far out, rounding turns the sides by less than this.
        if s * self.sin + c * self.cos < -1e-12 { 0.0 } else { f64::INFINITY }
    }

    fn size(&self) -> f64 {
        0.0
    }

    fn reach(&self) -> (f64, f64) {
        (f64::INFINITY, 0.0)
    }

    fn numbers(&self, add: &mut dyn FnMut(f64)) {
        [self.sin, self.cos].into_iter().for_each(add);
    }
}

impl Profile for Cone {
    const KIND: u64 = 24;

    fn value(&self, r: f64, z: f64) -> f64 {
        Cone::value(self, r, z)
    }

    fn gradient(&self, r: f64, z: f64) -> [f64; 2] {
        Cone::gradient(self, r, z)
    }

    fn support(&self, s: f64, c: f64) -> f64 {
        (self.radius * s + self.height * c).max(0.0)
    }

    fn size(&self) -> f64 {
        self.slant
    }

    fn reach(&self) -> (f64, f64) {
        (f64::INFINITY, 0.0)
    }

    fn numbers(&self, add: &mut dyn FnMut(f64)) {
        [self.wedge.sin, self.wedge.cos, self.height].into_iter().for_each(add);
    }
}

impl Profile for Outline {
    const KIND: u64 = 25;

    fn value(&self, r: f64, z: f64) -> f64 {
        self.signed([r, z]).0
    }

    fn gradient(&self, r: f64, z: f64) -> [f64; 2] {
        self.signed([r, z]).1
    }

    fn support(&self, s: f64, c: f64) -> f64 {
        self.corners().fold(f64::NEG_INFINITY, |most, p| most.max(p[0] * s + p[1] * c))
    }

    fn size(&self) -> f64 {
        self.corners().fold(0.0, |most: f64, p| most.max(length2(p[0], p[1])))
    }

    fn reach(&self) -> (f64, f64) {
        (if self.is_convex_around_axis() { f64::INFINITY } else { 0.0 }, 0.0)
    }

    fn numbers(&self, add: &mut dyn FnMut(f64)) {
        self.corners().flatten().for_each(add);
    }

    fn pack(&self, out: &mut Packer) {
        Outline::pack(self, out);
    }

    fn heap(&self) -> usize {
        Outline::heap(self)
    }
}
