// SPDX-License-Identifier: MIT OR Apache-2.0
//! Half-edges that join the same two vertices, found by a bucket sort over the lower vertex.

use super::faces::{Faces, starts_from_counts};
use crate::error::{Result, filled, try_with_capacity};

/// No half-edge.
pub(crate) const NONE: u32 = u32::MAX;

/// The edges of a surface: for each, its half-edges in ascending order. Edges are ordered by their lower,
/// then their higher vertex.
pub(crate) struct Edges {
    half_edges: Vec<u32>,
    start: Vec<u32>,
}

impl Edges {
    /// Edges of half-edges given by their ends. Near linear time.
    pub fn of(vertices: usize, half_edges: impl Iterator<Item = (u32, u32)> + Clone) -> Result<Edges> {
        let mut bucket = filled("vertices", vertices + 1, 0u32)?;
        let mut count = 0;
        for (a, b) in half_edges.clone() {
            bucket[a.min(b) as usize] += 1;
            count += 1;
        }
        starts_from_counts(&mut bucket);
        // Higher vertex in the upper half, number in the lower: sorting a bucket sorts by both.
        let mut keys = filled("half-edges", count, 0u64)?;
        for (h, (a, b)) in half_edges.enumerate() {
            let slot = &mut bucket[a.min(b) as usize];
            keys[*slot as usize] = u64::from(a.max(b)) << 32 | h as u64;
            *slot += 1;
        }
        let mut edges = Edges {
            half_edges: try_with_capacity("half-edges", count)?,
            start: try_with_capacity("edges", count + 1)?,
        };
        let mut begin = 0;
        // Scattering has moved each start to its bucket's end.
        for &end in &bucket[..vertices] {
            let bucket = &mut keys[begin..end as usize];
            bucket.sort_unstable();
            let mut higher = None;
            for key in bucket {
                if higher != Some(*key >> 32) {
                    higher = Some(*key >> 32);
                    edges.start.push(edges.half_edges.len() as u32);
                }
                edges.half_edges.push(*key as u32);
            }
            begin = end as usize;
        }
        edges.start.push(count as u32);
        Ok(edges)
    }

    /// The half-edges of each edge.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> {
        self.start.windows(2).map(|w| &self.half_edges[w[0] as usize..w[1] as usize])
    }

    /// For each half-edge the other one of an edge with exactly two; [`NONE`] elsewhere.
    pub fn mates(&self) -> Result<Vec<u32>> {
        let mut mates = filled("half-edges", self.half_edges.len(), NONE)?;
        for edge in self.iter() {
            if let &[g, h] = edge {
                mates[g as usize] = h;
                mates[h as usize] = g;
            }
        }
        Ok(mates)
    }

    /// The same edges after some faces were turned over by [`turn_over`].
    pub fn renumbered(mut self, faces: &Faces, of_half_edge: &[u32], turned: &[bool]) -> Edges {
        for h in &mut self.half_edges {
            let f = of_half_edge[*h as usize] as usize;
            if turned[f] {
                *h = faces.start[f] + (faces.start[f + 1] - 1 - *h);
            }
        }
        for w in self.start.windows(2) {
            self.half_edges[w[0] as usize..w[1] as usize].sort_unstable();
        }
        self
    }
}

/// How many more half-edges of an edge run one way than the other: 0 for a balanced one.
pub(crate) fn excess(corners: &[u32], edge: &[u32]) -> usize {
    let along = |h: &u32| corners[*h as usize] == corners[edge[0] as usize];
    if let [_, other] = edge {
        return if along(other) { 2 } else { 0 };
    }
    let same = edge.iter().filter(|h| along(h)).count();
    same.abs_diff(edge.len() - same)
}

/// Turns faces over: what belongs to their corners is read the other way round, from the same first corner.
pub(crate) fn turn_over(start: &[u32], of_corners: &mut [u32], turned: &[bool]) {
    for (f, _) in turned.iter().enumerate().filter(|(_, turn)| **turn) {
        of_corners[start[f] as usize + 1..start[f + 1] as usize].reverse();
    }
}
