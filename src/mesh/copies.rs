// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces given more than once: a mesh keeps them, but its orientation and its sign take one of each.

use super::duplicates::{self, Repeats, leave_out, runs_forward};
use super::edges::{Edges, excess};
use super::faces::{Faces, filled};
use super::half_edge::HalfEdges;
use super::orient::{self, Parts};
use super::{Data, Mesh, Surface, Triangle};
use crate::error::{Result, try_copy};
use crate::math::Vec3;

/// What is left without copies.
struct Single {
    faces: Faces,
    triangles: Vec<Triangle>,
    edges: Edges,
    /// Whether copies that run the other way stay.
    walled: bool,
}

/// Leaves out copies, whichever way they run, unless copies that run the other way are what closes the
/// surface: the wall between two bodies in contact, given by each of them.
fn single(vertices: &[Vec3], faces: &Faces, triangles: &[Triangle], repeats: &Repeats) -> Result<Single> {
    let (single, of_single) = leave_out(faces, triangles, &repeats.either_way)?;
    let edges = Edges::of(vertices.len(), single.half_edges())?;
    if edges.iter().any(|edge| edge.len() != 2) {
        let (walled, of_walled) = leave_out(faces, triangles, &repeats.same_way)?;
        let walled_edges = Edges::of(vertices.len(), walled.half_edges())?;
        if walled_edges.iter().all(|edge| excess(&walled.corners, edge) == 0) {
            return Ok(Single { faces: walled, triangles: of_walled, edges: walled_edges, walled: true });
        }
    }
    Ok(Single { faces: single, triangles: of_single, edges, walled: false })
}

/// The faces to turn over so that what is left without copies is oriented, and copies run as the one that
/// stands for them.
pub(super) fn turned(parts: &Parts, repeats: &Repeats, alternate: bool) -> Result<Vec<bool>> {
    let Single { faces, triangles, edges, walled } = single(parts.vertices, parts.faces, parts.triangles, repeats)?;
    let of_half_edge = faces.of_half_edges()?;
    let of_single = orient::outward(
        &Parts {
            vertices: parts.vertices,
            faces: &faces,
            triangles: &triangles,
            edges: &edges,
            of_half_edge: &of_half_edge,
        },
        alternate,
    )?;
    let first = if walled { &repeats.same_way } else { &repeats.either_way };
    let mut turned = filled("faces", first.len(), false)?;
    let mut next = 0;
    for (f, &r) in first.iter().enumerate() {
        if r as usize == f {
            turned[f] = of_single[next];
            next += 1;
        } else {
            let direction = |f: usize| runs_forward(parts.faces.face(f));
            turned[f] = turned[r as usize] ^ (direction(f) != direction(r as usize));
        }
    }
    Ok(turned)
}

impl Mesh {
    /// The mesh without faces that repeat an earlier one, and without data; none where there are no copies.
    pub(crate) fn without_copies(&self) -> Result<Option<Mesh>> {
        if self.report.duplicate_faces == 0 {
            return Ok(None);
        }
        let vertices = &self.vertices;
        let repeats = duplicates::find(self.half_edges.faces(), vertices.len())?;
        let Single { faces, mut triangles, edges, .. } =
            single(vertices, self.half_edges.faces(), &self.triangles, &repeats)?;
        triangles.iter_mut().for_each(|t| t.face = faces.input[t.face as usize]);
        let volume = super::measure::volume(vertices, &triangles, self.bounds().center());
        let surface = Surface::of(&faces, &edges, volume);
        let of_half_edge = faces.of_half_edges()?;
        let half_edges = HalfEdges::new(vertices.len(), faces, of_half_edge, &edges)?;
        Ok(Some(Mesh {
            vertices: try_copy("vertices", vertices)?,
            triangles,
            tags: try_copy("tags", &self.tags)?,
            tag_names: Vec::new(),
            data: Data::default(),
            face_count: self.face_count,
            shrunk: Vec::new(),
            half_edges,
            report: self.report.clone(),
            surface,
        }))
    }
}
