// SPDX-License-Identifier: MIT OR Apache-2.0
//! PLY: every encoding and order of things gives the same mesh, what is written reads back, and files that
//! are wrong are refused with the place.

mod common;

use common::{bodies, described};
use embound::Status;
use embound::io::{self, Format};
use embound::mesh::{Field, FieldType, Mesh, MeshOptions, Orient};
use std::fs;

/// A cube of quads as text; `{}` are replaced by what a test adds.
const CORNERS: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
const SIDES: &str = "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
const HEAD: &str = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n";
const FACE: &str = "element face 6\nproperty list uchar int vertex_indices\nend_header\n";

fn text(parts: &[&str]) -> String {
    parts.concat()
}

fn cube() -> String {
    text(&[HEAD, FACE, CORNERS, SIDES])
}

fn read(bytes: &[u8]) -> embound::Result<Mesh> {
    io::read_memory(bytes, Format::Detect, &MeshOptions::default())
}

fn refused(bytes: &[u8]) -> String {
    let error = read(bytes).expect_err("the file is wrong");
    assert_eq!(error.status(), Status::Parse, "{error}");
    error.message().to_owned()
}

/// The numbers after the header of a text, in binary; lists hold their length first.
fn binary(text: &str, big: bool) -> Vec<u8> {
    let (head, body) = text.split_once("end_header\n").unwrap();
    let kind = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut out = format!("{}end_header\n", head.replace("ascii", kind)).into_bytes();
    let mut lines = body.lines();
    let mut element = Vec::new();
    let put = |out: &mut Vec<u8>, word: &str, kind: &str| {
        let mut bytes = match kind {
            "char" | "uchar" | "int8" | "uint8" => vec![word.parse::<i16>().unwrap() as u8],
            "short" | "ushort" | "int16" | "uint16" => (word.parse::<i32>().unwrap() as u16).to_le_bytes().to_vec(),
            "int" | "uint" | "int32" | "uint32" => (word.parse::<i64>().unwrap() as u32).to_le_bytes().to_vec(),
            "uint64" => word.parse::<u64>().unwrap().to_le_bytes().to_vec(),
            "float" | "float32" => word.parse::<f32>().unwrap().to_le_bytes().to_vec(),
            _ => word.parse::<f64>().unwrap().to_le_bytes().to_vec(),
        };
        if big {
            bytes.reverse();
        }
        out.extend(bytes);
    };
    let mut flush = |element: &mut Vec<String>, count: usize, out: &mut Vec<u8>| {
        for _ in 0..count {
            let mut words = lines.next().unwrap().split_whitespace();
            for property in element.iter() {
                let p: Vec<&str> = property.split_whitespace().collect();
                if p[1] == "list" {
                    let length = words.next().unwrap();
                    put(out, length, p[2]);
                    (0..length.parse::<usize>().unwrap()).for_each(|_| put(out, words.next().unwrap(), p[3]));
                } else {
                    put(out, words.next().unwrap(), p[1]);
                }
            }
        }
        element.clear();
    };
    let mut count = 0;
    for line in head.lines() {
        if let Some(rest) = line.strip_prefix("element ") {
            flush(&mut element, count, &mut out);
            count = rest.split_whitespace().nth(1).unwrap().parse().unwrap();
        } else if line.starts_with("property") {
            element.push(line.to_owned());
        }
    }
    flush(&mut element, count, &mut out);
    out
}

fn everything() -> String {
    let head = "ply\r\nformat ascii 1.0\r\ncomment made for a test\ncomment tag 7 the wall\nobj_info nothing\n\
        element camera 2\nproperty list uchar float where\nproperty int8 k\n\
        element face 6\nproperty uint16 material\nproperty list uint8 uint32 Vertex_Index\nproperty list int8 float32 uv\nproperty int32 TAG\n\
        element edge 1\nproperty int a\nproperty int b\n\
        element vertex 8\nproperty double z\nproperty uchar red\nproperty list ushort short extra\nproperty float64 x\nproperty int16 quality\nproperty double y\n\
        end_header\n";
    let corners = CORNERS.lines().enumerate().map(|(k, line)| {
        let w: Vec<&str> = line.split(' ').collect();
        format!(
            "{} {} {} {} {} {}\n",
            w[2],
            30 * k,
            if k % 2 == 0 { "0" } else { "2 -1 5" },
            w[0],
            -100 * k as i32,
            w[1]
        )
    });
    let sides = SIDES
        .lines()
        .enumerate()
        .map(|(k, line)| format!("{} {line} 2 0.5 0.25 {}\n", 1000 * k, if k < 3 { 7 } else { -2 }));
    let faces: String = sides.collect();
    let vertices: String = corners.collect();
    text(&[head, "3 1 2 3 5\n0 -6\n", &faces, "1 2\n", &vertices])
}

