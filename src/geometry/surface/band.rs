// SPDX-License-Identifier: MIT OR Apache-2.0
//! Distances below a band, over a slab of a lattice. Each leaf is looked at from the points around it, instead of each
//! point looking for its leaves: points farther than the band from all leaves cost nothing. The distances are those of
//! single points to the bit: what may be nearest in f32 is left to the kernel.

use super::waiting::Waiting;
use super::{NO_TRIANGLE, Surface};
use crate::bvh::Tree;
use crate::error::{Error, Result};
use crate::math::{Aabb, Vec3};
use crate::scan::Axis;
use crate::simd::float8::{Float8, Simd, slack};
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, dispatch};
use std::ops::Range;

/// Cubes of so many points a side are left out where they are far from the leaf.
const SIDE: usize = 4;

/// Bands wider than so many sizes of the surface, and slabs of more points, are not for this.
const WIDEST: f64 = 100.0;
const MOST_POINTS: usize = 1 << 23;

/// Points that a leaf may be looked at from: so many for each point of the lattice, and for each leaf. Beyond that tiles
/// cost less.
const PER_POINT: usize = 4;
const PER_LEAF: usize = 400;

/// Ends a list.
const NONE: u32 = u32::MAX;

/// Buffers that serve one slab after another.
#[derive(Default)]
pub(crate) struct BandWork {
    points: Vec<Point>,
    candidates: Vec<Candidate>,
    leaves: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Point {
    /// How far the nearest triangle is at most, as the tree scales it, or the band.
    limit: f32,
    last: u32,
}

/// A triangle that may be the nearest of a point.
struct Candidate {
    triangle: u32,
    lower: f32,
    before: u32,
}

/// Where the points of a slab are, and how near a surface is to be.
#[derive(Clone, Copy)]
pub(crate) struct BandSlab<'a> {
    pub(crate) axes: [&'a Axis; 3],
    /// The points along z that the slab has.
    pub(crate) rows: &'a Range<usize>,
    pub(crate) band: f64,
}

impl BandSlab<'_> {
    fn row_len(&self) -> [usize; 2] {
        [self.axes[0].len(), self.axes[1].len()]
    }

    /// A leaf farther than this has no point within the band.
    fn reach(&self, surface: &Surface) -> f64 {
        self.band * (1.0 + 1e-9) + 1e-12 * (surface.reach() + surface.diagonal() + self.band)
    }

    /// The points that lie as near as that to a leaf.
    fn around(&self, b: Aabb, reach: f64) -> [Range<usize>; 3] {
        let range = |k: usize| self.axes[k].within(b.lo[k] - reach, b.hi[k] + reach);
        let z = range(2);
        [range(0), range(1), z.start.max(self.rows.start)..z.end.min(self.rows.end)]
    }
}

fn size(ranges: &[Range<usize>; 3]) -> usize {
    ranges.iter().fold(1, |n, r| n.saturating_mul(r.len()))
}

impl Surface {
    /// Whether [`Surface::near_band`] costs less than tiles; `slab` is all of the lattice.
    pub(crate) fn band_pays(&self, slab: &BandSlab, rows: usize) -> bool {
        let [nx, ny] = slab.row_len();
        let points = nx * ny * slab.rows.len();
        if self.leaves.is_empty() || slab.band > WIDEST * self.diagonal() || nx * ny * rows > MOST_POINTS {
            return false;
        }
        let reach = slab.reach(self);
        let steps = |k: usize| {
            let axis = slab.axes[k];
            let extent = if axis.len() > 1 { axis.at(axis.len() - 1) - axis.at(0) } else { 0.0 };
            if extent > 0.0 { (reach / extent * (axis.len() - 1) as f64) as usize } else { 0 }
        };
        let thick = 2 * (0..3).map(steps).max().unwrap_or(0) + 2 * SIDE;
        let most = PER_POINT * points + PER_LEAF * self.leaves.len();
        let mut looks = 0usize;
        for leaf in 0..self.leaves.len() {
            let around = slab.around(self.leaf_bounds(leaf), reach);
            let (all, thin) = (size(&around), around.iter().map(Range::len).min().unwrap_or(0));
            looks += if thin > thick { all / thin * thick + all / (SIDE * SIDE * SIDE) } else { all };
            if looks > most {
                return false;
            }
        }
        true
    }

