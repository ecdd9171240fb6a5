// SPDX-License-Identifier: MIT OR Apache-2.0
//! What may be nearest to some point of a box. For any set S and point b, dist(S, p)^2 - |p - b|^2 is a least of affine
//! functions of p, hence concave, and least at a corner of the box: where S is farther than b at all eight corners, it
//! is so in the whole box. Points of the surface are the b's, the witnesses.

use super::{LEAF, Node, Tree};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::simd::float8::{Float8, Simd, slack};
use crate::simd::lanes::WIDTH;

/// Eight things whose distance from a point is known to be at least so much. `slack` is that of the point. (A trait: closures are not always inlined, and what is not
/// inlined is compiled for the baseline.)
pub(crate) trait Eight<S: Simd> {
    fn at_least(&self, simd: S, at: [f32; 3], slack: f32) -> S::Float;
}

impl<S: Simd> Eight<S> for Node {
    #[inline(always)]
    fn at_least(&self, simd: S, at: [f32; 3], slack: f32) -> S::Float {
        let mut sum = S::Float::splat(simd, 0.0);
        for axis in 0..3 {
            let c = S::Float::splat(simd, at[axis]);
            let (lo, hi) = (S::Float::load(simd, &self.lo[axis]), S::Float::load(simd, &self.hi[axis]));
            let outside = lo.sub(c).max(c.sub(hi)).max(S::Float::splat(simd, 0.0));
            sum = outside.mul(outside).add(sum);
        }
        // Squares, sum and root are off by fewer than eight roundings.
        let distance = sum.sqrt();
        distance.mul(S::Float::splat(simd, 1.0 - 4.0 * f32::EPSILON)).sub(S::Float::splat(simd, slack))
    }
}

/// Witnesses of a box; more help little.
pub(crate) const WITNESSES: usize = 4;

/// The corners of a box, and how far from each the witnesses are.
pub(crate) struct Corners {
    at: [[f32; 3]; WIDTH],
    slack: [f32; WIDTH],
    /// Distances to the witnesses, rounded up.
    reach: [[f32; WIDTH]; WITNESSES],
}

impl Corners {
    /// Of corners and witnesses as the tree places them; witnesses are off the surface by up to `error`.
    pub(crate) fn new(corners: [Vec3; WIDTH], witnesses: [Vec3; WITNESSES], error: f64) -> Corners {
        let mut all = Corners {
            at: corners.map(|c| [c.x as f32, c.y as f32, c.z as f32]),
            slack: corners.map(|c| slack(c.abs().max_element())),
            reach: [[0.0; WIDTH]; WITNESSES],
        };
        for (j, witness) in witnesses.into_iter().enumerate() {
            for (k, corner) in corners.into_iter().enumerate() {
                // Beside a rounding of an f32 those of the f64 before it are nothing.
                all.reach[j][k] = ((corner - witness).length() * (1.0 + f64::from(f32::EPSILON)) + error) as f32;
            }
        }
        all
    }

    /// A bit for each of eight things that may be nearest somewhere.
    #[inline(always)]
    pub(crate) fn survivors<S: Simd>(&self, simd: S, things: &impl Eight<S>) -> u32 {
        let mut least = [S::Float::splat(simd, f32::INFINITY); WITNESSES];
        for k in 0..WIDTH {
            let distance = things.at_least(simd, self.at[k], self.slack[k]);
            for j in 0..WITNESSES {
                least[j] = distance.sub(S::Float::splat(simd, self.reach[j][k])).min(least[j]);
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

    /// How far a point is from the boxes at least, in eights; infinite beyond the last.
    #[inline(always)]
    pub(crate) fn distances<S: Simd>(&self, simd: S, at: [f32; 3], slack: f32, out: &mut Vec<f32>) -> Result<()> {
        out.clear();
        out.try_reserve(WIDTH * self.groups.len()).map_err(|_| Error::memory("leaves", self.count))?;
        for group in &self.groups {
            out.extend_from_slice(&group.at_least(simd, at, slack).lanes());
        }
        Ok(())
    }

    /// Those of `from` that may be nearest somewhere in the box.
    #[inline(always)]
    pub(crate) fn sift<S: Simd>(&mut self, simd: S, from: &LeafList, corners: &Corners) -> Result<()> {
        self.clear();
        for group in &from.groups {
            let mut bits = corners.survivors(simd, group);
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
            let mut bits = corners.survivors(simd, node);
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
