// SPDX-License-Identifier: MIT OR Apache-2.0
//! All leaves whose boxes meet a box. A line along an axis is a box, too.

use super::nearest::LEVELS;
use super::{LEAF, Tree};
use crate::math::Aabb;
use crate::simd::float8::{Float8, Simd};
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, dispatch};

/// Leaves that are found before they are visited.
const BATCH: usize = 32;

/// Nodes that are yet to be looked at, and leaves found.
struct Found {
    stack: [u32; LEVELS * WIDTH],
    depth: usize,
    leaves: [u32; BATCH],
    count: usize,
}

/// Looks at nodes until there may be no room for more leaves.
struct Look<'a> {
    tree: &'a Tree,
    lo: &'a [f32; 3],
    hi: &'a [f32; 3],
    found: &'a mut Found,
}

impl Kernel for Look<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Look { tree, lo, hi, found } = self;
        while found.depth > 0 && found.count + WIDTH <= BATCH {
            found.depth -= 1;
            let node = &tree.nodes[found.stack[found.depth] as usize];
            let zero = S::Float::splat(simd, 0.0);
            let mut apart = zero;
            for axis in 0..3 {
                let below = S::Float::load(simd, &node.lo[axis]).sub(S::Float::splat(simd, hi[axis]));
                let above = S::Float::splat(simd, lo[axis]).sub(S::Float::load(simd, &node.hi[axis]));
                apart = apart.max(below).max(above);
            }
            // What is no number, of two infinite ends, is a box that meets or no child.
            let mut meets = apart.not_above(0.0);
            while meets != 0 {
                let child = node.child[meets.trailing_zeros() as usize];
                meets &= meets - 1;
                if child == u32::MAX {
                } else if child & LEAF == 0 {
                    found.stack[found.depth] = child;
                    found.depth += 1;
                } else {
                    found.leaves[found.count] = child & !LEAF;
                    found.count += 1;
                }
            }
        }
    }
}

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
        let mut found = Found { stack: [0; LEVELS * WIDTH], depth: 1, leaves: [0; BATCH], count: 0 };
        while found.depth > 0 {
            dispatch(Look { tree: self, lo: &lo, hi: &hi, found: &mut found });
            if found.leaves[..found.count].iter().any(|&leaf| visit(leaf as usize)) {
                return true;
            }
            found.count = 0;
        }
        false
    }
}
