// SPDX-License-Identifier: MIT OR Apache-2.0
//! What may be the nearest as far as f32 tells, kept until the kernel is asked.

use super::nearest::{Best, Nearest, OfAll};
use super::{Leaf, NO_TRIANGLE, Surface};
use crate::math::Vec3;
use crate::simd::float8::{Float8, Simd};
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, prefetch};

/// Candidates that wait for the kernel.
const WAITING: usize = 32;

/// Where the kernel was asked about more triangles than this, and than an eighth of all, most are as near as each other, as
/// in the centre of a ball. Asked about all in their own order it takes less time.
const MANY: usize = 1024;

/// Triangles that may be the nearest, which wait for the kernel.
pub(super) struct Waiting<'a> {
    pub(super) surface: &'a Surface,
    p: Vec3,
    /// How far the nearest is at most.
    limit: f32,
    /// How far each is at least.
    lower: [f32; WAITING],
    triangles: [u32; WAITING],
    count: usize,
    /// How many do not wait any more.
    asked: usize,
    /// Of those that do not wait any more.
    pub(super) best: Best,
}

impl<'a> Waiting<'a> {
    #[inline(always)]
    pub(super) fn new(surface: &'a Surface, p: Vec3) -> Waiting<'a> {
        let (lower, triangles) = ([0.0; WAITING], [0; WAITING]);
        Waiting { surface, p, limit: f32::INFINITY, lower, triangles, count: 0, asked: 0, best: Best::NONE }
    }

    /// Looks at a leaf from a point as the tree places it; the distance beyond which nothing is of interest.
    #[inline(always)]
    pub(super) fn look<S: Simd>(&mut self, simd: S, leaf: &Leaf, at: [f32; 3], slack: f32) -> f32 {
        let [lower, upper] = leaf.estimates.between(simd, at, slack);
        let least = upper.least();
        let limit = if least < self.limit { least } else { self.limit };
        self.limit = limit;
        let mut near = lower.not_above(limit);
        if near != 0 && self.count > WAITING - WIDTH {
            // Where many are as near as each other, the kernel is asked about them on the way.
            self.sift(limit);
            if self.count > WAITING / 2 {
                self.settle(simd);
            }
            if self.asked > MANY.max(self.surface.triangle_count() / 8) {
                self.best = simd.apart(OfAll { surface: self.surface, p: self.p });
                (self.limit, self.count) = (f32::NEG_INFINITY, 0);
                return self.limit;
            }
        }
        let lower = lower.lanes();
        while near != 0 {
            let k = near.trailing_zeros() as usize & (WIDTH - 1);
            near &= near - 1;
            if leaf.triangle[k] != NO_TRIANGLE {
                self.push(leaf.triangle[k], lower[k]);
            }
        }
        limit
    }

    /// Adds one more.
    #[inline(always)]
    pub(super) fn add<S: Simd>(&mut self, simd: S, triangle: u32, lower: f32) {
        if self.count == WAITING {
            self.settle(simd);
        }
        self.push(triangle, lower);
    }

    #[inline(always)]
    fn push(&mut self, triangle: u32, lower: f32) {
        prefetch(&self.surface.triangles.vertex[triangle as usize]);
        prefetch(&self.surface.normals[triangle as usize]);
        let slot = self.count & (WAITING - 1);
        (self.lower[slot], self.triangles[slot]) = (lower, triangle);
        self.count += 1;
    }

    /// Leaves those that are still near enough.
    #[inline(always)]
    fn sift(&mut self, limit: f32) {
        let mut left = 0;
        for k in 0..self.count {
            (self.lower[left], self.triangles[left]) = (self.lower[k], self.triangles[k]);
            // What is no number is never too far.
            let is_far = self.lower[k] > limit;
            left += usize::from(!is_far);
        }
        self.count = left;
    }

    /// Asks the kernel about all that are still near enough.
    #[inline(always)]
    pub(super) fn settle_all<S: Simd>(&mut self, simd: S) {
        self.sift(self.limit);
        self.settle(simd);
    }

    /// Asks the kernel about all that wait.
    #[inline(always)]
    pub(super) fn settle<S: Simd>(&mut self, simd: S) {
        simd.apart(Settle(self));
    }

    /// What was found; of nothing, as where coordinates leave no room for a choice, what the hierarchy finds.
    pub(super) fn nearest(&self) -> Nearest {
        match self.best.triangle {
            NO_TRIANGLE => self.surface.nearest(self.p),
            _ => self.surface.at(self.p, self.best),
        }
    }

    #[inline(always)]
    fn ask_kernel(&mut self) {
        self.asked += self.count;
        for &triangle in &self.triangles[..self.count] {
            for &v in &self.surface.triangles.vertex[triangle as usize] {
                prefetch(&self.surface.vertices[v as usize]);
            }
        }
        for some in self.triangles[..self.count].chunks(WIDTH) {
            self.best.ask(self.surface, self.p, some);
        }
        self.count = 0;
    }
}

struct Settle<'a, 'b>(&'a mut Waiting<'b>);

impl Kernel for Settle<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        self.0.ask_kernel();
    }
}
