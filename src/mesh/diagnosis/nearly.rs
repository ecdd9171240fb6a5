// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the counts do not tell and advice needs: boundaries that nearly coincide, shells within shells.

use super::{Diagnosis, Subject};
use crate::error::{Result, filled, try_with_capacity};
use crate::math::{Aabb, Vec3};
use crate::mesh::Triangle;
use crate::mesh::orient::{self, Parts};
use crate::mesh::weld::{weld_equal, weld_near};

/// Tolerances to try, parts of the diagonal: from the rounding of f64 to well above that of f32.
const TOLERANCES: [f64; 6] = [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];

/// The tolerance that joins the most boundary edges in pairs, and how many edges these are, where it is at least half
/// of them and no edge vanishes by it. n log n in the boundary.
pub(super) fn weldable(subject: &Subject) -> Result<Option<(f64, usize)>> {
    let ends = |h: u32| [subject.mesh.half_edges.origin(h), subject.mesh.half_edges.target(h)];
    let count = subject.edges.iter().filter(|edge| edge.len() == 1).count();
    if count == 0 {
        return Ok(None);
    }
    let mut vertices: Vec<u32> = try_with_capacity("vertices", 2 * count)?;
    vertices.extend(subject.edges.iter().filter(|edge| edge.len() == 1).flat_map(|edge| ends(edge[0])));
    vertices.sort_unstable();
    vertices.dedup();
    let mut positions: Vec<Vec3> = try_with_capacity("vertices", vertices.len())?;
    positions.extend(vertices.iter().map(|&v| subject.vertices[v as usize]));
    let used = filled("vertices", positions.len(), true)?;
    let place = |v: u32| vertices.binary_search(&v).unwrap_or(0);
    let bounds = subject.mesh.bounds();
    let mut pairs: Vec<[u32; 2]> = try_with_capacity("edges", count)?;
    let mut best: Option<(f64, usize)> = None;
    for tolerance in TOLERANCES {
        let mut welded = weld_equal(&positions, &used)?;
        let around = Aabb::of(welded.vertices.iter().copied());
        weld_near(&mut welded, around, tolerance * bounds.diagonal())?;
        pairs.clear();
        pairs.extend(subject.edges.iter().filter(|edge| edge.len() == 1).map(|edge| {
            let [a, b] = ends(edge[0]).map(|v| welded.of[place(v)]);
            [a.min(b), a.max(b)]
        }));
        if pairs.iter().any(|[a, b]| a == b) {
            break;
        }
        pairs.sort_unstable();
        let joined = 2 * pairs.chunk_by(|a, b| a == b).filter(|same| same.len() == 2).count();
        if 2 * joined >= count && joined > best.map_or(0, |(_, n)| n) {
            best = Some((tolerance, joined));
        }
    }
    Ok(best)
}

/// Closed components that face outward within an odd number of closed shells: repair would turn them into cavities.
pub(super) fn solid_within(subject: &Subject, found: &Diagnosis) -> Result<usize> {
    if found.components.len() < 2 || found.surface.unbalanced_edges > 0 || found.report.duplicate_faces > 0 {
        return Ok(0);
    }
    let faces = subject.faces;
    let mut triangles: Vec<Triangle> = try_with_capacity("triangles", subject.mesh.triangles.len())?;
    for f in 0..faces.len() {
        let own = subject.mesh.triangles[faces.triangles_of(f)].iter();
        triangles.extend(own.map(|t| Triangle { face: f as u32, ..*t }));
    }
    let parts = Parts {
        vertices: subject.vertices,
        faces,
        triangles: &triangles,
        edges: &subject.edges,
        of_half_edge: &subject.of_half_edge,
    };
    let turned = orient::outward(&parts, true)?;
    let mut all = filled("components", found.components.len(), true)?;
    for (f, turned) in turned.iter().enumerate() {
        all[found.component_of_face[faces.input[f] as usize] as usize] &= *turned;
    }
    // Those of negative volume are merely inside out. Volumes are those as read.
    let outward = |c: &super::Component| match c.turned_faces {
        0 => c.volume > 0.0,
        n => n == c.faces && c.volume < 0.0,
    };
    Ok(found.components.iter().zip(all).filter(|(c, all)| *all && outward(c)).count())
}
