// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values over a block of a lattice. Cubes of 8 points a side, then of 4, find together what may be nearest to one of
//! their points (`bvh/witness.rs`); the few triangles that are left are held against the points (`cube.rs`). The values are those of
//! single points to the bit.

use super::columns::Columns;
use super::cube::{self, SIDE};
use super::few::{self, Cell, FIRST, Few};
use super::{Nearest, Surface};
use crate::bvh::{LeafList, Tree};
use crate::error::Result;
use crate::math::{Aabb, Vec3};
use crate::simd::float8::Simd;
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, dispatch};
use std::ops::Range;

/// Points a side of the larger cubes.
const LARGE: usize = 8;

/// With more leaves than these for a cube, its points ask the hierarchy one by one.
const MOST_LEAVES: usize = 512;

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

    fn first(&self) -> [usize; 3] {
        self.0.each_ref().map(|range| range.start)
    }

    fn last(&self) -> [usize; 3] {
        self.0.each_ref().map(|range| range.end - 1)
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
    distances: Vec<f32>,
    few: Few,
    points: cube::Cube,
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
        if self.has_jumps() {
            let whole = Aabb::of(cube.corners().map(|c| block.point(c)));
            if self.side_of_clear(whole) == 0 {
                return Ok(false);
            }
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
        let cell = Cell::new(tree, block.point(cube.first()), block.point(cube.last()));
        if !cell.is_near() {
            return surface.one_by_one(block, cube, self.columns, self.out);
        }
        let nearest = cell.corners.map(|c| surface.nearest(c));
        let witnesses = chosen(&nearest);
        let corners = cell.with(surface, tree, witnesses);
        let Scratch { stack, large, .. } = self.scratch;
        if !tree.surviving_leaves(simd, &corners, MOST_LEAVES, stack, large)? || large.len() == 0 {
            return surface.one_by_one(block, cube, self.columns, self.out);
        }
        for small in cube.cut(SIDE) {
            self.small(simd, &small, witnesses)?;
        }
        Ok(())
    }
}

impl Work<'_, '_> {
    #[inline(always)]
    fn small<S: Simd>(&mut self, simd: S, cube: &Cube, witnesses: [Vec3; FIRST]) -> Result<()> {
        let Work { surface, tree, block, .. } = *self;
        let cell = Cell::new(tree, block.point(cube.first()), block.point(cube.last()));
        let nearest = simd.apart(Middle { surface, tree, scratch: self.scratch, p: cell.middle() })?;
        let Scratch { large, few, points, .. } = self.scratch;
        if !simd.apart(Find { surface, tree, large, few, cell: &cell, nearest: &nearest, witnesses })? {
            return surface.one_by_one(block, cube, self.columns, self.out);
        }
        let axes = [0, 1, 2].map(|axis| &block.axes[axis][cube.0[axis].clone()]);
        simd.apart(Points { surface, tree, few, points, axes })?;
        let from = cube.first();
        for at in cube.points() {
            let p = block.point(at);
            let nearest = points.nearest(surface, p, [at[0] - from[0], at[1] - from[1], at[2] - from[2]]);
            self.out[block.place(at)] = self.columns.signed(at, p, &nearest)?;
        }
        Ok(())
    }
}

/// The nearest triangle, of the leaves of the large cube, to the middle of a small one.
struct Middle<'a> {
    surface: &'a Surface,
    tree: &'a Tree,
    scratch: &'a mut Scratch,
    p: Vec3,
}

impl Kernel for Middle<'_> {
    type Output = Result<Nearest>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Result<Nearest> {
        let Middle { surface, tree, scratch, p } = self;
        few::nearest_in(simd, (surface, tree), &scratch.large, p, &mut scratch.distances)
    }
}

/// [`Few::find`].
struct Find<'a> {
    surface: &'a Surface,
    tree: &'a Tree,
    large: &'a LeafList,
    few: &'a mut Few,
    cell: &'a Cell,
    nearest: &'a Nearest,
    witnesses: [Vec3; FIRST],
}

impl Kernel for Find<'_> {
    type Output = Result<bool>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Result<bool> {
        let Find { surface, tree, large, few, cell, nearest, witnesses } = self;
        few.find(simd, (surface, tree), large, cell, nearest, witnesses)
    }
}

/// [`cube::Cube::find`].
struct Points<'a> {
    surface: &'a Surface,
    tree: &'a Tree,
    few: &'a Few,
    points: &'a mut cube::Cube,
    axes: [&'a [f64]; 3],
}

impl Kernel for Points<'_> {
    type Output = Result<()>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Result<()> {
        let Points { surface, tree, few, points, axes } = self;
        points.find(simd, (surface, tree), few, axes)
    }
}

/// Witnesses of a cube: nearest points of its corners.
fn chosen(nearest: &[Nearest; WIDTH]) -> [Vec3; FIRST] {
    // Opposite corners first; as long as there are others, none on a triangle that another is on.
    let mut chosen = [0; FIRST];
    let mut count = 1;
    for k in [7, 3, 4, 5, 2, 6, 1] {
        if count < FIRST && chosen[..count].iter().all(|c: &usize| nearest[*c].triangle != nearest[k].triangle) {
            chosen[count] = k;
            count += 1;
        }
    }
    chosen.map(|k| nearest[k].point)
}
