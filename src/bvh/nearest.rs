// SPDX-License-Identifier: MIT OR Apache-2.0
//! Best-first descent to the nearest primitive. Every prune is strict and the bound that a leaf gives
//! allows for its own rounding, so the answer is the brute-force one to the bit.

use super::{LEAF, Node, Tree};
use crate::math::Vec3;
use crate::simd::lanes::WIDTH;

/// What a leaf does with the search: lowers its bound when it finds something nearer.
pub(crate) trait LeafDistance {
    /// Looks at a leaf; the [`key`] of the distance beyond which nothing is of interest any more, widened
    /// by the rounding of the primitives' distances. That of boxes is some units of the tree's diagonal.
    fn visit(&mut self, leaf: usize) -> f64;
}

/// Signed distances by their signed squares, which order alike and need no root.
#[inline(always)]
pub(crate) fn key(distance: f64) -> f64 {
    distance * distance.abs()
}

/// Room for the deepest tree: 16 levels by cost, then halves (31 binary levels, 3 to a node), 7
/// siblings waiting on each.
const STACK: usize = 7 * (16 + 12) + 8;

/// Visits leaves until none can hold anything nearer than the bound, which starts as given. Boxes around
/// the point are at distance zero, or, where `SIGNED`, at minus the distance to their nearest face.
#[inline(always)]
pub(crate) fn nearest<const SIGNED: bool>(tree: &Tree, p: Vec3, start: f64, leaf: &mut impl LeafDistance) {
    let at = p - tree.center;
    let mut bound = start;
    // Two arrays: one of pairs would be cleared element by element.
    let (mut keys, mut waiting) = ([f64::NEG_INFINITY; STACK], [0u32; STACK]);
    let mut top = 1;
    while top > 0 {
        top -= 1;
        if keys[top] > bound {
            continue;
        }
        let child = waiting[top];
        if child & LEAF != 0 {
            bound = leaf.visit((child & !LEAF) as usize);
            continue;
        }
        let node = &tree.nodes[child as usize];
        let distance = box_keys::<SIGNED>(node, at);
        let first = top;
        for k in 0..WIDTH {
            // An unused child is infinitely far, but so may be everything: test the reference too.
            if distance[k] > bound || node.child[k] == u32::MAX {
                continue;
            }
            // Insert so that the nearest ends on top.
            let mut i = top;
            while i > first && keys[i - 1] < distance[k] {
                (keys[i], waiting[i]) = (keys[i - 1], waiting[i - 1]);
                i -= 1;
            }
            (keys[i], waiting[i]) = (distance[k], node.child[k]);
            top += 1;
        }
    }
}

/// Key of the distance from a point, relative to the tree's centre, to each box.
#[inline(always)]
fn box_keys<const SIGNED: bool>(node: &Node, at: Vec3) -> [f64; WIDTH] {
    let mut out = [0.0; WIDTH];
    let mut deepest = [f64::NEG_INFINITY; WIDTH];
    let at = at.to_array();
    for axis in 0..3 {
        for k in 0..WIDTH {
            let below = f64::from(node.lo[axis][k]) - at[axis];
            let above = at[axis] - f64::from(node.hi[axis][k]);
            let outside = if below > above { below } else { above };
            if SIGNED {
                deepest[k] = if outside > deepest[k] { outside } else { deepest[k] };
            }
            let outside = if outside > 0.0 { outside } else { 0.0 };
            out[k] += outside * outside;
        }
    }
    if SIGNED {
        for k in 0..WIDTH {
            out[k] = if deepest[k] < 0.0 { -(deepest[k] * deepest[k]) } else { out[k] };
        }
    }
    out
}