#[test]
fn any_order_and_type_of_things_gives_the_mesh() {
    let plain = read(cube().as_bytes()).unwrap();
    assert_eq!((plain.report().volume, plain.report().faces, plain.report().closed), (1.0, 6, true));
    let mesh = read(everything().as_bytes()).unwrap();
    assert_eq!((mesh.vertices().len(), mesh.report().volume), (8, 1.0));
    let names: Vec<(&str, FieldType)> = mesh.vertex_fields().iter().map(|f| (f.name.as_str(), f.kind)).collect();
    assert_eq!(names, [("red", FieldType::U8), ("quality", FieldType::I16)]);
    for (v, p) in mesh.vertices().iter().enumerate() {
        let k = CORNERS.lines().position(|l| l == format!("{} {} {}", p.x, p.y, p.z)).unwrap() as f64;
        assert_eq!(mesh.vertex_fields()[0].item(v), [30.0 * k]);
        assert_eq!(mesh.vertex_fields()[1].item(v), [-100.0 * k]);
    }
    assert_eq!(mesh.face_fields()[0].values, [0.0, 1000.0, 2000.0, 3000.0, 4000.0, 5000.0]);
    assert_eq!((mesh.face_fields().len(), mesh.face_fields()[0].name.as_str()), (1, "material"));
    let tags: Vec<i32> = (0..6).map(|f| mesh.tag(f)).collect();
    assert_eq!((tags, mesh.tag_name(7)), (vec![7, 7, 7, -2, -2, -2], Some("the wall")));
}

#[test]
fn every_encoding_has_the_same_content() {
    for file in [cube(), everything()] {
        let wanted = described(&read(file.as_bytes()).unwrap());
        for big in [false, true] {
            assert_eq!(described(&read(&binary(&file.replace("\r\n", "\n"), big)).unwrap()), wanted);
        }
        assert_eq!(described(&read(file.replace("\r\n", "\n").replace('\n', "\r\n").as_bytes()).unwrap()), wanted);
        assert_eq!(described(&read(file.replace("\r\n", "\n").replace('\n', "\r").as_bytes()).unwrap()), wanted);
    }
}

/// Six values of each type, in the data of faces.
fn with_values(kinds: &[&str], values: [&str; 6]) -> String {
    let properties: String = kinds.iter().enumerate().map(|(k, kind)| format!("property {kind} p{k}\n")).collect();
    let sides: String =
        SIDES.lines().zip(values).map(|(side, x)| format!("{side}{}\n", format!(" {x}").repeat(kinds.len()))).collect();
    text(&[HEAD, &FACE.replace("end_header\n", &(properties + "end_header\n")), CORNERS, &sides])
}

#[test]
fn numbers_of_a_text_are_rounded_as_the_bytes_of_their_type() {
    let file = with_values(&["float", "double"], ["0.1", "-1e-40", "16777217", "nan", "-inf", "1e-60"]);
    let mesh = read(file.as_bytes()).unwrap();
    let [single, double] = mesh.face_fields() else { panic!("two fields") };
    assert_eq!((single.kind, double.kind), (FieldType::F32, FieldType::F64));
    assert_eq!(single.values[..3], [f64::from(0.1f32), f64::from(-1e-40f32), 16_777_216.0]);
    assert_eq!(double.values[..3], [0.1, -1e-40, 16_777_217.0]);
    assert!(single.values[3].is_nan() && single.values[4..] == [f64::NEG_INFINITY, 0.0]);
    let coordinates = file.replace("1 1 0\n", "1.1 1.1 0.3\n");
    for big in [false, true] {
        let wanted = described(&read(&binary(&coordinates.replace("nan", "0"), big)).unwrap());
        assert_eq!(described(&read(coordinates.replace("nan", "0").as_bytes()).unwrap()), wanted);
    }
    for (kind, value) in
        [("char", "128"), ("uchar", "-1"), ("short", "40000"), ("ushort", "0.5"), ("int", "3e9"), ("uint", "nan")]
    {
        let message = refused(with_values(&[kind], ["1", "2", "3", value, "5", "6"]).as_bytes());
        assert!(message.starts_with(&format!("line 22: \"{value}\" is not a number of the type ")), "{message}");
    }
}

