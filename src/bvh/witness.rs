// SPDX-License-Identifier: MIT OR Apache-2.0
//! What may be nearest to some point of a box. For any set S and point b, dist(S, p)^2 - |p - b|^2 is a least of affine
//! functions of p, hence concave, and least at a corner of the box: where S is farther than b at all eight corners, it
//! is so in the whole box. Points of the surface are the b's, the witnesses.

use super::oriented::{self, Oriented};
use super::{LEAF, Tree};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::simd::float8::{Float8, Simd, slack};
use crate::simd::lanes::WIDTH;

/// Eight things whose distance from a point is known to be at least so much. `slack` is that of the point. (A trait: closures are not always inlined, and what is not
/// inlined is compiled for the baseline.)
pub(crate) trait Eight<S: Simd> {
    fn at_least(&self, simd: S, at: [f32; 3], slack: f32) -> S::Float;
}

impl<S: Simd> Eight<S> for Oriented {
    #[inline(always)]
    fn at_least(&self, simd: S, at: [f32; 3], slack: f32) -> S::Float {
        // Squares are off by 24 roundings, distances by half as many and one.
        let distance = self.squares(simd, at).sqrt();
        distance.mul(S::Float::splat(simd, 1.0 - 10.0 * f32::EPSILON)).sub(S::Float::splat(simd, slack))
    }
}

/// The corners of a box, and how far from each the witnesses are.
pub(crate) struct Corners<const WITNESSES: usize> {
    at: [[f32; WIDTH]; 3],
    slack: [f32; WIDTH],
    /// Distances to the witnesses, rounded up.
    reach: [[f32; WIDTH]; WITNESSES],
}

impl<const WITNESSES: usize> Corners<WITNESSES> {
    /// Of corners and witnesses as the tree places them; witnesses are off the surface by up to `error`.
    #[inline(always)]
    pub(crate) fn new(corners: &[Vec3; WIDTH], witnesses: &[Vec3; WITNESSES], error: f64) -> Corners<WITNESSES> {
        let (mut at, mut slacks) = ([[0.0; WIDTH]; 3], [0.0; WIDTH]);
        let mut reach = [[0.0; WIDTH]; WITNESSES];
        for (k, corner) in corners.iter().enumerate() {
            (at[0][k], at[1][k], at[2][k]) = (corner.x as f32, corner.y as f32, corner.z as f32);
            slacks[k] = slack(corner.abs().max_element());
            for (j, witness) in witnesses.iter().enumerate() {
                // Beside a rounding of an f32 those of the f64 before it are nothing.
                reach[j][k] = ((*corner - *witness).length() * (1.0 + f64::from(f32::EPSILON)) + error) as f32;
            }
        }
        Corners { at, slack: slacks, reach }
    }

    /// A coordinate of all corners.
    #[inline(always)]
    pub(crate) fn along<S: Simd>(&self, simd: S, axis: usize) -> S::Float {
        S::Float::load(simd, &self.at[axis])
    }

    /// Whether what is at least so far from each corner may be nearest somewhere.
    #[inline(always)]
    pub(crate) fn survives<S: Simd>(&self, simd: S, lower: S::Float) -> bool {
        let mut survives = true;
        for reach in &self.reach {
            survives &= lower.sub(S::Float::load(simd, reach)).not_above(0.0) != 0;
        }
        survives
    }

    /// A bit for each of eight things that may be nearest somewhere.
    #[inline(always)]
    pub(crate) fn survivors<S: Simd>(&self, simd: S, things: &impl Eight<S>) -> u32 {
        let mut least = [S::Float::splat(simd, f32::INFINITY); WITNESSES];
        for k in 0..WIDTH {
            let distance = things.at_least(simd, [self.at[0][k], self.at[1][k], self.at[2][k]], self.slack[k]);
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
    groups: Vec<Oriented>,
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

    fn push(&mut self, node: &Oriented, lane: usize, leaf: u32) -> Result<()> {
        let k = self.count % WIDTH;
        if k == 0 {
            self.groups.try_reserve(1).map_err(|_| Error::memory("leaves", self.count + 1))?;
            self.groups.push(oriented::NONE);
        }
        let Some(group) = self.groups.last_mut() else { return Ok(()) };
        group.copy(k, node, lane);
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
    pub(crate) fn sift<S: Simd, const N: usize>(
        &mut self,
        simd: S,
        from: &LeafList,
        corners: &Corners<N>,
    ) -> Result<()> {
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
    /// After [`Tree::fit`], the leaves that may be nearest somewhere in the box; false where there are more than `most`. `stack` is scratch.
    #[inline(always)]
    pub(crate) fn surviving_leaves<S: Simd, const N: usize>(
        &self,
        simd: S,
        corners: &Corners<N>,
        most: usize,
        stack: &mut Vec<u32>,
        list: &mut LeafList,
    ) -> Result<bool> {
        list.clear();
        stack.clear();
        stack.push(0);
        while let Some(at) = stack.pop() {
            let node = &self.oriented[at as usize];
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
