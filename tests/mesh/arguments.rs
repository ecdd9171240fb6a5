// SPDX-License-Identifier: MIT OR Apache-2.0
//! What is refused, and how points, indices and tags are taken.

use super::*;

const XYZ: [f64; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

fn triangles(xyz: &[f64], indices: &[u32], tags: Option<&[i32]>) -> embound::Result<Mesh> {
    Mesh::from_triangles(xyz, indices, tags, &MeshOptions::default())
}

#[test]
fn lengths_that_do_not_fit_are_refused() {
    assert_eq!(refused(triangles(&XYZ[..8], &[0, 1, 2], None)), "xyz: 8 values are not 3 a vertex");
    assert_eq!(refused(triangles(&XYZ, &[0, 1], None)), "indices: 2 values are not 3 a triangle");
    assert_eq!(refused(triangles(&XYZ, &[], None)), "indices: empty: a mesh has at least one face");
    assert_eq!(refused(triangles(&XYZ, &[0, 1, 2], Some(&[1, 2]))), "tags: 2 values for 1 faces");
}

#[test]
fn indices_out_of_range_name_the_face_and_the_value() {
    let message = refused(triangles(&XYZ, &[0, 1, 2, 2, 1, 3], None));
    assert_eq!(message, "indices[5]: 3 of face 1 does not count one of 3 vertices from 0");
    let one_based = options(|o| o.index_base = 1);
    let message = refused(Mesh::from_triangles(&XYZ, &[1, 2, 0], None, &one_based));
    assert_eq!(message, "indices[2]: 0 of face 0 does not count one of 3 vertices from 1");
    assert_eq!(Mesh::from_triangles(&XYZ, &[1, 2, 3], None, &one_based).unwrap().triangle_count(), 1);
    refused(triangles(&[], &[0, 1, 2], None));
    refused(triangles(&XYZ, &[0, 1, u32::MAX], None));
}

#[test]
fn coordinates_that_cannot_be_used_name_the_vertex() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut xyz = XYZ;
        xyz[7] = bad;
        assert_eq!(refused(triangles(&xyz, &[0, 1, 2], None)), format!("xyz[7]: {bad} is not finite (vertex 2)"));
    }
    let mut xyz = XYZ;
    xyz[3] = 1e101;
    assert!(refused(triangles(&xyz, &[0, 1, 2], None)).starts_with("xyz: vertex 1 comes to lie at (1e101, "));
    let huge = options(|o| o.scale = 1e200);
    refused(Mesh::from_triangles(&XYZ, &[0, 1, 2], None, &huge));
    let tiny = options(|o| o.scale = 1e-101);
    assert!(refused(Mesh::from_triangles(&XYZ, &[0, 1, 2], None, &tiny)).contains("diagonal 1.4"));
}

#[test]
fn faces_of_which_nothing_is_left_are_refused() {
    assert!(refused(triangles(&XYZ, &[0, 0, 1], None)).contains("fewer than three different corners"));
    assert!(refused(triangles(&[0.5; 9], &[0, 1, 2], None)).contains("diagonal 0e0"));
}

#[test]
fn options_out_of_range_name_themselves_and_the_value() {
    let try_with = |change: &dyn Fn(&mut MeshOptions)| {
        refused(Mesh::from_triangles(&XYZ, &[0, 1, 2], None, &options(|o| change(o))))
    };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(try_with(&|o| o.scale = bad), format!("options.scale: {bad} is not finite and above 0"));
    }
    assert_eq!(try_with(&|o| o.shift[1] = f64::NAN), "options.shift[1]: NaN is not finite");
    for bad in [-0.1, 1e-13, 0.6, f64::NAN] {
        assert!(try_with(&|o| o.weld_tolerance = bad).starts_with(&format!("options.weld_tolerance: {bad} is")));
    }
    assert_eq!(try_with(&|o| o.index_base = 2), "options.index_base: 2 is neither 0 nor 1");
    assert_eq!(try_with(&|o| o.rotation[4] = f64::INFINITY), "options.rotation[4]: inf is not finite");
    assert!(try_with(&|o| o.rotation[8] = -1.0).contains("the determinant is -1: a reflection"));
    assert!(try_with(&|o| o.rotation[0] = 1.001).contains("product of rows 0 and 0 is 1.00"));
    assert!(try_with(&|o| o.rotation[1] = 1e-8).contains("product of rows 0 and 1 is 0.00000001"));
    for (k, bad) in [(0, 1e300), (1, -1e300), (8, 1e-300)] {
        assert!(try_with(&|o| o.rotation[k] = bad).starts_with("options.rotation: the product"));
    }
}

#[test]
fn offsets_that_are_not_ascending_by_three_are_refused() {
    let polygons = |offsets: &[usize], indices: &[u32]| {
        refused(Mesh::from_polygons(&XYZ, offsets, indices, None, &MeshOptions::default()))
    };
    assert_eq!(polygons(&[], &[]), "offsets: 0 values: a mesh has at least one face");
    assert_eq!(polygons(&[0], &[]), "offsets: 1 values: a mesh has at least one face");
    assert_eq!(polygons(&[1, 4], &[0, 1, 2, 0]), "offsets[0]: 1 is not 0");
    assert_eq!(polygons(&[0, 3, 2], &[0, 1, 2]), "offsets[2]: 2 after 3 is not ascending");
    assert_eq!(polygons(&[0, 3, 5], &[0, 1, 2, 0, 1]), "offsets[2]: face 1 has 2 corners, below 3");
    assert_eq!(polygons(&[0, 3], &[0, 1, 2, 0]), "offsets[1]: 3 is not the count of indices, 4");
    assert_eq!(
        polygons(&[0, usize::MAX], &[0, 1, 2]),
        format!("offsets[1]: {} is not the count of indices, 3", usize::MAX)
    );
}

#[test]
fn points_are_scaled_turned_and_shifted_in_this_order() {
    let quarter = [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let o = options(|o| (o.scale, o.rotation, o.shift) = (2.0, quarter, [10.0, 20.0, 30.0]));
    let mesh = Mesh::from_triangles(&XYZ, &[0, 1, 2], None, &o).unwrap();
    assert_eq!(mesh.vertices(), [[10.0, 20.0, 30.0], [10.0, 22.0, 30.0], [8.0, 20.0, 30.0]].map(Vec3::from_array));
    assert_eq!(mesh.report().lo, [8.0, 20.0, 30.0]);
    assert_eq!(mesh.bounds().hi, Vec3::new(10.0, 22.0, 30.0));
}

#[test]
fn tags_follow_the_input_faces() {
    let body = bodies::icosphere(0);
    let tags: Vec<i32> = (0..20).map(|k| 100 - k).collect();
    let mesh = Mesh::from_triangles(&body.xyz(), &body.indices(), Some(&tags), &MeshOptions::default()).unwrap();
    assert!((0..20).all(|f| mesh.tag(f) == 100 - f as i32));
    assert_eq!(body.mesh().tag(3), 0);
    assert_eq!(mesh.face_count(), 20);
}
