// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where segments and lattice edges cross the surface.
//!
//! Both questions answer from one function of the two ends, taken in a fixed order, so an edge has the
//! same crossing whoever asks and from whichever end.

use super::fill::in_row_pieces;
use super::{CHUNK, Lattice, check, in_chunks, scanned_crossings, sides, suited};
use crate::error::{Error, Result};
use crate::geometry::{Change, Event, Geometry, NO_PART};
use crate::math::{Vec3, positive_zero};
use crate::parallel::Run;

/// The crossing of one segment.
#[derive(Clone, Copy, Debug)]
pub struct Intercept {
    /// 0 at a, 1 at b; NaN where the ends are on one side.
    pub t: f64,
    /// How often the surface was met between the ends.
    pub count: i32,
    /// 0 none, 1 ray, 2 several (the one nearest the outside end is given), 3 bisected.
    pub status: i32,
    /// Outward unit normal at the crossing; NaN where there is none.
    pub normal: Vec3,
    /// Input face; -1 where there is none.
    pub primitive: i64,
    /// Innermost label; -1 where there is none.
    pub part: i32,
    /// Tag of the face; -1 where there is none.
    pub tag: i32,
}

/// How the place of a crossing is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CrossingForm {
    /// The coordinate along the axis.
    Coordinate,
    /// 0 at the lattice point, 1 at its neighbour: the `t` of an intercept.
    Fraction,
}

/// The crossing of one lattice edge.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// Where; NaN where the ends are on one side.
    pub at: f64,
    /// How often the surface was met between the ends.
    pub count: i32,
    /// Tag of the face; -1 where there is none.
    pub tag: i32,
    /// Innermost label; -1 where there is none.
    pub part: i32,
}

/// Told of a row of edges along x: where it begins, how many there are, and which of them meet the surface.
pub type EmitCrossings<'a> = &'a (dyn Fn([usize; 3], usize, &[(usize, Crossing)]) + Sync);

const NO_INTERCEPT: Intercept =
    Intercept { t: f64::NAN, count: 0, status: 0, normal: Vec3::NAN, primitive: -1, part: NO_PART, tag: -1 };

/// Crossings of the segments from `a[3 * i..]` to `b[3 * i..]`. Never fails for want of a crossing.
pub fn intercepts(
    g: &Geometry,
    a: &[f64],
    b: &[f64],
    run: &Run,
    emit: &(dyn Fn(usize, &[Intercept]) + Sync),
) -> Result<()> {
    if a.len() != b.len() || !a.len().is_multiple_of(3) {
        return Err(Error::invalid(format!("a, b: {} and {} numbers are not three an end", a.len(), b.len())));
    }
    in_chunks(&suited(g, run), a.len() / 3, &|first, count| {
        let end = |x: &[f64], i: usize| Vec3::from_slice(&x[3 * i..3 * i + 3]);
        let mut answers = [NO_INTERCEPT; CHUNK];
        for (k, answer) in answers[..count].iter_mut().enumerate() {
            *answer = intercept(g, end(a, first + k), end(b, first + k))?.0;
        }
        emit(first, &answers[..count]);
        Ok(())
    })
}

/// Crossings of the edges that join each lattice point to its neighbour along `axis`:
/// `emit([i, j, k], count, crossings)` tells of the edges that begin at (i, j, k), (i + 1, j, k), ... as many as
/// `count`, those that meet the surface, each with how many edges lie before it.
pub fn crossings(
    g: &Geometry,
    lattice: &Lattice,
    axis: usize,
    form: CrossingForm,
    run: &Run,
    emit: EmitCrossings,
) -> Result<()> {
    if axis > 2 {
        return Err(Error::invalid(format!("axis: {axis} is not 0, 1 or 2")));
    }
    if let Some(scanned) = g.scanned(lattice.axes) {
        return scanned_crossings::crossings(g, &scanned, lattice, axis, form, run, emit);
    }
    if sides::are_known(g) {
        return sides::crossings(g, lattice, axis, form, run, emit);
    }
    in_row_pieces(&suited(g, run), lattice.edges(axis), &|at, count| {
        let mut found = Vec::new();
        for d in 0..count {
            let from = [at[0] + d, at[1], at[2]];
            let mut to = from;
            to[axis] += 1;
            let crossing = crossing(g, lattice.point(from), lattice.point(to), axis, form)?;
            if crossing.is_any() {
                found.try_reserve(1).map_err(|_| Error::memory("crossings", count))?;
                found.push((d, crossing));
            }
        }
        emit(at, count, &found);
        Ok(())
    })
}

