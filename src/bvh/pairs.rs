// SPDX-License-Identifier: MIT OR Apache-2.0
//! All pairs of primitives whose boxes meet: each leaf against itself and those after it. Boxes are tested
//! eight at once in f32, rounded outward, so that no pair is missed and a few come for nothing.
//!
//! Primitives may belong to groups whose members are of no interest to each other, although their boxes all
//! meet (the faces round one vertex): two subtrees of one group are passed over as a whole, and so is a subtree
//! of one group that the caller knows to be apart from a leaf.

use super::{LEAF, Tree};
use crate::error::{Error, Result, try_with_capacity};
use crate::math::Aabb;
use crate::parallel::Run;
use crate::simd::float8::{Float8, Simd};
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, dispatch};
use std::ops::Range;

/// In no group.
pub(crate) const ALONE: u32 = u32::MAX;

/// Leaves for a thread to do in one go.
const PIECE: usize = 1024;

/// The boxes of a leaf side by side; unused lanes are empty.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
struct Boxes {
    lo: [[f32; WIDTH]; 3],
    hi: [[f32; WIDTH]; 3],
}

impl Boxes {
    const EMPTY: Boxes = Boxes { lo: [[f32::INFINITY; WIDTH]; 3], hi: [[f32::NEG_INFINITY; WIDTH]; 3] };

    #[inline(always)]
    fn lane(&self, k: usize) -> ([f32; 3], [f32; 3]) {
        ([self.lo[0][k], self.lo[1][k], self.lo[2][k]], [self.hi[0][k], self.hi[1][k], self.hi[2][k]])
    }

    /// The box around all.
    fn hull(&self) -> ([f32; 3], [f32; 3]) {
        (
            self.lo.map(|lanes| lanes.into_iter().fold(f32::INFINITY, f32::min)),
            self.hi.map(|lanes| lanes.into_iter().fold(f32::NEG_INFINITY, f32::max)),
        )
    }
}

/// A bit for each of eight boxes that meets one. (No difference is no number: empty boxes are infinitely far from those that
/// are not.)
#[inline(always)]
fn meeting<S: Simd>(simd: S, lo: &[[f32; WIDTH]; 3], hi: &[[f32; WIDTH]; 3], (low, high): ([f32; 3], [f32; 3])) -> u32 {
    let gap = |axis: usize| {
        let above = S::Float::load(simd, &lo[axis]).sub(S::Float::splat(simd, high[axis]));
        above.max(S::Float::splat(simd, low[axis]).sub(S::Float::load(simd, &hi[axis])))
    };
    gap(0).max(gap(1)).max(gap(2)).not_above(0.0)
}

/// Leaves that are looked at together.
const TOGETHER: usize = 16;

/// Scratch of a search.
#[derive(Default)]
pub(crate) struct Scratch {
    stack: Vec<u32>,
    near: Vec<Near>,
}

/// Eight leaves, by what is around them.
#[derive(Clone, Copy)]
struct Near {
    boxes: Boxes,
    leaf: [u32; WIDTH],
}

/// What a search for pairs needs beside the tree.
pub(crate) struct Pairs<'a> {
    tree: &'a Tree,
    /// Primitives, leaf after leaf, and where each leaf begins.
    order: &'a [u32],
    start: &'a [u32],
    boxes: Vec<Boxes>,
    /// The last leaf below each node.
    last_leaf: Vec<u32>,
    /// The group of all primitives of a leaf or below a node; none at all where there are no groups.
    group_of_leaf: Vec<u32>,
    group_of_node: Vec<u32>,
    /// Whether there is a leaf of one group below a node.
    has_groups: Vec<bool>,
}

/// Whether the primitives of a leaf are known to be apart from a group.
pub(super) type Apart<'a> = &'a dyn Fn(&[u32], u32) -> bool;

