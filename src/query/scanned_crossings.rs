// SPDX-License-Identifier: MIT OR Apache-2.0
//! Crossings of the edges of a lattice with a surface, from a scan of its lines. Edges near which no triangle comes are
//! none; where rounding may decide the side of an end, the edge is asked like any segment.

use super::Lattice;
use super::intercept::{Crossing, CrossingForm, EmitCrossings, crossing, settled};
use super::scanned_signs::{first_line, values};
use crate::error::{Error, Result};
use crate::geometry::{Buffers, Geometry, Scanned};
use crate::math::Vec3;
use crate::parallel::Run;
use crate::scan::{Axis, Slab};

/// [`super::crossings`] where the lattice can be scanned.
pub(super) fn crossings(
    g: &Geometry,
    scanned: &Scanned,
    lattice: &Lattice,
    axis: usize,
    form: CrossingForm,
    run: &Run,
    emit: EmitCrossings,
) -> Result<()> {
    let n = lattice.n();
    if n.contains(&0) || n[axis] == 1 {
        return Ok(());
    }
    let seen = scanned.axes(lattice.axes)?;
    let scan = scanned.scan(&seen, axis, run)?;
    run.for_each_chunk(scan.slab_count(), &|k| {
        let mut slab = Slab::default();
        scan.scan(k, &mut slab)?;
        let edges = Edges { g, scanned, lattice, axes: [0, 1, 2].map(|k| scan.axis(k)), axis, form };
        let rows = Rows::new(edges.found(&slab)?, edges.rows(&slab))?;
        edges.tell(&slab, rows, emit);
        Ok(())
    })
}

struct Edges<'a> {
    g: &'a Geometry,
    scanned: &'a Scanned<'a>,
    lattice: &'a Lattice<'a>,
    /// As the surface sees them, rising.
    axes: [&'a Axis; 3],
    axis: usize,
    form: CrossingForm,
}

/// A crossing, the row of edges along x that it belongs to, and which it is there.
type Found = (u32, (usize, Crossing));

