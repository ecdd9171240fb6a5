// SPDX-License-Identifier: MIT OR Apache-2.0
//! Repair: what is asked for, in an order in which each step finds what the ones before it leave.
//!
//! 1. Weld: vertices become one, so that faces meet in edges.
//! 2. Flat faces leave, so that what follows sees surfaces alone.
//! 3. Copies leave, so that edges have the faces that bodies need.
//! 4. Holes are filled. Before vertices are split: the rims of two holes that touch in a vertex are one loop after,
//!    and two before. Flat faces leave once more: those that fill T-junctions.
//! 5. Vertices where several fans of faces meet are split.
//! 6. Faces are oriented, new ones with the rest: now it is known what is closed.

mod degenerate;
mod edge_set;
mod fans;
mod holes;
mod orient;
mod rims;
mod weld;
mod work;

use super::build::build;
use super::options::is_tolerance;
pub(super) use edge_set::EdgeSet;

use super::{Mesh, MeshOptions, Orient, copies, duplicates};
use crate::error::{Error, Result};
use crate::parallel::Run;
use work::Work;

/// What [`Mesh::repaired`] does.
#[derive(Clone, Debug, PartialEq)]
pub struct RepairOptions {
    /// Vertices with equal positions, or nearer than [`RepairOptions::weld_tolerance`], become one. Faces that keep
    /// fewer than three different corners leave.
    pub weld: bool,
    /// Faces of exactly zero area leave. Their neighbours' edges are cut at their corners, so that no crack
    /// stays.
    pub degenerate: bool,
    /// Of faces that repeat an earlier one, whichever way they run, the earliest stays. The wall between two
    /// bodies in contact, given by each of them, stays whole.
    pub duplicates: bool,
    /// Holes are filled by the triangulation of least area over their rims, of the rims' vertices alone. No edge gets
    /// more than two faces by it.
    pub holes: bool,
    /// A vertex where several fans of faces meet becomes as many, at the same position. An edge of more than two faces
    /// falls apart into edges of two where the faces on it are two each of several sheets (closed bodies that share
    /// an edge); other such edges stay as they are.
    pub split: bool,
    /// Faces are turned over until neighbours agree, as the larger part of the area has it, the outermost of closed
    /// shells face outward, those directly inside them inward, and so on by turns. Open shells only become
    /// consistent.
    pub orient: bool,
    /// As [`MeshOptions::weld_tolerance`]; 0: equal positions.
    pub weld_tolerance: f64,
    /// The most edges of a hole, at most [`RepairOptions::MOST_HOLE_EDGES`]. Time grows with the cube of it.
    pub hole_edges: usize,
    /// The longest rim of a hole of more than three edges (three are a missing triangle), as a part of the diagonal of
    /// the box around the faces that edges connect with it: not negative. By default 0.5, the rim of a round hole of
    /// 0.16 diagonals across: what a scanner did not see, and not the open end of a pipe or a box without a lid. (The
    /// rim of a sheet is at least 2.)
    pub hole_length: f64,
    /// The tag of new faces; none: that of most faces round the hole, the lowest of several.
    pub fill_tag: Option<i32>,
}

impl RepairOptions {
    /// The largest [`RepairOptions::hole_edges`].
    pub const MOST_HOLE_EDGES: usize = 2048;

    /// Nothing; to be added to.
    pub const NOTHING: RepairOptions = RepairOptions {
        weld: false,
        degenerate: false,
        duplicates: false,
        holes: false,
        split: false,
        orient: false,
        weld_tolerance: 0.0,
        hole_edges: 1000,
        hole_length: 0.5,
        fill_tag: None,
    };

    fn asks_for_something(&self) -> bool {
        self.weld || self.degenerate || self.duplicates || self.holes || self.split || self.orient
    }

    /// Every value is in its range, or [`crate::Status::InvalidArgument`] naming the one that is not.
    pub fn check(&self) -> Result<()> {
        let w = self.weld_tolerance;
        if !is_tolerance(w) {
            return Err(Error::invalid(format!("options.weld_tolerance: {w} is neither 0 nor between 1e-12 and 0.5")));
        }
        if self.hole_edges > Self::MOST_HOLE_EDGES {
            let (given, most) = (self.hole_edges, Self::MOST_HOLE_EDGES);
            return Err(Error::invalid(format!("options.hole_edges: {given} is more than {most}")));
        }
        if self.hole_length.is_nan() || self.hole_length < 0.0 {
            return Err(Error::invalid(format!("options.hole_length: {} is not 0 or above", self.hole_length)));
        }
        Ok(())
    }
}

impl Default for RepairOptions {
    /// Everything.
    fn default() -> RepairOptions {
        RepairOptions {
            weld: true,
            degenerate: true,
            duplicates: true,
            holes: true,
            split: true,
            orient: true,
            ..RepairOptions::NOTHING
        }
    }
}

