// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lattices of trees, tile by tile: each cuts the tree that the larger one around it has left, until that gains nothing
//! or the tile is small; what is left is asked a node at a time. A tile that is beyond the band as a whole is stored.

use super::sides::{Cube, around};
use super::{FillMode, Lattice, in_blocks};
use crate::error::Result;
use crate::geometry::{Cut, Geometry};
use crate::parallel::Run;
use std::ops::Range;

/// Points a side of a block.
const SIDE: usize = 16;

/// Tiles of up to so many points are not cut any more; nor are larger ones where one leaf is left, the cut lost nothing,
/// or a mesh is left: the more points it is asked together, the less each costs.
const SMALL: usize = 64;
const LARGE: usize = 512;

/// [`super::fill()`] where [`Cut::suits`].
pub(super) fn fill(
    g: &Geometry,
    lattice: &Lattice,
    mode: FillMode,
    run: &Run,
    emit: &(dyn Fn([usize; 3], &[f64]) + Sync),
) -> Result<()> {
    let far = if let FillMode::Band(band) = mode { band } else { f64::INFINITY };
    in_blocks(run, lattice.n(), [SIDE; 3], &|block| {
        let mut out = [0.0; SIDE * SIDE * SIDE];
        let [width, height, depth] = block.each_ref().map(Range::len);
        let mut tiles = Tiles { lattice, mode, far, block, out: &mut out };
        tiles.descend(&Cut::whole(g), block)?;
        for (row, values) in out[..width * height * depth].chunks(width).enumerate() {
            emit([block[0].start, block[1].start + row % height, block[2].start + row / height], values);
        }
        Ok(())
    })
}

struct Tiles<'a> {
    lattice: &'a Lattice<'a>,
    mode: FillMode,
    far: f64,
    block: &'a Cube,
    out: &'a mut [f64; SIDE * SIDE * SIDE],
}

impl Tiles<'_> {
    /// Fills a cube, for which `tree` is what is left around it.
    fn descend(&mut self, tree: &Cut, cube: &Cube) -> Result<()> {
        let count: usize = cube.iter().map(Range::len).product();
        let (left, range) = tree.within(around(self.lattice, cube, None), self.far, count);
        if range.lo >= self.far || range.hi <= -self.far {
            let value = self.mode.of(if range.lo > 0.0 { range.lo } else { range.hi });
            self.rows(cube, |_, row| row.fill(value));
            return Ok(());
        }
        let is_one = left.leaves() <= 1 && (self.far == f64::INFINITY || left.has_meshes());
        let loses_none = left.leaves() >= tree.leaves() && !left.is_open();
        let gains_nothing = left.leaves() <= 1 || loses_none || left.has_meshes();
        if is_one || count <= SMALL || (count <= LARGE && gains_nothing) {
            return self.ask(&left, cube, count);
        }
        halves(cube, &mut |piece| self.descend(&left, piece))
    }

    fn ask(&mut self, left: &Cut, cube: &Cube, count: usize) -> Result<()> {
        let axes = [0, 1, 2].map(|axis| &self.lattice.axes[axis][cube[axis].clone()]);
        let mut values = [0.0; SIDE * SIDE * SIDE];
        let values = &mut values[..count];
        left.lattice_values(axes, self.far, values)?;
        let (mode, width) = (self.mode, cube[0].len());
        values.iter_mut().for_each(|value| *value = mode.of(*value));
        self.rows(cube, |k, row| row.copy_from_slice(&values[k * width..(k + 1) * width]));
        Ok(())
    }

    /// The rows of a cube, numbered.
    fn rows(&mut self, cube: &Cube, mut write: impl FnMut(usize, &mut [f64])) {
        let [width, height, _] = self.block.each_ref().map(Range::len);
        let from = [0, 1, 2].map(|axis| cube[axis].start - self.block[axis].start);
        let [x, y, z] = cube.each_ref().map(Range::len);
        for row in 0..y * z {
            let at = from[0] + width * (from[1] + row % y + height * (from[2] + row / y));
            write(row, &mut self.out[at..at + x]);
        }
    }
}

/// The pieces of a cube, its longer sides halved.
fn halves(cube: &Cube, work: &mut dyn FnMut(&Cube) -> Result<()>) -> Result<()> {
    let half = cube.iter().map(Range::len).max().unwrap_or(0).div_ceil(2);
    let pieces = cube.each_ref().map(|range| {
        let middle = if range.len() > half { range.start + range.len().div_ceil(2) } else { range.end };
        [range.start..middle, middle..range.end]
    });
    for k in 0..8 {
        let piece = [0, 1, 2].map(|axis| pieces[axis][k >> axis & 1].clone());
        if piece.iter().all(|range| !range.is_empty()) {
            work(&piece)?;
        }
    }
    Ok(())
}