    fn leaf_bounds(&self, leaf: usize) -> Aabb {
        let mut bounds = Aabb::EMPTY;
        for &t in self.leaves[leaf].triangle.iter().filter(|t| **t != NO_TRIANGLE) {
            let [a, b, c] = self.corners(t);
            bounds = bounds.hull(Aabb::new(a.min(b).min(c), a.max(b).max(c)));
        }
        bounds
    }

    /// Calls `put` with the distance of every point of the slab whose distance is below the band, and of some others:
    /// with the number of the point, x fastest, then y, then z, from 0 for the first of the slab. In order.
    pub(crate) fn near_band(
        &self,
        slab: &BandSlab,
        work: &mut BandWork,
        put: &mut dyn FnMut(usize, f64),
    ) -> Result<()> {
        let Some(tree) = &self.tree else { return Ok(()) };
        let [nx, ny] = slab.row_len();
        let count = nx * ny * slab.rows.len();
        let reach = slab.reach(self);
        work.leaves.clear();
        work.candidates.clear();
        work.points.clear();
        work.points.try_reserve(count).map_err(|_| Error::memory("points", count))?;
        // Whatever is nearer than the band is at least this near, rounded to f32.
        let limit = tree.scaled(slab.band) * (1.0 + 1e-6);
        work.points.resize(count, Point { limit, last: NONE });
        let (first, last) = (slab.axes[2].at(slab.rows.start), slab.axes[2].at(slab.rows.end - 1));
        let (mut lo, mut hi) = (Vec3::NEG_INFINITY, Vec3::INFINITY);
        (lo.z, hi.z) = (first - reach, last + reach);
        let mut full = false;
        let leaves = &mut work.leaves;
        tree.overlapping(Aabb::new(lo, hi), |leaf| {
            full |= leaves.try_reserve(1).is_err();
            if !full {
                leaves.push(leaf as u32);
            }
        });
        if full {
            return Err(Error::memory("leaves", work.leaves.len() + 1));
        }
        dispatch(Looks { surface: self, tree, slab, reach, limit, work })?;
        dispatch(Answers { surface: self, slab, work, put });
        Ok(())
    }
}

/// Looks at every leaf from the points around it.
struct Looks<'a> {
    surface: &'a Surface,
    tree: &'a Tree,
    slab: &'a BandSlab<'a>,
    reach: f64,
    limit: f32,
    work: &'a mut BandWork,
}

impl Kernel for Looks<'_> {
    type Output = Result<()>;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) -> Result<()> {
        for k in 0..self.work.leaves.len() {
            let leaf = self.work.leaves[k] as usize;
            let around = self.slab.around(self.surface.leaf_bounds(leaf), self.reach);
            let cut = size(&around) > SIDE * SIDE * SIDE;
            let [x, y, z] = &around;
            for k in z.clone().step_by(SIDE) {
                for j in y.clone().step_by(SIDE) {
                    for i in x.clone().step_by(SIDE) {
                        let piece = [i..x.end.min(i + SIDE), j..y.end.min(j + SIDE), k..z.end.min(k + SIDE)];
                        if !(cut && self.is_far(simd, leaf, &piece)) {
                            simd.apart(Look { looks: &mut self, leaf, piece })?;
                        }
                    }
                }
            }
        }
        Ok(())
    }
}

impl Looks<'_> {
    fn placed(&self, [i, j, k]: [usize; 3]) -> Vec3 {
        let [x, y, z] = self.slab.axes;
        self.tree.place(Vec3::new(x.at(i), y.at(j), z.at(k)))
    }

    /// Whether no point of a cube is within the band of a leaf.
    #[inline(always)]
    fn is_far<S: Simd>(&self, simd: S, leaf: usize, piece: &[Range<usize>; 3]) -> bool {
        let low = self.placed([piece[0].start, piece[1].start, piece[2].start]);
        let high = self.placed([piece[0].end - 1, piece[1].end - 1, piece[2].end - 1]);
        let (middle, half) = (0.5 * low + 0.5 * high, 0.5 * (high - low).length());
        let slack = slack(middle.abs().max_element());
        let at = [middle.x as f32, middle.y as f32, middle.z as f32];
        let [lower, _] = self.surface.leaves[leaf].estimates.between(simd, at, slack);
        lower.not_above((self.limit + half as f32) * (1.0 + 1e-5) + slack) == 0
    }
}