/// What [`Mesh::repaired`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repairs {
    /// Vertices that became one with another.
    pub vertices_welded: usize,
    /// Faces that this left fewer than three corners.
    pub faces_collapsed: usize,
    /// Faces of zero area that left.
    pub degenerate_faces: usize,
    /// Corners that the neighbours of these got.
    pub corners_added: usize,
    /// Copies that left.
    pub duplicate_faces: usize,
    /// Holes filled.
    pub holes_filled: usize,
    /// Faces added, all of them triangles.
    pub faces_added: usize,
    /// Rims that stay: of too many edges or too long, without a triangulation that spares the edges there are,
    /// or not closed because more than two faces meet on the way.
    pub holes_left: usize,
    /// Vertices added where several fans met.
    pub vertices_split: usize,
    /// Faces turned over.
    pub faces_turned: usize,
    /// Sets of faces connected over edges of which every face was turned over.
    pub components_turned: usize,
}

impl Mesh {
    /// The mesh with its faults repaired, as far as the options ask for it, and what was done.
    ///
    /// Faces keep their numbers, tags, names and data, vertices their data and its seams. New faces have the
    /// numbers from [`Mesh::face_count`] on, the data of the vertices round their hole, and as data of their own NaN,
    /// or 0 where its type is an integer. The report is that of the repaired mesh. Where nothing is to be done, the mesh is
    /// the same in every bit.
    ///
    /// Time is near linear, but for holes, each of which takes the cube of its edges, and for faces that get many
    /// corners from flat ones on one of their edges, which are cut into triangles in the square of these.
    ///
    /// # Errors
    /// [`Status::InvalidArgument`](crate::Status): options out of range; more corners, vertices or faces than 32 bits
    /// can count. [`Status::Topology`](crate::Status) where no face is left. [`Status::Memory`](crate::Status).
    pub fn repaired(&self, options: &RepairOptions) -> Result<(Mesh, Repairs)> {
        self.repaired_with(options, &Run::SERIAL)
    }

    /// [`Mesh::repaired`], telling `run` how far it is.
    ///
    /// # Errors
    /// Those of [`Mesh::repaired`], and [`Status::Cancelled`](crate::Status).
    pub fn repaired_with(&self, options: &RepairOptions, run: &Run) -> Result<(Mesh, Repairs)> {
        options.check()?;
        run.tell(0.0)?;
        let mut repairs = Repairs::default();
        if !options.asks_for_something() {
            run.tell(1.0)?;
            return Ok((self.copied()?, repairs));
        }
        let mut work = Work::of(self)?;
        if options.weld {
            weld::weld(&mut work, options.weld_tolerance, &mut repairs)?;
        }
        run.tell(0.1)?;
        if options.degenerate {
            degenerate::take_out(&mut work, &mut repairs)?;
        }
        run.tell(0.2)?;
        if options.duplicates {
            leave_out_copies(&mut work, &mut repairs)?;
        }
        run.tell(0.3)?;
        if options.holes {
            holes::fill(&mut work, self, options, &mut repairs, run)?;
            // Cracks where the edges of one side end within those of the other are filled by faces without area.
            if options.degenerate && repairs.faces_added > 0 {
                degenerate::take_out(&mut work, &mut repairs)?;
            }
        }
        run.tell(0.6)?;
        if options.split {
            fans::split(&mut work, &mut repairs)?;
        }
        run.tell(0.7)?;
        if options.orient {
            orient::orient(&mut work, &mut repairs)?;
        }
        run.tell(0.8)?;
        let mesh = if work.changed || self.tells_of_old_faults(options) {
            let as_it_stands = MeshOptions { weld_tolerance: -1.0, orient: Orient::Keep, ..MeshOptions::default() };
            let orient = if options.orient { Orient::Auto } else { self.orient };
            Mesh { orient, ..build(work.into_input(self)?, &as_it_stands)? }
        } else {
            self.copied()?
        };
        run.tell(1.0)?;
        Ok((mesh, repairs))
    }

    /// Whether the report has faults that are asked to go and are gone since the mesh was read.
    fn tells_of_old_faults(&self, options: &RepairOptions) -> bool {
        let report = &self.report;
        (options.degenerate && !self.shrunk.is_empty()) || (options.orient && (report.inside_out || !report.consistent))
    }
}

/// Leaves out faces that repeat an earlier one but for the walls between bodies.
fn leave_out_copies(work: &mut Work, repairs: &mut Repairs) -> Result<()> {
    let vertices = work.positions.len();
    let repeats = duplicates::find(&work.faces, vertices)?;
    if repeats.count() == 0 {
        return Ok(());
    }
    let standing = copies::standing(&work.faces, vertices, &repeats)?;
    let mut rings = work.rings(0)?;
    for f in (0..work.faces.len()).filter(|&f| standing[f] as usize == f) {
        (work.faces.start[f]..work.faces.start[f + 1]).for_each(|h| rings.add(work.corner(h)));
        rings.end(work.faces.input[f]);
    }
    repairs.duplicate_faces = work.faces.len() - rings.faces.len();
    if repairs.duplicate_faces == 0 { Ok(()) } else { work.replace(rings) }
}

/// Adds an item, or [`crate::Status::Memory`].
fn push<T>(list: &mut Vec<T>, what: &str, item: T) -> Result<()> {
    list.try_reserve(1).map_err(|_| Error::memory(what, list.len() + 1))?;
    list.push(item);
    Ok(())
}
