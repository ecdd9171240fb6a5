// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values within a band over a lattice around a surface: beyond the band only the sign is wanted, which a scan tells;
//! within it the distances come leaf by leaf.

use super::scanned_signs::{fill, first_line};
use super::{FillMode, Lattice, scanned_signs};
use crate::error::{Error, Result};
use crate::geometry::{BandWork, Geometry, Scanned};
use crate::parallel::Run;
use crate::scan::Slab;

/// [`super::fill`] of a band where the lattice can be scanned; false where that costs more than tiles.
pub(super) fn values(
    g: &Geometry,
    scanned: &Scanned,
    lattice: &Lattice,
    band: f64,
    run: &Run,
    emit: &(dyn Fn([usize; 3], &[f64]) + Sync),
) -> Result<bool> {
    let n = lattice.n();
    if n.contains(&0) {
        return Ok(true);
    }
    let seen = scanned.axes(lattice.axes)?;
    let scan = scanned.scan(&seen, 0, run)?;
    let [x, y, z] = [0, 1, 2].map(|k| scan.axis(k));
    if !scanned.band_pays([x, y, z], scan.rows(), band) {
        return Ok(false);
    }
    let falls = x.given(0) != 0;
    let sign = |winding: i32| if scanned.is_inside(winding) { -1.0 } else { 1.0 };
    run.for_each_chunk(scan.slab_count(), &|k| {
        let (mut slab, mut work) = (Slab::default(), BandWork::default());
        scan.scan(k, &mut slab)?;
        let rows = slab.rows();
        let mut row = Vec::new();
        row.try_reserve_exact(n[0]).map_err(|_| Error::memory("points", n[0]))?;
        row.resize(n[0], 0.0);
        // The row that is being filled; those before it are told.
        let (mut line, mut near, mut begun) = (0, slab.near(), false);
        let lines = rows.len() * slab.width();
        let begin = |line: usize, row: &mut [f64]| {
            let met = slab.met(line);
            let (mut from, mut winding) = (0, scanned.first_winding(met));
            for met in met {
                fill(row, from..met.below(), falls, band * sign(winding));
                (from, winding) = (met.below(), winding - met.turn());
            }
            fill(row, from..n[0], falls, band * sign(winding));
        };
        let mut finish = |line: usize, row: &mut [f64]| {
            let at = [0, y.given(line % slab.width()), z.given(rows.start + line / slab.width())];
            let of_line = first_line(&mut near, line);
            scanned_signs::values(
                g,
                of_line,
                |k| lattice.point([x.given(k), at[1], at[2]]),
                |k, value| {
                    row[x.given(k)] = FillMode::Band(band).of(value);
                },
            );
            emit(at, row);
        };
        scanned.near_band([x, y, z], &rows, band, &mut work, &mut |point, distance| {
            let (of, i) = (point / n[0], x.given(point % n[0]));
            if !begun {
                begin(line, &mut row);
                begun = true;
            }
            while line < of {
                finish(line, &mut row);
                line += 1;
                begin(line, &mut row);
            }
            if distance < band {
                row[i] = distance.copysign(row[i]);
            }
        })?;
        if !begun {
            begin(line, &mut row);
        }
        loop {
            finish(line, &mut row);
            line += 1;
            if line == lines {
                return Ok(());
            }
            begin(line, &mut row);
        }
    })?;
    Ok(true)
}
