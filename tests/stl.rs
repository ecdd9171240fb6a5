// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reading and writing STL: every rule and every refusal. Files are made here or by tests/common, and where
//! stl_io reads a file rightly both must agree.

mod common;

use common::random::Random;
use common::{Soup, bodies, stl_bytes};
use embound::Status;
use embound::io::{self, Format};
use embound::math::Vec3;
use embound::mesh::{Mesh, MeshOptions, Orient};
use proptest::prelude::*;
use std::fs;
use std::path::PathBuf;

fn read(bytes: &[u8]) -> embound::Result<Mesh> {
    io::read_memory(bytes, Format::Detect, &MeshOptions::default())
}

fn refused(bytes: &[u8]) -> String {
    let error = read(bytes).expect_err("the file is not valid");
    assert_eq!(error.status(), Status::Parse, "{error}");
    error.message().to_string()
}

/// The corners of all triangles, in order.
fn corners(mesh: &Mesh) -> Vec<[Vec3; 3]> {
    mesh.triangles().iter().map(|t| t.corners(mesh.vertices())).collect()
}

/// A valid ASCII file of a tetrahedron, to be spoiled.
fn text() -> String {
    stl_bytes::ascii_solid(&bodies::tetrahedron(), "corner of a cube")
}

fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("stl-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn binary_and_ascii_files_give_the_mesh_they_were_made_of() {
    let body = bodies::plate(2, 2, 0.125, 0.375, 2);
    let rounded = body.map(|p| p.map(|c| f64::from(c as f32)));
    let wanted = corners(&rounded.mesh());
    assert_eq!(corners(&read(&stl_bytes::binary(&body)).unwrap()), wanted);
    assert_eq!(corners(&read(&stl_bytes::ascii(&rounded)).unwrap()), wanted);
    let report = read(&stl_bytes::binary(&body)).unwrap().report().clone();
    assert!(report.closed && report.consistent);
    assert_eq!((report.vertices, report.triangles), (body.vertices.len(), body.triangles.len()));
}

#[test]
fn stl_io_reads_the_same_triangles() {
    let body = bodies::leaning_pyramid();
    for bytes in [stl_bytes::binary(&body), stl_bytes::ascii(&body)] {
        let theirs = stl_io::read_stl(&mut std::io::Cursor::new(&bytes)).unwrap();
        let ours = read(&bytes).unwrap();
        assert_eq!(theirs.faces.len(), ours.triangle_count());
        for (face, triangle) in theirs.faces.iter().zip(corners(&ours)) {
            for (v, p) in face.vertices.iter().zip(triangle) {
                let q = theirs.vertices[*v];
                assert_eq!([q[0], q[1], q[2]], p.to_array().map(|c| c as f32));
            }
        }
    }
}

#[test]
fn a_binary_file_whose_header_begins_with_solid_reads() {
    let body = bodies::icosphere(1);
    for header in [&b"solid"[..], b"solid exported by a CAD system", b"SOLID facet normal 0 0 1 outer loop"] {
        for padding in [0u8, b' ', b'\n'] {
            let mut full = header.to_vec();
            full.resize(80, padding);
            let mesh = read(&stl_bytes::binary_with(&body, &full, 0)).unwrap();
            assert_eq!(mesh.triangle_count(), body.triangles.len());
        }
    }
}

#[test]
fn attribute_bytes_and_trailing_bytes_are_ignored() {
    let body = bodies::icosphere(1);
    let plain = read(&stl_bytes::binary(&body)).unwrap();
    let coloured = read(&stl_bytes::binary_with(&body, b"COLOR=\xff\x00\x00\xff", 0xfc1f)).unwrap();
    assert_eq!(corners(&plain), corners(&coloured));
    assert_eq!(coloured.tag(3), 0);
    for header in [&b"made"[..], b"solid with a tail"] {
        let mut long = stl_bytes::binary_with(&body, header, 0);
        long.extend([0x1a; 33]);
        assert_eq!(corners(&read(&long).unwrap()), corners(&plain));
    }
}

