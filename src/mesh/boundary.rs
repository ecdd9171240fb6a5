// SPDX-License-Identifier: MIT OR Apache-2.0
//! The boundary of triangles as a chain: what edges are run along more often one way than the other. As a chain it has no
//! ends, so it is made of loops, whatever the mesh is like.

use super::diagnosis::Lists;
use super::edges::NONE;
use super::half_edge::HalfEdges;
use crate::error::{Error, Result, filled};

/// Loops that pass no vertex twice and together are the boundary, each edge as often as it is in excess; they run the way
/// that faces which close the surface run along them, against the faces that are there. Near linear time.
pub(crate) fn boundary_loops(topology: &HalfEdges) -> Result<Lists> {
    let mut edges = excess(topology)?;
    edges.sort_unstable();
    let full = || Error::memory("boundary edges", edges.len());
    let mut ends: Vec<u32> = Vec::new();
    ends.try_reserve_exact(edges.len()).map_err(|_| full())?;
    ends.extend(edges.iter().map(|e| e[0]));
    ends.dedup();
    // Where the edges from each vertex begin; they are taken in order.
    let number = |v: u32| ends.binary_search(&v).unwrap_or(0);
    let mut next: Vec<usize> = Vec::new();
    next.try_reserve_exact(ends.len()).map_err(|_| full())?;
    next.extend(ends.iter().map(|v| edges.partition_point(|e| e[0] < *v)));
    let mut place = filled("vertices", ends.len(), NONE)?;
    let mut path: Vec<u32> = Vec::new();
    path.try_reserve_exact(edges.len() + 1).map_err(|_| full())?;
    let mut loops = Lists::default();
    for first in 0..ends.len() {
        path.push(ends[first]);
        place[first] = 0;
        while let Some(&v) = path.last() {
            let at = number(v);
            let Some(&[_, to]) = edges.get(next[at]).filter(|e| e[0] == v) else { break };
            next[at] += 1;
            let from = place[number(to)];
            if from == NONE {
                place[number(to)] = path.len() as u32;
                path.push(to);
                continue;
            }
            // Back where it was: a loop.
            let closed = &path[from as usize..];
            loops.push(closed.iter().copied())?;
            closed[1..].iter().for_each(|&v| place[number(v)] = NONE);
            path.truncate(from as usize + 1);
        }
        path.drain(..).for_each(|v| place[number(v)] = NONE);
    }
    Ok(loops)
}

/// The edges in excess, turned, as often as they are.
fn excess(topology: &HalfEdges) -> Result<Vec<[u32; 2]>> {
    let mut alone: Vec<([u32; 2], bool)> = Vec::new();
    for h in (0..topology.count() as u32).filter(|h| topology.twin(*h).is_none()) {
        let (a, b) = (topology.origin(h), topology.target(h));
        alone.try_reserve(1).map_err(|_| Error::memory("boundary edges", alone.len() + 1))?;
        alone.push(([a.min(b), a.max(b)], a < b));
    }
    alone.sort_unstable();
    let mut edges = Vec::new();
    for edge in alone.chunk_by(|a, b| a.0 == b.0) {
        let rising = edge.iter().filter(|(_, rises)| *rises).count();
        let falling = edge.len() - rising;
        let [low, high] = edge[0].0;
        let turned = if rising > falling { [high, low] } else { [low, high] };
        edges.try_reserve(rising.abs_diff(falling)).map_err(|_| Error::memory("boundary edges", alone.len()))?;
        edges.extend(std::iter::repeat_n(turned, rising.abs_diff(falling)));
    }
    Ok(edges)
}
