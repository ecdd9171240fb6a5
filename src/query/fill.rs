// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values at the points of a lattice: the node values of a level set.

use super::{CHUNK, Lattice, check, in_blocks, scanned_band, scanned_signs, sides, suited, tiles};
use crate::error::{Error, Result};
use crate::geometry::{Cut, Geometry, Kind};
use crate::math::Vec3;
use crate::parallel::Run;

/// What a fill writes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FillMode {
    /// The value.
    Exact,
    /// The value where its magnitude is below the band, plus or minus the band elsewhere.
    Band(f64),
    /// -1, 0 or +1.
    Sign,
}

impl FillMode {
    /// What this mode writes for a value.
    pub(super) fn of(self, value: f64) -> f64 {
        match self {
            FillMode::Exact => value,
            FillMode::Band(band) if value.abs() < band => value,
            FillMode::Band(band) => band.copysign(value),
            FillMode::Sign if value > 0.0 => 1.0,
            FillMode::Sign if value < 0.0 => -1.0,
            FillMode::Sign => value,
        }
    }
}

/// Fills a lattice: `emit([i, j, k], values)` gives the values at (i, j, k), (i + 1, j, k), ... A geometry
/// of which only the sign is known takes [`FillMode::Sign`] alone.
pub fn fill(
    g: &Geometry,
    lattice: &Lattice,
    mode: FillMode,
    run: &Run,
    emit: &(dyn Fn([usize; 3], &[f64]) + Sync),
) -> Result<()> {
    if let FillMode::Band(band) = mode
        && !(band > 0.0 && band.is_finite())
    {
        return Err(Error::invalid(format!("band: {band} is not finite and > 0")));
    }
    if mode != FillMode::Sign && g.kind() == Kind::SignOnly {
        return Err(Error::unsupported(
            "mode: of a part of this geometry only the sign is known (EMB_SIGN_ONLY): fill with EMB_FILL_SIGN, or make a callback with a kind, an expression with finite bounds and emb_geom_lower_bound",
        ));
    }
    if mode == FillMode::Sign {
        return fill_signs(g, lattice, run, &|at, signs| {
            let mut values = [0.0; CHUNK];
            for (k, signs) in signs.chunks(CHUNK).enumerate() {
                values.iter_mut().zip(signs).for_each(|(value, sign)| *value = f64::from(*sign));
                emit([at[0] + k * CHUNK, at[1], at[2]], &values[..signs.len()]);
            }
        });
    }
    if let FillMode::Band(band) = mode
        && let Some(scanned) = g.scanned(lattice.axes)
        && scanned_band::values(g, &scanned, lattice, band, run, emit)?
    {
        return Ok(());
    }
    if !g.has_blocks() && Cut::suits(g) {
        return tiles::fill(g, lattice, mode, run, emit);
    }
    one_by_one(g, lattice, mode, run, emit)
}

/// [`fill`] with [`FillMode::Sign`]: -1, 0 and +1.
pub fn fill_signs(g: &Geometry, lattice: &Lattice, run: &Run, emit: &(dyn Fn([usize; 3], &[i8]) + Sync)) -> Result<()> {
    if let Some(scanned) = g.scanned(lattice.axes) {
        return scanned_signs::signs(g, &scanned, lattice, run, emit);
    }
    if !g.has_blocks() && sides::are_known(g) {
        return sides::signs(g, lattice, run, emit);
    }
    one_by_one(g, lattice, FillMode::Sign, run, &|at, values| {
        let mut signs = [0; CHUNK];
        // Coordinates are finite: there is no NaN among the values.
        signs.iter_mut().zip(values).for_each(|(sign, value)| *sign = *value as i8);
        emit(at, &signs[..values.len()]);
    })
}

fn one_by_one(
    g: &Geometry,
    lattice: &Lattice,
    mode: FillMode,
    run: &Run,
    emit: &(dyn Fn([usize; 3], &[f64]) + Sync),
) -> Result<()> {
    if g.has_blocks() {
        return block_by_block(g, lattice, mode, run, emit);
    }
    let [x, y, z] = lattice.axes;
    in_row_pieces(&suited(g, run), lattice.n(), &|at, count| {
        let (mut points, mut values) = ([Vec3::ZERO; CHUNK], [0.0; CHUNK]);
        for (d, p) in points[..count].iter_mut().enumerate() {
            *p = Vec3::new(x[at[0] + d], y[at[1]], z[at[2]]);
        }
        g.values(&points[..count], &mut values[..count]);
        for (value, p) in values[..count].iter_mut().zip(&points) {
            check(g, *value, *p)?;
            *value = mode.of(*value);
        }
        emit(at, &values[..count]);
        Ok(())
    })
}

/// Points along each axis of a block that is filled as one.
const BLOCK: [usize; 3] = [16, 16, 32];

fn block_by_block(
    g: &Geometry,
    lattice: &Lattice,
    mode: FillMode,
    run: &Run,
    emit: &(dyn Fn([usize; 3], &[f64]) + Sync),
) -> Result<()> {
    let far = match mode {
        FillMode::Exact => f64::INFINITY,
        FillMode::Band(band) => band,
        FillMode::Sign => 0.0,
    };
    in_blocks(run, lattice.n(), BLOCK, &|block| {
        let from = block.each_ref().map(|range| range.start);
        let axes = [0, 1, 2].map(|axis| &lattice.axes[axis][block[axis].clone()]);
        let [width, height, depth] = axes.map(<[f64]>::len);
        let mut values = [0.0; BLOCK[0] * BLOCK[1] * BLOCK[2]];
        let values = &mut values[..width * height * depth];
        g.block_values(axes, far, values)?;
        values.iter_mut().for_each(|value| *value = mode.of(*value));
        for (row, values) in values.chunks(width).enumerate() {
            emit([from[0], from[1] + row % height, from[2] + row / height], values);
        }
        Ok(())
    })
}

/// Pieces of the rows along x: `work([i, j, k], count)`.
pub(super) fn in_row_pieces(
    run: &Run,
    n: [usize; 3],
    work: &(dyn Fn([usize; 3], usize) -> Result<()> + Sync),
) -> Result<()> {
    if n.contains(&0) {
        return Ok(());
    }
    let pieces = n[0].div_ceil(CHUNK);
    run.for_each_chunk(pieces * n[1] * n[2], &|chunk| {
        let (piece, row) = (chunk % pieces, chunk / pieces);
        let i = piece * CHUNK;
        work([i, row % n[1], row / n[1]], CHUNK.min(n[0] - i))
    })
}