#[test]
fn unsigned_integers_of_64_bits_never_become_negative() {
    let head = "element face 6\nproperty list uchar int vertex_indices\nproperty uint64 id\nend_header\n";
    for (largest, kind) in [(u64::MAX, FieldType::F64), (1 << 63, FieldType::F64), (1 << 62, FieldType::I64)] {
        let sides: String = SIDES.lines().map(|side| format!("{side} {largest}\n")).collect();
        let text = text(&[HEAD, head, CORNERS, &sides]);
        let files = [text.clone().into_bytes(), binary(&text, false), binary(&text, true)];
        for bytes in files {
            let mesh = read(&bytes).unwrap();
            assert_eq!((mesh.face_fields()[0].kind, mesh.face_fields()[0].values[5]), (kind, largest as f64));
        }
    }
    let negative = text(&[HEAD, head, CORNERS, &SIDES.replace('\n', " -1\n")]);
    assert_eq!(refused(negative.as_bytes()), "line 19: \"-1\" is not a number of the type UInt64");
}

#[test]
fn strips_are_cut_into_triangles_that_agree() {
    // The sides of a cube as one strip around, and its ends as two more in the same list.
    let strip = "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    let list = "20 0 4 1 5 2 6 3 7 0 4 -1 0 1 3 2 -1 4 7 5 6\n";
    let file = text(&[HEAD, strip, CORNERS, list]);
    for bytes in [file.clone().into_bytes(), binary(&file, false), binary(&file, true)] {
        let kept =
            io::read_memory(&bytes, Format::Ply, &MeshOptions { orient: Orient::Keep, ..MeshOptions::default() });
        let kept = kept.unwrap();
        assert_eq!((kept.report().faces, kept.report().closed), (12, true));
        assert!(kept.report().consistent, "{:?}", kept.report());
        assert_eq!(read(&bytes).unwrap().surface().volume, 1.0);
    }
    // Repeated corners join pieces without a -1.
    let joined = text(&[HEAD, strip, CORNERS, "10 0 1 3 2 2 4 4 5 7 6\n"]);
    assert_eq!(read(joined.as_bytes()).unwrap().report().faces, 2 + 2);
}

#[test]
fn faces_of_fewer_than_three_corners_keep_their_number() {
    let file = cube().replace("4 4 5 6 7\n", "2 4 5\n");
    let mesh = read(file.as_bytes()).unwrap();
    assert_eq!((mesh.face_count(), mesh.half_edges().face_of_input(1)), (6, None));
    assert_eq!(mesh.half_edges().input_face(1), 2);
}

fn painted(scale: f64) -> Mesh {
    let body = bodies::icosphere(1).scaled(scale).flipped_where(|t| t % 3 == 0);
    let tags: Vec<i32> = (0..body.triangles.len() as i32).map(|t| t % 4 - 1).collect();
    let mesh = body.mesh().with_tags(&tags, vec![(2, "a wall".into()), (-1, "Einlaß".into())]).unwrap();
    let n = mesh.vertices().len();
    let field = |name: &str, kind, components, scale: f64, n: usize| {
        let values = (0..n * components).map(|k| (k as f64 * scale).trunc() + 0.0).collect();
        Field { name: name.into(), kind, components, values }
    };
    let mesh = mesh.with_field(false, field("small", FieldType::I8, 1, -1.0, n)).unwrap();
    let mesh = mesh.with_field(false, field("the velocity", FieldType::F64, 3, 0.1, n)).unwrap();
    let mesh = mesh.with_field(true, field("a b", FieldType::F32, 1, 1.0, tags.len())).unwrap();
    mesh.with_field(true, field("pair", FieldType::I64, 2, -1e9, tags.len())).unwrap()
}

