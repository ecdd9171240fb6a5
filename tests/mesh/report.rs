// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a mesh is like as read.

use super::*;

#[test]
fn closed_bodies_are_measured() {
    let r = bodies::bracket().mesh().report().clone();
    assert!(r.closed && r.consistent && !r.inside_out);
    assert_eq!((r.components, r.faces, r.triangles, r.vertices), (1, 164, 164, 80));
    assert_eq!(r.boundary_edges + r.nonmanifold_edges + r.inconsistent_edges, 0);
    assert_eq!(r.degenerate_faces + r.duplicate_faces, 0);
    // Two legs that share a corner, less two holes.
    let volume = 1.5 * 0.1 + 1.4 * 0.1 - 2.0 * 0.9 * 0.9 * 0.1;
    assert!(close(r.volume, volume), "{} instead of {volume}", r.volume);
    assert_eq!((r.lo, r.hi), ([0.0; 3], [1.5, 1.0, 1.5]));
    let r = bodies::cuboid([1.0, 2.0, 3.0], [2.0, 4.0, 6.0]).mesh().report().clone();
    assert!(close(r.volume, 6.0) && close(r.area, 22.0));
}

#[test]
fn open_sheets_have_boundary_edges() {
    let r = bodies::sheet(4).mesh().report().clone();
    assert!(!r.closed && r.consistent && !r.inside_out);
    assert_eq!((r.boundary_edges, r.nonmanifold_edges, r.components, r.area), (16, 0, 1, 16.0));
}

#[test]
fn edges_of_many_faces_are_not_manifold() {
    let r = bodies::book(5).mesh().report().clone();
    assert_eq!((r.nonmanifold_edges, r.boundary_edges, r.components), (1, 10, 1));
    let mesh = bodies::cubes_sharing_an_edge().mesh();
    let r = mesh.report();
    assert!(r.closed && r.consistent);
    assert_eq!((r.nonmanifold_edges, r.components), (1, 1));
    assert_eq!(mesh.surface().unbalanced_edges, 0);
    assert_eq!(bodies::book(5).mesh().surface().unbalanced_edges, 11);
}

#[test]
fn flipped_faces_make_edges_inconsistent() {
    let body = bodies::icosphere(1).flipped_where(|t| t == 17);
    let r = body.mesh().report().clone();
    assert!(r.closed && !r.consistent && !r.inside_out);
    assert_eq!(r.inconsistent_edges, 3);
    let r = bodies::icosphere(1).flipped().mesh().report().clone();
    assert!(r.closed && r.consistent && r.inside_out && r.volume < 0.0);
}

#[test]
fn degenerate_and_duplicate_faces_are_counted() {
    let mut body = bodies::icosphere(0);
    let [a, b, c] = body.triangles[4];
    body.triangles.extend([[a, a, b], [c, a, b], [b, a, c], [5, 5, 5]]);
    // The middle of an edge, and a face of three points on a line.
    let n = body.vertices.len() as u32;
    body.vertices.extend([[4.0, 5.0, 6.0], [5.0, 7.0, 9.0], [6.0, 9.0, 12.0]]);
    body.triangles.push([n, n + 1, n + 2]);
    let mesh = body.mesh();
    let r = mesh.report();
    assert_eq!((r.faces, r.degenerate_faces, r.duplicate_faces), (25, 3, 2));
    assert_eq!((r.nonmanifold_edges, r.boundary_edges, r.components), (3, 3, 2));
    let left: Vec<u32> = mesh.triangles().iter().map(|t| t.face).collect();
    assert_eq!(left, (0..20).chain([21, 22, 24]).collect::<Vec<u32>>(), "copies stay, what welding collapsed leaves");
    assert_eq!(mesh.shrunk_faces(), [20, 23]);
    assert_eq!(mesh.triangles()[4].vertices, [a, b, c]);
}

#[test]
fn components_are_connected_over_edges_alone() {
    assert_eq!(bodies::nested_shells(1).mesh().report().components, 3);
    // Two tetrahedra that share a vertex.
    let pair = bodies::tetrahedron().and(&bodies::tetrahedron().scaled(-1.0).flipped());
    let r = pair.mesh().report().clone();
    assert_eq!((r.components, r.vertices, r.nonmanifold_edges), (2, 7, 0));
    assert!(close(r.volume, 1.0 / 3.0));
}

#[test]
fn counts_and_relative_measures_do_not_depend_on_the_scale() {
    let body = bodies::plate(2, 1, 0.1, 0.4, 2);
    let r = body.mesh().report().clone();
    for s in [2f64.powi(-20), 2f64.powi(20), 2f64.powi(-300), 2f64.powi(300)] {
        let q = body.scaled(s).mesh().report().clone();
        assert_eq!((q.volume, q.area), (r.volume * s * s * s, r.area * s * s), "scale {s:e}");
        assert_eq!((q.vertices, q.degenerate_faces, q.closed), (r.vertices, 0, true));
    }
    let far = body.translated([4096.0; 3]).mesh().report().clone();
    assert!((far.volume / r.volume - 1.0).abs() < 1e-11, "{} and {}", far.volume, r.volume);
}
