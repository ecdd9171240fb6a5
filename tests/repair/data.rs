// SPDX-License-Identifier: MIT OR Apache-2.0
//! What faces and vertices carry through a repair.

use super::*;
use embound::mesh::{Field, FieldType};

fn field(name: &str, kind: FieldType, components: usize, values: Vec<f64>) -> Field {
    Field { name: name.into(), kind, components, values }
}

/// A ball with a hole, tags by octant, names, and data that say where they belong.
fn tagged() -> (Soup, Mesh) {
    let soup = bodies::icosphere(2).without(|t| t == 50 || t == 51);
    let tags: Vec<i32> = (0..soup.triangles.len()).map(|t| (t / 40) as i32 - 2).collect();
    let mesh = Mesh::from_triangles(&soup.xyz(), &soup.indices(), Some(&tags), &MeshOptions::default()).unwrap();
    let mesh = mesh.with_tags(&tags, vec![(-2, "inlet".into()), (3, "wall".into())]).unwrap();
    let linear = mesh.vertices().iter().flat_map(|p| [p.x + 2.0 * p.y, p.z]).collect();
    let numbers: Vec<f64> = (0..mesh.face_count()).map(|f| f as f64).collect();
    let mesh = mesh.with_field(false, field("linear", FieldType::F64, 2, linear)).unwrap();
    let mesh = mesh.with_field(true, field("number", FieldType::I32, 1, numbers.clone())).unwrap();
    let mesh =
        mesh.with_field(true, field("half", FieldType::F32, 1, numbers.iter().map(|n| n / 2.0).collect())).unwrap();
    (soup, mesh)
}

#[test]
fn tags_names_and_data_stay_with_their_faces_and_vertices() {
    let (_, mesh) = tagged();
    // Copies, flips and a fault of each kind besides.
    let (fixed, repairs) = repaired(&mesh, &RepairOptions::default());
    assert!(repairs.holes_filled > 0 && repairs.faces_added == 2);
    assert_eq!((fixed.face_count(), fixed.tag_names()), (mesh.face_count() + 2, mesh.tag_names()));
    for f in 0..mesh.face_count() as u32 {
        assert_eq!(fixed.tag(f), mesh.tag(f));
        for (a, b) in fixed.face_fields().iter().zip(mesh.face_fields()) {
            assert_eq!(a.item(f as usize), b.item(f as usize));
        }
    }
    let linear = &fixed.vertex_fields()[0];
    assert_eq!(linear.values.len(), 2 * fixed.vertices().len());
    for (v, p) in fixed.vertices().iter().enumerate() {
        assert_eq!(linear.item(v), [p.x + 2.0 * p.y, p.z]);
    }
}

#[test]
fn new_faces_have_the_tag_around_them_data_of_the_rim_and_none_of_their_own() {
    let (_, mesh) = tagged();
    let first = mesh.face_count();
    let (fixed, _) = repaired(&mesh, &RepairOptions::default());
    assert_eq!((fixed.tag(first as u32), fixed.tag(first as u32 + 1)), (-1, -1));
    let by_name = |name: &str| fixed.face_fields().iter().find(|f| f.name == name).expect("a field");
    assert_eq!((by_name("number").item(first), by_name("number").kind), (&[0.0][..], FieldType::I32));
    assert!(by_name("half").item(first)[0].is_nan());
    let g = Geometry::from_mesh(&fixed, &SdfOptions::default(), &Run::SERIAL).unwrap();
    let t = fixed.triangles().iter().find(|t| t.face as usize == first).expect("a new face");
    let corners = t.vertices.map(|v| fixed.vertices()[v as usize]);
    let p = (corners[0] + corners[1] * 2.0 + corners[2]) * 0.25;
    let at = g.closest(p * 1.01);
    assert_eq!(at.primitive, first as i64);
    let mut out = [0.0; 2];
    fixed.interpolate(&fixed.vertex_fields()[0], at.primitive, at.piece, at.barycentric, &mut out);
    assert!((out[0] - (at.point.x + 2.0 * at.point.y)).abs() < 1e-14 && (out[1] - at.point.z).abs() < 1e-14);
    let (fixed, _) = repaired(&mesh, &RepairOptions { fill_tag: Some(99), ..RepairOptions::default() });
    assert_eq!((fixed.tag(first as u32), fixed.tag(0)), (99, -2));
}

#[test]
fn a_mesh_without_tags_gets_them_where_new_faces_have_one() {
    let mesh = bodies::icosphere(2).without(|t| t == 3).mesh();
    let (fixed, _) = repaired(&mesh, &RepairOptions { fill_tag: Some(5), ..RepairOptions::default() });
    assert_eq!((fixed.tag(0), fixed.tag(319)), (0, 5));
    assert_eq!(fixed.used_tags().unwrap(), [0, 5]);
}

#[test]
fn seams_stay_seams() {
    // Three triangles around a vertex, whose values differ from face to face, and the rest of a tetrahedron missing.
    let soup = Soup { triangles: bodies::tetrahedron().triangles, ..bodies::tetrahedron() };
    let open = soup.without(|t| t == 3).unshared();
    let raw = open.mesh_with(&MeshOptions { weld_tolerance: -1.0, orient: Orient::Keep, ..MeshOptions::default() });
    let own = (0..raw.vertices().len()).map(|v| v as f64).collect();
    let raw = raw.with_field(false, field("own", FieldType::F64, 1, own)).unwrap();
    let (mesh, repairs) = repaired(&raw, &RepairOptions { hole_length: 10.0, ..RepairOptions::default() });
    assert_eq!((repairs.vertices_welded, repairs.holes_filled), (5, 1));
    assert_clean(&mesh);
    let own = &mesh.vertex_fields()[0];
    assert_eq!(own.values.len(), 9, "four vertices and five rows of seams");
    for t in mesh.triangles().iter().filter(|t| t.face < 3) {
        for (corner, weights) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
            let mut out = [f64::NAN];
            mesh.interpolate(own, t.face.into(), 0, weights, &mut out);
            assert_eq!(out, [f64::from(3 * t.face + corner as u32)]);
        }
    }
    let mut out = [f64::NAN];
    mesh.interpolate(own, 3, 0, Vec3::X, &mut out);
    assert!(out[0] >= 0.0 && out[0] < 9.0, "a value that the rim has: {}", out[0]);
}

#[test]
fn vertices_split_keep_their_data() {
    let one = bodies::tetrahedron();
    let soup = one.and(&one.map(|p| p.map(|c| -c)).flipped());
    let mesh = soup.mesh();
    let x: Vec<f64> = mesh.vertices().iter().map(|p| p.x + 10.0).collect();
    let mesh = mesh.with_field(false, field("x", FieldType::F64, 1, x)).unwrap();
    let (mesh, repairs) = repaired(&mesh, &only(|o| o.split = true));
    assert_eq!((repairs.vertices_split, mesh.vertices().len()), (1, 8));
    for (v, p) in mesh.vertices().iter().enumerate() {
        assert_eq!(mesh.vertex_fields()[0].item(v), [p.x + 10.0]);
    }
}
