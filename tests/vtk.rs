// SPDX-License-Identifier: MIT OR Apache-2.0
//! Legacy VTK: text and bytes, old cells and those of version 5, strips, every kind of data; what is written reads
//! back, and files that are wrong are refused with the place.

mod common;

use common::{bodies, described};
use embound::Status;
use embound::io::{self, Format};
use embound::mesh::{Field, FieldType, Mesh, MeshOptions, Orient};
use std::fs;

const POINTS: &str = "POINTS 8 float\n0 0 0  1 0 0  1 1 0  0 1 0\n0 0 1  1 0 1  1 1 1  0 1 1\n";
const OLD: &str = "POLYGONS 6 30\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
const NEW: &str = "POLYGONS 7 24\nOFFSETS vtktypeint64\n0 4 8 12 16 20 24\nCONNECTIVITY vtktypeint64\n\
    0 3 2 1 4 5 6 7 0 1 5 4 1 2 6 5 2 3 7 6 3 0 4 7\n";

fn file(version: &str, parts: &[&str]) -> String {
    format!("# vtk DataFile Version {version}\nany title at all\nASCII\nDATASET POLYDATA\n{}", parts.concat())
}

fn read(bytes: &[u8]) -> embound::Result<Mesh> {
    io::read_memory(bytes, Format::Detect, &MeshOptions::default())
}

fn refused(bytes: &[u8]) -> String {
    let error = read(bytes).expect_err("the file is wrong");
    assert_eq!(error.status(), Status::Parse, "{error}");
    error.message().to_owned()
}

/// Each line of numbers of a text as big-endian bytes of the type that the lines before it name.
fn binary(text: &str) -> Vec<u8> {
    let mut out = Vec::new();
    let (mut kind, mut numbers) = (String::from("int"), Vec::<String>::new());
    fn flush(out: &mut Vec<u8>, numbers: &mut Vec<String>, kind: &str) {
        for n in numbers.drain(..) {
            match kind {
                "float" => out.extend(n.parse::<f32>().unwrap().to_be_bytes()),
                "double" => out.extend(n.parse::<f64>().unwrap().to_be_bytes()),
                "vtktypeint64" => out.extend(n.parse::<i64>().unwrap().to_be_bytes()),
                "unsigned_char" => out.push(n.parse::<f64>().unwrap() as u8),
                "short" => out.extend(n.parse::<i16>().unwrap().to_be_bytes()),
                _ => out.extend(n.parse::<i32>().unwrap().to_be_bytes()),
            }
        }
    }
    let mut strings = 0;
    for (k, line) in text.lines().enumerate() {
        if strings > 0 {
            let plain = line.replace("%20", " ").replace("%25", "%");
            out.push(0xc0 | plain.len() as u8);
            out.extend(plain.bytes());
            strings -= 1;
            if strings == 0 {
                out.push(b'\n');
            }
            continue;
        }
        if k > 3 && line.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
            numbers.extend(line.split_whitespace().map(str::to_owned));
            continue;
        }
        if !numbers.is_empty() {
            flush(&mut out, &mut numbers, &kind);
            out.push(b'\n');
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        if let Some(word) = words
            .iter()
            .rev()
            .find(|w| ["float", "double", "vtktypeint64", "unsigned_char", "short", "int"].contains(w))
        {
            kind = (*word).to_owned();
        } else if words.len() == 4 && words[3] == "string" {
            strings = words[1].parse::<usize>().unwrap() * words[2].parse::<usize>().unwrap();
        } else if words.first().is_some_and(|w| w.ends_with("_SCALARS") || *w == "LOOKUP_TABLE") && words.len() == 3 {
            kind = "unsigned_char".to_owned();
        } else if words.len() == 3 && words[0] != "FIELD" {
            kind = "int".to_owned();
        }
        out.extend(line.replace("ASCII", "BINARY").bytes());
        out.push(b'\n');
    }
    flush(&mut out, &mut numbers, &kind);
    out
}

