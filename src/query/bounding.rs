// SPDX-License-Identifier: MIT OR Apache-2.0
//! A box or a ball around a body that does not know its own: a start box is subdivided as an octree, and
//! what may hold a part of the body is kept. Cells within what is kept already are not looked into.

use super::check;
use crate::error::{Error, Result};
use crate::geometry::{Geometry, Kind};
use crate::math::{Aabb, Vec3, length};
use crate::parallel::Run;

/// Finest subdivision: around the outermost points of a round body cells twice as fine are twice as many.
const DEEPEST: i32 = 16;

/// Faces of the start box are looked at no more coarsely than this.
const LEAST_FACE_DEPTH: i32 = 6;

/// Cells between two reports of progress.
const CELLS_A_REPORT: u64 = 4096;

/// What a search for bounds found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bounding<T> {
    /// The body lies within.
    Found(T),
    /// The body may reach the border of the start box: nothing is known of it beyond.
    ReachesStart,
    /// No part of the body lies in the start box.
    Nothing,
}

/// A box around the body: `start` is halved `depth` times (1 to 16) along each axis, and the result widened
/// by `safety` >= 0 widths of the finest cells. Right wherever boxes can be classified; a user's function of
/// whose slope nothing is known is taken to be 1-Lipschitz. A body smaller than the finest cells is found as well.
pub fn bounding_box(g: &Geometry, start: Aabb, depth: i32, safety: f64, run: &Run) -> Result<Bounding<Aabb>> {
    let mut search = Search::new(g, start, depth, safety, run, Hull(Aabb::EMPTY))?;
    if search.body_reaches_start()? {
        return Ok(Bounding::ReachesStart);
    }
    search.visit(start, depth)?;
    let room = search.room();
    Ok(search.answer().map(|Hull(b)| Aabb::new(b.lo - room, b.hi + room)))
}

/// A ball around the body, as centre and radius: about the middle of the box that [`bounding_box`] finds, as
/// large as the farthest cell needs.
pub fn bounding_sphere(g: &Geometry, start: Aabb, depth: i32, safety: f64, run: &Run) -> Result<Bounding<(Vec3, f64)>> {
    let ball = Ball { center: Vec3::ZERO, radius: f64::NEG_INFINITY };
    let mut search = Search::new(g, start, depth, safety, run, ball)?;
    let center = match bounding_box(g, start, depth, 0.0, run)? {
        Bounding::Found(b) => b.center(),
        Bounding::ReachesStart => return Ok(Bounding::ReachesStart),
        Bounding::Nothing => return Ok(Bounding::Nothing),
    };
    search.cover.center = center;
    search.visit(start, depth)?;
    let room = length(search.room());
    Ok(search.answer().map(|ball| (center, (ball.radius + room) * (1.0 + 1e-15))))
}

impl<T> Bounding<T> {
    fn map<U>(self, to: impl FnOnce(T) -> U) -> Bounding<U> {
        match self {
            Bounding::Found(found) => Bounding::Found(to(found)),
            Bounding::ReachesStart => Bounding::ReachesStart,
            Bounding::Nothing => Bounding::Nothing,
        }
    }
}

/// What cells are gathered in.
trait Cover: Copy {
    fn holds(&self, cell: Aabb) -> bool;
    fn take(&mut self, cell: Aabb);
}

#[derive(Clone, Copy)]
struct Hull(Aabb);

impl Cover for Hull {
    fn holds(&self, cell: Aabb) -> bool {
        self.0.contains(cell.lo) && self.0.contains(cell.hi)
    }

    fn take(&mut self, cell: Aabb) {
        self.0 = self.0.hull(cell);
    }
}

#[derive(Clone, Copy)]
struct Ball {
    center: Vec3,
    radius: f64,
}

impl Ball {
    fn farthest(&self, cell: Aabb) -> f64 {
        length((cell.hi - self.center).abs().max((cell.lo - self.center).abs()))
    }
}

impl Cover for Ball {
    fn holds(&self, cell: Aabb) -> bool {
        self.farthest(cell) <= self.radius
    }

    fn take(&mut self, cell: Aabb) {
        self.radius = self.radius.max(self.farthest(cell));
    }
}