#[test]
fn what_is_written_reads_back_the_same() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("ply");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join("m.ply");
    let seams = {
        // Each side of a cube has data of its own at its corners.
        let mut file = cube();
        file = file
            .replace("element vertex 8", "element vertex 24")
            .replace("property float z\n", "property float z\nproperty float u\n");
        let corner = |v: &str| CORNERS.lines().nth(v.parse().unwrap()).unwrap().to_owned();
        let vertices: String = SIDES
            .lines()
            .enumerate()
            .flat_map(|(f, l)| l.split(' ').skip(1).map(move |v| format!("{} {f}\n", corner(v))))
            .collect();
        let sides: String =
            (0..6).map(|f| format!("4 {} {} {} {}\n", 4 * f, 4 * f + 1, 4 * f + 2, 4 * f + 3)).collect();
        read(file.replace(CORNERS, &vertices).replace(SIDES, &sides).as_bytes()).unwrap()
    };
    assert_eq!((seams.vertices().len(), seams.vertex_fields()[0].values.len()), (8, 24));
    for mesh in [painted(1.0), painted(1e-6), painted(1e3), seams, read(everything().as_bytes()).unwrap()] {
        io::write(&mesh, &path).unwrap();
        let kept = MeshOptions { orient: Orient::Keep, ..MeshOptions::default() };
        let back = io::read(&path, Format::Detect, &kept).unwrap();
        assert!(described(&back) == described(&mesh));
        assert_eq!(back.tag_names(), mesh.tag_names());
        let shape = |m: &Mesh| {
            m.vertex_fields()
                .iter()
                .chain(m.face_fields())
                .map(|f| (f.name.clone(), f.kind, f.components))
                .collect::<Vec<_>>()
        };
        assert_eq!(shape(&back), shape(&mesh));
    }
}

#[test]
fn files_that_are_wrong_are_refused_with_the_place() {
    let file = cube();
    for (from, to, wanted) in [
        ("format ascii 1.0\n", "", "no format was named"),
        ("format ascii 1.0\n", "format ascii 1.0\nformat ascii 1.0\n", "line 3: \"format ascii 1.0\" is no line"),
        ("format ascii", "format morse", "\"format morse 1.0\" is no line of a PLY header"),
        ("property float x", "property quad x", "line 4: \"property quad x\""),
        ("property float y", "property float x", "line 5: the property \"x\" is there already"),
        ("property float z\n", "", "it has no property z"),
        ("list uchar int vertex_indices", "list float int vertex_indices", "the count of a list is no integer"),
        ("list uchar int vertex_indices", "list uchar float vertex_indices", "it has no list of integers"),
        ("list uchar int vertex_indices", "list uchar int corners", "it has no list of integers"),
        ("element vertex 8", "element vertex 4000000000", "cannot hold 4000000000 items"),
        ("element vertex 8", "element vertex 99999999999999999999", "is no line of a PLY header"),
        ("element face 6", "element face 18446744073709551615", "cannot hold"),
        ("4 4 5 6 7", "4 4 5 6 8", "line 19: the index 8 of face 1 does not count one of 8 vertices"),
        ("4 4 5 6 7", "4 4 5 6 -7", "the index -7 of face 1"),
        ("4 4 5 6 7", "-4 4 5 6 7", "line 19: \"-4\" is not a number of the type UInt8"),
        ("4 4 5 6 7", "4 4 5.5 6 7", "line 19: \"5.5\" is not a number of the type Int32"),
        ("1 1 0\n", "1 1e39 0\n", "line 12: \"1e39\" is not a number of the type Float32"),
        ("1 1 0\n", "1 nan 0\n", "line 12: the coordinate NaN of vertex 2 is not finite"),
        ("1 1 0\n", "1 inf 0\n", "the coordinate inf"),
        ("1 1 0\n", "1 one 0\n", "line 12: \"one\" is not a number"),
        ("element face 6", "element face 0", "has no face of three corners"),
        ("element vertex 8\n", "", "line 3: the property \"x\" has no element"),
    ] {
        assert!(file.contains(from), "{from}");
        let message = refused(file.replacen(from, to, 1).as_bytes());
        assert!(message.contains(wanted), "{from} -> {to}: {message}");
    }
    for (count, wanted) in [("-4", "cannot hold a list of -4"), ("4000000", "cannot hold a list of 4000000")] {
        let file = file.replace("list uchar", "list int").replace("4 4 5 6 7", &format!("{count} 4 5 6 7"));
        assert!(refused(file.as_bytes()).contains(wanted));
    }
    let other = io::read_memory(file.replacen("ply", "plx", 1).as_bytes(), Format::Ply, &MeshOptions::default());
    assert_eq!(other.unwrap_err().message(), "line 1: \"plx\" is not \"ply\"");
    assert!(refused(b"ply\n").contains("the file ends within the PLY header"));
    // A cut after which nothing is missing: white space at the end.
    for length in 4..file.trim_end().len() - 1 {
        refused(&file.as_bytes()[..length]);
    }
    for big in [false, true] {
        let bytes = binary(&everything().replace("\r\n", "\n"), big);
        (4..bytes.len()).for_each(|length| _ = refused(&bytes[..length]));
        assert!(read(&[bytes, b"more".to_vec()].concat()).is_ok(), "bytes behind the last item");
    }
}

