// SPDX-License-Identifier: MIT OR Apache-2.0
//! Boundary loops: simple, complete, in the right order and direction.

use super::*;
use std::collections::BTreeMap;

/// The boundary edges of a mesh as read, with the ways they run.
fn boundary(mesh: &Mesh) -> BTreeMap<[u32; 2], [u32; 2]> {
    let mut count: BTreeMap<[u32; 2], (usize, [u32; 2])> = BTreeMap::new();
    for t in mesh.triangles() {
        let [a, b, c] = t.vertices;
        let read = if t.turned { [a, c, b] } else { [a, b, c] };
        for k in 0..3 {
            let ends = [read[k], read[(k + 1) % 3]];
            let edge = count.entry([ends[0].min(ends[1]), ends[0].max(ends[1])]).or_insert((0, ends));
            edge.0 += 1;
        }
    }
    count.into_iter().filter(|(_, (n, _))| *n == 1).map(|(e, (_, ends))| (e, ends)).collect()
}

/// Checks what loops promise; how many there are, and how many of them do not close.
fn check(mesh: &Mesh) -> (usize, usize) {
    let (mut left, found) = (boundary(mesh), diagnosis(mesh));
    let mut degree: BTreeMap<u32, usize> = BTreeMap::new();
    left.keys().flatten().for_each(|v| *degree.entry(*v).or_default() += 1);
    assert_eq!(found.loops.len(), found.loop_vertices.len());
    let (mut before, mut open, mut against) = (Vec::new(), 0, 0);
    for (chain, vertices) in found.loops.iter().zip(found.loop_vertices.iter()) {
        assert!(before < vertices.to_vec(), "in order");
        before = vertices.to_vec();
        let mut sorted = vertices.to_vec();
        sorted.sort_unstable();
        sorted.dedup();
        assert_eq!(sorted.len(), vertices.len(), "no vertex twice");
        let ends = if chain.closed { vertices.to_vec() } else { vec![vertices[0], vertices[vertices.len() - 1]] };
        assert_eq!(Some(&vertices[0]), ends.iter().min(), "from the lowest on");
        open += usize::from(!chain.closed);
        assert_eq!(chain.edges, vertices.len() - usize::from(!chain.closed));
        let mut length = 0.0;
        for k in 0..chain.edges {
            let (a, b) = (vertices[k], vertices[(k + 1) % vertices.len()]);
            let runs = left.remove(&[a.min(b), a.max(b)]).expect("a boundary edge of no other loop");
            against += usize::from(runs != [a, b]);
            length += (mesh.vertices()[a as usize] - mesh.vertices()[b as usize]).length();
        }
        assert!((chain.length - length).abs() <= 1e-12 * length);
        let position = |v: &u32| mesh.vertices()[*v as usize];
        let bounds = embound::math::Aabb::of(vertices.iter().map(position));
        assert_eq!((chain.lo, chain.hi), (bounds.lo.to_array(), bounds.hi.to_array()));
        assert_eq!(chain.diagonal(), bounds.diagonal());
        let component = |a: u32, b: u32| {
            let at_edge = |t: &&embound::mesh::Triangle| t.vertices.contains(&a) && t.vertices.contains(&b);
            found.component_of_face[mesh.triangles().iter().find(at_edge).expect("a face").face as usize]
        };
        assert_eq!(chain.component, component(vertices[0], vertices[1]));
        if mesh.report().nonmanifold_edges == 0 {
            assert!(vertices.windows(2).all(|w| component(w[0], w[1]) == chain.component));
        }
    }
    assert!(left.is_empty(), "every boundary edge is in a loop");
    assert_eq!(2 * open, degree.values().filter(|n| **n % 2 == 1).count(), "chains end where they must");
    if mesh.report().consistent && mesh.report().nonmanifold_edges == 0 {
        assert_eq!(against, 0, "loops run as the faces do");
    }
    (found.loops.len(), open)
}

