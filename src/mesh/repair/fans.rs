// SPDX-License-Identifier: MIT OR Apache-2.0
//! Fans of faces that meet in one vertex get a vertex each (after Gueziec et al. 2001, "Cutting and
//! stitching").

use crate::error::{Error, Result};
use crate::mesh::edges::Edges;
use crate::mesh::faces::{Sets, filled};
use crate::mesh::{Input, Mesh};

/// The mesh with a vertex for each fan; none where there is nothing to split.
///
/// Faces belong to one fan where they share an edge of exactly two faces. At an edge of more, fans that do not
/// run along it as often one way as the other belong together, for they would be open without each other.
pub(super) fn split(mesh: &Mesh) -> Result<Option<Input>> {
    let topology = mesh.half_edges();
    let faces = topology.faces();
    let edges = Edges::of(mesh.vertices().len(), faces.half_edges())?;
    // The corner of the face of half-edge h at its origin is h, at its target the next one.
    let corner_at = |h: u32, v: u32| if topology.origin(h) == v { h } else { topology.next(h) };
    let mut fans = Sets::new(topology.count())?;
    for edge in edges.iter().filter(|edge| edge.len() == 2) {
        let ends = [topology.origin(edge[0]), topology.target(edge[0])];
        ends.iter().for_each(|&v| fans.join(corner_at(edge[0], v), corner_at(edge[1], v)));
    }
    let mut sums: Vec<(u32, i64)> = Vec::new();
    for edge in edges.iter().filter(|edge| edge.len() > 2) {
        for v in [topology.origin(edge[0]), topology.target(edge[0])] {
            sums.clear();
            let step = |h: u32| if topology.origin(h) == v { 1 } else { -1 };
            sums.extend(edge.iter().map(|&h| (fans.find(corner_at(h, v)), step(h))));
            sums.sort_unstable();
            let mut unbalanced = None;
            for group in sums.chunk_by(|a, b| a.0 == b.0) {
                if group.iter().map(|s| s.1).sum::<i64>() != 0 || group.len() % 2 == 1 {
                    fans.join(*unbalanced.get_or_insert(group[0].0), group[0].0);
                }
            }
        }
    }
    let mut first = filled("vertices", mesh.vertices().len(), u32::MAX)?;
    let mut input: Option<Input> = None;
    let mut new_row = std::collections::BTreeMap::new();
    for v in 0..first.len() as u32 {
        for &corner in topology.outgoing(v) {
            let fan = fans.find(corner);
            let kept = &mut first[v as usize];
            if *kept == u32::MAX {
                *kept = fan;
            }
            if fan == *kept {
                continue;
            }
            let input = match &mut input {
                Some(input) => input,
                none => none.insert(mesh.as_input()?),
            };
            let old = input.faces.corners[corner as usize];
            let row = match new_row.get(&(fan, old)) {
                Some(row) => *row,
                None => {
                    let row = input.positions.len() as u32;
                    let vertex = *new_row.entry((fan, u32::MAX)).or_insert(row);
                    add_row(input, old, vertex)?;
                    new_row.insert((fan, old), row);
                    row
                }
            };
            input.faces.corners[corner as usize] = row;
        }
    }
    Ok(input)
}

/// A copy of a row, at a vertex of its own or one that another row has.
fn add_row(input: &mut Input, row: u32, vertex: u32) -> Result<()> {
    let count = input.positions.len() + 1;
    if count >= u32::MAX as usize {
        return Err(Error::invalid(format!("mesh: split it has more than {} vertices", u32::MAX - 1)));
    }
    let reserved = input.positions.try_reserve(1).and(input.same_as.try_reserve(1));
    reserved.map_err(|_| Error::memory("vertices", count))?;
    input.positions.push(input.positions[row as usize]);
    input.same_as.push(vertex);
    for field in &mut input.vertex_data {
        let item = row as usize * field.components..(row as usize + 1) * field.components;
        field.values.try_reserve(field.components).map_err(|_| Error::memory("values", field.values.len()))?;
        field.values.extend_from_within(item);
    }
    Ok(())
}