#[test]
fn normals_are_ignored_whatever_they_hold() {
    let body = bodies::tetrahedron();
    let wanted = corners(&read(&stl_bytes::binary(&body)).unwrap());
    let mut bytes = stl_bytes::binary(&body);
    for t in 0..body.triangles.len() {
        bytes[84 + 50 * t..96 + 50 * t].fill(0xff);
    }
    assert_eq!(corners(&read(&bytes).unwrap()), wanted);
    for normal in ["normal nan nan nan", "normal -nan(ind) 1e999 x", "normal", "NORMAL 1 2", ""] {
        let spoiled = text().replace("normal 0 0 0", normal);
        assert_eq!(corners(&read(spoiled.as_bytes()).unwrap()), wanted, "{normal}");
    }
}

#[test]
fn line_ends_case_blank_lines_and_tabs_do_not_matter() {
    let wanted = corners(&read(text().as_bytes()).unwrap());
    let one_line_a_facet = text().replace("\n    ", " ").replace("\n      ", " ").replace("\n  endfacet", " endfacet");
    for variant in [
        text().replace('\n', "\r\n"),
        text().replace('\n', "\r"),
        text().replace('\n', "\n\n \t\n"),
        text().replace(' ', "\t").replace("solid\t", "solid "),
        text().to_uppercase(),
        text().replace("facet", "FaceT").replace("vertex", "Vertex"),
        format!("\n\n  {}", text()),
        format!("\u{feff}{}", text()),
        text().trim_end().to_string(),
        one_line_a_facet,
    ] {
        assert_eq!(corners(&read(variant.as_bytes()).unwrap()), wanted, "{variant}");
    }
}

#[test]
fn names_may_hold_anything_and_endsolid_may_be_missing() {
    let wanted = corners(&read(text().as_bytes()).unwrap());
    let body = bodies::tetrahedron();
    for name in ["", "two words", "facet normal 1 2 3", "endsolid solid vertex", "Größe ∅", "1e999 nan"] {
        let file = stl_bytes::ascii_solid(&body, name);
        assert_eq!(corners(&read(file.as_bytes()).unwrap()), wanted, "{name}");
        let cut = &file[..file.rfind("endsolid").unwrap()];
        assert_eq!(corners(&read(cut.as_bytes()).unwrap()), wanted, "{name} without its end");
    }
    let latin1 = [b"solid Gr\xf6\xdfe\n".to_vec(), text().split_once('\n').unwrap().1.into()].concat();
    assert_eq!(corners(&read(&latin1).unwrap()), wanted);
}

#[test]
fn solids_become_tags_in_their_order() {
    let at = |x: f64| bodies::tetrahedron().translated([x, 0.0, 0.0]);
    let solids: Vec<String> = (0..3).map(|k| stl_bytes::ascii_solid(&at(2.0 * f64::from(k)), "part")).collect();
    let unended: Vec<String> = solids.iter().map(|s| s.replace("endsolid part\n", "")).collect();
    for file in [solids.concat(), unended.concat()] {
        let mesh = read(file.as_bytes()).unwrap();
        let tags: Vec<i32> = mesh.triangles().iter().map(|t| mesh.tag(t.face)).collect();
        assert_eq!(tags, [0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2]);
        assert_eq!(mesh.report().components, 3);
    }
    let empty_first = format!("solid nothing\nendsolid nothing\n{}", solids[0]);
    assert_eq!(read(empty_first.as_bytes()).unwrap().tag(0), 1);
}

#[test]
fn numbers_are_read_in_every_usual_form() {
    let file = "solid\nfacet normal 0 0 1\nouter loop\nvertex 1e-3 +1. .5\nvertex -0.0 2E+0 -1.5e0\nvertex 00.25 3 1e1\n\
                endloop\nendfacet\nendsolid";
    let mesh = read(file.as_bytes()).unwrap();
    let wanted = [[1e-3, 1.0, 0.5], [0.0, 2.0, -1.5], [0.25, 3.0, 10.0]].map(Vec3::from_array);
    assert_eq!(corners(&mesh), [wanted]);
}

#[test]
fn minus_zero_equals_zero_when_welding() {
    let signed = |bytes: &mut [u8]| {
        // Every second zero coordinate loses its sign.
        let mut turn = false;
        for t in 0..(bytes.len() - 84) / 50 {
            for at in (96 + 50 * t..132 + 50 * t).step_by(4) {
                if bytes[at..at + 4] == [0; 4] {
                    turn = !turn;
                    bytes[at + 3] = if turn { 0x80 } else { 0 };
                }
            }
        }
    };
    let mut bytes = stl_bytes::binary(&bodies::unit_cube());
    signed(&mut bytes);
    let mesh = read(&bytes).unwrap();
    assert!(mesh.report().closed);
    assert_eq!(mesh.report().vertices, 8);
    let coordinates = mesh.vertices().iter().flat_map(|p| p.to_array());
    assert!(coordinates.into_iter().all(|c| c != 0.0 || c.is_sign_positive()));
}

