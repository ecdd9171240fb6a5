// SPDX-License-Identifier: MIT OR Apache-2.0
//! A surface whose lattices can be scanned (`scan`), and what the nodes above it make of its answers.

use super::Geometry;
use super::node::Node;
use super::segment::{Event, NO_PART, side_changes};
use super::surface::{BandSlab, BandWork, Hit, Surface};
use crate::error::{Error, Result, try_copy};
use crate::math::Vec3;
use crate::parallel::Run;
use crate::scan::{Axis, Met, Scan};
use std::ops::Range;

/// Beside the steps of a lattice, what rounding decides must be small.
const MOST_ROOM: f64 = 0.1;

/// Products of nonzero coordinates below this are no numbers, and predicates not exact.
const LEAST: f64 = 1e-70;

/// Axes of more points are asked point by point.
const LONGEST: usize = 1 << 26;

/// A surface below complements, translations and labels.
pub(crate) struct Scanned<'a> {
    surface: &'a Surface,
    /// Taken off the points one after another.
    shifts: Vec<Vec3>,
    /// Whether inside and outside are exchanged.
    turned: bool,
    part: i32,
}

/// Serve one edge after another.
#[derive(Default)]
pub(crate) struct Buffers {
    hits: Vec<Hit>,
    events: Vec<Event>,
}

impl Geometry {
    /// Its surface, where a scan of such a lattice gives the answers of its points and edges.
    pub(crate) fn scanned(&self, axes: [&[f64]; 3]) -> Option<Scanned<'_>> {
        let (mut shifts, mut turned, mut part) = (Vec::new(), false, NO_PART);
        let mut at = self;
        let surface = loop {
            match at.node() {
                Node::Surface(surface) => break surface,
                Node::Complement(g) => (at, turned) = (g, !turned),
                Node::Translate(g, shift) => {
                    shifts.push(*shift);
                    at = g;
                }
                Node::Part(g, label) => {
                    part = if *label == NO_PART { part } else { *label };
                    at = g;
                }
                _ => return None,
            }
        };
        let suits = |axis: &[f64]| {
            let steps = axis.len().max(2) - 1;
            let extent = axis.first().zip(axis.last()).map_or(0.0, |(a, b)| (a - b).abs());
            axis.len() < LONGEST
                && axis.iter().all(|c| *c == 0.0 || c.abs() > LEAST)
                && (extent == 0.0 || surface.room() * steps as f64 <= MOST_ROOM * extent)
        };
        let suits = surface.can_be_scanned() && axes.iter().all(|axis| suits(axis));
        suits.then_some(Scanned { surface, shifts, turned, part })
    }
}

impl Scanned<'_> {
    /// The axes of a lattice as the surface sees them.
    pub(crate) fn axes(&self, axes: [&[f64]; 3]) -> Result<[Vec<f64>; 3]> {
        let mut seen = [try_copy("axis", axes[0])?, try_copy("axis", axes[1])?, try_copy("axis", axes[2])?];
        for shift in &self.shifts {
            for (k, axis) in seen.iter_mut().enumerate() {
                axis.iter_mut().for_each(|c| *c -= shift[k]);
            }
        }
        Ok(seen)
    }

    /// The scan of the lines along an axis of a lattice that the surface sees so.
    pub(crate) fn scan(&self, axes: &[Vec<f64>; 3], axis: usize, run: &Run) -> Result<Scan<'_, Surface>> {
        Scan::new(self.surface, [&axes[0], &axes[1], &axes[2]], axis, self.surface.room(), run)
    }

    /// The winding number at the first point of a line that meets these triangles above it.
    pub(crate) fn first_winding(&self, met: &[Met]) -> i32 {
        met.iter().fold(self.surface.far_winding(), |winding, met| winding + met.turn())
    }

    /// Whether a point of such a winding number, which is not near the surface, is inside.
    pub(crate) fn is_inside(&self, winding: i32) -> bool {
        (self.surface.is_signed() && winding >= 1) != self.turned
    }

    /// Whether [`Scanned::near_band`] costs less than tiles, with slabs of so many rows.
    pub(crate) fn band_pays(&self, axes: [&Axis; 3], rows: usize, band: f64) -> bool {
        self.surface.band_pays(&BandSlab { axes, rows: &(0..axes[2].len()), band }, rows)
    }

    /// Calls `put` with each point of some rows along z whose magnitude is below the band, and with others, in order: its
    /// number, x fastest, and the magnitude.
    pub(crate) fn near_band(
        &self,
        axes: [&Axis; 3],
        rows: &Range<usize>,
        band: f64,
        work: &mut BandWork,
        put: &mut dyn FnMut(usize, f64),
    ) -> Result<()> {
        self.surface.near_band(&BandSlab { axes, rows, band }, work, put)
    }

    /// [`Geometry::events`] between the points `a` and `b` of a line, of which `a` is the lower one and has this winding
    /// number, where these are the triangles met between them.
    pub(crate) fn events<'b>(
        &self,
        [a, b]: [Vec3; 2],
        winding: i32,
        met: &[Met],
        buffers: &'b mut Buffers,
    ) -> Result<&'b [Event]> {
        let Buffers { hits, events } = buffers;
        hits.clear();
        events.clear();
        let full = || Error::memory("crossings", met.len());
        hits.try_reserve(met.len()).map_err(|_| full())?;
        events.try_reserve(met.len()).map_err(|_| full())?;
        hits.extend(met.iter().map(|met| self.surface.hit(a, b, met.triangle, -met.turn())));
        Hit::sort(hits);
        side_changes(self.surface, hits, winding, events);
        for event in events.iter_mut() {
            *event = if self.turned { event.turned() } else { *event };
            event.part = self.part;
        }
        Ok(events)
    }
}
