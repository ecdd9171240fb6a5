// SPDX-License-Identifier: MIT OR Apache-2.0
//! Repair on request: each step does one thing and says how often it did it.

mod degenerate;
mod fans;
mod holes;

use super::options::is_tolerance;
use super::{Input, Mesh, MeshOptions, Orient, SplitBy, build};
use crate::error::{Error, Result};

/// What to repair, and within which bounds. The steps are taken in the order of the members.
#[derive(Clone, Debug, PartialEq)]
pub struct RepairOptions {
    /// Weld vertices nearer than [`RepairOptions::weld_tolerance`].
    pub weld: bool,
    /// Drop faces of zero area. The faces next to them take over their corners, so that no crack opens.
    pub degenerate: bool,
    /// Drop faces that repeat an earlier one, but for the wall between two bodies in contact.
    pub duplicates: bool,
    /// Give each fan of faces that meets others in a vertex alone a vertex of its own, at the same place. So
    /// bodies that share a vertex or an edge come apart; sheets that meet in an edge of more than two faces
    /// and would be open without each other stay together.
    pub split: bool,
    /// Make components consistent, and closed shells outward and inward in turn ([`Orient::Alternate`]).
    pub orient: bool,
    /// Fill small holes.
    pub holes: bool,
    /// Of the diagonal; 0: equal positions. Otherwise between 1e-12 and 0.5.
    pub weld_tolerance: f64,
    /// Most edges of a hole that is filled.
    pub hole_edges: usize,
    /// Most length of the rim of a hole that is filled, relative to the diagonal.
    pub hole_length: f64,
    /// The tag of new faces; none: that of most faces round the hole.
    pub fill_tag: Option<i32>,
}

impl Default for RepairOptions {
    fn default() -> RepairOptions {
        RepairOptions {
            weld: true,
            degenerate: true,
            duplicates: true,
            split: true,
            orient: true,
            holes: true,
            weld_tolerance: 0.0,
            hole_edges: 1000,
            hole_length: 1.0,
            fill_tag: None,
        }
    }
}

/// What a repair did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repairs {
    /// Vertices that are gone after welding.
    pub vertices_welded: usize,
    /// Faces that welding left fewer than three corners.
    pub faces_collapsed: usize,
    /// Faces of zero area that left.
    pub degenerate_faces: usize,
    /// Faces that repeated an earlier one and left.
    pub duplicate_faces: usize,
    /// Vertices added for fans of faces.
    pub vertices_split: usize,
    /// Faces turned over.
    pub faces_turned: usize,
    /// Components turned over as a whole.
    pub components_turned: usize,
    /// Holes filled.
    pub holes_filled: usize,
    /// Boundary loops left: too large, or not to be filled without edges of more than two faces.
    pub holes_left: usize,
    /// Triangles that fill holes.
    pub faces_added: usize,
}

impl RepairOptions {
    fn check(&self) -> Result<()> {
        if self.hole_length.is_nan() || self.hole_length < 0.0 {
            return Err(Error::invalid(format!("options.hole_length: {} is not at least 0", self.hole_length)));
        }
        let w = self.weld_tolerance;
        if !is_tolerance(w) {
            return Err(Error::invalid(format!("options.weld_tolerance: {w} is neither 0 nor between 1e-12 and 0.5")));
        }
        Ok(())
    }
}

/// As it is: nothing welded, nothing turned.
fn kept() -> MeshOptions {
    MeshOptions { weld_tolerance: -1.0, orient: Orient::Keep, ..MeshOptions::default() }
}

