// SPDX-License-Identifier: MIT OR Apache-2.0
//! Random numbers and boxes for the tests of shapes.

use crate::math::{Aabb, Vec3};

/// Numbers that look random, the same in every run.
pub(super) struct Random(pub(super) u64);

impl Random {
    /// From 0 to 1.
    pub(super) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(super) fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    pub(super) fn point(&mut self, b: Aabb) -> Vec3 {
        Vec3::new(self.between(b.lo.x, b.hi.x), self.between(b.lo.y, b.hi.y), self.between(b.lo.z, b.hi.z))
    }

    /// Some box within `b`.
    pub(super) fn aabb(&mut self, b: Aabb) -> Aabb {
        let (p, q) = (self.point(b), self.point(b));
        let size = self.unit();
        Aabb::of([p, p + (q - p) * size * size])
    }
}
