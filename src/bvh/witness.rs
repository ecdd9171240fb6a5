// SPDX-License-Identifier: MIT OR Apache-2.0
//! What may be nearest to some point of a box. For any set S and point b, dist(S, p)^2 - |p - b|^2 is a least of affine
//! functions of p, hence concave, and least at a corner of the box: where S is farther than b at all eight corners, it
//! is so in the whole box. Points of the surface are the b's, the witnesses.

use super::{LEAF, Node, Tree};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::simd::float8::{Float8, Simd};
use crate::simd::lanes::WIDTH;

/// Eight things whose distance from a point is known. (A trait: closures are not always inlined, and what is not
/// inlined is compiled for the baseline.)
pub(crate) trait Eight<S: Simd> {
    fn distances(&self, simd: S, at: [f32; 3]) -> S::Float;
}

/// Squared distances of boxes.
impl<S: Simd> Eight<S> for Node {
    #[inline(always)]
    fn distances(&self, simd: S, at: [f32; 3]) -> S::Float {
        let mut sum = S::Float::splat(simd, 0.0);
        for axis in 0..3 {
            let c = S::Float::splat(simd, at[axis]);
            let (lo, hi) = (S::Float::load(simd, &self.lo[axis]), S::Float::load(simd, &self.hi[axis]));
            let outside = lo.sub(c).max(c.sub(hi)).max(S::Float::splat(simd, 0.0));
            sum = outside.mul(outside).add(sum);
        }
        sum
    }
}

/// Witnesses of a box; more help little.
pub(crate) const WITNESSES: usize = 4;

/// The corners of a box, and how far from each the witnesses are.
pub(crate) struct Corners {
    at: [[f32; 3]; WIDTH],
    /// Distances to the witnesses, with room for the rounding of what they are compared with.
    reach: [[f32; WIDTH]; WITNESSES],
    squared: [[f32; WIDTH]; WITNESSES],
}

impl Corners {
    /// Of corners and witnesses as the tree places them; `error` is that of a distance to a primitive relative to one plus
    /// the largest coordinate, at least that of boxes.
    pub(crate) fn new(corners: [Vec3; WIDTH], witnesses: [Vec3; WITNESSES], error: f64) -> Corners {
        let largest = corners.iter().fold(0.0f64, |most, c| most.max(c.abs().max_element()));
        // The error of the distance and as much again, beside which the rounding of an f64 is nothing, and that
        // of the distance to the witness.
        let room = 3.0 * error * (1.0 + largest);
        let mut all = Corners {
            at: corners.map(|c| [c.x as f32, c.y as f32, c.z as f32]),
            reach: [[0.0; WIDTH]; WITNESSES],
            squared: [[0.0; WIDTH]; WITNESSES],
        };
        for (j, witness) in witnesses.into_iter().enumerate() {
            for (k, corner) in corners.into_iter().enumerate() {
                let reach = (corner - witness).length() + room;
                all.reach[j][k] = reach as f32;
                all.squared[j][k] = (reach * reach) as f32;
            }
        }
        all
    }

    /// A bit for each of eight things that may be nearest somewhere.
    #[inline(always)]
    pub(crate) fn survivors<S: Simd>(&self, simd: S, things: &impl Eight<S>) -> u32 {
        self.not_beyond(simd, &self.reach, things)
    }

    #[inline(always)]
    fn surviving_boxes<S: Simd>(&self, simd: S, boxes: &Node) -> u32 {
        self.not_beyond(simd, &self.squared, boxes)
    }

    #[inline(always)]
    fn not_beyond<S: Simd>(&self, simd: S, reach: &[[f32; WIDTH]; WITNESSES], things: &impl Eight<S>) -> u32 {
        let mut least = [S::Float::splat(simd, f32::INFINITY); WITNESSES];
        for k in 0..WIDTH {
            let distance = things.distances(simd, self.at[k]);
            for j in 0..WITNESSES {
                least[j] = distance.sub(S::Float::splat(simd, reach[j][k])).min(least[j]);
            }
        }
        let mut bits = 0xFF;
        for j in 0..WITNESSES {
            bits &= least[j].not_above(0.0);
        }
        bits
    }
}

/// Leaves with their boxes, eight side by side.
#[derive(Default)]
pub(crate) struct LeafList {
    groups: Vec<Node>,
    count: usize,
}

impl LeafList {
    /// How many.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    pub(crate) fn leaf(&self, k: usize) -> usize {
        self.groups[k / WIDTH].child[k % WIDTH] as usize
    }

    fn clear(&mut self) {
        self.groups.clear();
        self.count = 0;
    }

    fn push(&mut self, node: &Node, lane: usize, leaf: u32) -> Result<()> {
        let k = self.count % WIDTH;
        if k == 0 {
            self.groups.try_reserve(1).map_err(|_| Error::memory("leaves", self.count + 1))?;
            self.groups.push(super::EMPTY_NODE);
        }
        let Some(group) = self.groups.last_mut() else { return Ok(()) };
        for axis in 0..3 {
            (group.lo[axis][k], group.hi[axis][k]) = (node.lo[axis][lane], node.hi[axis][lane]);
        }
        group.child[k] = leaf;
        self.count += 1;
        Ok(())
    }

    /// Squared distances of a point to the boxes, in eights; infinite beyond the last.
    #[inline(always)]
    pub(crate) fn squares<S: Simd>(&self, simd: S, at: [f32; 3], out: &mut Vec<f32>) -> Result<()> {
        out.clear();
        out.try_reserve(WIDTH * self.groups.len()).map_err(|_| Error::memory("leaves", self.count))?;
        for group in &self.groups {
            out.extend_from_slice(&group.distances(simd, at).lanes());
        }
        Ok(())
    }

    /// Those of `from` that may be nearest somewhere in the box.
    #[inline(always)]
    pub(crate) fn sift<S: Simd>(&mut self, simd: S, from: &LeafList, corners: &Corners) -> Result<()> {
        self.clear();
        for group in &from.groups {
            let mut bits = corners.surviving_boxes(simd, group);
            while bits != 0 {
                let k = bits.trailing_zeros() as usize & (WIDTH - 1);
                bits &= bits - 1;
                if group.child[k] != u32::MAX {
                    self.push(group, k, group.child[k])?;
                }
            }
        }
        Ok(())
    }
}

impl Tree {
    /// The leaves that may be nearest somewhere in the box; false where there are more than `most`. `stack` is scratch.
    #[inline(always)]
    pub(crate) fn surviving_leaves<S: Simd>(
        &self,
        simd: S,
        corners: &Corners,
        most: usize,
        stack: &mut Vec<u32>,
        list: &mut LeafList,
    ) -> Result<bool> {
        list.clear();
        stack.clear();
        stack.push(0);
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at as usize];
            let mut bits = corners.surviving_boxes(simd, node);
            while bits != 0 {
                let k = bits.trailing_zeros() as usize & (WIDTH - 1);
                bits &= bits - 1;
                match node.child[k] {
                    u32::MAX => {}
                    child if child & LEAF == 0 => stack.push(child),
                    child => list.push(node, k, child & !LEAF)?,
                }
            }
            if list.count > most {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
