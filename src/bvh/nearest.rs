// SPDX-License-Identifier: MIT OR Apache-2.0
//! Best-first descent to the nearest primitive. Every prune is strict and allows for the rounding of
//! boxes and of the leaf's own kernel, so the answer is the brute-force one to the bit.

use super::{LEAF, Node, Tree};
use crate::math::Vec3;
use crate::simd::lanes::WIDTH;

/// What a leaf does with the search: lowers `bound` when it finds something nearer.
pub(crate) trait LeafDistance {
    /// Looks at a leaf; the squared distance to the nearest primitive so far.
    fn visit(&mut self, leaf: usize) -> f64;
}

/// Room for the deepest tree: 16 levels by cost, then halves (31 binary levels, 3 to a node), 7
/// siblings waiting on each.
const STACK: usize = 7 * (16 + 12) + 8;

/// Visits leaves until none can hold anything nearer. `relative_error` bounds the leaf kernel's error
/// in a distance d by relative_error * (d + diagonal).
#[inline(always)]
pub(crate) fn nearest(tree: &Tree, p: Vec3, relative_error: f64, leaf: &mut impl LeafDistance) {
    let at = p - tree.center;
    let limit = |squared: f64| {
        let d = squared.sqrt();
        let widened = d + 2.0 * relative_error * (d + tree.diagonal);
        widened * widened
    };
    let mut bound = f64::INFINITY;
    // Two arrays: one of pairs would be cleared element by element.
    let (mut squared, mut waiting) = ([0.0f64; STACK], [0u32; STACK]);
    let mut top = 1;
    while top > 0 {
        top -= 1;
        if squared[top] > bound {
            continue;
        }
        let child = waiting[top];
        if child & LEAF != 0 {
            bound = limit(leaf.visit((child & !LEAF) as usize));
            continue;
        }
        let node = &tree.nodes[child as usize];
        let distance = squared_distances(node, at);
        let first = top;
        for k in 0..WIDTH {
            // An unused child is infinitely far, but so may be everything: test the reference too.
            if distance[k] > bound || node.child[k] == u32::MAX {
                continue;
            }
            // Insert so that the nearest ends on top.
            let mut i = top;
            while i > first && squared[i - 1] < distance[k] {
                (squared[i], waiting[i]) = (squared[i - 1], waiting[i - 1]);
                i -= 1;
            }
            (squared[i], waiting[i]) = (distance[k], node.child[k]);
            top += 1;
        }
    }
}

/// Squared distance from a point, relative to the tree's centre, to each box.
#[inline(always)]
fn squared_distances(node: &Node, at: Vec3) -> [f64; WIDTH] {
    let mut out = [0.0; WIDTH];
    let at = at.to_array();
    for axis in 0..3 {
        for k in 0..WIDTH {
            let below = f64::from(node.lo[axis][k]) - at[axis];
            let above = at[axis] - f64::from(node.hi[axis][k]);
            let outside = if below > above { below } else { above };
            let outside = if outside > 0.0 { outside } else { 0.0 };
            out[k] += outside * outside;
        }
    }
    out
}
