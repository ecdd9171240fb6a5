// SPDX-License-Identifier: MIT OR Apache-2.0
//! From checked vertices and faces to a mesh: place, weld, report, repair, orient.

use super::edges::{Edges, excess, turn_over};
use super::faces::{Faces, filled};
use super::half_edge::HalfEdges;
use super::orient::{self, Parts};
use super::triangulate::triangulate;
use super::weld::{UNUSED, Welded, weld_equal, weld_near};
use super::{Mesh, MeshOptions, Orient, Report, Surface, Triangle, duplicates, measure};
use crate::error::{Error, Result, Status};
use crate::math::{Aabb, Vec3};

/// Beyond these the exact predicates overflow, or lose the last digits of the coordinates to underflow.
pub(crate) const LARGEST_COORDINATE: f64 = 1e100;
const SMALLEST_DIAGONAL: f64 = 1e-90;

/// Finite positions, faces whose corners are in range, a tag for each face or none at all.
pub(crate) struct Input {
    pub positions: Vec<Vec3>,
    pub faces: Faces,
    pub tags: Vec<i32>,
    /// The status where the shape itself is unfit: the argument's or the file's fault.
    pub blame: Status,
}

/// The mesh of an input. `options` have been checked.
pub(crate) fn build(mut input: Input, options: &MeshOptions) -> Result<Mesh> {
    place(&mut input.positions, options)?;
    let (welded, bounds) = weld(&input, options)?;
    let mut report = Report {
        faces: input.faces.len(),
        triangles: input.faces.corners.len() - 2 * input.faces.len(),
        vertices: welded.vertices.len(),
        ..Report::default()
    };
    let (vertices, mut faces) = clean(&input, welded, &mut report)?;
    let mut triangles = triangulate(&vertices, &faces, input.blame)?;
    let mut edges = Edges::of(vertices.len(), faces.half_edges())?;
    let mut of_half_edge = faces.of_half_edges()?;
    report.measure(&vertices, &faces, &triangles, bounds.center())?;
    report.count(&faces, &edges, &of_half_edge)?;
    (report.lo, report.hi) = (bounds.lo.to_array(), bounds.hi.to_array());

    let repeats = duplicates::find(&faces, vertices.len())?;
    report.duplicate_faces = repeats.either_way.iter().filter(|r| **r).count();
    if report.duplicate_faces > 0 {
        (faces, triangles, edges) = without_repeats(&vertices, faces, triangles, &repeats)?;
        of_half_edge = faces.of_half_edges()?;
    }
    let turned = match options.orient {
        Orient::Keep => filled("faces", faces.len(), false)?,
        Orient::Flip => filled("faces", faces.len(), true)?,
        // The rule of orient.rs without the work, for what most files hold.
        Orient::Auto if report.is_one_consistent_sheet() => filled("faces", faces.len(), report.inside_out)?,
        Orient::Auto => orient::outward(&Parts {
            vertices: &vertices,
            faces: &faces,
            triangles: &triangles,
            edges: &edges,
            of_half_edge: &of_half_edge,
        })?,
    };
    turn_over(&mut faces, &turned);
    let edges = edges.renumbered(&faces, &of_half_edge, &turned);
    for t in &mut triangles {
        if turned[t.face as usize] {
            t.vertices.swap(1, 2);
            t.turned = true;
        }
        t.face = faces.input[t.face as usize];
    }
    let surface = Surface::of(&faces, &edges, measure::volume(&vertices, &triangles, bounds.center()));
    let half_edges = HalfEdges::new(vertices.len(), faces, of_half_edge, &edges)?;
    Ok(Mesh { vertices, triangles, tags: input.tags, half_edges, report, surface })
}

/// Leaves out copies, whichever way they run, unless copies that run the other way are what closes the
/// surface: the wall between two bodies in contact, given by each of them.
fn without_repeats(
    vertices: &[Vec3],
    faces: Faces,
    triangles: Vec<Triangle>,
    repeats: &duplicates::Repeats,
) -> Result<(Faces, Vec<Triangle>, Edges)> {
    let (single, of_single) = duplicates::leave_out(&faces, &triangles, &repeats.either_way)?;
    let edges = Edges::of(vertices.len(), single.half_edges())?;
    if edges.iter().any(|edge| edge.len() != 2) {
        let (walled, of_walled) = duplicates::leave_out(&faces, &triangles, &repeats.same_way)?;
        let walled_edges = Edges::of(vertices.len(), walled.half_edges())?;
        if walled_edges.iter().all(|edge| excess(&walled.corners, edge) == 0) {
            return Ok((walled, of_walled, walled_edges));
        }
    }
    Ok((single, of_single, edges))
}