const DATA: &str = "POINT_DATA 8\nSCALARS temperature%20of%20it double\nLOOKUP_TABLE default\n1 2 3 4\n5 6 7 8.5\n\
    VECTORS u float\n0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6 0 0 7 0 0 8\n\
    SCALARS bare short 2\n1 -1 2 -2 3 -3 4 -4 5 -5 6 -6 7 -7 8 -8\n\
    FIELD FieldData 2\nwall 1 8 int\n8 7 6 5 4 3 2 1\nelsewhere 1 3 float\n1 2 3\n\
    CELL_DATA 8\nSCALARS tag int 1\nLOOKUP_TABLE mine\n-9 -9 1 2 3 4 5 6\n\
    LOOKUP_TABLE mine 2\n0 0 0 1\n1 1 1 1\n\
    NORMALS n float\n0 0 0 0 0 0 0 0 -1 0 0 1 0 -1 0 1 0 0 0 1 0 -1 0 0\n";

#[test]
fn old_and_new_cells_as_text_and_bytes_are_the_same() {
    let other = "VERTICES 1 2\n1 0\nLINES 1 4\n3 0 1 2\n";
    let other_new = "VERTICES 2 1\nOFFSETS vtktypeint64\n0 1\nCONNECTIVITY vtktypeint64\n0\n\
        LINES 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\n";
    let names = "FIELD FieldData 4\nTIME 1 1 double\n0\nwords 2 1 string\na%20b\n\ntag_names 1 3 string\n100%25%20of%20the%20wall\n\n\
        again\ntag_numbers 1 3 int\n3 -4 3\n";
    let wanted = read(file("3.0", &[names, POINTS, other, OLD, DATA]).as_bytes()).unwrap();
    assert_eq!((wanted.report().volume, wanted.report().closed, wanted.face_count()), (1.0, true, 6));
    assert_eq!((0..6).map(|f| wanted.tag(f)).collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6]);
    assert_eq!(wanted.tag_names(), [(3, "100% of the wall".to_owned())]);
    let shape = |f: &Field| (f.name.clone(), f.kind, f.components);
    let of_vertices: Vec<_> = wanted.vertex_fields().iter().map(shape).collect();
    let name = |n: &str| n.to_owned();
    let types = [
        (name("temperature of it"), FieldType::F64, 1),
        (name("u"), FieldType::F32, 3),
        (name("bare"), FieldType::I16, 2),
        (name("wall"), FieldType::I32, 1),
    ];
    assert_eq!(of_vertices, types);
    assert_eq!(wanted.face_fields().iter().map(shape).collect::<Vec<_>>(), [(name("n"), FieldType::F32, 3)]);
    assert_eq!(wanted.face_fields()[0].item(1), [0.0, 0.0, 1.0]);
    for (version, text) in [
        ("3.0", file("3.0", &[names, POINTS, other, OLD, DATA])),
        ("5.1", file("5.1", &[names, POINTS, other_new, NEW, DATA])),
    ] {
        assert!(described(&read(text.as_bytes()).unwrap()) == described(&wanted), "{version}");
        assert!(described(&read(&binary(&text)).unwrap()) == described(&wanted), "{version} in bytes");
        assert!(described(&read(text.replace('\n', "\r\n").as_bytes()).unwrap()) == described(&wanted));
    }
}

/// Data with every form of METADATA that VTK writes: some or no components have names, and there are empty lines in it.
const DESCRIBED: &str = "POINT_DATA 8\nVECTORS u float\n0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6 0 0 7 0 0 8\n\
    METADATA\nCOMPONENT_NAMES\nINFORMATION%203\n\n\nINFORMATION 2\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0.5 9.1\n\
    NAME NAMES LOCATION vtkAbstractArray\nDATA 2\nCELL_DATA%206\nx\n\n\
    FIELD FieldData 4\nlast 3 8 short\n1 2 3 1 2 3 1 2 3 1 2 3 1 2 3 1 2 3 1 2 3 1 2 3\n\
    METADATA\nCOMPONENT_NAMES\n\n\nw\n\nINFORMATION 1 8 int\n1 2 3 4 5 6 7 8\n\
    METADATA 1 8 int\n8 7 6 5 4 3 2 1\nMETADATA\nINFORMATION 0\n\n\
    COMPONENT_NAMES 1 8 int\n1 1 1 1 1 1 1 1\nMETADATA\nCOMPONENT_NAMES\nMETADATA\n\n\
    CELL_DATA 6\nSCALARS tag int 1\nLOOKUP_TABLE default\n1 2 3 4 5 6\nMETADATA\n\
    INFORMATION 1\nNAME x LOCATION y\nDATA 3\n";