#[test]
fn holes_are_counted_and_run_round() {
    let sheet = bodies::sheet(8);
    // Cell (i, j) has the triangles 2 (8 j + i) and the next.
    let without = |cells: &[(usize, usize)]| {
        let gone: Vec<usize> = cells.iter().map(|(i, j)| 8 * j + i).collect();
        sheet.without(|t| gone.contains(&(t / 2))).mesh_kept()
    };
    assert_eq!(check(&sheet.mesh_kept()), (1, 0));
    assert_eq!(check(&without(&[(1, 1), (4, 4), (5, 4)])), (3, 0));
    // Holes that touch in a corner are two, a ring of four round a cell has the cell's border and one around it,
    // and a hole that touches the rim is part of it.
    assert_eq!(check(&without(&[(2, 2), (3, 3)])), (3, 0));
    assert_eq!(check(&without(&[(2, 2), (3, 3), (4, 2), (3, 1)])), (3, 0));
    assert_eq!(check(&without(&[(0, 0)])), (1, 0));
    let found = diagnosis(&without(&[(1, 1)]));
    let hole = found.loops.iter().find(|l| l.edges == 4).expect("the hole");
    assert_eq!((hole.length, hole.lo, hole.hi), (4.0, [1.0, 1.0, 0.0], [2.0, 2.0, 0.0]));
    // Clockwise seen from above, where the normals point.
    let k = found.loops.iter().position(|l| l.edges == 4).unwrap();
    assert_eq!(found.loop_vertices.get(k), Some(&[10, 19, 20, 11][..]));
}

#[test]
fn chains_end_at_edges_of_an_odd_number_of_faces() {
    assert_eq!(check(&bodies::book(5).mesh_kept()), (3, 1));
    assert_eq!(check(&bodies::book(4).mesh_kept()), (2, 0));
    assert_eq!(check(&bodies::book(3).and(&bodies::book(3).translated([0.0, 0.0, 1.0])).mesh_kept()).1, 1);
}

#[test]
fn loops_of_random_meshes_are_simple_and_complete() {
    let mut random = Random(61);
    let mut open = 0;
    for (count, points) in [(20, 3), (60, 3), (60, 4), (200, 6), (300, 30)] {
        for _ in 0..6 {
            let soup = grid_soup(count, points, &mut random);
            open += check(&soup.mesh_kept()).1;
            check(&soup.mesh());
        }
    }
    assert!(open > 10, "{open}");
    for soup in [bodies::moebius_strip(31), bodies::icosphere(3).without(|k| k % 5 == 0), drum(70, 1.0, 2.0)] {
        check(&soup.mesh());
        check(&soup.flipped_where(|k| k % 3 == 1).mesh());
    }
}

#[test]
fn a_loop_of_a_million_edges_and_a_hundred_thousand_loops_are_answered() {
    let length = 500_000;
    let vertices = (0..=length).flat_map(|k| [[f64::from(k), 0.0, 0.0], [f64::from(k), 1.0, 0.0]]).collect();
    let triangles = (0..length as u32).flat_map(|k| [[2 * k, 2 * k + 2, 2 * k + 3], [2 * k, 2 * k + 3, 2 * k + 1]]);
    let strip = Soup { vertices, triangles: triangles.collect() };
    let options = DiagnosisOptions { intersection_limit: 0, ..DiagnosisOptions::default() };
    let found = diagnose(&strip.mesh_kept(), &options, &Run::SERIAL).unwrap();
    assert_eq!((found.loops.len(), found.loops[0].edges, found.loops[0].length), (1, 1_000_002, 1_000_002.0));
    let apart = Soup {
        vertices: (0..300_000).map(|k| [f64::from(k % 3), f64::from(k / 3), f64::from(k % 2)]).collect(),
        triangles: (0..100_000).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
    };
    let found = diagnose(&apart.mesh_kept(), &options, &Run::SERIAL).unwrap();
    assert_eq!((found.loops.len(), found.components.len()), (100_000, 100_000));
    assert!(found.loops.iter().enumerate().all(|(k, l)| l.edges == 3 && l.component == k as u32));
}
