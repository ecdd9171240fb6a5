// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pseudonormals.

use super::*;
use embound::math::cross_of_differences;

#[test]
fn those_of_a_cube_point_to_its_faces_edges_and_corners() {
    let mesh = bodies::unit_cube().mesh();
    let normals = mesh.pseudonormals().unwrap();
    let center = Vec3::splat(0.5);
    for (t, triangle) in mesh.triangles().iter().enumerate() {
        let n = normals.triangle[t];
        assert_eq!(n.abs().to_array().iter().sum::<f64>(), 1.0);
        let corners = triangle.corners(mesh.vertices());
        for k in 0..3 {
            let middle = 0.5 * (corners[k] + corners[(k + 1) % 3]) - center;
            // On an edge of the cube two faces meet; on a diagonal one face meets itself.
            let wanted = if middle.abs().max_element() == middle.abs().element_sum() { 2.0 * n } else { 2.0 * middle };
            assert_eq!(normals.edge[t][k], wanted);
        }
    }
    for (p, n) in mesh.vertices().iter().zip(&normals.vertex) {
        // A right angle on each of three faces.
        let wanted = (*p - center) * std::f64::consts::PI;
        assert!((*n - wanted).length() < 1e-15 * 8.0, "{n} instead of {wanted}");
    }
}

#[test]
fn vertex_normals_do_not_depend_on_how_faces_are_cut() {
    let cube = bodies::unit_cube();
    let finer = bodies::quartered(&bodies::quartered(&cube));
    let (a, b) = (cube.mesh(), finer.mesh());
    let (na, nb) = (a.pseudonormals().unwrap(), b.pseudonormals().unwrap());
    for (p, n) in a.vertices().iter().zip(&na.vertex) {
        let at = b.vertices().iter().position(|q| q == p).unwrap();
        assert!((*n - nb.vertex[at]).length() < 1e-14);
    }
}

#[test]
fn triangles_of_zero_area_stay_and_lend_no_normal() {
    // The edge between two faces of a tetrahedron has an extra vertex on one side: a flat face fills it.
    let body = Soup {
        vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.5, 0.0, 0.0]],
        triangles: vec![[0, 2, 4], [4, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3], [0, 4, 1]],
    };
    let mesh = body.mesh();
    assert!(mesh.report().closed && mesh.report().degenerate_faces == 1 && mesh.triangle_count() == 6);
    assert_eq!(mesh.surface().unbalanced_edges, 0);
    let normals = mesh.pseudonormals().unwrap();
    assert_eq!(normals.triangle[5], Vec3::ZERO);
    assert_eq!(normals.edge[0][2], Vec3::new(0.0, 0.0, -1.0), "what is left of the edge is one face");
    let plain = bodies::tetrahedron().mesh().pseudonormals().unwrap();
    for (n, m) in normals.vertex[..4].iter().zip(&plain.vertex) {
        assert!((*n - *m).length() < 1e-15 * 4.0);
    }
    assert!(normals.vertex.iter().all(|n| n.is_finite()));
}

#[test]
fn they_are_the_same_at_every_scale_and_for_slivers() {
    let body = bodies::plate(2, 1, 0.1, 0.4, 2);
    let wanted = body.mesh().pseudonormals().unwrap();
    for s in [2f64.powi(-20), 2f64.powi(20), 2f64.powi(-150), 2f64.powi(150)] {
        assert_eq!(body.scaled(s).mesh().pseudonormals().unwrap(), wanted, "scale {s:e}");
    }
    // 1 by 1e-14: plain arithmetic would leave a few digits of its normal.
    let sliver =
        Soup { vertices: vec![[0.1, 0.2, 0.3], [1.1, 1.2, 1.3], [0.6, 0.7 + 1e-14, 0.8]], triangles: vec![[0, 1, 2]] };
    let mesh = sliver.mesh_kept();
    let n = mesh.pseudonormals().unwrap().triangle[0];
    let [a, b, c] = mesh.triangles()[0].corners(mesh.vertices());
    assert!((n.length() - 1.0).abs() < 1e-15);
    assert!(n.dot(b - a).abs() < 1e-15 && n.dot(c - a).abs() < 1e-15);
}

#[test]
fn exactly_flat_triangles_are_found_where_arithmetic_leaves_a_residue() {
    let mut random = Random(3);
    let mut residues = 0;
    for _ in 0..200 {
        // Three points of one line through the origin, all coordinates exact.
        let d = Vec3::from_array(std::array::from_fn(|_| random.below(1 << 25) as f64 + 1.0));
        let [a, b, c] = [2f64.powi(-27), 1.0, 2f64.powi(-20)].map(|s| d * (s * (random.below(1 << 25) as f64 + 1.0)));
        residues += usize::from(cross_of_differences(a, b, c) != Vec3::ZERO);
        let soup = Soup { vertices: [a, b, c].map(|p| p.to_array()).to_vec(), triangles: vec![[0, 1, 2]] };
        let mesh = soup.mesh();
        assert_eq!(mesh.report().degenerate_faces, 1);
        assert_eq!(mesh.pseudonormals().unwrap().triangle[0], Vec3::ZERO);
    }
    assert!(residues > 0, "otherwise this shows nothing");
}
