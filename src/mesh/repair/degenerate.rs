// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces of zero area leave without a crack: whatever of their corners lies within one of their edges is put
//! into the faces on the other side of that edge.

use crate::error::Result;
use crate::math::Vec3;
use crate::mesh::edges::Edges;
use crate::mesh::faces::{Faces, filled};
use crate::mesh::{Input, edges};
use crate::primitive::polygon::are_on_a_line;
use std::collections::BTreeMap;

/// Merges all of them; counts them in `dropped`. Where nothing else is left they stay.
pub(super) fn merge(mut input: Input, dropped: &mut usize) -> Result<Input> {
    loop {
        let flat = flat_faces(&input)?;
        let count = flat.iter().filter(|f| **f).count();
        if count == 0 || count == flat.len() {
            return Ok(input);
        }
        let gone = round(&mut input, &flat)?;
        *dropped += gone;
    }
}

fn vertex(input: &Input, row: u32) -> u32 {
    input.same_as.get(row as usize).copied().unwrap_or(row)
}

/// Faces whose corners lie on one line, exactly.
fn flat_faces(input: &Input) -> Result<Vec<bool>> {
    let mut flat = filled("faces", input.faces.len(), false)?;
    for (flat, ring) in flat.iter_mut().zip(input.faces.iter()) {
        *flat = are_on_a_line(ring.iter().map(|r| input.positions[*r as usize]));
    }
    Ok(flat)
}

/// One round: faces that touch none that is dealt with in the same round. Returns how many left.
fn round(input: &mut Input, flat: &[bool]) -> Result<usize> {
    let faces = &input.faces;
    let of = |row: u32| vertex(input, row);
    let ends = faces.half_edges().map(|(a, b)| (of(a), of(b)));
    let edges = Edges::of(input.positions.len(), ends)?;
    let of_half_edge = faces.of_half_edges()?;
    let mut edge_at = filled("half-edges", faces.corners.len(), edges::NONE)?;
    let starts: Vec<&[u32]> = edges.iter().collect();
    for (e, edge) in starts.iter().enumerate() {
        edge.iter().for_each(|&h| edge_at[h as usize] = e as u32);
    }
    let mut busy = filled("faces", faces.len(), false)?;
    let mut gone = filled("faces", faces.len(), false)?;
    let mut inserts: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    let mut count = 0;
    for f in (0..faces.len()).filter(|&f| flat[f]) {
        let half_edges = faces.start[f]..faces.start[f + 1];
        let others = |h: u32| starts[edge_at[h as usize] as usize].iter().copied().filter(move |g| *g != h);
        let neighbours = || half_edges.clone().flat_map(others).map(|g| of_half_edge[g as usize] as usize);
        if busy[f] || neighbours().any(|g| busy[g]) {
            continue;
        }
        busy[f] = true;
        neighbours().for_each(|g| busy[g] = true);
        (gone[f], count) = (true, count + 1);
        let ring = faces.face(f);
        for (k, h) in half_edges.clone().enumerate() {
            let ends = [ring[k], ring[(k + 1) % ring.len()]];
            let within = between(&input.positions, ring, ends);
            if within.is_empty() {
                continue;
            }
            for g in others(h).filter(|g| of_half_edge[*g as usize] as usize != f) {
                let along = of(faces.corners[g as usize]) == of(ends[0]);
                let list: Vec<u32> = if along { within.clone() } else { within.iter().rev().copied().collect() };
                inserts.insert(g, list);
            }
        }
    }
    let mut left = Faces::with_capacity(faces.len() - count, faces.corners.len())?;
    let mut ring = Vec::new();
    for f in (0..faces.len()).filter(|&f| !gone[f]) {
        ring.clear();
        for h in faces.start[f]..faces.start[f + 1] {
            ring.push(faces.corners[h as usize]);
            ring.extend(inserts.get(&h).into_iter().flatten());
        }
        left.push(&ring, faces.input[f]);
    }
    input.faces = left;
    Ok(count)
}

/// The corners strictly between two others on the line of a flat face, from the first to the second.
fn between(positions: &[Vec3], ring: &[u32], [from, to]: [u32; 2]) -> Vec<u32> {
    let (a, b) = (positions[from as usize], positions[to as usize]);
    let size = (b - a).abs();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
    let at = |row: u32| positions[row as usize][axis];
    let mut within: Vec<u32> = ring.iter().copied().filter(|r| at(*r) > low && at(*r) < high).collect();
    within.sort_by(|p, q| at(*p).total_cmp(&at(*q)).then(p.cmp(q)));
    within.dedup();
    if a[axis] > b[axis] {
        within.reverse();
    }
    within
}
