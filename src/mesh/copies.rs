// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces given more than once: a mesh keeps them, but its orientation and its sign take one of each.

use super::duplicates::{self, Repeats, leave_out, runs_forward};
use super::edges::{Edges, NONE};
use super::faces::{Faces, Sets};
use super::half_edge::HalfEdges;
use super::orient::{self, Parts};
use super::{Data, Mesh, Surface, Triangle};
use crate::error::{Result, filled, try_copy};

/// What is left without copies.
struct Single {
    faces: Faces,
    triangles: Vec<Triangle>,
    edges: Edges,
}

/// For each face the one that stands for it: itself where it stays. Of copies the earliest stays, whichever way they
/// run, and of the wall between two bodies in contact, given by each of them, the earliest of each side.
pub(super) fn standing(faces: &Faces, vertices: usize, repeats: &Repeats) -> Result<Vec<u32>> {
    let first = &repeats.either_way;
    // For the earliest of each set of copies: the earliest that runs against it.
    let mut against = filled("faces", faces.len(), NONE)?;
    for (f, (&same, &either)) in repeats.same_way.iter().zip(first).enumerate() {
        if same as usize == f && either as usize != f {
            against[either as usize] = f as u32;
        }
    }
    let mut standing = try_copy("faces", first)?;
    if against.iter().all(|f| *f == NONE) {
        return Ok(standing);
    }
    let walls = walls(faces, vertices, first, &against)?;
    for (f, stands_for) in standing.iter_mut().enumerate() {
        if walls[first[f] as usize] {
            *stands_for = repeats.same_way[f];
        }
    }
    Ok(standing)
}

/// Which faces are part of a wall between bodies; told of the earliest of each set of copies.
///
/// A wall is made of faces that were given both ways and hang together over edges. It stands where it closes
/// something: at each of its edges an even number of faces was given one way alone, and at some edge (its rim, say,
/// which the bodies on either side meet) one of each two would leave an odd number of faces, at least three.
fn walls(faces: &Faces, vertices: usize, first: &[u32], against: &[u32]) -> Result<Vec<bool>> {
    let two_sided = |f: u32| against[f as usize] != NONE;
    let edges = Edges::of(vertices, faces.half_edges())?;
    let of_half_edge = faces.of_half_edges()?;
    let distinct = |edge: &[u32], out: &mut Vec<u32>| {
        out.clear();
        out.extend(edge.iter().map(|&h| of_half_edge[h as usize]).filter(|&f| first[f as usize] == f));
    };
    let mut at_edge = Vec::new();
    let mut sets = Sets::new(faces.len())?;
    for edge in edges.iter() {
        distinct(edge, &mut at_edge);
        let mut sides = at_edge.iter().filter(|f| two_sided(**f));
        if let Some(&one) = sides.next() {
            sides.for_each(|&f| sets.join(one, f));
        }
    }
    let mut needed = filled("faces", faces.len(), false)?;
    let mut spoilt = filled("faces", faces.len(), false)?;
    for edge in edges.iter() {
        distinct(edge, &mut at_edge);
        let Some(&side) = at_edge.iter().find(|f| two_sided(**f)) else { continue };
        let wall = sets.find(side) as usize;
        let one_sided = at_edge.iter().filter(|f| !two_sided(**f)).count();
        needed[wall] |= at_edge.len() > 2 && !at_edge.len().is_multiple_of(2);
        spoilt[wall] |= at_edge.len() == 1 || !one_sided.is_multiple_of(2);
    }
    let mut stands = filled("faces", faces.len(), false)?;
    for f in (0..faces.len() as u32).filter(|f| two_sided(*f)) {
        let wall = sets.find(f) as usize;
        stands[f as usize] = needed[wall] && !spoilt[wall];
    }
    Ok(stands)
}

fn single(vertices: usize, faces: &Faces, triangles: &[Triangle], standing: &[u32]) -> Result<Single> {
    let (faces, triangles) = leave_out(faces, triangles, standing)?;
    let edges = Edges::of(vertices, faces.half_edges())?;
    Ok(Single { faces, triangles, edges })
}

/// The faces to turn over so that what is left without copies is oriented, and copies run as the one that
/// stands for them.
pub(super) fn turned(parts: &Parts, repeats: &Repeats, alternate: bool) -> Result<Vec<bool>> {
    let vertices = parts.vertices.len();
    let standing = standing(parts.faces, vertices, repeats)?;
    let Single { faces, triangles, edges } = single(vertices, parts.faces, parts.triangles, &standing)?;
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
    let mut turned = filled("faces", standing.len(), false)?;
    let mut next = 0;
    for (f, &r) in standing.iter().enumerate() {
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
        let standing = standing(self.half_edges.faces(), vertices.len(), &repeats)?;
        let Single { faces, mut triangles, edges } =
            single(vertices.len(), self.half_edges.faces(), &self.triangles, &standing)?;
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
            orient: self.orient,
        }))
    }
}
