// SPDX-License-Identifier: MIT OR Apache-2.0
//! Half-edges of polygons in flat index arrays (Mäntylä 1988, Campagna et al. 1998).

use super::edges::{Edges, NONE};
use super::faces::{Faces, starts_from_counts};
use super::{Mesh, Triangle};
use crate::error::{Result, filled, try_copy, try_with_capacity};
use std::ops::Range;

/// The topology of a mesh as it stands: oriented, without collapsed faces; faces keep all
/// their corners.
///
/// The half-edges of a face have consecutive numbers, in its order. A half-edge has a twin where its edge
/// has exactly two faces that run along it in opposite directions; at boundary edges, edges of more than
/// two faces and edges that two faces run along the same way it has none. Every function is O(1) except where it
/// says otherwise, and panics on a number out of range, as indexing does.
#[derive(Clone, Debug)]
pub struct HalfEdges {
    faces: Faces,
    of_half_edge: Vec<u32>,
    twin: Vec<u32>,
    outgoing_start: Vec<u32>,
    outgoing: Vec<u32>,
}

impl HalfEdges {
    pub(super) fn new(vertices: usize, faces: Faces, of_half_edge: Vec<u32>, edges: &Edges) -> Result<HalfEdges> {
        let mut twin = edges.mates()?;
        let corners = &faces.corners;
        for (h, mate) in twin.iter_mut().enumerate() {
            if *mate != NONE && corners[h] == corners[*mate as usize] {
                *mate = NONE;
            }
        }
        HalfEdges::with_twins(vertices, faces, of_half_edge, twin)
    }

    fn with_twins(vertices: usize, faces: Faces, of_half_edge: Vec<u32>, twin: Vec<u32>) -> Result<HalfEdges> {
        let corners = &faces.corners;
        let mut start = filled("vertices", vertices + 1, 0u32)?;
        for &v in corners {
            start[v as usize] += 1;
        }
        starts_from_counts(&mut start);
        let mut outgoing = filled("half-edges", corners.len(), 0u32)?;
        for (h, &v) in corners.iter().enumerate() {
            outgoing[start[v as usize] as usize] = h as u32;
            start[v as usize] += 1;
        }
        // Scattering has moved each start to the next one's place.
        start.rotate_right(1);
        start[0] = 0;
        Ok(HalfEdges { faces, of_half_edge, twin, outgoing_start: start, outgoing })
    }

    /// A copy.
    pub(super) fn try_clone(&self) -> Result<HalfEdges> {
        Ok(HalfEdges {
            faces: self.faces.try_clone()?,
            of_half_edge: try_copy("half-edges", &self.of_half_edge)?,
            twin: try_copy("half-edges", &self.twin)?,
            outgoing_start: try_copy("vertices", &self.outgoing_start)?,
            outgoing: try_copy("half-edges", &self.outgoing)?,
        })
    }

    /// The topology of triangles, each a face of its own.
    pub(crate) fn of_triangles(vertices: usize, triangles: &[Triangle]) -> Result<HalfEdges> {
        let mut faces = Faces::with_capacity(triangles.len(), 3 * triangles.len())?;
        triangles.iter().zip(0..).for_each(|(t, k)| faces.push(&t.vertices, k));
        let edges = Edges::of(vertices, faces.half_edges())?;
        let of_half_edge = faces.of_half_edges()?;
        HalfEdges::new(vertices, faces, of_half_edge, &edges)
    }

    /// The same, given the triangle across each edge, as a topology of them tells, and a number that is none.
    pub(crate) fn of_neighbours(vertices: usize, triangles: &[Triangle], neighbours: &[[u32; 3]]) -> Result<HalfEdges> {
        let mut faces = Faces::with_capacity(triangles.len(), 3 * triangles.len())?;
        triangles.iter().zip(0..).for_each(|(t, k)| faces.push(&t.vertices, k));
        let of_half_edge = faces.of_half_edges()?;
        let mut twin = try_with_capacity("half-edges", faces.corners.len())?;
        for (t, across) in triangles.iter().zip(neighbours) {
            for k in 0..3 {
                let (from, to) = (t.vertices[k], t.vertices[(k + 1) % 3]);
                let back = |s: &Triangle| (0..3).find(|j| s.vertices[*j] == to && s.vertices[(j + 1) % 3] == from);
                let other = triangles.get(across[k] as usize).and_then(back);
                twin.push(other.map_or(NONE, |j| 3 * across[k] + j as u32));
            }
        }
        HalfEdges::with_twins(vertices, faces, of_half_edge, twin)
    }

