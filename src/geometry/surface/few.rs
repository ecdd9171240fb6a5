// SPDX-License-Identifier: MIT OR Apache-2.0
//! The few triangles that may be nearest to some point of a cube: leaves by their boxes, their triangles first as seen
//! from the middle, then by the corners (`bvh/witness.rs`) with eight of them side by side.

use super::waiting::Waiting;
use super::{Leaf, NO_TRIANGLE, Nearest, Surface};
use crate::bvh::{Corners, LeafList, Tree};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::primitive::estimate::BELOW;
use crate::simd::float8::{Float8, Simd, slack};
use crate::simd::lanes::WIDTH;

/// More than these are not few.
const MOST: usize = 512;

/// Witnesses of a cell at first, as long as triangles are not known.
pub(super) const FIRST: usize = 4;

/// From farther than this, in sizes of the surface, f32 tells nothing apart.
pub(super) const FARTHEST: f64 = 1e4;

/// A triangle of a leaf.
#[derive(Clone, Copy)]
pub(super) struct Member {
    pub(super) leaf: u32,
    pub(super) lane: u32,
}

/// A box, as it is and as a tree places it.
pub(super) struct Cell {
    /// Bit k of an index is set at the upper end of axis k.
    pub(super) corners: [Vec3; WIDTH],
    placed: [Vec3; WIDTH],
    /// The largest coordinate's slack.
    slack: f32,
    middle: Vec3,
    /// No point is farther from the middle.
    radius: f32,
}

impl Cell {
    pub(super) fn new(tree: &Tree, lo: Vec3, hi: Vec3) -> Cell {
        let mut corners = [lo; WIDTH];
        for (k, corner) in corners.iter_mut().enumerate() {
            for axis in 0..3 {
                if k >> axis & 1 == 1 {
                    corner[axis] = hi[axis];
                }
            }
        }
        let placed = corners.map(|c| tree.place(c));
        let middle = lo + (hi - lo) * 0.5;
        let from = tree.place(middle);
        let (mut largest, mut radius) = (0.0f64, 0.0f64);
        for c in &placed {
            largest = largest.max(c.abs().max_element());
            radius = radius.max((*c - from).length());
        }
        let radius = (radius * (1.0 + 1e-6)) as f32;
        Cell { corners, placed, slack: slack(largest), middle, radius }
    }

    /// Whether f32 serves there.
    pub(super) fn is_near(&self) -> bool {
        self.placed.iter().all(|c| c.abs().max_element() < FARTHEST)
    }

    pub(super) fn middle(&self) -> Vec3 {
        self.middle
    }

    /// With points of the surface as witnesses.
    #[inline(always)]
    pub(super) fn with<const N: usize>(&self, surface: &Surface, tree: &Tree, witnesses: [Vec3; N]) -> Corners<N> {
        Corners::new(&self.placed, &witnesses.map(|w| tree.place(w)), self.error(surface, tree))
    }

    /// Nearest points are rounded to their coordinates, which are large where the surface is far from the origin.
    fn error(&self, surface: &Surface, tree: &Tree) -> f64 {
        let largest = self.corners.iter().fold(surface.reach(), |most, c| most.max(c.abs().max_element()));
        f64::from(tree.scaled(16.0 * f64::EPSILON * largest))
    }
}

/// What [`Few::find`] finds.
#[derive(Default)]
pub(super) struct Few {
    leaves: LeafList,
    pub(super) members: Vec<Member>,
    /// How far each is at least from the corners.
    lower: Vec<[f32; WIDTH]>,
}

