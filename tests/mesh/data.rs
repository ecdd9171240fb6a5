// SPDX-License-Identifier: MIT OR Apache-2.0
//! Data of vertices and faces, interpolated at closest points.

use super::*;
use embound::geometry::{Geometry, SdfOptions};
use embound::mesh::{Field, FieldType};
use embound::parallel::Run;

fn linear(p: Vec3) -> [f64; 2] {
    [1.0 + 2.0 * p.x - 3.0 * p.y + 0.5 * p.z, -p.x]
}

fn with_linear(mesh: &Mesh) -> Mesh {
    let values = mesh.vertices().iter().flat_map(|p| linear(*p)).collect();
    mesh.with_field(false, Field { name: "linear".into(), kind: FieldType::F64, components: 2, values }).unwrap()
}

/// A linear function of the vertices is the same function at every closest point, whatever the faces' number
/// of corners and orientation.
fn assert_linear(mesh: &Mesh) {
    let mesh = with_linear(mesh);
    let g = Geometry::from_mesh(&mesh, &SdfOptions::default(), &Run::default()).unwrap();
    let (lo, hi) = (mesh.bounds().lo.to_array(), mesh.bounds().hi.to_array());
    let mut random = Random(11);
    for _ in 0..500 {
        let c = g.closest(Vec3::from_array(random.point(lo, hi)));
        let mut found = [0.0; 2];
        mesh.interpolate(&mesh.vertex_fields()[0], c.primitive, c.piece, c.barycentric, &mut found);
        let wanted = linear(c.point);
        let size = 1e-12 * (1.0 + mesh.bounds().diagonal());
        assert!((0..2).all(|k| (found[k] - wanted[k]).abs() < size), "{found:?} {wanted:?} {c:?}");
    }
}

#[test]
fn a_linear_function_of_the_vertices_is_linear_on_the_surface() {
    assert_linear(&bodies::icosphere(2).mesh());
    assert_linear(&bodies::icosphere(2).flipped().mesh());
    assert_linear(&bodies::bracket().flipped_where(|t| t % 2 == 0).mesh());
    assert_linear(&bodies::bracket().duplicated().mesh());
}

#[test]
fn corners_of_polygons_have_their_own_weights() {
    let (xyz, offsets, indices) = super::polygons::prism(&super::polygons::L_SHAPE, 2.0);
    for flip in [false, true] {
        let mut indices = indices.clone();
        if flip {
            offsets.windows(2).for_each(|w| indices[w[0]..w[1]].reverse());
        }
        let mesh = Mesh::from_polygons(&xyz, &offsets, &indices, None, &MeshOptions::default()).unwrap();
        assert!(mesh.triangles().len() > mesh.face_count());
        assert_linear(&mesh);
    }
}

#[test]
fn values_of_faces_and_of_nothing() {
    let mesh = with_linear(&bodies::icosphere(0).mesh());
    let numbers = (0..20).map(f64::from).collect();
    let mesh = mesh
        .with_field(true, Field { name: "n".into(), kind: FieldType::F64, components: 1, values: numbers })
        .unwrap();
    let mut one = [0.0];
    for f in 0..20 {
        mesh.face_value(&mesh.face_fields()[0], f, &mut one);
        assert_eq!(one, [f as f64]);
    }
    for (face, piece) in [(-1, 0), (20, 0), (i64::MAX, 0), (3, 1), (3, -1)] {
        let mut two = [0.0; 2];
        mesh.interpolate(&mesh.vertex_fields()[0], face, piece, Vec3::X, &mut two);
        assert!(two.iter().all(|x| x.is_nan()), "{face} {piece}");
    }
    mesh.face_value(&mesh.face_fields()[0], 20, &mut one);
    assert!(one[0].is_nan());
}

#[test]
fn a_field_replaces_one_of_its_name_and_must_fit() {
    let mesh = with_linear(&with_linear(&bodies::icosphere(0).mesh()));
    assert_eq!(mesh.vertex_fields().len(), 1);
    let refused = |name: &str, components, values: Vec<f64>| {
        let field = Field { name: name.into(), kind: FieldType::F64, components, values };
        mesh.with_field(true, field).unwrap_err().message().to_owned()
    };
    assert_eq!(refused("", 1, vec![0.0; 20]), "name: \"\" is empty, not one line or has white space around it");
    assert_eq!(refused("a", 1, vec![0.0; 12]), "values: 12 are not 1 for each of 20 items");
    assert_eq!(refused("a", 0, vec![]), "values: 0 are not 0 for each of 20 items");
    assert_eq!(mesh.with_tags(&[1], vec![]).unwrap_err().message(), "tags: 1 values for 20 faces");
    let twice = vec![(1, "a".to_owned()), (1, "b".to_owned())];
    assert_eq!(mesh.with_tags(&[1; 20], twice).unwrap_err().message(), "names: tag 1 has two names");
}