#[test]
fn metadata_of_arrays_are_stepped_over_and_arrays_may_have_their_names() {
    let points = POINTS.to_owned() + "METADATA\nINFORMATION 1\nNAME x LOCATION y\nDATA 1 0\n\n";
    for text in [file("4.2", &[&points, OLD, DESCRIBED]), file("5.1", &[&points, NEW, DESCRIBED])] {
        for bytes in [text.clone().into_bytes(), binary(&text), text.replace('\n', "\r\n").into_bytes()] {
            let mesh = read(&bytes).unwrap();
            assert!(mesh.report().closed);
            let names: Vec<&str> = mesh.vertex_fields().iter().map(|f| f.name.as_str()).collect();
            assert_eq!(names, ["u", "last", "INFORMATION", "METADATA", "COMPONENT_NAMES"]);
            assert_eq!(mesh.vertex_fields()[3].values, [8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0]);
            assert_eq!((0..6).map(|f| mesh.tag(f)).collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6]);
        }
    }
    for (wrong, wanted) in [
        ("METADATA\nCOMPONENT_NAMES\na\nb\nc\nd\n\n", "line 13: \"d\" is no part of METADATA"),
        ("METADATA\nCOMPONENT_NAMES\na\nb", "the file ends within COMPONENT_NAMES"),
        ("METADATA\nINFORMATION 1 2\n\n", "\"INFORMATION 1 2\" is no part of METADATA"),
        ("METADATA\nINFORMATION 2\nNAME x LOCATION y\nDATA 1 0\n\n", "the file ends within INFORMATION"),
        ("METADATA\nINFORMATION 1\nNAM x\nDATA 1 0\n\n", "\"NAM x\" and \"DATA 1 0\" are no key of INFORMATION"),
    ] {
        let message = refused(file("5.1", &[POINTS, wrong]).as_bytes());
        assert!(message.contains(wanted), "{wrong}: {message}");
    }
}

#[test]
fn numbers_of_a_text_are_rounded_as_the_bytes_of_their_type() {
    let data = "POINT_DATA 8\nFIELD f 3\ns 1 8 float\n0.1 -1e-40 16777217 0.3 1 1 1 1\n\
        c 1 8 unsigned_char\n0 255 1 1 1 1 1 1\nu 1 8 vtkTypeUInt64\n18446744073709551615 1 1 1 1 1 1 1\n";
    let points = POINTS.replace("1 1 0", "1.1 1.1 0.3");
    let text = file("3.0", &[&points, OLD, data]);
    let mesh = read(text.as_bytes()).unwrap();
    assert_eq!(mesh.vertex_fields()[0].values[..3], [f64::from(0.1f32), f64::from(-1e-40f32), 16_777_216.0]);
    assert_eq!(mesh.vertices()[6].x, 1.0);
    assert!(mesh.vertices().iter().any(|p| p.z == f64::from(0.3f32)));
    assert_eq!((mesh.vertex_fields()[2].kind, mesh.vertex_fields()[2].values[0]), (FieldType::F64, 2f64.powi(64)));
    let bytes = binary(&text.replace("vtkTypeUInt64", "double"));
    assert!(described(&read(&bytes).unwrap()) == described(&mesh));
    for (kind, value) in [
        ("char", "128"),
        ("unsigned_char", "-1"),
        ("short", "0.5"),
        ("vtkIdType", "3e9"),
        ("float", "1e39"),
        ("double", "1e309"),
    ] {
        let data = format!("POINT_DATA 8\nFIELD f 1\ns 1 8 {kind}\n1 2 3\n{value} 5 6 7 8\n");
        let message = refused(file("3.0", &[POINTS, OLD, &data]).as_bytes());
        assert!(message.starts_with(&format!("line 19: \"{value}\" is not a number")), "{message}");
    }
    // Colours of text are parts of one.
    let colours = "POINT_DATA 8\nCOLOR_SCALARS c 1\n0 1 0.00392157 0.498 2 -1 nan 0.2\n";
    let mesh = read(file("3.0", &[POINTS, OLD, colours]).as_bytes()).unwrap();
    let mut values = mesh.vertex_fields()[0].values.clone();
    values.sort_by(f64::total_cmp);
    assert_eq!(
        (mesh.vertex_fields()[0].kind, values),
        (FieldType::U8, vec![0.0, 0.0, 0.0, 1.0, 51.0, 127.0, 255.0, 255.0])
    );
}

