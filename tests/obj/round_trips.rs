// SPDX-License-Identifier: MIT OR Apache-2.0
//! A mesh written and read again is the same mesh.

use super::*;
use embound::mesh::{Field, FieldType};
use std::fs;
use std::path::PathBuf;

fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("obj-{name}"));
    fs::create_dir_all(&folder).unwrap();
    folder.join("part.obj")
}

fn written(mesh: &Mesh, name: &str) -> String {
    let path = scratch(name);
    io::write(mesh, &path).unwrap();
    fs::read_to_string(&path).unwrap()
}

fn back(mesh: &Mesh, name: &str) -> Mesh {
    let text = written(mesh, name);
    io::read_memory(text.as_bytes(), Format::Detect, &MeshOptions::default()).unwrap()
}

#[test]
fn positions_come_back_to_the_bit_at_any_scale() {
    for (name, scale) in [("micron", 1e-6), ("unit", 1.0), ("kilometre", 1e3), ("huge", 1e99), ("tiny", 1e-80)] {
        let mesh = bodies::torus(2.0 / 3.0, 0.1, 24, 12).scaled(scale).mesh();
        same::assert_same(&back(&mesh, name), &mesh);
    }
}

/// A prism of polygons and quadrilaterals, its caps and sides tagged in turns.
fn prism() -> Mesh {
    let outline = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
    let level = |z: f64| outline.iter().flat_map(move |p| [p[0] / 3.0, p[1] / 7.0, z]);
    let xyz: Vec<f64> = level(0.0).chain(level(0.1)).collect();
    let mut indices: Vec<u32> = (0..6).rev().chain(6..12).collect();
    let mut offsets = vec![0, 6, 12];
    for a in 0..6 {
        let b = (a + 1) % 6;
        indices.extend([a, b, b + 6, a + 6]);
        offsets.push(indices.len());
    }
    let tags = [5, -2, 0, 5, 0, 5, 0, 9];
    Mesh::from_polygons(&xyz, &offsets, &indices, Some(&tags), &MeshOptions::default()).unwrap()
}

#[test]
fn polygons_tags_and_names_come_back() {
    let mesh = prism();
    same::assert_same(&back(&mesh, "prism"), &mesh);
    let names = vec![(5, "hot wall".into()), (-2, "g: # tag 3 x".into()), (77, "of no face".into()), (0, "0".into())];
    let named = mesh.with_tags(&[5, -2, 0, 5, 0, 5, 0, 9], names).unwrap();
    same::assert_same(&back(&named, "names"), &named);
    let one = mesh.with_tags(&[0; 8], vec![(0, "all".into())]).unwrap();
    same::assert_same(&back(&one, "one"), &one);
}

#[test]
fn colours_come_back_with_their_seams() {
    let mesh = mesh(
        "v 0 0 0 1 1 1\nv 1 0 0 2 2 0.1\nv 1 1 0 3 3 3\nv 0 0 0 4 4 4\nv 1 1 0 3 3 3\nv 0 1 0 5 5 5\nv 0 0 1\nf 1 2 3\nf 4 5 6\nf 2 1 7\n",
    );
    assert_eq!(mesh.vertex_fields()[0].values.len(), mesh.vertices().len() + 1, "there is a seam");
    same::assert_same(&back(&mesh, "seams"), &mesh);
}

#[test]
fn data_that_the_format_does_not_hold_is_left_out() {
    let mesh = bodies::icosphere(0).mesh();
    let field = |name: &str, items| Field {
        name: name.into(),
        kind: FieldType::U8,
        components: 1,
        values: (0..items).map(f64::from).collect(),
    };
    let mut rich = mesh.with_field(true, field("pressure", 20)).unwrap();
    for name in ["red", "green", "temperature"] {
        rich = rich.with_field(false, field(name, 12)).unwrap();
    }
    same::assert_same(&back(&rich, "other"), &mesh);
    let coloured = rich.with_field(false, field("blue", 12)).unwrap();
    let names: Vec<String> = back(&coloured, "coloured").vertex_fields().iter().map(|f| f.name.clone()).collect();
    assert_eq!(names, ["red", "green", "blue"]);
}

#[test]
fn other_readers_find_plain_statements() {
    let text = written(&prism().with_tags(&[0, 0, 0, 0, 1, 1, 1, 1], vec![(0, "hot wall".into())]).unwrap(), "plain");
    let lines = |with: &str| text.lines().filter(|l| l.starts_with(with)).count();
    assert_eq!((lines("v "), lines("f "), lines("g ")), (12, 8, 2));
    assert!(text.contains("\n# tag 0 hot wall\ng hot_wall\nf 6 5 4 3 2 1\n"), "{text}");
    assert!(text.contains("\n# tag 1\ng tag_1\nf "), "{text}");
}