    /// The topology of the triangles of a mesh; none where its faces are triangles, so that they have it already.
    pub(crate) fn of_pieces(mesh: &Mesh) -> Result<Option<HalfEdges>> {
        match mesh.half_edges.face_count() == mesh.triangles.len() {
            true => Ok(None),
            false => HalfEdges::of_triangles(mesh.vertices.len(), &mesh.triangles).map(Some),
        }
    }

    /// The faces and their corners.
    pub(crate) fn faces(&self) -> &Faces {
        &self.faces
    }

    /// How many half-edges.
    pub fn count(&self) -> usize {
        self.twin.len()
    }

    /// How many faces; their numbers leave out the input faces that are gone.
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// The input face that a face comes from.
    pub fn input_face(&self, face: u32) -> u32 {
        self.faces.input[face as usize]
    }

    /// The face that comes from an input face, where there is one. O(log n).
    pub fn face_of_input(&self, input: u32) -> Option<u32> {
        // Where no input face is gone the numbers are the same.
        if self.faces.input.get(input as usize) == Some(&input) {
            return Some(input);
        }
        self.faces.input.binary_search(&input).ok().map(|f| f as u32)
    }

    /// The vertices of a face, counter-clockwise seen from outside.
    pub fn corners(&self, face: u32) -> &[u32] {
        self.faces.face(face as usize)
    }

    /// The half-edges round a face.
    pub fn around_face(&self, face: u32) -> Range<u32> {
        self.faces.start[face as usize]..self.faces.start[face as usize + 1]
    }

    /// The face of a half-edge.
    pub fn face(&self, half_edge: u32) -> u32 {
        self.of_half_edge[half_edge as usize]
    }

    /// The vertex that a half-edge leaves.
    pub fn origin(&self, half_edge: u32) -> u32 {
        self.faces.corners[half_edge as usize]
    }

    /// The vertex that a half-edge leads to.
    pub fn target(&self, half_edge: u32) -> u32 {
        self.origin(self.next(half_edge))
    }

    /// The next half-edge of the face.
    pub fn next(&self, half_edge: u32) -> u32 {
        let face = self.around_face(self.face(half_edge));
        if half_edge + 1 == face.end { face.start } else { half_edge + 1 }
    }

    /// The previous half-edge of the face.
    pub fn previous(&self, half_edge: u32) -> u32 {
        let face = self.around_face(self.face(half_edge));
        if half_edge == face.start { face.end - 1 } else { half_edge - 1 }
    }

    /// The half-edge of the other face, where there is one.
    pub fn twin(&self, half_edge: u32) -> Option<u32> {
        Some(self.twin[half_edge as usize]).filter(|&h| h != NONE)
    }

    /// All half-edges that leave a vertex, ascending: also where several fans of faces meet in it.
    pub fn outgoing(&self, vertex: u32) -> &[u32] {
        let at = |v: usize| self.outgoing_start[v] as usize;
        &self.outgoing[at(vertex as usize)..at(vertex as usize + 1)]
    }

    /// The half-edges that leave the origin of `half_edge`, counter-clockwise seen from outside, beginning
    /// with it; ends where the fan of faces ends or comes round.
    pub fn around_vertex(&self, half_edge: u32) -> impl Iterator<Item = u32> + '_ {
        let turn = move |&h: &u32| self.twin(self.previous(h)).filter(|&g| g != half_edge);
        std::iter::successors(Some(half_edge), turn)
    }
}
