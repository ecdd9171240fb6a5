// SPDX-License-Identifier: MIT OR Apache-2.0
//! Best-first descent to the nearest primitive. Boxes are tested in f32 with room for its rounding, every
//! prune is strict, and the bound that a leaf gives allows for the leaf's own rounding, so the answer is
//! the brute-force one to the bit.

use super::oriented::Oriented;
use super::{LEAF, Node, Tree};
use crate::math::Vec3;
use crate::simd::float8::{Float8, Keys8, LANE, Simd, slack};
use crate::simd::lanes::WIDTH;
use crate::simd::prefetch;

/// What a leaf does with the search: lowers its bound when it finds something nearer.
pub(crate) trait LeafDistance<S: Simd> {
    /// Looks at a leaf from a point as [`Tree::place`] places it, whose rounding moves distances by up to `slack`; the
    /// distance, so scaled, beyond which nothing is of interest any more, widened by the rounding of the primitives' own
    /// distances.
    fn visit(&mut self, simd: S, leaf: usize, at: [f32; 3], slack: f32) -> f32;

    /// Asks for the memory of a leaf that may be visited next.
    #[inline(always)]
    fn fetch(&self, _: usize) {}

    /// The search is over.
    #[inline(always)]
    fn finish(&mut self, _: S) {}
}

/// The bound while nothing is known: infinity, in order.
const UNBOUNDED: i32 = f32::INFINITY.to_bits() as i32 | LANE;

/// Room for the deepest tree: 16 levels by cost, then halves (31 binary levels, 3 to a node), all eight
/// children waiting on each.
const DEEPEST: usize = (8 * (16 + 12usize)).next_power_of_two();

/// Levels of nodes that there is room for.
pub(super) const LEVELS: usize = DEEPEST / WIDTH;

/// Room for eight levels; clearing more than is needed costs as much as a node.
const COMMON: usize = 64;

/// Which of its boxes a search of a tree goes by.
pub(crate) trait Way<S: Simd> {
    type Boxes;
    fn boxes(tree: &Tree) -> &[Self::Boxes];
    fn child(boxes: &Self::Boxes) -> &[u32; WIDTH];
    /// Square, in order, of the distance from a point to each box, with the lane in the last bits; an unused child is
    /// further than infinity.
    fn keys(simd: S, boxes: &Self::Boxes, at: [f32; 3]) -> <S::Float as Float8<S>>::Keys;
}

/// The boxes along the axes; those around a point are at distance zero, or, where `SIGNED`, at minus the distance to
/// their nearest face.
pub(crate) struct Along<const SIGNED: bool>;

/// The oriented boxes; those around a point are at distance zero. Only after [`Tree::fit`].
pub(crate) struct Around;

impl<S: Simd, const SIGNED: bool> Way<S> for Along<SIGNED> {
    type Boxes = Node;

    #[inline(always)]
    fn boxes(tree: &Tree) -> &[Node] {
        &tree.nodes
    }

    #[inline(always)]
    fn child(node: &Node) -> &[u32; WIDTH] {
        &node.child
    }

    #[inline(always)]
    fn keys(simd: S, node: &Node, at: [f32; 3]) -> <S::Float as Float8<S>>::Keys {
        let zero = S::Float::splat(simd, 0.0);
        let [u, v, w] = [outside(simd, node, at, 0), outside(simd, node, at, 1), outside(simd, node, at, 2)];
        let (x, y, z) = (u.max(zero), v.max(zero), w.max(zero));
        let squares = x.mul(x).add(y.mul(y)).add(z.mul(z));
        if !SIGNED {
            return squares.keys(&node.child);
        }
        // Not positive: minus its square, as bits in order, where it is the deepest of all.
        let deepest = zero.sub(u.max(v).max(w).max(S::Float::splat(simd, -f32::MAX)));
        let inside = deepest.max(zero);
        squares.signed_keys(inside.mul(inside), &node.child)
    }
}

impl<S: Simd> Way<S> for Around {
    type Boxes = Oriented;

    #[inline(always)]
    fn boxes(tree: &Tree) -> &[Oriented] {
        &tree.oriented
    }

    #[inline(always)]
    fn child(boxes: &Oriented) -> &[u32; WIDTH] {
        &boxes.child
    }

    #[inline(always)]
    fn keys(simd: S, boxes: &Oriented, at: [f32; 3]) -> <S::Float as Float8<S>>::Keys {
        boxes.squares(simd, at).keys(&boxes.child)
    }
}

/// Visits leaves until none can hold anything nearer than the bound, which starts as given and scaled.
#[inline(always)]
pub(crate) fn nearest<S: Simd, W: Way<S>>(simd: S, tree: &Tree, p: Vec3, start: f32, leaf: &mut impl LeafDistance<S>) {
    match WIDTH * tree.depth <= COMMON {
        true => Descent::<COMMON>::new(tree, p).finish::<S, W>(simd, tree, start, leaf),
        false => Descent::<DEEPEST>::new(tree, p).finish::<S, W>(simd, tree, start, leaf),
    }
}

/// Points that go down a tree side by side.
pub(crate) const GROUP: usize = 16;