#[test]
fn truncated_binary_files_name_the_offset_and_both_counts() {
    let bytes = stl_bytes::binary(&bodies::icosphere(1));
    assert_eq!(
        refused(&bytes[..84 + 50 * 10 + 49]),
        "offset 633: the file ends after 10 of the 80 triangles it claims"
    );
    assert!(refused(&bytes[..80]).contains("line 1"), "all of it is text");
    let mut header = vec![0u8; 83];
    assert_eq!(refused(&header), "offset 83: the file ends within the 84 bytes of header and count");
    header.push(0);
    assert_eq!(refused(&header), "offset 80: the count of triangles is 0; 0 bytes follow");
    for length in 0..bytes.len() {
        refused(&bytes[..length]);
    }
}

#[test]
fn a_claim_of_two_billion_triangles_is_refused_without_allocating_them() {
    let mut bytes = stl_bytes::binary(&bodies::tetrahedron());
    bytes[80..84].copy_from_slice(&(1u32 << 31).to_le_bytes());
    assert_eq!(refused(&bytes), "offset 284: the file ends after 4 of the 2147483648 triangles it claims");
    bytes[80..84].fill(0);
    assert_eq!(refused(&bytes), "offset 80: the count of triangles is 0; 200 bytes follow");
}

#[test]
fn binary_coordinates_that_are_not_finite_name_their_offset() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut bytes = stl_bytes::binary(&bodies::icosphere(0));
        let at = 84 + 50 * 7 + 12 + 4 * 5;
        bytes[at..at + 4].copy_from_slice(&bad.to_le_bytes());
        assert_eq!(refused(&bytes), format!("offset {at}: the coordinate {bad} of triangle 7 is not finite"));
    }
}

#[test]
fn spoiled_ascii_files_name_the_line_and_the_word() {
    // Line 4 of the file is the first vertex.
    let first = "vertex 0e0 0e0 0e0";
    for (with, message) in [
        ("vertex 0 nan 0", "line 4: \"nan\" is not a finite coordinate"),
        ("vertex inf 0 0", "line 4: \"inf\" is not a finite coordinate"),
        ("vertex 1e999 0 0", "line 4: \"1e999\" is not a finite coordinate"),
        ("vertex 0 0 -1e101", "line 4: \"-1e101\" is not a finite coordinate"),
        ("vertex 0 0", "line 5: \"vertex\" is not a number"),
        ("vertex 0 0 0 0", "line 4: \"0\" is not vertex"),
        ("vertex 0 1,5 0", "line 4: \"1,5\" is not a number"),
        ("vertices 0 0 0", "line 4: \"vertices\" is not vertex"),
        ("", "line 7: \"endloop\" is not vertex"),
    ] {
        let file = text().replacen(first, with, 1);
        assert_eq!(refused(file.as_bytes()), message);
        assert_eq!(refused(file.replace('\n', "\r\n").as_bytes()), message);
        assert_eq!(refused(file.replace('\n', "\r").as_bytes()), message);
    }
}

#[test]
fn files_without_triangles_are_refused() {
    assert_eq!(refused(b""), "offset 0: the file is empty");
    assert_eq!(refused(b"\n\n"), "line 3: the file ends without a triangle");
    assert_eq!(refused(b"solid a\nendsolid a\n"), "line 3: the file ends without a triangle");
    assert_eq!(refused(b"solid"), "line 1: the file ends without a triangle");
    assert_eq!(refused(b"Hello, world"), "line 1: \"Hello,\" is not solid, and no PLY, OBJ, VTK or VTP begins so");
    assert_eq!(refused(b"solid a\nendsolid a\nfacet"), "line 3: \"facet\" is not solid");
    assert_eq!(refused(b"solid a\nv 1 2 3"), "line 2: \"v\" is not facet or endsolid");
    assert_eq!(refused(b"\x7fELF"), "offset 4: the file ends within the 84 bytes of header and count");
    let point = Soup { vertices: vec![[1.0; 3]; 3], triangles: vec![[0, 1, 2]] };
    assert!(refused(&stl_bytes::binary(&point)).contains("diagonal 0e0"));
    let line = Soup { vertices: vec![[1.0; 3], [2.0; 3], [1.0; 3]], triangles: vec![[0, 1, 2]] };
    assert!(refused(&stl_bytes::binary(&line)).contains("fewer than three different corners"));
}