#[test]
fn data_that_are_no_numbers_are_left_out_in_text_and_in_bytes() {
    let others = "POINT_DATA 8\nPEDIGREE_IDS ids string\na\nb\n\nd\ne%20e\nf\ng\nh\n";
    let text =
        file("3.0", &[POINTS, OLD, others, "VECTORS u float\n0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6 0 0 7 0 0 8\n"]);
    let long = "x".repeat(20_000);
    let mut bytes = binary(&file("3.0", &[POINTS, OLD]));
    bytes.extend(b"POINT_DATA 8\nFIELD FieldData 2\nwords 1 8 string\n");
    for (k, head) in
        [&[0xc1][..], &[0x80, 100], &[0x40, 0, 0x4e, 0x20], &[0, 0, 0, 0, 0, 0, 0, 3], &[0xc0]].iter().enumerate()
    {
        bytes.extend(*head);
        bytes.extend(&long.as_bytes()[..[1, 100, 20_000, 3, 0][k]]);
    }
    bytes.extend(b"\xc1a\xc1b\xc1c\nu 1 8 unsigned_char\nabcdefgh\n");
    for (bytes, first) in [(text.into_bytes(), 1.0), (bytes, 97.0)] {
        let mesh = read(&bytes).unwrap();
        assert_eq!(mesh.vertex_fields().len(), 1);
        assert!(mesh.vertex_fields()[0].values.contains(&first));
    }
    let cut = file("3.0", &[POINTS, OLD, "POINT_DATA 8\nFIELD FieldData 1\nwords 1 8 string\na\nb\n"]);
    assert!(refused(cut.as_bytes()).contains("the file ends within an array of strings"));
    let mut cut = binary(&file("3.0", &[POINTS, OLD]));
    let end = cut.len();
    cut.extend(b"POINT_DATA 8\nFIELD FieldData 1\nwords 1 8 string\n\xc3abc\x3f\xff\xff\xff\xff\xff\xff\xff");
    assert_eq!(refused(&cut), format!("offset {}: 0 bytes left cannot hold a string of 4611686018427387903", end + 52));
}

#[test]
fn strips_are_cut_into_triangles_that_agree_and_share_their_cell_data() {
    let strips = "TRIANGLE_STRIPS 3 21\n10 0 4 1 5 2 6 3 7 0 4\n4 0 1 3 2\n4 4 7 5 6\n";
    let data = "CELL_DATA 3\nSCALARS patch int 1\nLOOKUP_TABLE default\n10 20 30\n";
    for text in [file("2.0", &[POINTS, strips, data])] {
        for bytes in [text.clone().into_bytes(), binary(&text)] {
            let mesh =
                io::read_memory(&bytes, Format::Vtk, &MeshOptions { orient: Orient::Keep, ..MeshOptions::default() });
            let mesh = mesh.unwrap();
            assert!(mesh.report().closed && mesh.report().consistent, "{:?}", mesh.report());
            assert_eq!(mesh.face_fields()[0].values, [[10.0].repeat(8), [20.0].repeat(2), [30.0].repeat(2)].concat());
        }
    }
}

