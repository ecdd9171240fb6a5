// SPDX-License-Identifier: MIT OR Apache-2.0
//! All leaves whose boxes meet a box. A line along an axis is a box, too.

use super::{LEAF, Tree};
use crate::math::Aabb;
use crate::simd::lanes::WIDTH;

impl Tree {
    /// Calls `visit` for every leaf that may hold a primitive whose box meets `region` (closed, possibly
    /// infinite).
    pub(crate) fn overlapping(&self, region: Aabb, mut visit: impl FnMut(usize)) {
        self.any_overlapping(region, |leaf| {
            visit(leaf);
            false
        });
    }

    /// The same until `visit` says that it has seen enough; whether it did.
    pub(crate) fn any_overlapping(&self, region: Aabb, mut visit: impl FnMut(usize) -> bool) -> bool {
        // Rounded outward like the boxes: what meets still meets.
        let (lo, hi) = self.relative(region);
        let mut stack = vec![0u32];
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at as usize];
            let mut meets = [true; WIDTH];
            for axis in 0..3 {
                for k in 0..WIDTH {
                    meets[k] &= node.lo[axis][k] <= hi[axis] && lo[axis] <= node.hi[axis][k];
                }
            }
            for k in 0..WIDTH {
                if !meets[k] || node.child[k] == u32::MAX {
                    continue;
                }
                if node.child[k] & LEAF == 0 {
                    stack.push(node.child[k]);
                } else if visit((node.child[k] & !LEAF) as usize) {
                    return true;
                }
            }
        }
        false
    }
}