impl<'a> Pairs<'a> {
    /// `order` and `start` are those of [`super::Leaves`], `bounds` the box of each primitive, at least as large
    /// as the one that the tree was built with, `groups` the group of each, or nothing at all.
    pub fn new(
        tree: &'a Tree,
        order: &'a [u32],
        start: &'a [u32],
        bounds: impl Fn(u32) -> Aabb + Sync,
        groups: &[u32],
        run: &Run,
    ) -> Result<Pairs<'a>> {
        let mut boxes = try_with_capacity("boxes", start.len())?;
        boxes.resize(start.len() - 1, Boxes::EMPTY);
        run.silent().for_each_piece(&mut boxes, PIECE, &|from, piece| {
            for (lanes, leaf) in piece.iter_mut().zip(start[from..].windows(2)) {
                for (k, &primitive) in order[leaf[0] as usize..leaf[1] as usize].iter().enumerate() {
                    let (lo, hi) = tree.relative(bounds(primitive));
                    for axis in 0..3 {
                        lanes.lo[axis][k] = lo[axis];
                        lanes.hi[axis][k] = hi[axis];
                    }
                }
            }
            Ok(())
        })?;
        let (last_leaf, group_of_leaf, group_of_node, has_groups) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut pairs = Pairs { tree, order, start, boxes, last_leaf, group_of_leaf, group_of_node, has_groups };
        pairs.number_leaves()?;
        if !groups.is_empty() {
            pairs.gather_groups(groups)?;
        }
        Ok(pairs)
    }

    fn members(&self, leaf: usize) -> &'a [u32] {
        &self.order[self.start[leaf] as usize..self.start[leaf + 1] as usize]
    }

    /// How many leaves.
    pub fn leaf_count(&self) -> usize {
        self.boxes.len()
    }

    /// Children come after their parent, so from the end they are known first.
    fn number_leaves(&mut self) -> Result<()> {
        self.last_leaf = try_with_capacity("nodes", self.tree.nodes.len())?;
        self.last_leaf.resize(self.tree.nodes.len(), 0);
        for (k, node) in self.tree.nodes.iter().enumerate().rev() {
            let last = |&child: &u32| match child & LEAF {
                0 => self.last_leaf[child as usize],
                _ => child & !LEAF,
            };
            let children = node.child.iter().filter(|child| **child != u32::MAX);
            self.last_leaf[k] = children.map(last).max().unwrap_or(0);
        }
        Ok(())
    }

    fn gather_groups(&mut self, groups: &[u32]) -> Result<()> {
        self.group_of_leaf = try_with_capacity("leaves", self.leaf_count())?;
        for leaf in 0..self.leaf_count() {
            let group = common(self.members(leaf).iter().map(|p| groups[*p as usize]));
            self.group_of_leaf.push(group);
        }
        self.group_of_node = try_with_capacity("nodes", self.tree.nodes.len())?;
        self.group_of_node.resize(self.tree.nodes.len(), ALONE);
        self.has_groups = try_with_capacity("nodes", self.tree.nodes.len())?;
        self.has_groups.resize(self.tree.nodes.len(), false);
        for k in (0..self.tree.nodes.len()).rev() {
            let children = || self.tree.nodes[k].child.into_iter().filter(|child| *child != u32::MAX);
            self.group_of_node[k] = common(children().map(|child| self.group(child)));
            self.has_groups[k] = children().any(|child| self.has_group(child));
        }
        Ok(())
    }

    /// The group of all below a child.
    fn group(&self, child: u32) -> u32 {
        if self.group_of_leaf.is_empty() {
            return ALONE;
        }
        match child & LEAF {
            0 => self.group_of_node[child as usize],
            _ => self.group_of_leaf[(child & !LEAF) as usize],
        }
    }

    /// Whether a child is, or has below it, a leaf of one group.
    fn has_group(&self, child: u32) -> bool {
        match child & LEAF {
            0 => self.has_groups.get(child as usize).is_some_and(|has| *has),
            _ => self.group(child) != ALONE,
        }
    }

    /// Adds to `out` the pairs of primitives whose boxes meet that are these leaves' to find: all leaves together
    /// find each pair once. A leaf of no one group finds what it has in common with itself, with later such leaves
    /// and with all leaves of a group, so that it can be told to be apart from these; a leaf of a group, with later
    /// leaves of others.
    pub fn of_leaves(
        &self,
        leaves: Range<usize>,
        apart: Apart,
        scratch: &mut Scratch,
        out: &mut Vec<[u32; 2]>,
    ) -> Result<()> {
        if self.group_of_leaf.is_empty() {
            return dispatch(OfRun { pairs: self, leaves, scratch, out });
        }
        for leaf in leaves {
            dispatch(OfLeaf { pairs: self, leaf, apart, stack: &mut scratch.stack, out })?;
        }
        Ok(())
    }

    /// Whether the pairs of two leaves, of these groups, are the first one's to find.
    #[inline(always)]
    fn finds(&self, leaf: usize, group: u32, other: usize, group_of_other: u32) -> bool {
        match (group, group_of_other) {
            (ALONE, ALONE) => other >= leaf,
            (ALONE, _) => true,
            (_, ALONE) => false,
            _ => group != group_of_other && other >= leaf,
        }
    }
}

/// The group of all, or [`ALONE`].
fn common(groups: impl Iterator<Item = u32>) -> u32 {
    let mut all = None;
    for group in groups {
        if *all.get_or_insert(group) != group {
            return ALONE;
        }
    }
    all.unwrap_or(ALONE)
}

struct OfLeaf<'a, 'b> {
    pairs: &'b Pairs<'a>,
    leaf: usize,
    apart: Apart<'b>,
    stack: &'b mut Vec<u32>,
    out: &'b mut Vec<[u32; 2]>,
}

