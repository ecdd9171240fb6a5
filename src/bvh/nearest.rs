// SPDX-License-Identifier: MIT OR Apache-2.0
//! Best-first descent to the nearest primitive. Boxes are tested in f32 with room for its rounding, every
//! prune is strict, and the bound that a leaf gives allows for the leaf's own rounding, so the answer is
//! the brute-force one to the bit.

use super::{LEAF, Node, Tree};
use crate::math::Vec3;
use crate::simd::float8::{Float8, Keys8, LANE, Simd, slack};
use crate::simd::lanes::WIDTH;
use crate::simd::prefetch;

/// What a leaf does with the search: lowers its bound when it finds something nearer.
pub(crate) trait LeafDistance<S: Simd> {
    /// Looks at a leaf; the distance, as [`Tree::place`] scales it, beyond which nothing is of interest any more, widened
    /// by the rounding of the primitives' own distances.
    fn visit(&mut self, simd: S, leaf: usize) -> f32;

    /// The search is over.
    #[inline(always)]
    fn finish(&mut self, _: S) {}
}

/// The bound while nothing is known: infinity, in order.
const UNBOUNDED: i32 = f32::INFINITY.to_bits() as i32;

/// Room for the deepest tree: 16 levels by cost, then halves (31 binary levels, 3 to a node), all eight
/// children waiting on each.
const DEEPEST: usize = (8 * (16 + 12usize)).next_power_of_two();

/// Room for eight levels; clearing more than is needed costs as much as a node.
const COMMON: usize = 64;

/// Visits leaves until none can hold anything nearer than the bound, which starts as given and scaled. Boxes around
/// the point are at distance zero, or, where `SIGNED`, at minus the distance to their nearest face.
#[inline(always)]
pub(crate) fn nearest<S: Simd, const SIGNED: bool>(
    simd: S,
    tree: &Tree,
    p: Vec3,
    start: f32,
    leaf: &mut impl LeafDistance<S>,
) {
    match WIDTH * tree.depth <= COMMON {
        true => Descent::<COMMON>::new(tree, p).finish::<S, SIGNED>(simd, tree, start, leaf),
        false => Descent::<DEEPEST>::new(tree, p).finish::<S, SIGNED>(simd, tree, start, leaf),
    }
}

/// Points that go down a tree side by side.
pub(crate) const GROUP: usize = 16;

/// [`nearest`] for up to [`GROUP`] points, each with its own start and leaf in `searches`. They go down to their first leaves
/// level by level, so that the memory of one is fetched while others are computed; `fetch` asks for a leaf's.
#[inline(always)]
pub(crate) fn nearest_for_group<S: Simd, const SIGNED: bool, L: LeafDistance<S>>(
    simd: S,
    tree: &Tree,
    points: &[Vec3],
    fetch: impl Fn(usize),
    searches: impl Iterator<Item = (f32, L)>,
) {
    if WIDTH * tree.depth > COMMON {
        for (p, (start, mut leaf)) in points.iter().zip(searches) {
            Descent::<DEEPEST>::new(tree, *p).finish::<S, SIGNED>(simd, tree, start, &mut leaf);
        }
        return;
    }
    let mut descents = [const { Descent::<COMMON>::NOWHERE }; GROUP];
    for (descent, p) in descents.iter_mut().zip(points) {
        descent.place(tree, *p);
    }
    for _ in 0..tree.depth {
        for descent in descents[..points.len().min(GROUP)].iter_mut() {
            if descent.child & LEAF != 0 {
                continue;
            }
            descent.down::<S, SIGNED>(simd, tree);
            match descent.child & LEAF {
                0 => prefetch(&tree.nodes[descent.child as usize]),
                _ => fetch((descent.child & !LEAF) as usize),
            }
        }
    }
    for (descent, (start, mut leaf)) in descents.iter_mut().zip(searches) {
        descent.finish::<S, SIGNED>(simd, tree, start, &mut leaf);
    }
}

/// A search under way. `STACK` is a power of two; indices into the stack are masked by it, which spares the check.
struct Descent<const STACK: usize> {
    /// The point relative to the tree and scaled.
    at: [f32; 3],
    /// What distances are off by for the rounding of the point.
    slack: f32,
    /// Two arrays side by side: a node's eight keys and children are stored at once.
    keys: [i32; STACK],
    waiting: [u32; STACK],
    top: usize,
    /// The node or leaf to look at next.
    child: u32,
}

impl<const STACK: usize> Descent<STACK> {
    const NOWHERE: Descent<STACK> =
        Descent { at: [0.0; 3], slack: 0.0, keys: [0; STACK], waiting: [0; STACK], top: 0, child: 0 };

    #[inline(always)]
    fn new(tree: &Tree, p: Vec3) -> Descent<STACK> {
        let mut descent = Descent::NOWHERE;
        descent.place(tree, p);
        descent
    }

