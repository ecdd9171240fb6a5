// SPDX-License-Identifier: MIT OR Apache-2.0
//! Names of tags and of data: any line without white space around it comes back of every format that holds it, and
//! nothing else is taken for one.

mod common;

use common::bodies;
use embound::Status;
use embound::io::{self, Format};
use embound::mesh::{Field, FieldType, JoinTags, Mesh, MeshOptions};
use std::fs;
use std::path::PathBuf;

/// Names that some format has to write in another way.
fn awkward() -> Vec<String> {
    let mut names: Vec<String> = [
        "two  words",
        "100%",
        "%20",
        "a\\",
        "\\",
        "\"quoted\" & <b> 'c' &amp; &#10;",
        "# tag 3 x",
        "Einlaß \u{2028} \u{3bc}",
        "METADATA",
        "metadata of it",
        "INFORMATION",
        "tag_names",
        "comment field face 3 x",
        "a/b:c",
        "end_header",
        "-1",
    ]
    .map(String::from)
    .to_vec();
    names.extend([63, 64, 300, 16_384].map(|n| "long ".repeat(n)[..n].trim().to_owned() + "x"));
    names
}

fn path(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("names");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

fn back(mesh: &Mesh, name: &str, extension: &str) -> Mesh {
    let path = path(name).with_extension(extension);
    io::write(mesh, &path).unwrap();
    io::read(&path, Format::Detect, &MeshOptions::default()).unwrap()
}

#[test]
fn names_of_tags_come_back_of_every_format_that_has_tags() {
    let body = bodies::icosphere(1);
    let count = body.triangles.len() as i32;
    let named: Vec<(i32, String)> = (0..).map(|k| 3 * k - 5).zip(awkward()).collect();
    let tags: Vec<i32> = (0..count).map(|f| named[f as usize % named.len()].0).collect();
    let mesh = body.mesh().with_tags(&tags, named.clone()).unwrap();
    for extension in ["ply", "obj", "vtk", "vtp"] {
        let found = back(&mesh, "tags", extension);
        assert_eq!(found.tag_names(), named, "{extension}");
        assert_eq!((0..count as u32).map(|f| found.tag(f)).collect::<Vec<_>>(), tags, "{extension}");
    }
}

#[test]
fn names_of_data_come_back_of_every_format_that_has_data() {
    let plain = bodies::icosphere(0).mesh();
    for name in awkward() {
        let field = |n: usize, components| Field {
            name: name.clone(),
            kind: FieldType::I16,
            components,
            values: (0..n * components).map(|k| k as f64).collect(),
        };
        let mesh = plain.with_field(false, field(12, 1)).unwrap().with_field(true, field(20, 3)).unwrap();
        for extension in ["ply", "vtk", "vtp"] {
            let found = back(&mesh, "data", extension);
            assert_eq!(found.vertex_fields(), mesh.vertex_fields(), "{extension}");
            assert_eq!(found.face_fields(), mesh.face_fields(), "{extension}");
        }
    }
}

#[test]
fn what_is_no_line_is_no_name() {
    let mesh = bodies::icosphere(0).mesh();
    for name in ["", " ", " a", "a ", "a\n", "a\nb", "a\rb", "a\tb", "\u{a0}a", "a\u{85}b", "a\0"] {
        let error = mesh.with_tags(&[7; 20], vec![(7, name.to_owned())]).unwrap_err();
        let wanted = format!("names: {name:?} of tag 7 is empty, not one line or has white space around it");
        assert_eq!((error.status(), error.message()), (Status::InvalidArgument, &wanted[..]));
        let field = Field { name: name.into(), kind: FieldType::F64, components: 1, values: vec![1.0; 20] };
        let error = mesh.with_field(true, field).unwrap_err();
        let wanted = format!("name: {name:?} is empty, not one line or has white space around it");
        assert_eq!((error.status(), error.message()), (Status::InvalidArgument, &wanted[..]));
    }
}

#[test]
fn a_file_lends_its_tag_a_name_of_one_line() {
    let paths = [path(" a\tb .stl"), path("c.stl")];
    paths.iter().for_each(|p| io::write(&bodies::icosphere(0).mesh(), p).unwrap());
    let paths = paths.each_ref().map(|p| p.as_path());
    let mesh = io::read_files(&paths, Format::Stl, JoinTags::Renumber, &MeshOptions::default()).unwrap();
    assert_eq!(mesh.tag_names(), [(0, "a b".to_owned()), (1, "c".to_owned())]);
    let solid = "solid a\tb\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    let mesh = io::read_memory(solid.as_bytes(), Format::Stl, &MeshOptions::default()).unwrap();
    assert_eq!(mesh.tag_names(), [(0, "a b".to_owned())]);
}
