// SPDX-License-Identifier: MIT OR Apache-2.0
//! From checked vertices and faces to a mesh: place, weld, report, orient.

use super::clean::{Cleaned, clean};
use super::data::Data;
use super::duplicates;
use super::edges::{Edges, turn_over};
use super::half_edge::HalfEdges;
use super::input::Input;
use super::orient::{self, Parts};
use super::triangulate::triangulate;
use super::weld::{Welded, keep_all, weld_equal, weld_near};
use super::{Mesh, MeshOptions, Orient, Report, Surface, Triangle, copies, measure};
use crate::error::{Error, Result, filled};
use crate::math::{Aabb, Vec3};

/// Beyond these the exact predicates overflow, or lose the last digits of the coordinates to underflow.
pub(crate) const LARGEST_COORDINATE: f64 = 1e100;
pub(crate) const SMALLEST_DIAGONAL: f64 = 1e-90;

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
    let Cleaned { vertices, mut faces, source, shrunk } = clean(&input, welded)?;
    let face_count = input.face_numbers();
    let Input { positions, same_as, faces: given, tags, tag_names, vertex_data, face_data, .. } = input;
    // Of a large file these are most of the memory.
    drop((positions, same_as, given));
    report.degenerate_faces = shrunk.len();
    let mut data = Data::of(vertices.len(), &faces, &source, vertex_data, face_data)?;
    drop(source);
    let cut = triangulate(&vertices, &faces, &data.row_of_corner)?;
    let mut triangles = cut.triangles;
    report.warped_faces = cut.warped;
    data.of_pieces = cut.rows;
    let edges = Edges::of(vertices.len(), faces.half_edges())?;
    let of_half_edge = faces.of_half_edges()?;
    let repeats = duplicates::find_by_edges(&faces, vertices.len(), &edges, &of_half_edge)?;
    report.duplicate_faces = repeats.count();
    let flux = report.measure(&vertices, &faces, &triangles, bounds.center())?;
    report.count(&faces, &edges, &of_half_edge, flux)?;
    (report.lo, report.hi) = (bounds.lo.to_array(), bounds.hi.to_array());

    let parts =
        Parts { vertices: &vertices, faces: &faces, triangles: &triangles, edges: &edges, of_half_edge: &of_half_edge };
    let turned = match options.orient {
        Orient::Keep => filled("faces", faces.len(), false)?,
        Orient::Flip => filled("faces", faces.len(), true)?,
        // The rule of orient.rs without the work, for what most files hold.
        Orient::Auto | Orient::Alternate if report.is_one_consistent_sheet() => {
            filled("faces", faces.len(), report.inside_out)?
        }
        _ if report.duplicate_faces == 0 => orient::outward(&parts, options.orient == Orient::Alternate)?,
        _ => copies::turned(&parts, &repeats, options.orient == Orient::Alternate)?,
    };
    drop(repeats);
    turn_over(&faces.start, &mut faces.corners, &turned);
    if !data.row_of_corner.is_empty() {
        turn_over(&faces.start, &mut data.row_of_corner, &turned);
    }
    let edges = edges.renumbered(&faces, &of_half_edge, &turned);
    for t in &mut triangles {
        if turned[t.face as usize] {
            t.vertices.swap(1, 2);
            t.turned = true;
        }
        t.face = faces.input[t.face as usize];
    }
    let volume = measure::volume(&vertices, &triangles, bounds.center());
    let surface = Surface::of(&faces, &edges, volume);
    let half_edges = HalfEdges::new(vertices.len(), faces, of_half_edge, &edges)?;
    let mut mesh = Mesh {
        vertices,
        triangles,
        tags,
        tag_names,
        data,
        face_count,
        shrunk,
        half_edges,
        report,
        surface,
        orient: options.orient,
    };
    if let Some(distinct) = mesh.without_copies()? {
        mesh.surface = distinct.surface;
    }
    Ok(mesh)
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
    let mut welded = if options.weld_tolerance >= 0.0 {
        weld_equal(&input.positions, &used)?
    } else {
        keep_all(&input.positions, &input.same_as, &used)?
    };
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

impl Triangle {
    /// Its corners as positions.
    #[inline]
    pub fn corners(&self, vertices: &[Vec3]) -> [Vec3; 3] {
        measure::corners(vertices, self)
    }
}
