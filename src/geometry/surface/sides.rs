// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which side of the surface a box is on: a coarse lattice over the bounds says of each cell whether a triangle comes
//! near it, and if none does, on which side it is.

use super::Surface;
use crate::error::{Result, filled};
use crate::math::{Aabb, Vec3};
use crate::primitive::overlap::are_apart;
use crate::primitive::triangle::RELATIVE_ERROR;
use crate::store::{Array, Packer, Unpacker, wrong};

/// Cells along each axis: a row of them is a word.
const CELLS: usize = 32;
const OF_ROWS: usize = CELLS * CELLS;

/// Regions of empty cells whose side is asked for; others stay unknown.
const MOST_REGIONS: usize = 256;

/// A cell is one of these.
const NEAR: u8 = 0;
const UNKNOWN: u8 = 1;
const OUTSIDE: u8 = 2;
const INSIDE: u8 = 3;

/// The lattice: for each row along x a word of the cells that are outside, and one of those inside.
#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    lo: Vec3,
    /// Cells a unit of length.
    density: Vec3,
    outside: Array<u32>,
    inside: Array<u32>,
}

impl Sides {
    /// Of a surface that is complete but for this.
    pub(super) fn new(surface: &Surface) -> Result<Sides> {
        let b = surface.bounds;
        // An empty ring lies around what the surface reaches.
        let room = Vec3::splat((2.0 * RELATIVE_ERROR) * (surface.reach() + surface.diagonal) + 1e-6 * surface.diagonal);
        let cell = (b.hi - b.lo + 4.0 * room) / (CELLS - 2) as f64;
        let mut sides = Sides { lo: b.lo - 2.0 * room - cell, density: 1.0 / cell, ..Sides::default() };
        if !(sides.density.is_finite() && sides.lo.is_finite()) {
            return Ok(sides);
        }
        let mut cells = filled("cells", CELLS * CELLS * CELLS, UNKNOWN)?;
        for t in 0..surface.triangles.len() as u32 {
            let corners = surface.corners(t);
            let around = Aabb::of(corners);
            let [lo, hi] = [sides.cell(around.lo - room), sides.cell(around.hi + room)];
            let is_long = (0..3).map(|k| hi[k] - lo[k] + 1).product::<usize>() > 12;
            for (at, index) in cells_between(lo, hi) {
                if cells[index] == NEAR {
                    continue;
                }
                if is_long {
                    let corner = sides.lo + cell * Vec3::from_array(at.map(|k| k as f64));
                    if are_apart(corners, Aabb::new(corner - room, corner + cell + room)) {
                        continue;
                    }
                }
                cells[index] = NEAR;
            }
        }
        if surface.closing.is_some() {
            for (index, known) in cells.iter_mut().enumerate() {
                let at = [index % CELLS, index / CELLS % CELLS, index / CELLS / CELLS].map(|k| k as f64);
                let corner = sides.lo + cell * Vec3::from_array(at);
                if *known == UNKNOWN && !surface.settles(Aabb::new(corner - room, corner + cell + room)) {
                    *known = NEAR;
                }
            }
        }
        sides.settle(surface, &mut cells)?;
        let mut outside = filled("cells", CELLS * CELLS, 0)?;
        let mut inside = filled("cells", CELLS * CELLS, 0)?;
        for (index, cell) in cells.into_iter().enumerate() {
            outside[index / CELLS] |= u32::from(cell == OUTSIDE) << (index % CELLS);
            inside[index / CELLS] |= u32::from(cell == INSIDE) << (index % CELLS);
        }
        (sides.outside, sides.inside) = (outside.into(), inside.into());
        Ok(sides)
    }

