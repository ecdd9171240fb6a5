// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces turned over until neighbours agree and closed shells face outward and inward by turns.

use super::Repairs;
use super::work::Work;
use crate::error::{Result, filled};
use crate::mesh::edges::{Edges, turn_over};
use crate::mesh::faces::Sets;
use crate::mesh::orient::{self, Parts};
use crate::mesh::triangulate::triangulate;
use crate::mesh::{copies, duplicates};

/// Orients all faces; the rule is that of [`orient`].
pub(super) fn orient(work: &mut Work, repairs: &mut Repairs) -> Result<()> {
    let faces = &work.faces;
    let triangles = triangulate(&work.positions, faces, &[])?.triangles;
    let edges = Edges::of(work.positions.len(), faces.half_edges())?;
    let of_half_edge = faces.of_half_edges()?;
    let parts =
        Parts { vertices: &work.positions, faces, triangles: &triangles, edges: &edges, of_half_edge: &of_half_edge };
    let repeats = duplicates::find(faces, work.positions.len())?;
    let turned = match repeats.count() {
        0 => orient::outward(&parts, true)?,
        _ => copies::turned(&parts, &repeats, true)?,
    };
    repairs.faces_turned = turned.iter().filter(|t| **t).count();
    if repairs.faces_turned == 0 {
        return Ok(());
    }
    let mut components = Sets::new(faces.len())?;
    for edge in edges.iter() {
        edge[1..].iter().for_each(|&h| components.join(of_half_edge[edge[0] as usize], of_half_edge[h as usize]));
    }
    let mut whole = filled("faces", faces.len(), true)?;
    for (f, turned) in turned.iter().enumerate() {
        whole[components.find(f as u32) as usize] &= *turned;
    }
    repairs.components_turned =
        (0..faces.len()).filter(|&f| components.find(f as u32) as usize == f && whole[f]).count();
    turn_over(&work.faces.start, &mut work.faces.corners, &turned);
    if !work.rows.is_empty() {
        turn_over(&work.faces.start, &mut work.rows, &turned);
    }
    work.changed = true;
    Ok(())
}