impl Kernel for OfLeaf<'_, '_> {
    type Output = Result<()>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Result<()> {
        let OfLeaf { pairs, leaf, apart, stack, out } = self;
        let hull = pairs.boxes[leaf].hull();
        let own = pairs.group(leaf as u32 | LEAF);
        stack.clear();
        stack.push(0);
        while let Some(at) = stack.pop() {
            let node = &pairs.tree.nodes[at as usize];
            let within = pairs.group(at);
            let mut near = meeting(simd, &node.lo, &node.hi, hull);
            while near != 0 {
                let child = node.child[near.trailing_zeros() as usize & (WIDTH - 1)];
                near &= near - 1;
                if child == u32::MAX {
                    continue;
                }
                let group = pairs.group(child);
                if group != ALONE && (group == own || (within == ALONE && apart(pairs.members(leaf), group))) {
                    continue;
                }
                if child & LEAF != 0 {
                    let other = (child & !LEAF) as usize;
                    if pairs.finds(leaf, own, other, group) {
                        between(simd, pairs, leaf, other, out)?;
                    }
                } else {
                    let is_later = pairs.last_leaf[child as usize] as usize >= leaf;
                    if is_later || (own == ALONE && pairs.has_group(child)) {
                        stack.push(child);
                    }
                }
            }
        }
        Ok(())
    }
}

/// A few leaves one after another lie side by side: what is near to all of them is looked for once.
struct OfRun<'a, 'b> {
    pairs: &'b Pairs<'a>,
    leaves: Range<usize>,
    scratch: &'b mut Scratch,
    out: &'b mut Vec<[u32; 2]>,
}

impl Kernel for OfRun<'_, '_> {
    type Output = Result<()>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Result<()> {
        let OfRun { pairs, leaves, scratch, out } = self;
        let mut from = leaves.start;
        while from < leaves.end {
            let to = leaves.end.min(from + TOGETHER);
            gather(simd, pairs, from..to, scratch)?;
            for leaf in from..to {
                let hull = pairs.boxes[leaf].hull();
                for near in &scratch.near {
                    let mut bits = meeting(simd, &near.boxes.lo, &near.boxes.hi, hull);
                    while bits != 0 {
                        let other = near.leaf[bits.trailing_zeros() as usize & (WIDTH - 1)] as usize;
                        bits &= bits - 1;
                        if other >= leaf {
                            between(simd, pairs, leaf, other, out)?;
                        }
                    }
                }
            }
            from = to;
        }
        Ok(())
    }
}

/// Finds the leaves, not before these, whose boxes meet that of all of these.
#[inline(always)]
fn gather<S: Simd>(simd: S, pairs: &Pairs, leaves: Range<usize>, scratch: &mut Scratch) -> Result<()> {
    let Scratch { stack, near } = scratch;
    let mut all = Boxes::EMPTY;
    for boxes in &pairs.boxes[leaves.clone()] {
        for axis in 0..3 {
            for k in 0..WIDTH {
                all.lo[axis][k] = if boxes.lo[axis][k] < all.lo[axis][k] { boxes.lo[axis][k] } else { all.lo[axis][k] };
                all.hi[axis][k] = if boxes.hi[axis][k] > all.hi[axis][k] { boxes.hi[axis][k] } else { all.hi[axis][k] };
            }
        }
    }
    let hull = all.hull();
    let mut count = 0;
    near.clear();
    stack.clear();
    stack.push(0);
    while let Some(at) = stack.pop() {
        let node = &pairs.tree.nodes[at as usize];
        let mut bits = meeting(simd, &node.lo, &node.hi, hull);
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize & (WIDTH - 1);
            bits &= bits - 1;
            let child = node.child[lane];
            if child == u32::MAX {
                continue;
            }
            if child & LEAF == 0 {
                if pairs.last_leaf[child as usize] as usize >= leaves.start {
                    stack.push(child);
                }
                continue;
            }
            if ((child & !LEAF) as usize) < leaves.start {
                continue;
            }
            if count % WIDTH == 0 {
                near.try_reserve(1).map_err(|_| Error::memory("leaves", count + 1))?;
                near.push(Near { boxes: Boxes::EMPTY, leaf: [0; WIDTH] });
            }
            let (slot, last) = (count % WIDTH, near.len() - 1);
            for axis in 0..3 {
                near[last].boxes.lo[axis][slot] = node.lo[axis][lane];
                near[last].boxes.hi[axis][slot] = node.hi[axis][lane];
            }
            near[last].leaf[slot] = child & !LEAF;
            count += 1;
        }
    }
    Ok(())
}

/// The pairs of two leaves, or of one.
#[inline(always)]
fn between<S: Simd>(simd: S, pairs: &Pairs, leaf: usize, other: usize, out: &mut Vec<[u32; 2]>) -> Result<()> {
    let (ours, theirs) = (pairs.members(leaf), pairs.members(other));
    let room = WIDTH * WIDTH;
    out.try_reserve(room).map_err(|_| Error::memory("pairs", out.len() + room))?;
    let (lanes, boxes) = (&pairs.boxes[leaf], &pairs.boxes[other]);
    for (i, &a) in ours.iter().enumerate() {
        let mut bits = meeting(simd, &boxes.lo, &boxes.hi, lanes.lane(i));
        if leaf == other {
            // Each pair once, and nothing with itself.
            bits &= !0u32 << (i + 1);
        }
        while bits != 0 {
            let k = bits.trailing_zeros() as usize;
            bits &= bits - 1;
            if let Some(&b) = theirs.get(k) {
                out.push([a, b]);
            }
        }
    }
    Ok(())
}