impl Edges<'_> {
    /// Edges of a line.
    fn count(&self) -> usize {
        self.axes[self.axis].len() - 1
    }

    /// Rows of edges along x.
    fn rows(&self, slab: &Slab) -> usize {
        slab.rows().len() * if self.axis == 0 { slab.width() } else { self.count() }
    }

    /// All crossings of a slab.
    fn found(&self, slab: &Slab) -> Result<Vec<Found>> {
        let mut found = Vec::new();
        let (mut near, mut work) = (slab.near(), Work::default());
        for row in 0..slab.rows().len() {
            for column in 0..slab.width() {
                let line = row * slab.width() + column;
                let of_line = first_line(&mut near, line);
                if slab.met(line).is_empty() && of_line.is_empty() {
                    continue;
                }
                self.line(slab, line, of_line, &mut work, &mut |edge, crossing| {
                    found.try_reserve(1).map_err(|_| Error::memory("crossings", found.len() + 1))?;
                    found.push(match self.axis {
                        0 => (line as u32, (self.axes[0].given_step(edge), crossing)),
                        _ => ((row * self.count() + edge) as u32, (self.axes[0].given(column), crossing)),
                    });
                    Ok(())
                })?;
            }
        }
        Ok(found)
    }

    /// The point of a line, counted from where the axes are least.
    fn at(&self, slab: &Slab, line: usize, k: usize) -> [usize; 3] {
        let (row, column) = (slab.rows().start + line / slab.width(), line % slab.width());
        match self.axis {
            0 => [k, column, row],
            1 => [column, k, row],
            _ => [column, row, k],
        }
    }

    /// The crossings of a line, in order.
    fn line(
        &self,
        slab: &Slab,
        line: usize,
        near: &[[u32; 2]],
        work: &mut Work,
        put: &mut dyn FnMut(usize, Crossing) -> Result<()>,
    ) -> Result<()> {
        let mut met = slab.met(line);
        let mut winding = self.scanned.first_winding(met);
        work.sides.clear();
        work.sides.try_reserve(near.len()).map_err(|_| Error::memory("points", near.len()))?;
        let sides = &mut work.sides;
        values(self.g, near, |k| self.given(self.at(slab, line, k)), |k, value| sides.push((k, value <= 0.0)));
        // The first of these points that is not below the edge.
        let mut beside = 0;
        let mut from = 0;
        loop {
            let sides = &work.sides[beside..];
            // The next edge that meets a triangle or has an end near one.
            let of_met = met.first().map_or(usize::MAX, |met| met.below() - 1);
            let of_near = sides.first().map_or(usize::MAX, |(k, _)| k.saturating_sub(1).max(from));
            let edge = of_met.min(of_near);
            if edge >= self.count() {
                return Ok(());
            }
            let (here, rest) = met.split_at(met.iter().take_while(|met| met.below() == edge + 1).count());
            let after = here.iter().fold(winding, |winding, met| winding - met.turn());
            let known = |k: usize| sides.iter().take(2).find(|(at, _)| *at == k).map(|(_, is_inside)| *is_inside);
            let ends = [known(edge), known(edge + 1)];
            let inside = [
                ends[0].unwrap_or_else(|| self.scanned.is_inside(winding)),
                ends[1].unwrap_or_else(|| self.scanned.is_inside(after)),
            ];
            if !here.is_empty() || inside[0] != inside[1] {
                let low = self.at(slab, line, edge);
                let mut high = low;
                high[self.axis] += 1;
                let crossing = match ends {
                    [None, None] => {
                        let events =
                            self.scanned.events([self.seen(low), self.seen(high)], winding, here, &mut work.buffers)?;
                        let value = |is_inside: bool| if is_inside { -1.0 } else { 1.0 };
                        let (a, b) = (self.given(low), self.given(high));
                        let answer = settled(self.g, a, b, (value(inside[0]), value(inside[1])), events)?;
                        let falls = self.axes[self.axis].given(0) != 0;
                        answer.seen(falls).in_form(answer.t, a[self.axis], b[self.axis], self.form)
                    }
                    _ if self.axes[self.axis].given(0) != 0 => {
                        crossing(self.g, self.given(high), self.given(low), self.axis, self.form)?
                    }
                    _ => crossing(self.g, self.given(low), self.given(high), self.axis, self.form)?,
                };
                if crossing.is_any() {
                    put(edge, crossing)?;
                }
            }
            (met, winding, from) = (rest, after, edge + 1);
            beside += usize::from(sides.first().is_some_and(|(k, _)| *k <= edge));
        }
    }

    /// A point as the surface sees it.
    fn seen(&self, at: [usize; 3]) -> Vec3 {
        Vec3::new(self.axes[0].at(at[0]), self.axes[1].at(at[1]), self.axes[2].at(at[2]))
    }

    /// A point as the caller gave it.
    fn given(&self, at: [usize; 3]) -> Vec3 {
        self.lattice.point([0, 1, 2].map(|k| self.axes[k].given(at[k])))
    }

    fn tell(&self, slab: &Slab, rows: Rows, emit: EmitCrossings) {
        let n = self.lattice.n();
        let mut all = rows;
        let turned = self.axes[0].given(0) != 0;
        let width = if self.axis == 0 { n[0] - 1 } else { n[0] };
        for row in 0..self.rows(slab) {
            let at = match self.axis {
                0 => {
                    let (k, j) = (slab.rows().start + row / slab.width(), row % slab.width());
                    [0, self.axes[1].given(j), self.axes[2].given(k)]
                }
                1 => {
                    let (k, j) = (slab.rows().start + row / self.count(), row % self.count());
                    [0, self.axes[1].given_step(j), self.axes[2].given(k)]
                }
                _ => {
                    let (j, k) = (slab.rows().start + row / self.count(), row % self.count());
                    [0, self.axes[1].given(j), self.axes[2].given_step(k)]
                }
            };
            let found = &mut all.found[all.start[row] as usize..all.start[row + 1] as usize];
            if turned {
                found.reverse();
            }
            emit(at, width, found);
        }
    }
}

/// Buffers that serve one line after another.
#[derive(Default)]
struct Work {
    buffers: Buffers,
    /// Points of the line near the surface, and whether they are inside.
    sides: Vec<(usize, bool)>,
}

/// Crossings row by row.
struct Rows {
    start: Vec<u32>,
    found: Vec<(usize, Crossing)>,
}

impl Rows {
    /// Keeps the order within each row.
    fn new(found: Vec<Found>, count: usize) -> Result<Rows> {
        let full = || Error::memory("rows", count);
        let mut start: Vec<u32> = Vec::new();
        start.try_reserve_exact(count + 1).map_err(|_| full())?;
        start.resize(count + 1, 0);
        let mut sorted = Vec::new();
        sorted.try_reserve_exact(found.len()).map_err(|_| full())?;
        if let Some((_, first)) = found.first() {
            sorted.resize(found.len(), *first);
        }
        found.iter().for_each(|(row, _)| start[*row as usize] += 1);
        let mut sum = 0;
        for count in &mut start {
            sum += *count;
            *count = sum;
        }
        for (row, item) in found.iter().rev() {
            let end = &mut start[*row as usize];
            *end -= 1;
            sorted[*end as usize] = *item;
        }
        Ok(Rows { start, found: sorted })
    }
}
