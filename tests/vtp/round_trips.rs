// SPDX-License-Identifier: MIT OR Apache-2.0
//! A mesh written and read again is the same mesh.

use super::*;
use embound::mesh::Field;
use std::fs;
use std::path::PathBuf;

fn path(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("vtp-{name}"));
    fs::create_dir_all(&folder).unwrap();
    folder.join("part.vtp")
}

fn back(mesh: &Mesh, name: &str) -> Mesh {
    let path = path(name);
    io::write(mesh, &path).unwrap();
    io::read(&path, Format::Detect, &MeshOptions::default()).unwrap()
}

#[test]
fn positions_come_back_to_the_bit_at_any_scale() {
    for (name, scale) in [("micron", 1e-6), ("unit", 1.0), ("kilometre", 1e3)] {
        let mesh = bodies::torus(2.0 / 3.0, 0.1, 24, 12).scaled(scale).mesh();
        same::assert_same(&back(&mesh, name), &mesh);
    }
}

#[test]
fn polygons_data_tags_and_names_come_back() {
    let faces = [[0u32, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
    let xyz: Vec<f64> = rich_piece().points.concat();
    let offsets: Vec<usize> = (0..=6).map(|f| 4 * f).collect();
    let tags = [5, -2, 0, 5, i32::MAX, i32::MIN];
    let mesh = Mesh::from_polygons(&xyz, &offsets, &faces.concat(), Some(&tags), &MeshOptions::default()).unwrap();
    same::assert_same(&back(&mesh, "tags"), &mesh);
    let mut mesh = mesh
        .with_tags(&tags, vec![(5, "a <b> & \"c\"".into()), (-2, "\u{3bc}".into()), (8, "of none".into())])
        .unwrap();
    let kinds = [
        (FieldType::I8, -128.0),
        (FieldType::U8, 255.0),
        (FieldType::I16, -32768.0),
        (FieldType::U16, 65535.0),
        (FieldType::I32, -2147483648.0),
        (FieldType::U32, 4294967295.0),
        (FieldType::I64, -9007199254740992.0),
        (FieldType::F32, f64::from(f32::MIN_POSITIVE)),
        (FieldType::F64, f64::NAN),
    ];
    for (k, (kind, value)) in kinds.into_iter().enumerate() {
        for (on_faces, items) in [(true, 6), (false, 8)] {
            let mut values: Vec<f64> = (0..items * (k + 1)).map(|x| (x % 100) as f64).collect();
            values[k] = value;
            let field = Field { name: format!("{kind:?} <{k}>"), kind, components: k + 1, values };
            mesh = mesh.with_field(on_faces, field).unwrap();
        }
    }
    let found = back(&mesh, "data");
    same::assert_same(&found, &mesh);
    assert_eq!((found.vertex_fields().len(), found.face_fields().len()), (9, 9));
}

#[test]
fn seams_come_back() {
    let piece = Piece {
        points: vec![
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0; 3],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ],
        polys: vec![vec![0, 1, 2], vec![3, 4, 5], vec![6, 1, 0]],
        point_data: vec![
            Array::new("u", "Float32", 2, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 0.5, 1.5, 2.5, 3.5]),
            Array::new("same", "Int8", 1, &[0.0, 1.0, 2.0, 0.0, 2.0, 5.0, 6.0]),
        ],
        ..Piece::default()
    };
    let mesh = mesh(&file(ASCII, &[piece]));
    assert_eq!((mesh.vertices().len(), mesh.vertex_fields()[0].values.len()), (5, 14));
    let path = path("seams");
    io::write(&mesh, &path).unwrap();
    same::assert_same(&super::mesh(&fs::read(&path).unwrap()), &mesh);
}

#[test]
fn faces_are_numbered_anew_and_gaps_are_closed() {
    let mesh = mesh(&rich(ASCII));
    let path = path("numbers");
    io::write(&mesh, &path).unwrap();
    let found = super::mesh(&fs::read(&path).unwrap());
    assert_eq!(same::faces(&found), same::faces(&mesh));
    assert_eq!((numbers_of_faces(&found), found.face_count()), ((0..8).collect(), 8));
    assert_eq!((0..8).map(|f| found.tag(f)).collect::<Vec<_>>(), [7, 7, 7, 7, 3, 3, 7, 3]);
    assert_eq!(found.face_fields()[0].values, [4.0, 4.0, 4.0, 4.0, 5.0, 6.0, 7.0, 65535.0]);
    assert_eq!(found.tag_names(), mesh.tag_names());
}

#[test]
fn face_data_with_the_name_of_the_tags_is_refused_where_it_would_be_read_as_tags() {
    let mesh = bodies::icosphere(0).mesh();
    let with = |kind| Field { name: "tag".into(), kind, components: 1, values: vec![1.0; 20] };
    let reals = mesh.with_field(true, with(FieldType::F64)).unwrap();
    same::assert_same(&back(&reals, "reals"), &reals);
    for mesh in [mesh.with_field(true, with(FieldType::I32)), reals.with_tags(&[1; 20], Vec::new())] {
        let error = io::write(&mesh.unwrap(), &path("clash")).unwrap_err();
        assert_eq!(error.status(), Status::Unsupported);
        assert!(error.message().ends_with("face data \"tag\": the name is that of the tags in a file"), "{error}");
    }
}
