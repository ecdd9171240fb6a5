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
    let mut edges = excess(&alone(topology)?)?;
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

/// How many edges have two faces that run along them the same way: on one-sided strips, and on meshes kept as given.
pub(crate) fn one_way_edges(topology: &HalfEdges) -> Result<usize> {
    let alone = alone(topology)?;
    let edges = alone.chunk_by(|a, b| a.0 == b.0);
    Ok(edges.filter(|edge| edge.len() == 2 && edge[0].1 == edge[1].1).count())
}

/// The half-edges without a twin, edge by edge: the lower and the higher vertex, and whether they run from one to the other.
fn alone(topology: &HalfEdges) -> Result<Vec<([u32; 2], bool)>> {
    let mut alone: Vec<([u32; 2], bool)> = Vec::new();
    for h in (0..topology.count() as u32).filter(|h| topology.twin(*h).is_none()) {
        let (a, b) = (topology.origin(h), topology.target(h));
        alone.try_reserve(1).map_err(|_| Error::memory("boundary edges", alone.len() + 1))?;
        alone.push(([a.min(b), a.max(b)], a < b));
    }
    alone.sort_unstable();
    Ok(alone)
}

/// The edges in excess, turned, as often as they are.
fn excess(alone: &[([u32; 2], bool)]) -> Result<Vec<[u32; 2]>> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Triangle;

    fn topology(triangles: &[[u32; 3]]) -> HalfEdges {
        let vertices = triangles.iter().flatten().max().map_or(0, |v| *v as usize + 1);
        let all: Vec<Triangle> =
            triangles.iter().zip(0..).map(|(&vertices, face)| Triangle { vertices, face, turned: false }).collect();
        HalfEdges::of_triangles(vertices, &all).unwrap()
    }

    fn edges_of(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> + '_ {
        ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| [*a, *b])
    }

    /// The loops, after a look at what is promised: simple, and with the triangles every edge balanced.
    fn loops(triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
        let loops = boundary_loops(&topology(triangles)).unwrap();
        let mut balance = std::collections::BTreeMap::new();
        let rings = triangles.iter().map(|t| &t[..]).chain(loops.iter());
        for [a, b] in rings.flat_map(edges_of) {
            *balance.entry([a.min(b), a.max(b)]).or_insert(0) += if a < b { 1 } else { -1 };
        }
        assert!(balance.values().all(|n| *n == 0), "{triangles:?} {loops:?}");
        for ring in loops.iter() {
            let mut sorted = ring.to_vec();
            sorted.sort_unstable();
            sorted.dedup();
            assert!(sorted.len() == ring.len() && ring.len() > 2, "{ring:?}");
        }
        loops.iter().map(<[u32]>::to_vec).collect()
    }

    #[test]
    fn a_triangle_has_one_loop_that_runs_against_it() {
        assert_eq!(loops(&[[0, 1, 2]]), [[0, 2, 1]]);
    }

    #[test]
    fn a_closed_body_has_none() {
        assert_eq!(loops(&[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]), <[[u32; 0]; 0]>::default());
    }

    #[test]
    fn sheets_that_meet_in_a_vertex_have_a_loop_each() {
        assert_eq!(loops(&[[0, 1, 2], [2, 3, 4]]).len(), 2);
        assert_eq!(loops(&[[0, 1, 2], [0, 3, 4], [0, 5, 6]]).len(), 3);
    }

    #[test]
    fn a_fin_on_a_body_has_a_loop_of_its_own() {
        let body = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        assert_eq!(loops(&[&body[..], &[[0, 1, 4]]].concat()), [[0, 4, 1]]);
    }

    #[test]
    fn edges_in_excess_twice_are_passed_twice() {
        // Two faces that run along the edge 0-1 the same way.
        assert_eq!(loops(&[[0, 1, 2], [0, 1, 3]]).len(), 2);
        assert_eq!(one_way_edges(&topology(&[[0, 1, 2], [0, 1, 3]])).unwrap(), 1);
        assert_eq!(one_way_edges(&topology(&[[0, 1, 2], [1, 0, 3]])).unwrap(), 0);
        // Three of them, and one that runs against them: two loops pass the edge, and one does not.
        let three = loops(&[[0, 1, 2], [0, 1, 3], [0, 1, 4], [1, 0, 5]]);
        assert_eq!(three.iter().map(Vec::len).collect::<std::collections::BTreeSet<_>>(), [3, 4].into());
        assert_eq!(three.len(), 3);
    }

    #[test]
    fn any_triangles_have_a_boundary_without_ends() {
        let mut state = 1u64;
        let mut below = |n: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) % n) as u32
        };
        for count in 1..200 {
            let vertices = 4 + u64::from(below(20));
            let mut triangles = Vec::new();
            while triangles.len() < count {
                let t = [below(vertices), below(vertices), below(vertices)];
                if t[0] != t[1] && t[1] != t[2] && t[2] != t[0] {
                    triangles.push(t);
                }
            }
            assert!(!loops(&triangles).is_empty() || count > 1);
        }
    }
}
