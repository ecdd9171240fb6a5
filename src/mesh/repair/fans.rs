// SPDX-License-Identifier: MIT OR Apache-2.0
//! Fans: corners of one vertex whose faces hang together there, face by face over edges.

use super::work::{Work, fits};
use super::{Repairs, push};
use crate::error::{Error, Result, filled};
use crate::mesh::edges::{Edges, NONE};
use crate::mesh::faces::Sets;

/// Sets of corners, one a fan. Corners have the numbers of their half-edges.
///
/// The faces of an edge of two hold together. Those of an edge of more than two do where they are all of one or of
/// unpaired sheets; where each sheet that edges of two faces make has exactly two faces there, as where closed
/// bodies share an edge, only those two do.
pub(super) fn fans(work: &Work, edges: &Edges, of_half_edge: &[u32]) -> Result<Sets> {
    let mut corners = Sets::new(work.faces.corners.len())?;
    let join = |corners: &mut Sets, g: u32, h: u32| {
        let next = |h: u32| work.next(of_half_edge[h as usize] as usize, h);
        let vertex = |h: u32| work.faces.corners[h as usize];
        let (g_end, h_end) = (next(g), next(h));
        let same_way = vertex(g) == vertex(h);
        corners.join(g, if same_way { h } else { h_end });
        corners.join(g_end, if same_way { h_end } else { h });
    };
    for edge in edges.iter() {
        if let &[g, h] = edge {
            join(&mut corners, g, h);
        }
    }
    if edges.iter().all(|edge| edge.len() < 3) {
        return Ok(corners);
    }
    let mut sheets = Sets::new(work.faces.len())?;
    for edge in edges.iter() {
        if let &[g, h] = edge {
            sheets.join(of_half_edge[g as usize], of_half_edge[h as usize]);
        }
    }
    let mut by_sheet: Vec<(u32, u32)> = Vec::new();
    for edge in edges.iter().filter(|edge| edge.len() > 2) {
        by_sheet.clear();
        by_sheet.extend(edge.iter().map(|&h| (sheets.find(of_half_edge[h as usize]), h)));
        by_sheet.sort_unstable();
        let paired = by_sheet.chunk_by(|a, b| a.0 == b.0).all(|sheet| sheet.len() == 2);
        for pair in by_sheet.windows(2).filter(|pair| !paired || pair[0].0 == pair[1].0) {
            join(&mut corners, pair[0].1, pair[1].1);
        }
    }
    Ok(corners)
}

/// Gives each fan of a vertex but the one with the lowest corner a vertex of its own, at the same position.
pub(super) fn split(work: &mut Work, repairs: &mut Repairs) -> Result<()> {
    let edges = Edges::of(work.positions.len(), work.faces.half_edges())?;
    let of_half_edge = work.faces.of_half_edges()?;
    let mut fans = fans(work, &edges, &of_half_edge)?;
    drop((edges, of_half_edge));
    let mut first_fan = filled("vertices", work.positions.len(), NONE)?;
    let mut vertex_of_fan = filled("corners", work.faces.corners.len(), NONE)?;
    let mut copies = Vec::new();
    for h in 0..work.faces.corners.len() {
        let (v, fan) = (work.faces.corners[h], fans.find(h as u32) as usize);
        if first_fan[v as usize] == NONE {
            first_fan[v as usize] = fan as u32;
            vertex_of_fan[fan] = v;
        } else if vertex_of_fan[fan] == NONE {
            let copy = work.positions.len() + copies.len();
            fits("vertices", copy + 1)?;
            push(&mut copies, "vertices", work.positions[v as usize])?;
            vertex_of_fan[fan] = copy as u32;
        }
        work.faces.corners[h] = vertex_of_fan[fan];
    }
    if !copies.is_empty() {
        repairs.vertices_split = copies.len();
        work.positions.try_reserve(copies.len()).map_err(|_| Error::memory("vertices", copies.len()))?;
        work.positions.append(&mut copies);
        work.changed = true;
    }
    Ok(())
}
