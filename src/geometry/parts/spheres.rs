// SPDX-License-Identifier: MIT OR Apache-2.0
//! Balls eight side by side: the bits of [`crate::primitive::sphere::value`] for each.

use crate::geometry::shape::Sphere;
use crate::math::Vec3;
use crate::primitive::sphere;
use crate::simd::lanes::{F64s, F64x8, Lanes, WIDTH};
use crate::store::plain;

/// Marks the unused lanes of a block.
const NO_PART: u32 = u32::MAX;

/// The balls of one leaf.
#[derive(Clone, Copy)]
#[repr(C)]
pub(super) struct Block {
    center: [F64x8; 3],
    radius: F64x8,
    /// Part of each lane; an unused lane repeats the first one's shape.
    pub(super) part: [u32; WIDTH],
}

plain! {
    Block { center: [F64x8; 3], radius: F64x8, part: [u32; WIDTH] }
}

impl Block {
    /// Up to eight balls; at least one.
    pub(super) fn new(spheres: &[(u32, Sphere)]) -> Block {
        let lane = |k: usize| &spheres[if k < spheres.len() { k } else { 0 }].1;
        Block {
            center: std::array::from_fn(|axis| F64s(std::array::from_fn(|k| lane(k).center[axis]))),
            radius: F64s(std::array::from_fn(|k| lane(k).radius)),
            part: std::array::from_fn(|k| spheres.get(k).map_or(NO_PART, |s| s.0)),
        }
    }

    /// Whether both are the same numbers.
    pub(super) fn is(&self, other: &Block) -> bool {
        let same = |a: &F64x8, b: &F64x8| a.0 == b.0;
        self.part == other.part
            && same(&self.radius, &other.radius)
            && (0..3).all(|axis| same(&self.center[axis], &other.center[axis]))
    }

    pub(super) fn parts(&self) -> impl Iterator<Item = u32> {
        self.part.into_iter().filter(|&k| k != NO_PART)
    }

    /// The value of each.
    #[inline(always)]
    pub(super) fn values(&self, p: Vec3) -> F64x8 {
        let x = F64x8::splat(p.x) - self.center[0];
        let y = F64x8::splat(p.y) - self.center[1];
        let z = F64x8::splat(p.z) - self.center[2];
        let squared = x * x + y * y + z * z;
        let mut is_common = true;
        for k in 0..WIDTH {
            is_common &= squared.0[k] > 1e-280 && squared.0[k] < 1e300;
        }
        if is_common { squared.sqrt() - self.radius } else { self.values_one_by_one(p) }
    }

    #[cold]
    #[inline(never)]
    fn values_one_by_one(&self, p: Vec3) -> F64x8 {
        let center = |k: usize| Vec3::from_array([0, 1, 2].map(|axis| self.center[axis].0[k]));
        F64s(std::array::from_fn(|k| sphere::value(center(k), self.radius.0[k], p)))
    }
}
