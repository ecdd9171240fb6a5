// SPDX-License-Identifier: MIT OR Apache-2.0
//! Best-first descent to the nearest primitive. Boxes are tested in f32 with room for its rounding, every
//! prune is strict, and the bound that a leaf gives allows for the leaf's own rounding, so the answer is
//! the brute-force one to the bit.

use super::{LEAF, Node, Tree};
use crate::math::{Vec3, f32_above};
use crate::simd::lanes::WIDTH;

/// What a leaf does with the search: lowers its bound when it finds something nearer.
pub(crate) trait LeafDistance {
    /// Looks at a leaf; the distance beyond which nothing is of interest any more, widened by the rounding of
    /// the primitives' own distances.
    fn visit(&mut self, leaf: usize) -> f64;
}

/// Room for the deepest tree: 16 levels by cost, then halves (31 binary levels, 3 to a node), 7
/// siblings waiting on each.
const DEEPEST: usize = 7 * (16 + 12) + 8;

/// Room for nine levels; clearing more than is needed costs as much as a node.
const COMMON: usize = 64;

/// The bound while nothing is known: infinity, in order.
const UNBOUNDED: i32 = f32::INFINITY.to_bits() as i32;

/// Visits leaves until none can hold anything nearer than the bound, which starts as given. Boxes around
/// the point are at distance zero, or, where `SIGNED`, at minus the distance to their nearest face.
#[inline(always)]
pub(crate) fn nearest<const SIGNED: bool>(tree: &Tree, p: Vec3, start: f64, leaf: &mut impl LeafDistance) {
    match 7 * tree.depth < COMMON {
        true => search::<SIGNED, COMMON>(tree, p, start, leaf),
        false => search_deep::<SIGNED>(tree, p, start, leaf),
    }
}

#[cold]
#[inline(never)]
fn search_deep<const SIGNED: bool>(tree: &Tree, p: Vec3, start: f64, leaf: &mut impl LeafDistance) {
    search::<SIGNED, DEEPEST>(tree, p, start, leaf);
}

#[inline(always)]
fn search<const SIGNED: bool, const STACK: usize>(tree: &Tree, p: Vec3, start: f64, leaf: &mut impl LeafDistance) {
    let at = (p - tree.center) * tree.scale;
    // Room for the rounding of the point, of the differences and of the squares to f32: boxes are within 1.
    let room = 1e-6 * (1.0 + at.abs().max_element());
    let at = [at.x as f32, at.y as f32, at.z as f32];
    let limit = |distance: f64| {
        let distance = distance * tree.scale + room;
        let key = distance * distance.abs();
        order(f32_above(key + key.abs() * 1e-6))
    };
    let mut bound = limit(start);
    // The key in order above, the child below: one number to compare and to move.
    let mut waiting = [0i64; STACK];
    waiting[0] = i64::from(i32::MIN) << 32;
    let mut top = 1;
    while top > 0 {
        top -= 1;
        if (waiting[top] >> 32) as i32 > bound {
            continue;
        }
        let child = waiting[top] as u32;
        if child & LEAF != 0 {
            bound = limit(leaf.visit((child & !LEAF) as usize));
            continue;
        }
        let node = &tree.nodes[child as usize];
        let keys = box_keys::<SIGNED>(node, at);
        let mut entries = [0i64; WIDTH];
        for k in 0..WIDTH {
            entries[k] = i64::from(keys[k]) << 32 | i64::from(node.child[k]);
        }
        if bound == UNBOUNDED {
            // The way down to the first leaf: all children are of interest, and sorting them would cost more
            // than what their order saves. Only the nearest goes on top.
            let first = top;
            for entry in entries {
                waiting[top] = entry;
                // An unused child.
                top += usize::from(entry as u32 != u32::MAX);
            }
            let mut nearest = first;
            for k in first + 1..top {
                nearest = if waiting[k] < waiting[nearest] { k } else { nearest };
            }
            waiting.swap(nearest, top - 1);
            continue;
        }
        let first = top;
        for k in 0..WIDTH {
            let entry = entries[k];
            // An unused child is infinitely far, but so may be everything: test the reference too.
            if keys[k] > bound || entry as u32 == u32::MAX {
                continue;
            }
            // Insert so that the nearest ends on top.
            let mut i = top;
            while i > first && waiting[i - 1] < entry {
                waiting[i] = waiting[i - 1];
                i -= 1;
            }
            waiting[i] = entry;
            top += 1;
        }
    }
}

/// Numbers that compare as integers in the order of the floats; NaN is not among them.
#[inline(always)]
fn order(x: f32) -> i32 {
    let bits = x.to_bits() as i32;
    bits ^ ((bits >> 31) & i32::MAX)
}

/// Signed square, in order, of the distance from a point to each box.
#[inline(always)]
fn box_keys<const SIGNED: bool>(node: &Node, at: [f32; 3]) -> [i32; WIDTH] {
    let mut squared = [0.0f32; WIDTH];
    let mut deepest = [f32::NEG_INFINITY; WIDTH];
    for axis in 0..3 {
        for k in 0..WIDTH {
            let below = node.lo[axis][k] - at[axis];
            let above = at[axis] - node.hi[axis][k];
            let outside = if below > above { below } else { above };
            if SIGNED {
                deepest[k] = if outside > deepest[k] { outside } else { deepest[k] };
            }
            let outside = if outside > 0.0 { outside } else { 0.0 };
            squared[k] += outside * outside;
        }
    }
    let mut keys = [0; WIDTH];
    for k in 0..WIDTH {
        let inside = SIGNED && deepest[k] < 0.0;
        keys[k] = order(if inside { -(deepest[k] * deepest[k]) } else { squared[k] });
    }
    keys
}
