// SPDX-License-Identifier: MIT OR Apache-2.0
//! Signs over a lattice around a surface, from a scan of its lines along x: between two triangles the sign is that of
//! the winding number; points so near to a triangle that rounding may decide are asked one by one.

use super::Lattice;
use crate::error::{Error, Result};
use crate::geometry::{Geometry, Scanned};
use crate::math::Vec3;
use crate::parallel::Run;
use crate::scan::Slab;
use std::ops::Range;

/// Points that are asked together.
const GROUP: usize = 32;

/// [`super::fill_signs`] where the lattice can be scanned.
pub(super) fn signs(
    g: &Geometry,
    scanned: &Scanned,
    lattice: &Lattice,
    run: &Run,
    emit: &(dyn Fn([usize; 3], &[i8]) + Sync),
) -> Result<()> {
    let n = lattice.n();
    if n.contains(&0) {
        return Ok(());
    }
    let seen = scanned.axes(lattice.axes)?;
    let scan = scanned.scan(&seen, 0, run)?;
    let [x, y, z] = [0, 1, 2].map(|k| scan.axis(k));
    let falls = x.given(0) != 0;
    let sign = |winding: i32| if scanned.is_inside(winding) { -1 } else { 1 };
    run.for_each_chunk(scan.slab_count(), &|k| {
        let mut slab = Slab::default();
        scan.scan(k, &mut slab)?;
        let mut row = Vec::new();
        row.try_reserve_exact(n[0]).map_err(|_| Error::memory("points", n[0]))?;
        row.resize(n[0], sign(scanned.first_winding(&[])));
        let mut near = slab.near();
        let mut is_far = true;
        for line in 0..slab.rows().len() * slab.width() {
            let at = [0, y.given(line % slab.width()), z.given(slab.rows().start + line / slab.width())];
            let met = slab.met(line);
            // Most lines meet nothing, and the row of the last one serves.
            if !(met.is_empty() && is_far) {
                let (mut from, mut winding) = (0, scanned.first_winding(met));
                for met in met {
                    fill(&mut row, from..met.below(), falls, sign(winding));
                    (from, winding) = (met.below(), winding - met.turn());
                }
                fill(&mut row, from..n[0], falls, sign(winding));
                is_far = met.is_empty();
            }
            let of_line = first_line(&mut near, line);
            is_far &= of_line.is_empty();
            values(
                g,
                of_line,
                |k| lattice.point([x.given(k), at[1], at[2]]),
                |k, value| {
                    row[x.given(k)] = i8::from(value > 0.0) - i8::from(value < 0.0);
                },
            );
            emit(at, &row);
        }
        Ok(())
    })
}

/// Takes the points near triangles that lie on a line from those that are left.
pub(super) fn first_line<'a>(near: &mut &'a [[u32; 2]], line: usize) -> &'a [[u32; 2]] {
    let (here, rest) = near.split_at(near.iter().take_while(|n| n[0] as usize == line).count());
    *near = rest;
    here
}

/// The values at points of a line, in order; many at once cost less.
pub(super) fn values(
    g: &Geometry,
    points: &[[u32; 2]],
    point: impl Fn(usize) -> Vec3,
    mut put: impl FnMut(usize, f64),
) {
    let (mut at, mut found) = ([Vec3::ZERO; GROUP], [0.0; GROUP]);
    for points in points.chunks(GROUP) {
        at.iter_mut().zip(points).for_each(|(at, [_, k])| *at = point(*k as usize));
        g.values(&at[..points.len()], &mut found[..points.len()]);
        points.iter().zip(found).for_each(|([_, k], value)| put(*k as usize, value));
    }
}

/// Fills part of a row that is counted from the end of lesser coordinates.
#[inline(always)]
pub(super) fn fill<T: Copy>(row: &mut [T], part: Range<usize>, falls: bool, with: T) {
    let n = row.len();
    if falls { &mut row[n - part.end..n - part.start] } else { &mut row[part] }.fill(with);
}
