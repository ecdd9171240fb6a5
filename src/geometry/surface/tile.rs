// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values over a block of a lattice. Cubes of 8 points a side, then of 4, find together what may be nearest to one of
//! their points (`bvh/witness.rs`); each point then asks the few triangles that are left. The values are those of
//! single points to the bit.

use super::columns::Columns;
use super::nearest::Waiting;
use super::{Leaf, NO_TRIANGLE, Nearest, Surface};
use crate::bvh::{Corners, Eight, LeafList, Tree, WITNESSES};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::primitive::estimate::Estimates;
use crate::simd::float8::{Float8, Simd, slack};
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, dispatch};
use std::ops::Range;

/// Points a side of the larger and of the smaller cubes.
const LARGE: usize = 8;
const SMALL: usize = 4;

/// With more leaves or triangles than these for a cube, its points ask the hierarchy one by one.
const MOST_LEAVES: usize = 192;
const MOST_TRIANGLES: usize = 256;

/// From farther than this, in sizes of the surface, f32 tells nothing apart.
const FARTHEST: f64 = 1e4;

/// A block of a lattice, and what is to be known there.
#[derive(Clone, Copy)]
pub(crate) struct Block<'a> {
    pub(crate) axes: [&'a [f64]; 3],
    /// Values of at least this magnitude may be any such of the same sign. Infinity: no value.
    pub(crate) far: f64,
}

impl Block<'_> {
    fn point(&self, [i, j, k]: [usize; 3]) -> Vec3 {
        Vec3::new(self.axes[0][i], self.axes[1][j], self.axes[2][k])
    }

    fn place(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.axes[0].len() * (j + self.axes[1].len() * k)
    }
}

/// A cube of a block.
#[derive(Clone)]
struct Cube([Range<usize>; 3]);

impl Cube {
    /// Its corner points, of which some are one where it is a point thin.
    fn corners(&self) -> [[usize; 3]; WIDTH] {
        let end = |range: &Range<usize>, last: bool| if last { range.end - 1 } else { range.start };
        std::array::from_fn(|k| std::array::from_fn(|axis| end(&self.0[axis], k >> axis & 1 == 1)))
    }

    fn points(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let [x, y, z] = &self.0;
        z.clone().flat_map(move |k| y.clone().flat_map(move |j| x.clone().map(move |i| [i, j, k])))
    }

    fn cut(&self, side: usize) -> impl Iterator<Item = Cube> + '_ {
        let [x, y, z] = &self.0;
        let pieces = move |range: &Range<usize>| {
            let range = range.clone();
            range.clone().step_by(side).map(move |from| from..range.end.min(from + side))
        };
        pieces(z).flat_map(move |z| {
            pieces(y).flat_map(move |y| {
                let z = z.clone();
                pieces(x).map(move |x| Cube([x, y.clone(), z.clone()]))
            })
        })
    }
}

/// Buffers that serve one cube after another.
#[derive(Default)]
struct Scratch {
    stack: Vec<u32>,
    large: LeafList,
    small: LeafList,
    distances: Vec<f32>,
    triangles: Vec<Leaf>,
    count: usize,
}

impl Surface {
    /// Fills `out`, x fastest.
    pub(crate) fn block_values(&self, block: &Block, out: &mut [f64]) -> Result<()> {
        let whole = Cube(std::array::from_fn(|axis| 0..block.axes[axis].len()));
        let mut columns = Columns::new(self, block)?;
        let mut scratch = Scratch::default();
        for cube in whole.cut(LARGE) {
            if block.far < f64::INFINITY && self.is_far(block, &cube, &mut columns, out)? {
                continue;
            }
            let Some(tree) = self.tree.as_ref().filter(|_| self.compact.is_none()) else {
                self.one_by_one(block, &cube, &mut columns, out)?;
                continue;
            };
            let work =
                Work { surface: self, tree, block, cube: &cube, columns: &mut columns, scratch: &mut scratch, out };
            dispatch(work)?;
        }
        Ok(())
    }

    fn one_by_one(&self, block: &Block, cube: &Cube, columns: &mut Columns, out: &mut [f64]) -> Result<()> {
        let mut points = [Vec3::ZERO; LARGE * LARGE * LARGE];
        let mut count = 0;
        for (slot, at) in points.iter_mut().zip(cube.points()) {
            *slot = block.point(at);
            count += 1;
        }
        let mut at = cube.points();
        let mut done = Ok(());
        self.for_each_nearest(&points[..count], |k, nearest| {
            if let (Ok(()), Some(at)) = (&done, at.next()) {
                match columns.signed(at, points[k], nearest) {
                    Ok(value) => out[block.place(at)] = value,
                    Err(error) => done = Err(error),
                }
            }
        });
        done
    }