/// Looks at a leaf from the points of a small cube.
struct Look<'w, 'a> {
    looks: &'w mut Looks<'a>,
    leaf: usize,
    piece: [Range<usize>; 3],
}

impl Kernel for Look<'_, '_> {
    type Output = Result<()>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Result<()> {
        let Look { looks, leaf, piece } = self;
        let low = looks.placed([piece[0].start, piece[1].start, piece[2].start]);
        let high = looks.placed([piece[0].end - 1, piece[1].end - 1, piece[2].end - 1]);
        let slack = slack(low.abs().max(high.abs()).max_element());
        let [nx, ny] = looks.slab.row_len();
        let mut xs = [0.0; SIDE];
        for (x, i) in xs.iter_mut().zip(piece[0].clone()) {
            *x = looks.placed([i, piece[1].start, piece[2].start]).x as f32;
        }
        let leaf = &looks.surface.leaves[leaf];
        let BandWork { points, candidates, .. } = &mut *looks.work;
        for k in piece[2].clone() {
            for j in piece[1].clone() {
                let Vec3 { y, z, .. } =
                    looks.tree.place(Vec3::new(0.0, looks.slab.axes[1].at(j), looks.slab.axes[2].at(k)));
                let row = nx * (j + ny * (k - looks.slab.rows.start)) + piece[0].start;
                for (point, x) in points[row..row + piece[0].len()].iter_mut().zip(xs) {
                    let [lower, upper] = leaf.estimates.between(simd, [x, y as f32, z as f32], slack);
                    let mut near = lower.not_above(point.limit);
                    if near == 0 {
                        continue;
                    }
                    let least = upper.least();
                    if least < point.limit {
                        point.limit = least;
                        near &= lower.not_above(least);
                    }
                    let lower = lower.lanes();
                    while near != 0 {
                        let lane = near.trailing_zeros() as usize & (WIDTH - 1);
                        near &= near - 1;
                        if leaf.triangle[lane] == NO_TRIANGLE {
                            continue;
                        }
                        let count = candidates.len();
                        if count == candidates.capacity() {
                            candidates.try_reserve(count.max(1024)).map_err(|_| Error::memory("triangles", count))?;
                        }
                        candidates.push(Candidate {
                            triangle: leaf.triangle[lane],
                            lower: lower[lane],
                            before: point.last,
                        });
                        point.last = count as u32;
                    }
                }
            }
        }
        match candidates.len() < NONE as usize - (1 << 16) {
            true => Ok(()),
            false => Err(Error::memory("triangles", candidates.len())),
        }
    }
}

/// Leaves the candidates of every point to the kernel.
struct Answers<'a, 'b> {
    surface: &'a Surface,
    slab: &'a BandSlab<'a>,
    work: &'a BandWork,
    put: &'b mut dyn FnMut(usize, f64),
}

impl Kernel for Answers<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Answers { surface, slab, work, put } = self;
        let [nx, ny] = slab.row_len();
        let [x, y, z] = slab.axes;
        for (row, points) in work.points.chunks(nx).enumerate() {
            for (i, point) in points.iter().enumerate() {
                if point.last != NONE {
                    let p = Vec3::new(x.at(i), y.at(row % ny), z.at(slab.rows.start + row / ny));
                    put(row * nx + i, simd.apart(Answer { surface, p, point, candidates: &work.candidates }));
                }
            }
        }
    }
}

struct Answer<'a> {
    surface: &'a Surface,
    p: Vec3,
    point: &'a Point,
    candidates: &'a [Candidate],
}

impl Kernel for Answer<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> f64 {
        let mut waiting = Waiting::new(self.surface, self.p);
        let mut at = self.point.last;
        while at != NONE {
            let Candidate { triangle, lower, before } = self.candidates[at as usize];
            let is_far = lower > self.point.limit;
            if !is_far {
                waiting.add(simd, triangle, lower);
            }
            at = before;
        }
        waiting.settle(simd);
        waiting.nearest().distance
    }
}
