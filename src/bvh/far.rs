// SPDX-License-Identifier: MIT OR Apache-2.0
//! The nearest from far away, where roundings of f32 are larger than what tells boxes apart.

use super::{LEAF, Node, Tree};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::simd::lanes::{F64s, F64x8, Lanes, WIDTH};

/// Farther than this along an axis, as the tree places it, a point is far away.
const FAR: f64 = 64.0;

/// What the squares of distances here are off by, relative: few roundings of f64, of the point placed among them.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

impl Tree {
    #[inline(always)]
    pub(crate) fn is_far(&self, p: Vec3) -> bool {
        self.place(p).abs().max_element() > FAR
    }

    /// Visits leaves until none can hold anything nearer than `visit` says, as [`Tree::place`] scales it.
    pub(crate) fn nearest_from_far(&self, p: Vec3, mut visit: impl FnMut(usize) -> f64) -> Result<()> {
        let at = self.place(p);
        let mut waiting: Vec<(f64, u32)> = vec![(0.0, 0)];
        let mut limit = f64::INFINITY;
        while let Some((squared, child)) = waiting.pop() {
            if squared > limit {
                continue;
            }
            if child & LEAF != 0 {
                let distance = visit((child & !LEAF) as usize);
                limit = distance * distance * (1.0 + ROUNDING);
                continue;
            }
            let node = &self.nodes[child as usize];
            let first = waiting.len();
            waiting.try_reserve(WIDTH).map_err(|_| Error::memory("nodes", first + WIDTH))?;
            for (squared, child) in squares(node, at).0.into_iter().zip(node.child) {
                let is_far = squared > limit;
                if child != u32::MAX && !is_far {
                    waiting.push((squared, child));
                }
            }
            // The nearest on top.
            waiting[first..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        }
        Ok(())
    }
}

/// Squared distances of a point from the boxes of a node.
fn squares(node: &Node, at: Vec3) -> F64x8 {
    let zero = F64x8::splat(0.0);
    let mut sum = zero;
    for axis in 0..3 {
        let c = F64x8::splat(at[axis]);
        let (lo, hi) = (F64s(node.lo[axis].map(f64::from)), F64s(node.hi[axis].map(f64::from)));
        let (below, above) = (lo - c, c - hi);
        let outside = Lanes::select(below.lt(above), above, below);
        let outside = Lanes::select(outside.lt(zero), zero, outside);
        sum = sum + outside * outside;
    }
    sum
}