    /// Fills a cube that is as far from the surface as need be.
    fn is_far(&self, block: &Block, cube: &Cube, columns: &mut Columns, out: &mut [f64]) -> Result<bool> {
        let middle = [0, 1, 2].map(|axis| (cube.0[axis].start + cube.0[axis].end) / 2);
        let p = block.point(middle);
        let nearest = self.nearest(p);
        let radius = cube.corners().iter().fold(0.0f64, |most, c| most.max((block.point(*c) - p).length()));
        // Room for the rounding of distances, in coordinates of any size.
        let rounding = 1e-13 * (p.abs().max_element() + self.reach() + self.diagonal + nearest.distance);
        if nearest.distance - radius - rounding <= block.far.max(rounding) {
            return Ok(false);
        }
        let value = columns.signed(middle, p, &nearest)?;
        cube.points().for_each(|at| out[block.place(at)] = value);
        Ok(true)
    }
}

struct Work<'a, 'b> {
    surface: &'a Surface,
    tree: &'a Tree,
    block: &'a Block<'a>,
    cube: &'a Cube,
    columns: &'a mut Columns<'b>,
    scratch: &'a mut Scratch,
    out: &'a mut [f64],
}

impl Kernel for Work<'_, '_> {
    type Output = Result<()>;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) -> Result<()> {
        let Work { surface, tree, block, cube, .. } = self;
        let at = cube.corners();
        let is_near = |c: [usize; 3]| tree.place(block.point(c)).abs().max_element() < FARTHEST;
        let nearest = at.map(|c| surface.nearest(block.point(c)));
        let corners = corners(surface, tree, at.map(|c| block.point(c)), &nearest);
        let Scratch { stack, large, .. } = self.scratch;
        if !(at.into_iter().all(is_near) && tree.surviving_leaves(simd, &corners, MOST_LEAVES, stack, large)?) {
            return surface.one_by_one(block, cube, self.columns, self.out);
        }
        for small in cube.cut(SMALL) {
            self.small(simd, &small)?;
        }
        Ok(())
    }
}

/// A point's question: of the few triangles of its small cube, or of the leaves of the large one.
struct Ask<'w, 'a, 'b> {
    work: &'w mut Work<'a, 'b>,
    p: Vec3,
    of_few: bool,
}

impl Kernel for Ask<'_, '_, '_> {
    type Output = Result<Nearest>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Result<Nearest> {
        if self.of_few { self.work.by_triangles(simd, self.p) } else { self.work.by_leaves(simd, self.p) }
    }
}

impl<S: Simd> Eight<S> for Leaf {
    #[inline(always)]
    fn at_least(&self, simd: S, at: [f32; 3], slack: f32) -> S::Float {
        let [lower, _] = self.estimates.between(simd, at, slack);
        lower
    }
}

impl Work<'_, '_> {
    #[inline(always)]
    fn small<S: Simd>(&mut self, simd: S, cube: &Cube) -> Result<()> {
        let Work { surface, tree, block, .. } = *self;
        let at = cube.corners();
        let mut nearest = [Nearest::NONE; WIDTH];
        for (k, c) in at.into_iter().enumerate() {
            // Where the cube is a point thin, corners are one.
            nearest[k] = match at[..k].iter().position(|other| *other == c) {
                Some(same) => nearest[same],
                None => simd.apart(Ask { work: self, p: block.point(c), of_few: false })?,
            };
            self.out[block.place(c)] = self.columns.signed(c, block.point(c), &nearest[k])?;
        }
        let corners = corners(surface, tree, at.map(|c| block.point(c)), &nearest);
        let Scratch { large, small, .. } = self.scratch;
        small.sift(simd, large, &corners)?;
        let of_few = self.gather(simd, &corners)?;
        for point in cube.points().filter(|point| !at.contains(point)) {
            let p = block.point(point);
            let nearest = simd.apart(Ask { work: self, p, of_few })?;
            self.out[block.place(point)] = self.columns.signed(point, p, &nearest)?;
        }
        Ok(())
    }