#[test]
fn names_that_ply_cannot_keep_apart_are_refused_when_written() {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("clash.ply");
    let mesh = bodies::icosphere(0).mesh();
    let field =
        |name: &str, n: usize| Field { name: name.into(), kind: FieldType::F64, components: 1, values: vec![1.0; n] };
    let both = mesh.with_field(false, field("a b", 12)).unwrap().with_field(false, field("a_b", 12)).unwrap();
    let own = [
        mesh.with_field(false, field("X", 12)),
        mesh.with_field(true, field("vertex_indices", 20)),
        mesh.with_field(true, field("tag", 20)),
    ];
    for mesh in own.into_iter().map(Result::unwrap).chain([both]) {
        assert_eq!(io::write(&mesh, &path).unwrap_err().status(), Status::Unsupported);
    }
}

#[test]
fn elements_that_would_mix_up_data_are_refused() {
    let strips = "element tristrips 1\nproperty list int int vertex_indices\n";
    let file = cube()
        .replace("end_header\n", "property int mark\nend_header\n")
        .replace("element face", &format!("{strips}element face"));
    assert_eq!(read(file.as_bytes()).unwrap_err().status(), Status::Unsupported);
    let twice = cube().replace("end_header\n", "element face 1\nproperty list int int vertex_indices\nend_header\n");
    assert_eq!(refused(twice.as_bytes()), "line 9: element face: it is there twice");
    // A line feed as the first byte behind a header of CR alone is the first number's.
    let big = binary(&cube().replace("0 0 0\n", "8 0 0\n").replace("float", "double"), false);
    let split = big.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    let mut bytes: Vec<u8> = big[..split].iter().map(|b| if *b == b'\n' { b'\r' } else { *b }).collect();
    bytes.extend(&big[split..]);
    bytes[split] = b'\n';
    assert!(read(&bytes).is_ok());
}

#[test]
fn large_strips_joined_by_triangles_without_area_are_read() {
    // Three columns of points, a ribbon of one long strip: half of its triangles only turn its corners.
    let rows = 60_000u32;
    let mut xyz = Vec::new();
    for k in 0..rows {
        (0..3).for_each(|i| xyz.extend([i as f32, k as f32, 0.0].map(f32::to_le_bytes).concat()));
    }
    let mut strip = Vec::new();
    for k in 0..rows - 1 {
        let row: Vec<u32> = (0..3).flat_map(|i| [3 * (k + 1) + i, 3 * k + i]).collect();
        strip.extend([row[0]].iter().chain(&row).chain(&row[5..]).flat_map(|v| (*v as i32).to_le_bytes()));
    }
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n",
        3 * rows
    );
    let length = (strip.len() as i32 / 4).to_le_bytes().to_vec();
    let mesh = read(&[header.into_bytes(), xyz, length, strip].concat()).unwrap();
    assert_eq!((mesh.report().faces, mesh.report().boundary_edges), (4 * (rows as usize - 1), 2 * (rows as usize + 1)));
}
