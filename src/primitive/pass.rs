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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::primitive::ray::Ray;
    use crate::simd::float8::Plain;
    use crate::simd::lanes::WIDTH;

    /// Numbers from -1 to 1.
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }

        fn vector(&mut self) -> Vec3 {
            Vec3::new(self.next(), self.next(), self.next())
        }
    }

    #[test]
    fn what_a_line_meets_is_passed_however_near_its_edge_and_little_else_is() {
        let mut random = Random(1);
        let (mut met, mut passed, mut asked) = (0, 0, 0);
        for k in 0..40_000 {
            // From large to tiny, some thin to the last digit, some flat.
            let size = [1.0, 0.1, 1e-3, 1e-5][k % 4];
            let width = [1.0, 1e-2, 1e-6, 1e-12, 0.0][k / 4 % 5];
            let a = random.vector() * (1.0 - size) * 0.5;
            let (u, v) = (random.vector() * size * 0.5, random.vector() * size * 0.5);
            let corners = [a, a + u, a + u * (0.5 + 0.5 * random.next()) + v * width];
            let mut eight = Estimates::NONE;
            eight.set(k % WIDTH, corners);
            // Towards a corner, an edge, the middle, or beside it by little.
            let weights = [[1.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.3, 0.3], [0.0, 0.2]][k / 20 % 5];
            let off = random.vector() * size * [0.0, 1e-9, 1e-6, 1e-2, 1.0][k / 100 % 5];
            let target = corners[0] + u * weights[0] + (corners[2] - a) * weights[1] + off;
            let from = random.vector() * 3.0;
            let Some(ray) = Ray::new(from, target - from, [f64::NEG_INFINITY, f64::INFINITY]) else { continue };
            let along = ray.direction / ray.direction.dot(ray.direction).sqrt();
            let middle = from - along * from.dot(along);
            let [m, d] = [middle, along].map(|v| v.to_array().map(|c| c as f32));
            let is_passed = eight.passed(Plain, m, d) >> (k % WIDTH) & 1 == 1;
            let is_met = ray.meets(corners) != 0;
            assert!(is_passed || !is_met, "{corners:?} {ray:?}");
            asked += 1;
            met += usize::from(is_met);
            // Of those that f32 can tell apart.
            if size >= 0.1 && width == 1.0 && k / 100 % 5 == 4 {
                passed += usize::from(is_passed) - usize::from(is_met);
            }
        }
        assert!(asked > 39_000 && met > 4000, "{asked} {met}");
        assert!(passed < 20, "{passed}");
    }
}