    #[inline(always)]
    fn place(&mut self, tree: &Tree, p: Vec3) {
        let at = tree.place(p);
        self.slack = slack(at.abs().max_element());
        self.at = [at.x as f32, at.y as f32, at.z as f32];
    }

    /// From a node to its nearest child; the others wait. Sorting them would cost more than what their order
    /// saves.
    #[inline(always)]
    fn down<S: Simd, const SIGNED: bool>(&mut self, simd: S, tree: &Tree) {
        let node = &tree.nodes[self.child as usize];
        let keys = box_keys::<S, SIGNED>(simd, node, self.at);
        let nearest = (keys.least() & LANE) as usize;
        let top = self.top;
        self.keys[top..top + WIDTH].copy_from_slice(&keys.lanes());
        self.waiting[top..top + WIDTH].copy_from_slice(&node.child);
        self.keys[(top + nearest) & (STACK - 1)] = i32::MAX;
        self.top += WIDTH;
        self.child = node.child[nearest];
    }

    #[inline(always)]
    fn finish<S: Simd, const SIGNED: bool>(
        &mut self,
        simd: S,
        tree: &Tree,
        start: f32,
        leaf: &mut impl LeafDistance<S>,
    ) {
        let slack = self.slack;
        let limit = |distance: f32| {
            // Minus infinity, where nothing is of interest any more, has no key.
            let distance = if distance > -1e15 { distance } else { -1e15 } + slack;
            // Where squares of what is as far may be infinite, nothing is known.
            let key = if distance < 1.8e19 { distance * distance.abs() } else { f32::INFINITY };
            // The box's square is off by five roundings and by fourteen for the lane in its key, the limit's by seven: 1.6e-6.
            order((key + key.abs() * 3e-6).to_bits() as i32) | LANE
        };
        let mut bound = limit(start);
        loop {
            if self.child & LEAF != 0 {
                bound = limit(leaf.visit(simd, (self.child & !LEAF) as usize));
            } else if bound >= UNBOUNDED {
                // The way down to the first leaf.
                self.down::<S, SIGNED>(simd, tree);
                continue;
            } else {
                let node = &tree.nodes[self.child as usize];
                let keys = box_keys::<S, SIGNED>(simd, node, self.at);
                let (first, mut near) = (self.top, keys.at_most(bound));
                let keys = keys.lanes();
                while near != 0 {
                    let k = near.trailing_zeros() as usize & (WIDTH - 1);
                    near &= near - 1;
                    // Insert so that the nearest ends on top.
                    let mut i = self.top;
                    while i > first && self.keys[(i - 1) & (STACK - 1)] < keys[k] {
                        let (to, from) = (i & (STACK - 1), (i - 1) & (STACK - 1));
                        (self.keys[to], self.waiting[to]) = (self.keys[from], self.waiting[from]);
                        i -= 1;
                    }
                    (self.keys[i & (STACK - 1)], self.waiting[i & (STACK - 1)]) = (keys[k], node.child[k]);
                    self.top += 1;
                }
            }
            loop {
                if self.top == 0 {
                    return leaf.finish(simd);
                }
                self.top -= 1;
                let top = self.top & (STACK - 1);
                if self.keys[top] <= bound {
                    self.child = self.waiting[top];
                    break;
                }
            }
        }
    }
}

/// Numbers that compare as integers in the order of the floats; NaN is not among them.
#[inline(always)]
fn order(bits: i32) -> i32 {
    bits ^ ((bits >> 31) & i32::MAX)
}

/// Signed square, in order, of the distance from a point to each box, with the lane in the last bits; an
/// unused child is further than infinity.
#[inline(always)]
fn box_keys<S: Simd, const SIGNED: bool>(simd: S, node: &Node, at: [f32; 3]) -> <S::Float as Float8<S>>::Keys {
    let zero = S::Float::splat(simd, 0.0);
    let [u, v, w] = [outside(simd, node, at, 0), outside(simd, node, at, 1), outside(simd, node, at, 2)];
    let (x, y, z) = (u.max(zero), v.max(zero), w.max(zero));
    let squares = x.mul(x).add(y.mul(y)).add(z.mul(z));
    if SIGNED {
        // Not positive: minus its square, as bits in order, where it is the deepest of all.
        let deepest = zero.sub(u.max(v).max(w).max(S::Float::splat(simd, -f32::MAX)));
        let inside = deepest.max(zero);
        squares.signed_keys(inside.mul(inside), &node.child)
    } else {
        squares.keys(&node.child)
    }
}

/// How far a point is outside the boxes along an axis; negative inside.
#[inline(always)]
fn outside<S: Simd>(simd: S, node: &Node, at: [f32; 3], axis: usize) -> S::Float {
    let at = S::Float::splat(simd, at[axis]);
    S::Float::load(simd, &node.lo[axis]).sub(at).max(at.sub(S::Float::load(simd, &node.hi[axis])))
}