    /// The nearest triangle of all leaves of the large cube.
    #[inline(always)]
    fn by_leaves<S: Simd>(&mut self, simd: S, p: Vec3) -> Result<Nearest> {
        let Scratch { large, distances, .. } = self.scratch;
        if large.len() == 0 {
            return Ok(self.surface.nearest(p));
        }
        let placed = self.tree.place(p);
        let at = [placed.x as f32, placed.y as f32, placed.z as f32];
        let slack = slack(placed.abs().max_element());
        large.distances(simd, at, slack, distances)?;
        let first = (0..large.len()).fold(0, |best, k| if distances[k] < distances[best] { k } else { best });
        let mut waiting = Waiting::new(self.surface, p);
        let mut limit = waiting.look(simd, &self.surface.leaves[large.leaf(first)], at, slack);
        for k in 0..large.len() {
            let is_far = distances[k] > limit;
            if k != first && !is_far {
                limit = waiting.look(simd, &self.surface.leaves[large.leaf(k)], at, slack);
            }
        }
        waiting.settle_all(simd);
        Ok(waiting.nearest())
    }

    /// Lays the triangles that may be nearest in the small cube side by side; false where there are too many.
    #[inline(always)]
    fn gather<S: Simd>(&mut self, simd: S, corners: &Corners) -> Result<bool> {
        let Scratch { small, triangles, count, .. } = self.scratch;
        triangles.clear();
        *count = 0;
        for k in 0..small.len() {
            let leaf = &self.surface.leaves[small.leaf(k)];
            let mut bits = corners.survivors(simd, leaf);
            while bits != 0 {
                let from = bits.trailing_zeros() as usize & (WIDTH - 1);
                bits &= bits - 1;
                if leaf.triangle[from] == NO_TRIANGLE {
                    continue;
                }
                let to = *count % WIDTH;
                if to == 0 {
                    triangles.try_reserve(1).map_err(|_| Error::memory("leaves", triangles.len() + 1))?;
                    triangles.push(Leaf { estimates: Estimates::NONE, triangle: [NO_TRIANGLE; WIDTH] });
                }
                if let Some(last) = triangles.last_mut() {
                    last.estimates.copy(to, &leaf.estimates, from);
                    last.triangle[to] = leaf.triangle[from];
                }
                *count += 1;
            }
            if *count > MOST_TRIANGLES {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The nearest of the triangles laid side by side.
    #[inline(always)]
    fn by_triangles<S: Simd>(&mut self, simd: S, p: Vec3) -> Result<Nearest> {
        let Scratch { triangles, distances, .. } = self.scratch;
        let placed = self.tree.place(p);
        let at = [placed.x as f32, placed.y as f32, placed.z as f32];
        let slack = slack(placed.abs().max_element());
        distances.clear();
        distances.try_reserve(WIDTH * triangles.len()).map_err(|_| Error::memory("leaves", triangles.len()))?;
        let mut least = S::Float::splat(simd, f32::INFINITY);
        for leaf in triangles.iter() {
            let [lower, upper] = leaf.estimates.between(simd, at, slack);
            least = upper.min(least);
            distances.extend_from_slice(&lower.lanes());
        }
        let limit = least.least();
        let mut waiting = Waiting::new(self.surface, p);
        for (leaf, lower) in triangles.iter().zip(distances.as_chunks::<WIDTH>().0) {
            let mut near = S::Float::load(simd, lower).not_above(limit);
            while near != 0 {
                let k = near.trailing_zeros() as usize & (WIDTH - 1);
                near &= near - 1;
                if leaf.triangle[k] != NO_TRIANGLE {
                    waiting.add(simd, leaf.triangle[k], lower[k]);
                }
            }
        }
        waiting.settle(simd);
        Ok(waiting.nearest())
    }
}

/// The corners of a cube with, as witnesses, their nearest points.
#[inline(always)]
fn corners(surface: &Surface, tree: &Tree, at: [Vec3; WIDTH], nearest: &[Nearest; WIDTH]) -> Corners {
    // Opposite corners first; as long as there are others, none on a triangle that another is on.
    let mut chosen = [0; WITNESSES];
    let mut count = 1;
    for k in [7, 3, 4, 5, 2, 6, 1] {
        if count < WITNESSES && chosen[..count].iter().all(|c: &usize| nearest[*c].triangle != nearest[k].triangle) {
            chosen[count] = k;
            count += 1;
        }
    }
    let witnesses = chosen.map(|k| tree.place(nearest[k].point));
    // Nearest points are rounded to their coordinates, which are large where the surface is far from the origin.
    let largest = at.iter().fold(surface.reach(), |most, c| most.max(c.abs().max_element()));
    let error = f64::from(tree.scaled(16.0 * f64::EPSILON * largest));
    Corners::new(at.map(|c| tree.place(c)), witnesses, error)
}