#[test]
fn what_is_written_reads_back_the_same() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("vtk");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join("m.vtk");
    let kept = MeshOptions { orient: Orient::Keep, ..MeshOptions::default() };
    for scale in [1.0, 1e-6, 1e3] {
        let body = bodies::bracket().scaled(scale).flipped_where(|t| t % 3 == 0);
        let tags: Vec<i32> = (0..body.triangles.len() as i32).map(|t| t % 4 - 1).collect();
        let mesh = body.mesh().with_tags(&tags, vec![(2, "a 100% wall".into()), (-1, "Einlaß".into())]).unwrap();
        let n = mesh.vertices().len();
        let kinds = [
            FieldType::I8,
            FieldType::U8,
            FieldType::I16,
            FieldType::U16,
            FieldType::I32,
            FieldType::U32,
            FieldType::I64,
            FieldType::F32,
            FieldType::F64,
        ];
        let mut mesh = mesh;
        for (k, kind) in kinds.into_iter().enumerate() {
            let components = 1 + k % 3;
            let field = |n: usize| Field {
                name: format!("data {k}"),
                kind,
                components,
                values: (0..n * components).map(|i| (i % 100) as f64).collect(),
            };
            mesh = mesh.with_field(false, field(n)).unwrap().with_field(true, field(tags.len())).unwrap();
        }
        io::write(&mesh, &path).unwrap();
        let back = io::read(&path, Format::Detect, &kept).unwrap();
        assert!(described(&back) == described(&mesh));
        assert_eq!(back.tag_names(), mesh.tag_names());
        assert!(back.vertex_fields() == mesh.vertex_fields() && back.face_fields() == mesh.face_fields());
    }
    // Polygons, and corners of one place with data of their own.
    let seams = file(
        "3.0",
        &[
            "POINTS 8 double\n0 0 0 1 0 0 1 1 0 0 1 0\n1 0 0 2 0 0 2 1 0 1 1 0\n",
            "POLYGONS 2 10\n4 0 1 2 3\n4 4 5 6 7\nPOINT_DATA 8\nSCALARS side int\n1 1 1 1 2 2 2 2\n",
        ],
    );
    let mesh = read(seams.as_bytes()).unwrap();
    assert_eq!((mesh.vertices().len(), mesh.vertex_fields()[0].values.len()), (6, 8));
    io::write(&mesh, &path).unwrap();
    assert!(described(&io::read(&path, Format::Detect, &kept).unwrap()) == described(&mesh));
}

