// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices where several fans of faces meet, and edges of more than two faces.

use super::*;

fn split() -> RepairOptions {
    only(|o| o.split = true)
}

/// Tetrahedra that have their first vertex in common, each in a direction of its own.
fn tetrahedra(count: usize) -> Soup {
    let one = bodies::tetrahedron();
    let turned = |k: usize| {
        let a = std::f64::consts::TAU * k as f64 / count as f64;
        let width = 0.9 * libm::sin(std::f64::consts::PI / count as f64);
        let (c, s) = (libm::cos(a), libm::sin(a));
        one.map(|p| {
            let q = [p[0] + p[1] + p[2], width * (p[0] - p[1]), width * (p[2] - p[1])];
            [c * q[0] - s * q[1], s * q[0] + c * q[1], q[2]]
        })
    };
    (0..count).map(turned).reduce(|all, next| all.and(&next)).unwrap_or_default()
}

#[test]
fn a_vertex_shared_by_bodies_becomes_one_for_each() {
    for count in [2, 3, 7] {
        let soup = tetrahedra(count);
        let mesh = soup.mesh();
        assert_eq!((mesh.vertices().len(), vertices_of_several_fans(&mesh)), (3 * count + 1, 1));
        let (mesh, repairs) = repaired(&mesh, &split());
        assert_eq!(repairs, Repairs { vertices_split: count - 1, ..Repairs::default() });
        assert_eq!(mesh.vertices().len(), 4 * count);
        assert_clean(&mesh);
        assert_same_bits(&mesh, &soup.mesh(), &soup);
        // What reads positions welds them again.
        assert_eq!(repaired(&mesh, &only(|o| o.weld = true)).1.vertices_welded, count - 1);
    }
}

#[test]
fn vertices_of_one_body_are_split_as_well() {
    // A torus pinched in one vertex: two vertices of opposite sides are at one place.
    let (around, across) = (12, 8);
    let mut ring = bodies::torus(1.0, 0.3, around, across);
    let far = (around / 2) * across;
    ring.vertices[far] = ring.vertices[0];
    let faulty = ring.mesh_kept();
    assert_eq!(vertices_of_several_fans(&faulty), 1);
    let (mesh, repairs) = repaired(&faulty, &split());
    assert_eq!((repairs.vertices_split, vertices_of_several_fans(&mesh)), (1, 0));
    assert_eq!(rings(&mesh), rings(&faulty));
}

#[test]
fn closed_bodies_that_share_an_edge_fall_apart() {
    let soup = bodies::cubes_sharing_an_edge();
    let mesh = soup.mesh();
    assert_eq!((mesh.report().nonmanifold_edges, mesh.report().components), (1, 1));
    let (mesh, repairs) = repaired(&mesh, &split());
    assert_eq!(repairs, Repairs { vertices_split: 2, ..Repairs::default() });
    assert_clean(&mesh);
    assert_eq!(mesh.report().components, 2);
    // A long common edge with vertices on the way.
    let z = [0.0, 0.25, 0.5, 1.0];
    let long = bodies::cells(&[0.0, 1.0, 2.0], &[0.0, 1.0, 2.0], &z, |i, j, _| i == j);
    let (mesh, repairs) = repaired(&long.mesh(), &split());
    assert_eq!(repairs.vertices_split, 4);
    assert_clean(&mesh);
}

#[test]
fn edges_of_more_than_two_faces_stay_where_sheets_are_not_paired() {
    // A fin on a box: three faces at each edge along the way.
    let cube = bodies::unit_cube();
    let find = |p: [f64; 3]| cube.vertices.iter().position(|q| *q == p).expect("a corner") as u32;
    let (a, b) = (find([0.0, 0.0, 1.0]), find([1.0, 0.0, 1.0]));
    let mut fin = cube.clone();
    fin.vertices.push([0.5, 0.0, 2.0]);
    fin.triangles.push([a, b, 8]);
    for soup in [fin, bodies::book(4)] {
        let mesh = soup.mesh();
        let (same, repairs) = repaired(&mesh, &split());
        assert_eq!(repairs, Repairs::default());
        assert_eq!(rings(&same), rings(&mesh));
    }
}

#[test]
fn a_body_that_touches_itself_along_an_edge_stays_whole() {
    // A ring of cubes that meets itself in an edge: all four faces are of one sheet.
    let x = [0.0, 1.0, 2.0, 3.0];
    let ring = bodies::cells(&x, &x, &[0.0, 1.0], |i, j, _| {
        // Around the middle cell without one corner cell: the ends touch in an edge.
        (i, j) != (1, 1) && (i, j) != (2, 2)
    });
    let mesh = ring.mesh();
    assert_eq!(mesh.report().nonmanifold_edges, 1);
    let (same, repairs) = repaired(&mesh, &split());
    assert_eq!(repairs, Repairs::default());
    assert_eq!(same.report(), mesh.report());
}