#[test]
fn an_ascii_file_may_be_cut_only_between_facets() {
    let file = text();
    for length in 1..file.len() {
        let cut = &file[..length];
        // A cut within a word leaves another word, within the first line another name, and after a
        // facet or in the last line nothing is missing.
        match read(cut.as_bytes()) {
            Ok(mesh) => assert_eq!(mesh.triangle_count(), cut.matches("endfacet").count()),
            Err(e) => assert!(e.message().starts_with("line "), "{e}"),
        }
    }
    let within = file.find("endloop").unwrap();
    assert_eq!(refused(&file.as_bytes()[..within]), "line 7: the file ends where endloop should be");
}

#[test]
fn files_are_found_by_content_and_errors_carry_the_path() {
    let folder = scratch("paths");
    let body = bodies::icosphere(1);
    for (name, bytes) in [("a.stl", stl_bytes::ascii(&body)), ("b.dat", stl_bytes::binary(&body))] {
        fs::write(folder.join(name), bytes).unwrap();
        let mesh = io::read(&folder.join(name), Format::Stl, &MeshOptions::default()).unwrap();
        assert_eq!(mesh.triangle_count(), 80);
    }
    let missing = folder.join("missing.stl");
    let error = io::read(&missing, Format::Detect, &MeshOptions::default()).unwrap_err();
    assert_eq!(error.status(), Status::Io);
    assert!(error.message().contains("missing.stl: cannot read: No such file"), "{error}");
    let error = io::read(&folder, Format::Detect, &MeshOptions::default()).unwrap_err();
    assert_eq!(error.status(), Status::Io);
    fs::write(folder.join("empty.stl"), b"").unwrap();
    let error = io::read(&folder.join("empty.stl"), Format::Detect, &MeshOptions::default()).unwrap_err();
    assert!(error.message().ends_with("empty.stl: offset 0: the file is empty"), "{error}");
    let options = MeshOptions { scale: -1.0, ..MeshOptions::default() };
    let error = io::read(&missing, Format::Detect, &options).unwrap_err();
    assert_eq!(error.message(), "options.scale: -1 is not finite and above 0");
}

#[test]
fn what_is_written_reads_back_to_f32() {
    let folder = scratch("round-trip");
    let path = folder.join("part.StL");
    let body = bodies::bracket().and(&bodies::sphere_at(2, [5.0, 0.1, 0.2], 0.3));
    let mesh = body.flipped().mesh();
    io::write(&mesh, &path).unwrap();
    let back =
        io::read(&path, Format::Detect, &MeshOptions { orient: Orient::Keep, ..MeshOptions::default() }).unwrap();
    let rounded =
        corners(&mesh).into_iter().map(|t| t.map(|p| Vec3::from_array(p.to_array().map(|c| f64::from(c as f32)))));
    assert!(rounded.eq(corners(&back)));
    assert_eq!(back.report().volume > 0.0, mesh.surface().volume > 0.0);
    let bytes = fs::read(&path).unwrap();
    assert_eq!(bytes.len(), 84 + 50 * mesh.triangle_count());
    assert!(!bytes.to_ascii_lowercase().starts_with(b"solid"));
    let theirs = stl_io::read_stl(&mut std::io::Cursor::new(&bytes)).unwrap();
    assert_eq!(theirs.faces.len(), mesh.triangle_count());
    for (face, normal) in theirs.faces.iter().zip(mesh.pseudonormals().unwrap().triangle) {
        assert_eq!([face.normal[0], face.normal[1], face.normal[2]], normal.to_array().map(|c| c as f32));
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "nothing else is left in the folder");
}