    /// Gives empty cells their sides: neighbours have the same, so one of a region is asked.
    fn settle(&self, surface: &Surface, cells: &mut [u8]) -> Result<()> {
        let mut waiting = Vec::new();
        let mut regions = 0;
        for from in 0..cells.len() {
            if cells[from] != UNKNOWN {
                continue;
            }
            regions += 1;
            if regions > MOST_REGIONS {
                return Ok(());
            }
            let at = [from % CELLS, from / CELLS % CELLS, from / CELLS / CELLS].map(|k| k as f64 + 0.5);
            let is_inside = surface.is_inside(self.lo + Vec3::from_array(at) / self.density);
            let side = if is_inside { INSIDE } else { OUTSIDE };
            cells[from] = side;
            waiting.push(from);
            while let Some(at) = waiting.pop() {
                for (step, k) in [(1, at % CELLS), (CELLS, at / CELLS % CELLS), (CELLS * CELLS, at / CELLS / CELLS)] {
                    let before = (k > 0).then(|| at - step);
                    let after = (k + 1 < CELLS).then_some(at + step);
                    for next in [before, after].into_iter().flatten() {
                        if cells[next] == UNKNOWN {
                            cells[next] = side;
                            waiting.push(next);
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// The cell of a point; those beyond the lattice count to its outermost cells. Monotone, so what lies between two
    /// points has a cell between theirs.
    #[inline]
    fn cell(&self, p: Vec3) -> [usize; 3] {
        ((p - self.lo) * self.density).to_array().map(|c| (c as usize).min(CELLS - 1))
    }

    /// -1 where a finite box is inside, +1 where it is outside, 0 where neither is known.
    fn of(&self, b: Aabb) -> i32 {
        if self.outside.is_empty() {
            return 0;
        }
        let ([i, j, k], [end, last_j, last_k]) = (self.cell(b.lo), self.cell(b.hi));
        let row = (u32::MAX << i) & (u32::MAX >> (CELLS - 1 - end));
        let all = |rows: &[u32]| {
            (k..=last_k).all(|k| rows[CELLS * k + j..=CELLS * k + last_j].iter().all(|cells| cells & row == row))
        };
        // One of the cells says which of the two it can be.
        match self.outside[CELLS * k + j] >> i & 1 == 1 {
            true => i32::from(all(&self.outside)),
            false => -i32::from(all(&self.inside)),
        }
    }

    pub(super) fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.vector(self.lo);
        out.numbers(self.density.to_array());
        out.array(&self.outside);
        out.array(&self.inside);
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Sides> {
        let lo = from.vector()?;
        let density = Vec3::new(from.number()?, from.number()?, from.number()?);
        let (outside, inside) = (from.array("cells")?, from.array("cells")?);
        let sides = Sides { lo, density, outside, inside };
        match (sides.outside.len(), sides.inside.len()) {
            (0, 0) => Ok(sides),
            (OF_ROWS, OF_ROWS) if sides.density.is_finite() && sides.density.cmpge(Vec3::ZERO).all() => Ok(sides),
            _ => Err(wrong("the cells of a surface are damaged")),
        }
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.outside[..]) + size_of_val(&self.inside[..])
    }
}

fn cells_between(lo: [usize; 3], hi: [usize; 3]) -> impl Iterator<Item = ([usize; 3], usize)> {
    (lo[2]..=hi[2]).flat_map(move |k| {
        (lo[1]..=hi[1]).flat_map(move |j| (lo[0]..=hi[0]).map(move |i| ([i, j, k], i + CELLS * (j + CELLS * k))))
    })
}

impl Surface {
    /// -1 where every double of a box is inside, +1 where outside, 0 where the surface is near; none where all that is
    /// known is that it may be, as of a box that is not finite.
    pub(crate) fn side(&self, b: Aabb) -> Option<i32> {
        if !b.is_finite() {
            return None;
        }
        match self.sides.of(b) {
            0 => {}
            side => return Some(side),
        }
        if !self.misses(b) {
            // Of a box as small as rounding a distance may tell more.
            let is_large = (b.hi - b.lo).max_element() > 1e6 * RELATIVE_ERROR * (self.reach() + self.diagonal);
            return is_large.then_some(0);
        }
        Some(self.side_of_clear(b))
    }
}