struct Search<'a, C> {
    g: &'a Geometry,
    start: Aabb,
    depth: i32,
    safety: f64,
    run: &'a Run<'a>,
    cover: C,
    found: bool,
    cells: u64,
}

impl<'a, C: Cover> Search<'a, C> {
    fn new(g: &'a Geometry, start: Aabb, depth: i32, safety: f64, run: &'a Run<'a>, cover: C) -> Result<Self> {
        for k in 0..3 {
            if !(start.lo[k] < start.hi[k] && start.lo[k].is_finite() && start.hi[k].is_finite()) {
                return Err(Error::invalid(format!(
                    "start_lo[{k}], start_hi[{k}]: {} to {} is no finite range",
                    start.lo[k], start.hi[k]
                )));
            }
        }
        if !(1..=DEEPEST).contains(&depth) {
            return Err(Error::invalid(format!("depth: {depth} is not between 1 and {DEEPEST}")));
        }
        if !(safety >= 0.0 && safety.is_finite()) {
            return Err(Error::invalid(format!("safety: {safety} is not finite and >= 0")));
        }
        Ok(Search { g, start, depth, safety, run, cover, found: false, cells: 0 })
    }

    /// Depth first; the recursion is as deep as the octree.
    fn visit(&mut self, cell: Aabb, depth: i32) -> Result<()> {
        if self.found && self.cover.holds(cell) {
            return Ok(());
        }
        self.count()?;
        match self.side(cell)? {
            1 => return Ok(()),
            0 if depth > 0 => {
                return (0..8).try_for_each(|octant| self.visit(octant_of(cell, octant), depth - 1));
            }
            _ => {}
        }
        self.found = true;
        self.cover.take(cell);
        Ok(())
    }

    /// As classified; of a function of which nothing but values is known, from the value in the middle.
    fn side(&self, cell: Aabb) -> Result<i32> {
        let side = self.g.classify(cell);
        if side != 0 {
            return Ok(side);
        }
        let middle = cell.center();
        let value = self.g.value(middle);
        check(self.g, value, middle)?;
        let known = !self.g.has_functions() || self.g.kind() != Kind::SignOnly || self.g.lipschitz().is_finite();
        let half = length(cell.hi - middle);
        Ok(if known || value.abs() <= half { 0 } else { value.signum() as i32 })
    }

    /// Whether the body may reach a face of the start box.
    fn body_reaches_start(&mut self) -> Result<bool> {
        for axis in 0..3 {
            for side in [self.start.lo[axis], self.start.hi[axis]] {
                let mut face = self.start;
                (face.lo[axis], face.hi[axis]) = (side, side);
                if self.reaches(face, axis, self.depth.max(LEAST_FACE_DEPTH))? {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    fn reaches(&mut self, face: Aabb, axis: usize, depth: i32) -> Result<bool> {
        self.count()?;
        match self.side(face)? {
            1 => Ok(false),
            0 if depth > 0 => {
                for quarter in (0..8).filter(|octant| octant >> axis & 1 == 0) {
                    if self.reaches(octant_of(face, quarter), axis, depth - 1)? {
                        return Ok(true);
                    }
                }
                Ok(false)
            }
            _ => Ok(true),
        }
    }

    /// Tells progress now and then; how much there is to do cannot be told.
    fn count(&mut self) -> Result<()> {
        self.cells += 1;
        if self.cells.is_multiple_of(CELLS_A_REPORT) { self.run.tell(0.5) } else { Ok(()) }
    }

    /// The safety along each axis.
    fn room(&self) -> Vec3 {
        (self.start.hi - self.start.lo) * (self.safety / (1u64 << self.depth) as f64)
    }

    fn answer(&self) -> Bounding<C> {
        if self.found { Bounding::Found(self.cover) } else { Bounding::Nothing }
    }
}

/// One of the eight halves of halves of halves; bit k says on which side of the middle along axis k.
fn octant_of(cell: Aabb, octant: i32) -> Aabb {
    let (mut part, middle) = (cell, cell.center());
    for k in 0..3 {
        if octant >> k & 1 == 1 {
            part.lo[k] = middle[k];
        } else {
            part.hi[k] = middle[k];
        }
    }
    part
}
