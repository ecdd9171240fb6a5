// SPDX-License-Identifier: MIT OR Apache-2.0
//! Best-first descent to the nearest primitive. Boxes are tested in f32 with room for its rounding, every
//! prune is strict, and the bound that a leaf gives allows for the leaf's own rounding, so the answer is
//! the brute-force one to the bit.

use super::{LEAF, Node, Tree};
use crate::math::{Vec3, f32_above};
use crate::simd::lanes::{F32x8, I32x8, WIDTH};

/// What a leaf does with the search: lowers its bound when it finds something nearer.
pub(crate) trait LeafDistance {
    /// Looks at a leaf; the distance beyond which nothing is of interest any more, widened by the rounding of
    /// the primitives' own distances.
    fn visit(&mut self, leaf: usize) -> f64;
}

/// The bound while nothing is known: infinity, in order.
const UNBOUNDED: i32 = f32::INFINITY.to_bits() as i32;

/// Room for the deepest tree: 16 levels by cost, then halves (31 binary levels, 3 to a node), all eight
/// children waiting on each.
const DEEPEST: usize = 8 * (16 + 12);

/// Room for eight levels; clearing more than is needed costs as much as a node.
const COMMON: usize = 64;

/// Visits leaves until none can hold anything nearer than the bound, which starts as given. Boxes around
/// the point are at distance zero, or, where `SIGNED`, at minus the distance to their nearest face.
#[inline(always)]
pub(crate) fn nearest<const SIGNED: bool>(tree: &Tree, p: Vec3, start: f64, leaf: &mut impl LeafDistance) {
    match WIDTH * tree.depth <= COMMON {
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
    // Room for the rounding of the point, of the differences and of the squares to f32, and for the lanes'
    // numbers in the keys: boxes are within 1.
    let room = 4e-6 * (1.0 + at.abs().max_element());
    let at = [at.x as f32, at.y as f32, at.z as f32];
    let limit = |distance: f64| {
        let distance = distance * tree.scale + room;
        let key = distance * distance.abs();
        order(f32_above(key + key.abs() * 1e-6).to_bits() as i32) | LANE
    };
    let mut bound = limit(start);
    // Two arrays side by side: a node's eight keys and children are stored at once.
    let (mut keys_waiting, mut waiting) = ([0i32; STACK], [0u32; STACK]);
    let (mut top, mut child) = (0, 0u32);
    loop {
        if child & LEAF != 0 {
            bound = limit(leaf.visit((child & !LEAF) as usize));
        } else {
            let node = &tree.nodes[child as usize];
            let keys = box_keys::<SIGNED>(node, at);
            if bound >= UNBOUNDED {
                // The way down to the first leaf: sorting all children would cost more than what their order
                // saves. The nearest comes next.
                let nearest = keys.least() as usize & (WIDTH - 1);
                keys_waiting[top..top + WIDTH].copy_from_slice(&keys.0);
                waiting[top..top + WIDTH].copy_from_slice(&node.child);
                keys_waiting[top + nearest] = i32::MAX;
                top += WIDTH;
                child = node.child[nearest];
                continue;
            }
            let (first, mut near) = (top, keys.at_most(bound));
            while near != 0 {
                let k = near.trailing_zeros() as usize & (WIDTH - 1);
                near &= near - 1;
                // Insert so that the nearest ends on top.
                let mut i = top;
                while i > first && keys_waiting[i - 1] < keys.0[k] {
                    (keys_waiting[i], waiting[i]) = (keys_waiting[i - 1], waiting[i - 1]);
                    i -= 1;
                }
                (keys_waiting[i], waiting[i]) = (keys.0[k], node.child[k]);
                top += 1;
            }
        }
        loop {
            if top == 0 {
                return;
            }
            top -= 1;
            if keys_waiting[top] <= bound {
                child = waiting[top];
                break;
            }
        }
    }
}

/// The last bits of a key, which hold the lane.
const LANE: i32 = WIDTH as i32 - 1;

/// Numbers that compare as integers in the order of the floats; NaN is not among them.
#[inline(always)]
fn order(bits: i32) -> i32 {
    bits ^ ((bits >> 31) & i32::MAX)
}

/// Signed square, in order, of the distance from a point to each box, with the lane in the last bits; an
/// unused child is further than infinity.
#[inline(always)]
fn box_keys<const SIGNED: bool>(node: &Node, at: [f32; 3]) -> I32x8 {
    let zero = F32x8::splat(0.0);
    let outside = |axis: usize| {
        let at = F32x8::splat(at[axis]);
        F32x8(node.lo[axis]).sub(at).max(at.sub(F32x8(node.hi[axis])))
    };
    let (u, v, w) = (outside(0), outside(1), outside(2));
    let (x, y, z) = (u.max(zero), v.max(zero), w.max(zero));
    let mut keys = x.mul(x).add(y.mul(y)).add(z.mul(z)).bits();
    if SIGNED {
        // Not positive: minus its square, as bits in order, where it is the deepest of all.
        let deepest = zero.sub(u.max(v).max(w).max(F32x8::splat(-f32::MAX)));
        let inside = deepest.max(zero);
        let below = inside.mul(inside).bits();
        keys = keys.zip(below, |key, below| if below != 0 { !below } else { key });
    }
    let lanes = I32x8([0, 1, 2, 3, 4, 5, 6, 7]);
    let keys = keys.zip(lanes, |key, lane| (key & !LANE) | lane);
    let mut child = [0; WIDTH];
    for k in 0..WIDTH {
        child[k] = node.child[k] as i32;
    }
    keys.zip(I32x8(child), |key, child| if child == -1 { i32::MAX } else { key })
}
