// SPDX-License-Identifier: MIT OR Apache-2.0
//! What is no OBJ file, or none with a surface: one line that names the line of the file and the value.

use super::*;

fn refused(text: &str) -> String {
    let error = read(text).expect_err(text);
    assert_eq!(error.status(), Status::Parse, "{error}");
    assert!(!error.message().contains(['\n', '\r']), "{error}");
    error.message().to_owned()
}

#[test]
fn every_refusal_names_the_line_and_the_value() {
    for (text, wanted) in [
        ("", "offset 0: the file is empty"),
        ("#\n#\n", "line 3: the file ends without a face"),
        ("v 0 0 0\nv 1 0 0\n", "line 3: the file ends without a face"),
        ("v 0 0\n", "line 1: v: 2 numbers are not x y z, x y z w or x y z red green blue"),
        ("v\n1 2 3\n", "line 1: v: 0 numbers are not x y z"),
        ("v 1 2 3 4 5", "line 1: v: 5 numbers are not x y z"),
        ("v 1 2 3 4 5 6 7", "line 1: v: 7 or more numbers are not x y z"),
        ("v 1 2 3 4 5 6 7 8 9", "line 1: v: 7 or more numbers are not x y z"),
        ("\n\nv 0 0 x\n", "line 3: \"x\" is not a number"),
        ("v 0 0 1,5\n", "line 1: \"1,5\" is not a number"),
        ("v nan 0 0\n", "line 1: \"nan\" is not a finite coordinate"),
        ("v 0 -inf 0\n", "line 1: \"-inf\" is not a finite coordinate"),
        ("v 0 1e400 0\n", "line 1: \"1e400\" is not a finite coordinate"),
        ("v 0 1.1e100 0\n", "line 1: \"1.1e100\" is not a finite coordinate"),
        ("v 0 0 0 w\n", "line 1: \"w\" is not a number"),
        ("v 0 0 0 1 1 red\n", "line 1: \"red\" is not a number"),
        ("v 0 0 \\\n\\\r\n 0x10\n", "line 3: \"0x10\" is not a number"),
        ("1 2 3\n", "line 1: \"1\" is not a statement of OBJ"),
        ("v 0 0 0\n\0\0\0\n", "line 2: \"   \" is not a statement of OBJ"),
    ] {
        let message = refused(text);
        assert!(message.starts_with(wanted), "{text:?}: {message}");
    }
}

#[test]
fn every_refused_face_names_the_line_and_the_index() {
    for (face, wanted) in [
        ("f 1 2", "line 5: f: 2 corners are fewer than three"),
        ("f", "line 5: f: 0 corners are fewer than three"),
        ("f 1 2 \\\n", "line 5: f: 2 corners are fewer than three"),
        ("f 0 1 2", "line 5: f: 0 is not one of the 4 vertices"),
        ("\n f 1 2 5\n", "line 6: f: 5 is not one of the 4 vertices"),
        ("f 1 2 9\nf 1 2 7\nf 1 2 3", "line 5: f: 9 is not one of the 4 vertices"),
        ("f 1 2 7\nf 1 2 9\nf 1 2 3", "line 6: f: 9 is not one of the 4 vertices"),
        ("f 1 2 -5", "line 5: f: -5 is not one of the 4 vertices before it"),
        ("f 1 2 4294967297", "line 5: f: 4294967297 is not one of the 4 vertices"),
        ("f 1 2 -9223372036854775808", "line 5: f: -9223372036854775808 is not one of"),
        ("f 1 2 9223372036854775808", "line 5: \"9223372036854775808\" is not a corner of a face"),
        ("f 1 2 2147483648", "line 5: f: 2147483648 is not one of the 4 vertices"),
        ("f 1 2 3.0", "line 5: \"3.0\" is not a corner of a face"),
        ("f 1 2 x", "line 5: \"x\" is not a corner of a face"),
        ("f 1 2 /3", "line 5: \"/3\" is not a corner of a face"),
        ("f 1 2 3/x", "line 5: \"3/x\" is not a corner of a face"),
        ("f 1 2 3/1/1/1", "line 5: \"3/1/1/1\" is not a corner of a face"),
        ("f 1 2 3/1-1", "line 5: \"3/1-1\" is not a corner of a face"),
        ("f 1 1 1", "xyz: the box around the faces has the diagonal 0e0"),
        ("f 1 2 1", "faces: each of 1 has fewer than three different corners"),
    ] {
        let message = refused(&format!("{VERTICES}{face}"));
        assert!(message.starts_with(wanted), "{face:?}: {message}");
    }
}

#[test]
fn relative_indices_do_not_reach_later_vertices() {
    let message = refused("v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n");
    assert_eq!(message, "line 3: f: -3 is not one of the 2 vertices before it");
}

#[test]
fn a_file_cut_at_any_byte_is_a_smaller_mesh_or_an_error() {
    let whole = obj_files::rich();
    let faces = mesh(&whole).face_count();
    let mut meshes = 0;
    for cut in 0..whole.len() {
        match read(&whole[..cut]) {
            Ok(mesh) => {
                assert!(mesh.face_count() <= faces);
                meshes += 1;
            }
            Err(e) => assert!(e.status() == Status::Parse && !e.message().contains('\n'), "{cut}: {e}"),
        }
    }
    assert!(meshes > 0);
}
