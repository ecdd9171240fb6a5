// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which of eight triangles a line may meet, computed in f32 in the frames that distances are estimated in
//! (`estimate.rs`): on which side of each edge it passes, where that is certain.
//!
//! The error, in roundings of f32, for a line of unit direction whose middle and a triangle's corners are within the
//! root of 3 of the origin, so that one is within 3.5 of the other, b the longest edge: 7 for the way from the corner to
//! the middle, 21 when that is turned into the frame, 5 for the direction there; 61 for x and y where the line meets the
//! plane, times z of the direction. That is what the side of the longest edge is off by. Of the others, times b: 86
//! for these x and y, 64 for the products, 30 for a triangle so thin that its frame lies any way round its longest edge.

use super::estimate::Estimates;
use crate::simd::float8::{Float8, Simd};
use crate::simd::lanes::F32x8;

/// Bound on the error of the side of the longest edge.
const LONGEST: f32 = 96.0 * f32::EPSILON / 2.0;

/// The same of the others, relative to the longest edge.
const OTHERS: f32 = 256.0 * f32::EPSILON / 2.0;

impl Estimates {
    /// A bit for each triangle that the line may meet; unused lanes may have any.
    #[inline(always)]
    pub(crate) fn passed<S: Simd>(&self, simd: S, middle: [f32; 3], direction: [f32; 3]) -> u32 {
        let zero = S::Float::splat(simd, 0.0);
        let (mut at, mut along) = ([zero; 3], [zero; 3]);
        for axis in 0..3 {
            let way = S::Float::splat(simd, direction[axis]);
            let to = S::Float::splat(simd, middle[axis]).sub(load(simd, &self.origin[axis]));
            for row in 0..3 {
                let turn = load(simd, &self.axes[row][axis]);
                at[row] = at[row].add(to.mul(turn));
                along[row] = along[row].add(way.mul(turn));
            }
        }
        let (b, c) = (load(simd, &self.b), [load(simd, &self.c[0]), load(simd, &self.c[1])]);
        // Where it meets the plane, times along[2].
        let x = at[0].mul(along[2]).sub(at[2].mul(along[0]));
        let y = at[1].mul(along[2]).sub(at[2].mul(along[1]));
        let second = y.mul(c[0].sub(b)).sub(x.sub(b.mul(along[2])).mul(c[1]));
        let third = x.mul(c[1]).sub(y.mul(c[0]));
        let (longest, others) = (S::Float::splat(simd, LONGEST), b.mul(S::Float::splat(simd, OTHERS)));
        let most = y.sub(longest).max(second.max(third).sub(others));
        let least = y.add(longest).min(second.min(third).add(others));
        most.not_above(0.0) | zero.sub(least).not_above(0.0)
    }
}

#[inline(always)]
fn load<S: Simd>(simd: S, lanes: &F32x8) -> S::Float {
    S::Float::load(simd, &lanes.0)
}
