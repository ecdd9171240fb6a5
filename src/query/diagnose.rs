// SPDX-License-Identifier: MIT OR Apache-2.0
//! What is the matter with a mesh, its intersections with itself included.

use crate::bvh::{LEAF_SIZE, Tree};
use crate::error::Result;
use crate::geometry::contacts::Contacts;
use crate::math::Aabb;
use crate::mesh::{Diagnosis, DiagnosisOptions, HalfEdges, Intersections, Mesh};
use crate::parallel::Run;

/// Tells of a mesh as read all that its report counts, one by one. Intersections are pairs of input faces whose
/// triangles meet in more than the vertices and edges that they share, decided exactly; touching counts. Copies
/// of one face do not count against each other, nor do faces of zero area, nor the triangles of one face.
///
/// Near linear in the faces and in the pairs found; the same bits however it runs.
///
/// # Errors
/// [`Status::InvalidArgument`](crate::Status) naming the option, [`Status::Memory`](crate::Status),
/// [`Status::Cancelled`](crate::Status).
pub fn diagnose(mesh: &Mesh, options: &DiagnosisOptions, run: &Run) -> Result<Diagnosis> {
    options.check()?;
    run.tell(0.0)?;
    let diagnosis = mesh.diagnosis(options)?;
    if options.intersection_limit == 0 {
        run.tell(1.0)?;
        return Ok(diagnosis);
    }
    let found = intersections(mesh, options.intersection_limit, run)?;
    Ok(diagnosis.with_intersections(mesh, found))
}

/// Pairs of input faces that meet; the search ends where more than `limit` are found.
fn intersections(mesh: &Mesh, limit: usize, run: &Run) -> Result<Intersections> {
    let copies = mesh.copies()?;
    let triangles = copies.as_ref().map_or(mesh.triangles(), |c| &c.triangles);
    let own = match &copies {
        Some(_) => Some(HalfEdges::of_triangles(mesh.vertices().len(), triangles)?),
        None => HalfEdges::of_pieces(mesh)?,
    };
    let topology = own.as_ref().unwrap_or(mesh.half_edges());
    let contacts = Contacts::new(mesh.vertices(), triangles, topology, 0.0, true, run)?;
    let bounds = |t: usize| Aabb::of(triangles[t].corners(mesh.vertices()));
    let (tree, leaves) = Tree::build(triangles.len(), &bounds, LEAF_SIZE, run)?;
    // One more tells whether there are more.
    let found = contacts.find(&tree, &leaves, limit.saturating_add(1), run)?;
    let mut faces = found.pairs;
    for pair in &mut faces {
        let [a, b] = pair.map(|t| triangles[t as usize].face);
        *pair = [a.min(b), a.max(b)];
    }
    faces.sort_unstable();
    // Several triangles of two polygons may meet.
    faces.dedup();
    match copies {
        Some(copies) => copies.intersections(&faces, found.complete, limit),
        None => {
            let count = faces.len() as u64;
            faces.truncate(limit);
            Ok(Intersections { pairs: faces, count, complete: found.complete })
        }
    }
}