#[test]
fn writing_over_a_file_replaces_it_and_failing_leaves_it() {
    let folder = scratch("replace");
    let path = folder.join("part.stl");
    let mesh = bodies::icosphere(1).mesh();
    fs::write(&path, b"something older and shorter").unwrap();
    io::write(&mesh, &path).unwrap();
    assert_eq!(fs::read(&path).unwrap().len(), 84 + 50 * 80);
    let far = bodies::icosphere(1).scaled(1e39).mesh();
    let error = io::write(&far, &path).unwrap_err();
    assert_eq!(error.status(), Status::Unsupported);
    assert!(error.message().contains("part.stl: vertex 0: the coordinate "), "{error}");
    assert_eq!(fs::read(&path).unwrap().len(), 84 + 50 * 80);
    // A folder under the file's name.
    let taken = folder.join("taken.stl");
    fs::create_dir(&taken).unwrap();
    fs::write(taken.join("x"), b"x").unwrap();
    let error = io::write(&mesh, &taken).unwrap_err();
    assert_eq!(error.status(), Status::Io);
    assert!(error.message().contains("taken.stl: cannot write: "), "{error}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2, "no half file is left");
}

#[test]
fn writing_follows_links_keeps_permissions_and_spares_what_is_no_file() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = scratch("links");
    let mesh = bodies::icosphere(1).mesh();
    let path = folder.join(format!("{}.stl", "n".repeat(250)));
    fs::write(&path, b"something older").unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).unwrap();
    let link = folder.join("link.stl");
    symlink(&path, &link).unwrap();
    io::write(&mesh, &link).unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o600);
    assert_eq!(fs::read(&path).unwrap().len(), 84 + 50 * 80);
    let pipe = folder.join("pipe.stl");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let error = io::write(&mesh, &pipe).unwrap_err();
    assert!(error.status() == Status::Io && error.message().contains("not a regular file"), "{error}");
    assert!(!fs::metadata(&pipe).unwrap().is_file());
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 3, "no half file is left");
}

#[test]
fn unknown_extensions_and_missing_folders_are_refused_for_writing() {
    let folder = scratch("refused");
    let mesh = bodies::icosphere(0).mesh();
    for (name, shown) in [("part.step", "\"step\""), ("part", "\"\""), ("stl", "\"\""), ("a.stl.gz", "\"gz\"")] {
        let error = io::write(&mesh, &folder.join(name)).unwrap_err();
        assert_eq!(error.status(), Status::Unsupported);
        assert!(error.message().contains(shown), "{error}");
    }
    let error = io::write(&mesh, &folder.join("no/such/part.stl")).unwrap_err();
    assert_eq!(error.status(), Status::Io);
    assert!(error.message().contains("No such file"), "{error}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

#[test]
fn a_hundred_thousand_triangles_read_closed() {
    let body = bodies::torus(2.0, 0.5, 250, 200);
    let report = read(&stl_bytes::binary(&body)).unwrap().report().clone();
    assert_eq!((report.triangles, report.vertices, report.components), (100_000, 50_000, 1));
    assert!(report.closed && report.consistent && report.volume > 0.0);
}

/// Whatever the bytes are: a mesh or an error of one line.
fn survives(bytes: &[u8]) -> Result<(), TestCaseError> {
    if let Err(e) = read(bytes) {
        prop_assert!(matches!(e.status(), Status::Parse | Status::InvalidArgument), "{e}");
        prop_assert!(!e.message().is_empty() && !e.message().contains(['\n', '\r']));
    }
    Ok(())
}

fn mutate(mut bytes: Vec<u8>, seed: u64) -> Vec<u8> {
    let mut random = Random(seed);
    for _ in 0..1 + random.below(8) {
        if bytes.is_empty() {
            break;
        }
        let at = random.below(bytes.len());
        let span = random.below(40).min(bytes.len() - at);
        match random.below(6) {
            0 => bytes[at] = random.bits() as u8,
            1 => bytes[at] ^= 1 << random.below(8),
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..at + span)),
            4 => {
                let copy = bytes[at..at + span].to_vec();
                let to = random.below(bytes.len());
                bytes.splice(to..to, copy);
            }
            _ => {
                let n = 4.min(bytes.len() - at);
                bytes[at..at + n].copy_from_slice(&(random.bits() as u32).to_le_bytes()[..n]);
            }
        }
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_mutation_of_a_binary_file_panics(seed: u64) {
        survives(&mutate(stl_bytes::binary(&bodies::icosphere(1)), seed))?;
    }

    #[test]
    fn no_mutation_of_an_ascii_file_panics(seed: u64) {
        survives(&mutate(stl_bytes::ascii(&bodies::icosphere(0)), seed))?;
    }

    #[test]
    fn no_bytes_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        survives(&bytes)?;
        survives(&[b"solid ", &bytes[..]].concat())?;
    }
}