impl Few {
    /// Looks in `leaves`, given the nearest triangle of the cell's middle and points of the surface; false where there are
    /// too many.
    #[inline(always)]
    pub(super) fn find<S: Simd>(
        &mut self,
        simd: S,
        (surface, tree): (&Surface, &Tree),
        leaves: &LeafList,
        cell: &Cell,
        nearest: &Nearest,
        mut witnesses: [Vec3; FIRST],
    ) -> Result<bool> {
        witnesses[0] = nearest.point;
        let corners = cell.with(surface, tree, witnesses);
        self.leaves.sift(simd, leaves, &corners)?;
        self.members.clear();
        self.lower.clear();
        let placed = tree.place(cell.middle);
        let middle = [placed.x as f32, placed.y as f32, placed.z as f32];
        let error = cell.error(surface, tree) as f32;
        let distance = (placed - tree.place(nearest.point)).length() as f32;
        let reach = (distance + error) * (1.0 + f32::EPSILON) + 2.0 * cell.radius + cell.slack;
        for k in 0..self.leaves.len() {
            let index = self.leaves.leaf(k);
            let leaf = &surface.leaves[index];
            let [lower, _] = leaf.estimates.between(simd, middle, cell.slack);
            let mut bits = lower.not_above(reach);
            self.members.try_reserve(WIDTH).map_err(|_| Error::memory("triangles", self.members.len() + WIDTH))?;
            self.lower.try_reserve(WIDTH).map_err(|_| Error::memory("triangles", self.members.len() + WIDTH))?;
            while bits != 0 {
                let lane = bits.trailing_zeros() as usize & (WIDTH - 1);
                bits &= bits - 1;
                let lower = at_corners(simd, leaf, lane, &corners, cell.slack);
                if corners.survives(simd, lower) && leaf.triangle[lane] != NO_TRIANGLE {
                    self.members.push(Member { leaf: index as u32, lane: lane as u32 });
                    self.lower.push(lower.lanes());
                }
            }
            if self.members.len() > 2 * MOST {
                return Ok(false);
            }
        }
        if self.members.is_empty() {
            return Ok(false);
        }
        let witnesses = self.witnesses(surface, &cell.corners);
        self.sift(simd, &cell.with(surface, tree, witnesses));
        Ok(self.members.len() <= MOST)
    }

    /// The points of the surface that are nearest, or nearly so, to a cell's corners; there is a member.
    #[inline(always)]
    fn witnesses(&self, surface: &Surface, at: &[Vec3; WIDTH]) -> [Vec3; WIDTH] {
        let (mut least, mut which) = ([f32::INFINITY; WIDTH], [0u32; WIDTH]);
        for (t, lower) in (0..).zip(&self.lower) {
            for k in 0..WIDTH {
                let nearer = lower[k] < least[k];
                least[k] = if nearer { lower[k] } else { least[k] };
                which[k] = if nearer { t } else { which[k] };
            }
        }
        let mut witnesses = *at;
        for k in 0..WIDTH {
            let Member { leaf, lane } = self.members[which[k] as usize];
            let triangle = surface.leaves[leaf as usize].triangle[lane as usize];
            witnesses[k] = surface.nearest_of(triangle, at[k]);
        }
        witnesses
    }

    /// Leaves those that may be nearest.
    #[inline(always)]
    fn sift<S: Simd>(&mut self, simd: S, corners: &Corners<WIDTH>) {
        let mut left = 0;
        for t in 0..self.members.len() {
            self.members[left] = self.members[t];
            left += usize::from(corners.survives(simd, S::Float::load(simd, &self.lower[t])));
        }
        self.members.truncate(left);
    }
}

/// How far a triangle is at least from the corners.
#[inline(always)]
fn at_corners<S: Simd, const N: usize>(
    simd: S,
    leaf: &Leaf,
    lane: usize,
    corners: &Corners<N>,
    slack: f32,
) -> S::Float {
    let one = leaf.estimates.one(simd, lane);
    let mut frame = one.along::<S>(0, corners.along(simd, 0));
    for axis in 1..3 {
        let part = one.along::<S>(axis, corners.along(simd, axis));
        frame = [frame[0].add(part[0]), frame[1].add(part[1]), frame[2].add(part[2])];
    }
    let margin = S::Float::splat(simd, leaf.estimates.margin(lane, slack));
    one.distances(simd, frame).mul(S::Float::splat(simd, BELOW)).sub(margin)
}

/// The nearest triangle of some leaves; `distances` is scratch.
#[inline(always)]
pub(super) fn nearest_in<S: Simd>(
    simd: S,
    (surface, tree): (&Surface, &Tree),
    leaves: &LeafList,
    p: Vec3,
    distances: &mut Vec<f32>,
) -> Result<Nearest> {
    let placed = tree.place(p);
    let at = [placed.x as f32, placed.y as f32, placed.z as f32];
    let slack = slack(placed.abs().max_element());
    leaves.distances(simd, at, slack, distances)?;
    let first = (0..leaves.len()).fold(0, |best, k| if distances[k] < distances[best] { k } else { best });
    let mut waiting = Waiting::new(surface, p);
    let mut limit = waiting.look(simd, &surface.leaves[leaves.leaf(first)], at, slack);
    for k in 0..leaves.len() {
        let is_far = distances[k] > limit;
        if k != first && !is_far {
            limit = waiting.look(simd, &surface.leaves[leaves.leaf(k)], at, slack);
        }
    }
    waiting.settle_all(simd);
    Ok(waiting.nearest())
}