/// [`nearest`] for up to [`GROUP`] points, each with its own start and leaf in `searches`. They go down to their first leaves
/// level by level, so that the memory of one is fetched while others are computed; `fetch` asks for a leaf's.
#[inline(always)]
pub(crate) fn nearest_for_group<S: Simd, W: Way<S>, L: LeafDistance<S>>(
    simd: S,
    tree: &Tree,
    points: &[Vec3],
    fetch: impl Fn(usize),
    searches: impl Iterator<Item = (f32, L)>,
) {
    if WIDTH * tree.depth > COMMON {
        for (p, (start, mut leaf)) in points.iter().zip(searches) {
            Descent::<DEEPEST>::new(tree, *p).finish::<S, W>(simd, tree, start, &mut leaf);
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
            descent.down::<S, W>(simd, W::boxes(tree), UNBOUNDED);
            match descent.child & LEAF {
                0 => prefetch(&W::boxes(tree)[descent.child as usize]),
                _ => fetch((descent.child & !LEAF) as usize),
            }
        }
    }
    for (descent, (start, mut leaf)) in descents.iter_mut().zip(searches) {
        descent.finish::<S, W>(simd, tree, start, &mut leaf);
    }
}

/// A search under way. `STACK` is a power of two; indices into the stack are masked by it, which spares the check.
struct Descent<const STACK: usize> {
    /// The point relative to the tree and scaled.
    at: [f32; 3],
    /// What distances are off by for the rounding of the point.
    slack: f32,
    /// Arrays side by side: a node's eight keys and children are stored at once.
    keys: [i32; STACK],
    waiting: [u32; STACK],
    /// Where the children of the same node begin, the farthest of them first.
    first: [u8; STACK],
    top: usize,
    /// The node or leaf to look at next.
    child: u32,
}

impl<const STACK: usize> Descent<STACK> {
    const NOWHERE: Descent<STACK> = Descent {
        at: [0.0; 3],
        slack: 0.0,
        keys: [0; STACK],
        waiting: [0; STACK],
        first: [0; STACK],
        top: 0,
        child: 0,
    };

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

    /// From a node to the nearest of its children within the bound; the others wait, the nearer above. False where
    /// there is none. (Nothing here depends on how many there are: what is not foreseen costs as much as a node.)
    #[inline(always)]
    fn down<S: Simd, W: Way<S>>(&mut self, simd: S, boxes: &[W::Boxes], bound: i32) -> bool {
        let boxes = &boxes[self.child as usize];
        let keys = W::keys(simd, boxes, self.at);
        let least = keys.least();
        if least > bound {
            return false;
        }
        let top = self.top;
        if let (Some(waiting), Some(children), Some(first)) = (
            self.keys[top..].first_chunk_mut(),
            self.waiting[top..].first_chunk_mut(),
            self.first[top..].first_chunk_mut(),
        ) {
            *first = [top as u8; WIDTH];
            self.top += keys.others(keys.at_most(bound), W::child(boxes), waiting, children);
        }
        self.child = W::child(boxes)[(least & LANE) as usize];
        true
    }

    /// The nearest of those that wait within the bound; false where none is left.
    #[inline(always)]
    fn up(&mut self, bound: i32) -> bool {
        while self.top > 0 {
            let last = (self.top - 1) & (STACK - 1);
            if self.keys[last] <= bound {
                self.top = last;
                self.child = self.waiting[last];
                return true;
            }
            // The others of the same node are farther.
            self.top = self.first[last] as usize;
        }
        false
    }

    /// Asks for the memory of what comes next if the bound stays.
    #[inline(always)]
    fn fetch_next<S: Simd, W: Way<S>>(&self, boxes: &[W::Boxes], bound: i32, leaf: &impl LeafDistance<S>) {
        let last = self.top.wrapping_sub(1) & (STACK - 1);
        if self.top > 0 && self.keys[last] <= bound {
            match self.waiting[last] {
                child if child & LEAF == 0 => prefetch(&boxes[child as usize]),
                child => leaf.fetch((child & !LEAF) as usize),
            }
        }
    }

    #[inline(always)]
    fn finish<S: Simd, W: Way<S>>(&mut self, simd: S, tree: &Tree, start: f32, leaf: &mut impl LeafDistance<S>) {
        let slack = self.slack;
        let limit = |distance: f32| {
            // Minus infinity, where nothing is of interest any more, has no key.
            let distance = if distance > -1e15 { distance } else { -1e15 } + slack;
            // Where squares of what is as far may be infinite, nothing is known.
            let key = if distance < 1.8e19 { distance * distance.abs() } else { f32::INFINITY };
            // A box's square is off by 24 roundings and by fourteen for the lane in its key, the limit's by seven: 2.7e-6.
            order((key + key.abs() * 3e-6).to_bits() as i32) | LANE
        };
        let boxes = W::boxes(tree);
        let mut bound = limit(start);
        loop {
            let goes_on = if self.child & LEAF == 0 {
                self.down::<S, W>(simd, boxes, bound)
            } else {
                self.fetch_next::<S, W>(boxes, bound, leaf);
                bound = limit(leaf.visit(simd, (self.child & !LEAF) as usize, self.at, slack));
                false
            };
            if !goes_on && !self.up(bound) {
                return leaf.finish(simd);
            }
        }
    }
}

/// Numbers that compare as integers in the order of the floats; NaN is not among them.
#[inline(always)]
fn order(bits: i32) -> i32 {
    bits ^ ((bits >> 31) & i32::MAX)
}

/// How far a point is outside the boxes along an axis; negative inside.
#[inline(always)]
fn outside<S: Simd>(simd: S, node: &Node, at: [f32; 3], axis: usize) -> S::Float {
    let at = S::Float::splat(simd, at[axis]);
    S::Float::load(simd, &node.lo[axis]).sub(at).max(at.sub(S::Float::load(simd, &node.hi[axis])))
}