#[test]
fn files_that_are_wrong_are_refused_with_the_place() {
    let whole = file("3.0", &[POINTS, OLD]);
    for (from, to, wanted) in [
        ("Version 3.0", "Version three", "line 1: "),
        ("ASCII", "EBCDIC", "line 3: \"EBCDIC\" is neither ASCII nor BINARY"),
        ("DATASET", "DATA", "there is no DATASET"),
        ("POINTS 8 float", "POINTS 8 quad", "line 5: \"quad\" is no type of numbers"),
        ("POINTS 8 float", "POINTS 5000000000 float", "line 5: 5000000000 points are more than"),
        ("POINTS 8 float", "POINTS 400000000 float", "cannot hold 1200000000 numbers"),
        ("POINTS 8 float", "POINTS eight float", "line 5: \"eight\" is not a count"),
        ("1 1 0 ", "1 nan 0 ", "the coordinate NaN of point 2 is not finite"),
        ("1 1 0 ", "1 one 0 ", "\"one\" is not a number"),
        ("POLYGONS 6 30", "POLYGONS 6 29", "cell 5 has 4 corners, and 29 numbers hold all"),
        ("POLYGONS 6 30", "POLYGONS 5 30", "5 cells have 25 of 30 numbers"),
        ("POLYGONS 6 30", "POLYGONS 40 30", "30 numbers cannot hold 40 cells"),
        ("4 4 5 6 7", "4 4 5 6 8", "the index 8 of cell 1 is not one of 8 points"),
        ("4 4 5 6 7", "4 4 5 6 -1", "the index -1 of cell 1"),
        ("4 4 5 6 7", "-4 4 5 6 7", "cell 1 has -4 corners"),
        ("POLYGONS", "POLYGON", "\"POLYGON\" is no part of a POLYDATA"),
    ] {
        assert!(whole.contains(from), "{from}");
        let message = refused(whole.replacen(from, to, 1).as_bytes());
        assert!(message.contains(wanted), "{from} -> {to}: {message}");
    }
    let grid = read(whole.replace("POLYDATA", "STRUCTURED_POINTS").as_bytes()).unwrap_err();
    assert_eq!(
        (grid.status(), grid.message()),
        (Status::Unsupported, "line 4: the dataset is STRUCTURED_POINTS, not POLYDATA")
    );
    let cells = read(whole.replace("POLYDATA", "UNSTRUCTURED_GRID").as_bytes()).unwrap_err();
    assert_eq!(
        cells.message(),
        "line 4: the dataset is UNSTRUCTURED_GRID, not POLYDATA; extract its surface first (vtkGeometryFilter, in \
         ParaView Extract Surface)"
    );
    let data = file("3.0", &[POINTS, OLD, "POINT_DATA 7\nSCALARS a int\n1 2 3 4 5 6 7\n"]);
    assert_eq!(refused(data.as_bytes()), "line 16: POINT_DATA: 7 items for 8");
    let new = file("5.1", &[POINTS, &NEW.replace("0 4 8 12", "0 4 3 12")]);
    assert!(refused(new.as_bytes()).contains("OFFSETS do not rise from 0 to 24"));
    let few = file("5.1", &[POINTS, &NEW.replace("16 20 24", "16 20 23")]);
    assert!(refused(few.as_bytes()).contains("OFFSETS do not rise from 0 to 24"));
    for text in [file("3.0", &[POINTS, OLD]), file("5.1", &[POINTS, NEW])] {
        for bytes in [text.trim_end().as_bytes().to_vec(), binary(&text)] {
            // Only a cut within the last number may go unseen.
            for length in 0..bytes.len() - 1 {
                assert!(read(&bytes[..length]).is_err() || length > bytes.len() - 3, "cut at {length}");
            }
        }
    }
}

#[test]
fn sections_of_data_must_all_fit_and_strips_do_not_multiply_them_without_bound() {
    let none = "CELL_DATA 0\nSCALARS tag int 1\nLOOKUP_TABLE default\nCELL_DATA 6\nSCALARS u int 1\nLOOKUP_TABLE default\n1 2 3 4 5 6\n";
    assert_eq!(refused(file("3.0", &[POINTS, OLD, none]).as_bytes()), "line 19: CELL_DATA: \"tag\" has 0 items for 6");
    let wide = |of: &str| format!("POINT_DATA {of}\nFIELD f 1\nu 4611686018427387904 0 int\n");
    let after = format!("POINT_DATA 8\nVECTORS n int\n{}\n", "1 ".repeat(24));
    let message = refused(file("3.0", &[POINTS, OLD, &wide("0"), &after]).as_bytes());
    assert_eq!(message, "line 19: POINT_DATA: \"u\" has 0 items for 8");
    assert!(read(file("3.0", &[POINTS, OLD, &wide("8")]).as_bytes()).unwrap().vertex_fields().is_empty());
    let strip = format!("TRIANGLE_STRIPS 1 20001\n20000 {}\n", "0 1 2 3 ".repeat(5000));
    let arrays: String = (0..400).map(|k| format!("a{k} 1 1 int\n{k}\n")).collect();
    let text = file("3.0", &[POINTS, &strip, "CELL_DATA 1\nFIELD FieldData 400\n", &arrays]);
    assert_eq!(read(text.as_bytes()).unwrap_err().status(), Status::Unsupported);
}