impl Mesh {
    /// The mesh with what the options ask for repaired, and what was done. Faces keep their numbers, tags and
    /// data; triangles that fill holes take numbers from [`Mesh::face_count`] on and have no data of faces
    /// (NaN), while data of vertices are those of the rim. What is not asked for stays. Near linear time, and
    /// the cube of the edges of each hole filled.
    ///
    /// # Errors
    /// [`Status::InvalidArgument`](crate::Status) naming an option out of its range, or where nothing would be
    /// left; [`Status::Memory`](crate::Status).
    pub fn repaired(&self, options: &RepairOptions) -> Result<(Mesh, Repairs)> {
        options.check()?;
        let mut done = Repairs::default();
        let mut mesh = self.copied()?;
        if options.weld {
            mesh = mesh.step(Ok, &MeshOptions { weld_tolerance: options.weld_tolerance, ..kept() })?;
            done.vertices_welded = self.vertices.len() - mesh.vertices.len();
            done.faces_collapsed = self.half_edges.face_count() - mesh.half_edges.face_count();
        }
        if options.degenerate {
            let dropped = &mut done.degenerate_faces;
            mesh = mesh.step(|input| degenerate::merge(input, dropped), &kept())?;
        }
        if options.duplicates
            && let Some(distinct) = mesh.without_copies()?
        {
            done.duplicate_faces = mesh.half_edges.face_count() - distinct.half_edges.face_count();
            let left = &distinct.half_edges.faces().input;
            mesh = mesh.step(|input| keep(input, left), &kept())?;
        }
        if options.split {
            let before = mesh.vertices.len();
            mesh = match fans::split(&mesh)? {
                Some(input) => build(input, &kept())?,
                None => mesh,
            };
            done.vertices_split = mesh.vertices.len() - before;
        }
        let numbers = mesh.face_count;
        let original = if options.orient { Some(directions(&mesh)?) } else { None };
        if options.orient {
            mesh = mesh.oriented()?;
        }
        if options.holes
            && let Some(input) = holes::fill(&mesh, options, &mut done)?
        {
            mesh = build(input, &kept())?;
            // What was open had no outside.
            if options.orient {
                mesh = mesh.oriented()?;
            }
        }
        if let Some(original) = original {
            count_turns(&mesh, &original, numbers, &mut done)?;
        }
        Ok((mesh, done))
    }

    /// Builds the mesh anew from its faces as `change` leaves them.
    fn step(&self, change: impl FnOnce(Input) -> Result<Input>, options: &MeshOptions) -> Result<Mesh> {
        build(change(self.as_input()?)?, options)
    }

    /// Oriented, with a report that says so.
    fn oriented(&self) -> Result<Mesh> {
        let mesh = self.step(Ok, &MeshOptions { orient: Orient::Alternate, ..kept() })?;
        if mesh.triangles.iter().any(|t| t.turned) { mesh.step(Ok, &kept()) } else { Ok(mesh) }
    }
}

/// Leaves the faces of these numbers, which are ascending.
fn keep(mut input: Input, numbers: &[u32]) -> Result<Input> {
    let mut left = super::Faces::with_capacity(numbers.len(), input.faces.corners.len())?;
    let mut wanted = numbers.iter().peekable();
    for (face, number) in input.faces.iter().zip(&input.faces.input) {
        if wanted.next_if_eq(&number).is_some() {
            left.push(face, *number);
        }
    }
    input.faces = left;
    Ok(input)
}

/// The second and the last corner of each face, with its number: how it runs.
fn directions(mesh: &Mesh) -> Result<Vec<(u32, u32, u32)>> {
    let faces = mesh.half_edges.faces();
    let mut all = crate::error::try_with_capacity("faces", faces.len())?;
    all.extend(faces.iter().zip(&faces.input).map(|(ring, number)| (*number, ring[1], ring[ring.len() - 1])));
    Ok(all)
}

/// Counts faces and components that do not run as they did. Turning a face keeps its first corner.
fn count_turns(mesh: &Mesh, original: &[(u32, u32, u32)], numbers: usize, done: &mut Repairs) -> Result<()> {
    let faces = mesh.half_edges.faces();
    let (part, count) = mesh.parts(SplitBy::Component)?;
    let mut whole = super::faces::filled("components", count, true)?;
    for (f, before) in (0..faces.len()).filter(|f| (faces.input[*f] as usize) < numbers).zip(original) {
        let turned = faces.face(f)[1] != before.1;
        done.faces_turned += usize::from(turned);
        whole[part[f] as usize] &= turned;
    }
    done.components_turned = whole.iter().filter(|w| **w).count();
    Ok(())
}
