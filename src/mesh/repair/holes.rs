// SPDX-License-Identifier: MIT OR Apache-2.0
//! Small holes filled by the triangulation of least area over their rims (Barequet & Sharir 1995; Liepa 2003,
//! without its refinement).

use super::{RepairOptions, Repairs};
use crate::error::{Error, Result};
use crate::math::{Vec3, length};
use crate::mesh::edges::{Edges, NONE};
use crate::mesh::faces::filled;
use crate::mesh::least_area::least_area;
use crate::mesh::{Input, Mesh};
use std::collections::BTreeSet;

/// The mesh with its small holes filled; none where there are none. Faces must agree round each hole.
pub(super) fn fill(mesh: &Mesh, options: &RepairOptions, done: &mut Repairs) -> Result<Option<Input>> {
    let loops = boundary_loops(mesh)?;
    let topology = mesh.half_edges();
    let most = options.hole_length * mesh.bounds().diagonal();
    let mut input: Option<Input> = None;
    let mut added = BTreeSet::new();
    for rim in &loops {
        // Round the hole the other way than the faces at its rim.
        let hole: Vec<u32> = rim.iter().rev().map(|&h| topology.origin(h)).collect();
        let at = |k: usize| mesh.vertices()[hole[k] as usize];
        let rim_length: f64 = (0..hole.len()).map(|k| length(at((k + 1) % hole.len()) - at(k))).sum();
        let positions: Vec<Vec3> = (0..hole.len()).map(at).collect();
        let small = (3..=options.hole_edges).contains(&hole.len()) && rim_length <= most;
        let is_edge = |i: usize, k: usize| {
            let (a, b) = (hole[i], hole[k]);
            joined(mesh, a, b) || added.contains(&(a.min(b), a.max(b)))
        };
        let Some(triangles) = small.then(|| least_area(&positions, &is_edge)).transpose()?.flatten() else {
            done.holes_left += 1;
            continue;
        };
        let input = match &mut input {
            Some(input) => input,
            none => none.insert(mesh.as_input()?),
        };
        let tag = options.fill_tag.unwrap_or_else(|| most_frequent_tag(mesh, rim));
        let row = |k: u32| mesh.data().row(rim[rim.len() - 1 - k as usize], hole[k as usize]);
        for t in triangles {
            let corners = t.map(|k| hole[k as usize]);
            (0..3)
                .map(|k| (corners[k], corners[(k + 1) % 3]))
                .for_each(|(a, b)| _ = added.insert((a.min(b), a.max(b))));
            let number = input.face_numbers();
            if number >= u32::MAX as usize - 1 || input.faces.corners.len() > u32::MAX as usize - 3 {
                return Err(Error::invalid(format!("mesh: with its holes filled it has more than {number} faces")));
            }
            input.faces.push(&t.map(row), number as u32);
            if input.tags.is_empty() && tag != 0 {
                input.tags = filled("tags", number, 0)?;
            }
            if !input.tags.is_empty() {
                input.tags.resize(number, 0);
                input.tags.push(tag);
            }
            input.numbers = number + 1;
            done.faces_added += 1;
        }
        done.holes_filled += 1;
    }
    if let Some(input) = &mut input {
        let count = input.face_numbers();
        input.face_data.iter_mut().for_each(|field| field.pad(count));
    }
    Ok(input)
}

/// Whether any face has an edge between the two vertices.
fn joined(mesh: &Mesh, a: u32, b: u32) -> bool {
    let topology = mesh.half_edges();
    let leads = |from: u32, to: u32| topology.outgoing(from).iter().any(|&h| topology.target(h) == to);
    leads(a, b) || leads(b, a)
}

/// Of several as frequent the least.
fn most_frequent_tag(mesh: &Mesh, rim: &[u32]) -> i32 {
    let topology = mesh.half_edges();
    let mut tags: Vec<i32> = rim.iter().map(|&h| mesh.tag(topology.input_face(topology.face(h)))).collect();
    tags.sort_unstable();
    let runs = tags.chunk_by(|a, b| a == b);
    runs.fold((0, 0), |best, run| if run.len() > best.0 { (run.len(), run[0]) } else { best }).1
}

/// The half-edges at the rim of each hole, in the order of the faces, in loops that pass no vertex twice. Rims
/// that lead to an edge whose faces disagree are left out.
fn boundary_loops(mesh: &Mesh) -> Result<Vec<Vec<u32>>> {
    let topology = mesh.half_edges();
    let edges = Edges::of(mesh.vertices().len(), topology.faces().half_edges())?;
    let mut open = filled("half-edges", topology.count(), false)?;
    for edge in edges.iter().filter(|edge| edge.len() == 1) {
        open[edge[0] as usize] = true;
    }
    let mut place = filled("vertices", mesh.vertices().len(), NONE)?;
    let mut loops = Vec::new();
    let mut path: Vec<u32> = Vec::new();
    for start in 0..topology.count() as u32 {
        let mut h = start;
        path.clear();
        while open[h as usize] {
            open[h as usize] = false;
            place[topology.origin(h) as usize] = path.len() as u32;
            path.push(h);
            let end = topology.target(h);
            if let Some(from) = Some(place[end as usize]).filter(|p| *p != NONE) {
                let closed = path.split_off(from as usize);
                closed.iter().for_each(|&g| place[topology.origin(g) as usize] = NONE);
                loops.push(closed);
            }
            h = next_open(mesh, h);
        }
        path.iter().for_each(|&g| place[topology.origin(g) as usize] = NONE);
    }
    Ok(loops)
}

/// The last half-edge of the fan of faces round the target of a boundary half-edge.
fn next_open(mesh: &Mesh, h: u32) -> u32 {
    let topology = mesh.half_edges();
    let mut g = topology.next(h);
    while let Some(twin) = topology.twin(g) {
        g = topology.next(twin);
    }
    g
}