/// The crossing of an edge along `axis`.
pub(super) fn crossing(g: &Geometry, a: Vec3, b: Vec3, axis: usize, form: CrossingForm) -> Result<Crossing> {
    let (answer, from_low) = intercept(g, a, b)?;
    Ok(answer.in_form(from_low, a[axis], b[axis], form))
}

impl Crossing {
    /// Whether the surface was met.
    pub(super) fn is_any(&self) -> bool {
        self.count != 0 || !self.at.is_nan()
    }
}

impl Intercept {
    /// As the crossing of an edge between two coordinates, from its place counted from the lesser one.
    pub(super) fn in_form(&self, from_low: f64, a: f64, b: f64, form: CrossingForm) -> Crossing {
        let at = match form {
            CrossingForm::Fraction => self.t,
            CrossingForm::Coordinate => coordinate(a.min(b), a.max(b), from_low),
        };
        Crossing { at, count: self.count, tag: self.tag, part: self.part }
    }
}

/// The coordinate at `t` between two ends, never beyond them; NaN where `t` is.
fn coordinate(low: f64, high: f64, t: f64) -> f64 {
    let at = low + (high - low) * t;
    positive_zero(if t == 1.0 || at > high { high } else { at })
}

/// The crossing of one segment, and the same `t` counted from the end of lesser coordinates.
fn intercept(g: &Geometry, a: Vec3, b: Vec3) -> Result<(Intercept, f64)> {
    if !a.is_finite() || !b.is_finite() || a == b {
        return Ok((NO_INTERCEPT, f64::NAN));
    }
    let turned = b.to_array() < a.to_array();
    let (low, high) = if turned { (b, a) } else { (a, b) };
    let answer = ordered(g, low, high)?;
    Ok((answer.seen(turned), answer.t))
}

impl Intercept {
    /// From the end of lesser coordinates, or from the other one.
    pub(super) fn seen(self, turned: bool) -> Intercept {
        Intercept { t: if turned { 1.0 - self.t } else { self.t }, ..self }
    }
}

/// The same, from the end of lesser coordinates.
fn ordered(g: &Geometry, low: Vec3, high: Vec3) -> Result<Intercept> {
    let values = (g.value(low), g.value(high));
    check(g, values.0, low)?;
    check(g, values.1, high)?;
    if values.0.is_nan() || values.1.is_nan() {
        return Ok(NO_INTERCEPT);
    }
    settled(g, low, high, values, &g.events(low, high))
}

/// The same where the meetings with the surface are known, and the values of the ends, or their signs.
pub(super) fn settled(g: &Geometry, low: Vec3, high: Vec3, values: (f64, f64), events: &[Event]) -> Result<Intercept> {
    let inside = (values.0 <= 0.0, values.1 <= 0.0);
    let count = events.len() as i32;
    if inside.0 == inside.1 {
        return Ok(Intercept { count, ..NO_INTERCEPT });
    }
    let mut crossings = events.iter().filter(|e| e.change != Change::Touch);
    let number = crossings.clone().count();
    let change = if inside.0 { Change::Leave } else { Change::Enter };
    // The sides alternate, beginning and ending as the values say.
    let agrees = number % 2 == 1 && crossings.clone().enumerate().all(|(k, e)| (e.change == change) == (k % 2 == 0));
    let nearest_outside = if inside.0 { crossings.next_back() } else { crossings.next() };
    let (event, status) = match nearest_outside {
        Some(event) if agrees && (g.has_slope() || g.changes_side(low, high, event.t)) => {
            (*event, if number > 1 { 2 } else { 1 })
        }
        // A zero end needs no search.
        _ if values.0 == 0.0 => (g.bisected_event(low, 0.0, change), 1),
        _ if values.1 == 0.0 => (g.bisected_event(high, 1.0, change), 1),
        _ => {
            let t = g.bisect(low, high);
            (g.bisected_event(low + (high - low) * t, t, change), 3)
        }
    };
    let t = if values.0 == 0.0 {
        0.0
    } else if values.1 == 0.0 {
        1.0
    } else {
        event.t
    };
    Ok(Intercept {
        t,
        count: count.max(1),
        status,
        // Adding zero turns -0.0 into +0.0.
        normal: event.normal + Vec3::ZERO,
        primitive: event.primitive,
        part: event.part,
        tag: event.tag,
    })
}