fn place(positions: &mut [Vec3], options: &MeshOptions) -> Result<()> {
    for (v, p) in positions.iter_mut().enumerate() {
        let q = options.place(*p);
        // Also false for what overflowed to an infinity or a NaN on the way.
        if !(q.abs().max_element() <= LARGEST_COORDINATE && q.is_finite()) {
            return Err(Error::invalid(format!(
                "xyz: vertex {v} comes to lie at ({:e}, {:e}, {:e}), beyond {LARGEST_COORDINATE:e}",
                q.x, q.y, q.z
            )));
        }
        *p = q;
    }
    Ok(())
}

/// Welds the vertices that faces use; also their box.
fn weld(input: &Input, options: &MeshOptions) -> Result<(Welded, Aabb)> {
    let mut used = filled("vertices", input.positions.len(), false)?;
    for &v in &input.faces.corners {
        used[v as usize] = true;
    }
    let mut welded = weld_equal(&input.positions, &used)?;
    let bounds = Aabb::of(welded.vertices.iter().copied());
    let diagonal = bounds.diagonal();
    if diagonal <= SMALLEST_DIAGONAL {
        return Err(Error::new(
            input.blame,
            format!("xyz: the box around the faces has the diagonal {diagonal:e}, not above {SMALLEST_DIAGONAL:e}"),
        ));
    }
    if options.weld_tolerance > 0.0 {
        weld_near(&mut welded, bounds, options.weld_tolerance * diagonal)?;
        let bounds = Aabb::of(welded.vertices.iter().copied());
        return Ok((welded, bounds));
    }
    Ok((welded, bounds))
}

/// Faces over welded vertices, without those that welding collapsed, and the vertices they use.
fn clean(input: &Input, welded: Welded, report: &mut Report) -> Result<(Vec<Vec3>, Faces)> {
    let mut faces = Faces::with_capacity(input.faces.len(), input.faces.corners.len())?;
    let mut ring = Vec::new();
    for (f, corners) in input.faces.iter().enumerate() {
        ring.clear();
        let mut lost = false;
        for &corner in corners {
            lost |= add_corner(&mut ring, welded.of[corner as usize]);
        }
        lost |= close_ring(&mut ring);
        report.degenerate_faces += usize::from(lost);
        if ring.len() > 2 {
            faces.push(&ring, f as u32);
        }
    }
    if faces.len() == 0 {
        return Err(Error::new(
            input.blame,
            format!("faces: each of {} has fewer than three different corners", input.faces.len()),
        ));
    }
    let vertices = if report.degenerate_faces > 0 { compact(welded.vertices, &mut faces)? } else { welded.vertices };
    Ok((vertices, faces))
}

/// Adds a corner unless it repeats the last one or ends a spike (x, y, x), which encloses nothing.
fn add_corner(ring: &mut Vec<u32>, v: u32) -> bool {
    let n = ring.len();
    if n > 0 && ring[n - 1] == v {
        return true;
    }
    if n > 1 && ring[n - 2] == v {
        ring.pop();
        return true;
    }
    ring.push(v);
    false
}

/// The same across the end of the ring.
fn close_ring(ring: &mut Vec<u32>) -> bool {
    let before = ring.len();
    loop {
        let n = ring.len();
        if n > 1 && ring[n - 1] == ring[0] {
            ring.pop();
        } else if n > 2 && ring[n - 2] == ring[0] {
            ring.truncate(n - 2);
        } else if n > 2 && ring[n - 1] == ring[1] {
            ring.pop();
            ring.remove(0);
        } else {
            return n < before;
        }
    }
}

/// Leaves out vertices that no face uses any more.
fn compact(mut vertices: Vec<Vec3>, faces: &mut Faces) -> Result<Vec<Vec3>> {
    let mut new = filled("vertices", vertices.len(), UNUSED)?;
    for &v in &faces.corners {
        new[v as usize] = 0;
    }
    let mut left = 0;
    for v in 0..vertices.len() {
        if new[v] != UNUSED {
            new[v] = left as u32;
            vertices[left] = vertices[v];
            left += 1;
        }
    }
    vertices.truncate(left);
    for v in &mut faces.corners {
        *v = new[*v as usize];
    }
    Ok(vertices)
}

/// Triangles over vertices of their own, as in a file without shared vertices; a tag each.
pub(crate) fn soup(positions: Vec<Vec3>, tags: Vec<i32>, options: &MeshOptions) -> Result<Mesh> {
    let count = positions.len() / 3;
    let mut faces = Faces::with_capacity(count, positions.len())?;
    for t in 0..count as u32 {
        faces.push(&[3 * t, 3 * t + 1, 3 * t + 2], t);
    }
    build(Input { positions, faces, tags, blame: Status::Parse }, options)
}

impl Triangle {
    /// Its corners as positions.
    pub fn corners(&self, vertices: &[Vec3]) -> [Vec3; 3] {
        measure::corners(vertices, self)
    }
}
