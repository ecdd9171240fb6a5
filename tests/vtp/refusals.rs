// SPDX-License-Identifier: MIT OR Apache-2.0
//! What is not read: one line that names the place, the array and the value.

use super::*;

/// The message for the text of one triangle in which `from` became `to`.
fn changed(from: &str, to: &str) -> String {
    let plain = text(&triangle());
    assert!(plain.contains(from), "{from}");
    refused(plain.replace(from, to).as_bytes())
}

fn assert_refused(from: &str, to: &str, wanted: &str) {
    let message = changed(from, to);
    assert!(message.contains(wanted), "{from} -> {to}: {message}");
}

#[test]
fn other_data_sets_and_compressors_are_unsupported() {
    let plain = text(&triangle());
    let with = |from: &str, to: &str| refused_with(plain.replace(from, to).as_bytes(), Status::Unsupported);
    assert_eq!(with("\"PolyData\"", "\"ImageData\""), "offset 22: <VTKFile>: type: \"ImageData\" is not PolyData");
    assert!(
        with("\"PolyData\"", "\"UnstructuredGrid\"")
            .ends_with("is not PolyData; extract its surface first (vtkGeometryFilter, in ParaView Extract Surface)")
    );
    assert_eq!(with("type=\"PolyData\"", ""), "offset 22: <VTKFile>: type: \"\" is not PolyData");
    for name in ["vtkLZ4DataCompressor", "vtkLZMADataCompressor"] {
        let wanted = format!("offset 22: <VTKFile>: compressor: {name} is not zlib");
        assert_eq!(with("version=\"1.0\" byte", &format!("compressor=\"{name}\" byte")), wanted);
    }
}

#[test]
fn what_is_not_the_xml_of_vtk_is_refused_with_its_offset() {
    for (text, wanted) in [
        ("<?xml", "offset 0: no \"?>\" ends this"),
        ("<?xml ?><!-- ", "offset 8: no \"-->\" ends this"),
        ("<?xml ?><a>", "offset 0: the first tag is not <VTKFile>"),
        ("<?xml ?><!DOCTYPE a [<!ENTITY b \"c\">]>", "offset 8: \"<!DOCTYPE\" is not a tag of VTK"),
        ("<VTKFile type=\"Poly", "offset 0: the file ends within this tag"),
        ("<VTKFile type=\"PolyData\">", "offset 25: the file ends within <VTKFile>"),
        ("<VTKFile type=\"PolyData\"></VTKFile>", "offset 35: the file ends without a polygon"),
        ("<VTKFile type=\"PolyData\"/>", "offset 0: the first tag is not <VTKFile>"),
        ("<VTKFile type=\"PolyData\" byte_order=\"x\">", "byte_order: \"x\" is neither LittleEndian nor BigEndian"),
        ("<VTKFile type=\"PolyData\" header_type=\"x\">", "header_type: \"x\" is neither UInt32 nor UInt64"),
        ("<VTKFile type=\"PolyData\"><a></b>", "offset 32: </b> closes another element"),
        ("<VTKFile type=\"PolyData\">< a>", "offset 25: a tag has no name"),
        ("<VTKFile type=PolyData>", "<VTKFile>: \"type=PolyData\" is not an attribute"),
    ] {
        let message = refused(text.as_bytes());
        assert!(message.contains(wanted), "{text}: {message}");
    }
    let deep = format!("<VTKFile type=\"PolyData\">{}", "<a>".repeat(100_000));
    assert!(refused(deep.as_bytes()).ends_with("<a>: elements nest deeper than 32"));
}

#[test]
fn counts_that_lie_are_refused_before_anything_is_reserved() {
    assert_refused("NumberOfPoints=\"3\"", "NumberOfPoints=\"4\"", "line 12: array \"Points\": 9 numbers, not 12");
    assert_refused("NumberOfPoints=\"3\"", "NumberOfPoints=\"2\"", "line 11: array \"Points\": more than 6 numbers");
    assert_refused("NumberOfPoints=\"3\"", "NumberOfPoints=\"9999999999999\"", "9 numbers, not 29999999999997");
    assert_refused("NumberOfPoints=\"3\"", "NumberOfPoints=\"18446744073709551615\"", "are too many");
    assert_refused("NumberOfPoints=\"3\"", "NumberOfPoints=\"-3\"", "<Piece>: NumberOfPoints: \"-3\" is not a count");
    assert_refused(
        "NumberOfVerts=\"0\"",
        "NumberOfVerts=\"4000000000\"",
        "array \"offsets\": 0 numbers, not 4000000000",
    );
    assert_refused("NumberOfLines=\"0\"", "NumberOfLines=\"1\"", "array \"offsets\": 0 numbers, not 1");
    assert_refused("NumberOfPolys=\"1\"", "NumberOfPolys=\"0\"", "the file ends without a polygon");
    assert_refused("NumberOfPolys=\"1\"", "NumberOfPolys=\"2\"", "array \"offsets\": 1 numbers, not 2");
    assert_refused("<Points>", "<PointsX>", "</Points> closes another element");
    assert_refused("Points\" NumberOfComponents=\"3\"", "P\"", "array \"P\": 1 components, not 3");
    assert_refused("Components=\"3\"", "Components=\"0\"", "NumberOfComponents: 0 is not at least 1");
    assert_refused("type=\"Float64\"", "type=\"Float16\"", "array \"Points\": type: \"Float16\" is no type of numbers");
    assert_refused("format=\"ascii\"", "format=\"hex\"", "format: \"hex\" is none of ascii, binary, appended");
    assert_refused("format=\"ascii\"", "format=\"appended\"", "offset: 0 is beyond the appended data");
}

#[test]
fn points_and_corners_are_checked() {
    assert_refused("0 0 0 1 0 0", "0 0 0 nan 0 0", "array \"Points\": point 1: NaN is not a finite coordinate");
    assert_refused("0 0 0 1 0 0", "0 0 0 1 0 1e101", "array \"Points\": point 1: 1");
    assert_refused("0 0 0 1 0 0", "0 0 0 1 0 x", "line 11: array \"Points\": \"x\" is not a number");
    assert_refused("0 1 2 ", "0 1 3 ", "array \"connectivity\": item 2: 3 is not one of the 3 points");
    assert_refused("0 1 2 ", "0 -1 2 ", "item 1: -1 is not one of the 3 points");
    assert_refused("0 1 2 ", "0 1.5 2 ", "\"1.5\" is not a number of the type Int64");
    let reals = text(&triangle()).replace("\"Int64\"", "\"Float32\"").replace("\"Int32\"", "\"Float32\"");
    for (from, to, wanted) in [
        ("0 1 2 ", "0 1.5 2 ", "item 1: 1.5 is not one of the 3 points"),
        ("0 1 2 ", "0 nan 2 ", "item 1: NaN is not one of the 3 points"),
        ("          3 \n", "          1e30 \n", "cell 0 ends at 1"),
        ("          3 \n", "          2.5 \n", "cell 0 ends at 2.5"),
    ] {
        let message = refused(reals.replace(from, to).as_bytes());
        assert!(message.contains(wanted), "{from} -> {to}: {message}");
    }
    assert_refused("0 1 2 ", "0 nan 2 ", "\"nan\" is not a number of the type Int64");
    assert_refused("          3 \n", "          -3 \n", "array \"offsets\": cell 0 ends at -3, the one before at 0");
    assert_refused("          3 \n", "          1e300 \n", "\"1e300\" is not a number of the type Int32");
    assert_refused("          3 \n", "          2.5 \n", "\"2.5\" is not a number of the type Int32");
    assert_refused("          3 \n", "          4 \n", "array \"connectivity\": 3 numbers, not 4");
    assert_refused("Name=\"offsets\"", "Name=\"ends\"", "<Piece>: Polys have no array \"offsets\"");
    assert_refused("Name=\"connectivity\"", "Name=\"x\"", "<Piece>: Polys have no array \"connectivity\"");
}

#[test]
fn pieces_with_other_data_are_refused() {
    let with = |arrays: &[Array]| Piece { point_data: arrays.to_vec(), ..triangle() };
    let array = |name, kind, components| Array::new(name, kind, components, &vec![1.0; 3 * components]);
    let a = array("a", "Int8", 1);
    for (second, wanted) in [
        (vec![], "no array \"a\", which the pieces before have"),
        (vec![a.clone(), array("b", "Int8", 1)], "array \"b\": the pieces before have no such array"),
        (vec![array("a", "Int8", 2)], "array \"a\": 2 components, 1 in the pieces before"),
        (vec![array("a", "Int16", 1)], "array \"a\": values of I16, I8 in the pieces before"),
        (vec![a.clone(), a.clone()], "array \"a\": an array of this name is there already"),
    ] {
        let message = refused(&file(ASCII, &[with(std::slice::from_ref(&a)), with(&second)]));
        assert!(message.contains(wanted), "{message}");
    }
    let twice = refused(&file(ASCII, &[with(&[a.clone(), a])]));
    assert!(twice.contains("an array of this name is there already"), "{twice}");
}

#[test]
fn arrays_may_not_read_the_same_bytes_again_and_again() {
    let points: Vec<[f64; 3]> = (0..1000).map(|k| [f64::from(k), f64::from(k % 7), f64::from(k % 3)]).collect();
    let point_data = vec![Array::new("p", "Float64", 1, &vec![1.0; 1000])];
    for style in [Style::new(Form::AppendedRaw), Style::new(Form::AppendedBase64)] {
        let piece = Piece {
            points: points.clone(),
            polys: vec![vec![0, 1, 2]],
            point_data: point_data.clone(),
            ..Piece::default()
        };
        let bytes = file(style, &[piece]);
        let (begin, end) =
            (position(&bytes, b"<DataArray type=\"Float64\" Name=\"p\""), position(&bytes, b"</PointData>"));
        let tag = String::from_utf8(bytes[begin..end].to_vec()).unwrap();
        let with = |count: usize| {
            let copies: String = (0..count).map(|k| tag.replace("\"p\"", &format!("\"q{k}\""))).collect();
            [&bytes[..begin], copies.as_bytes(), &bytes[begin..]].concat()
        };
        assert_eq!(mesh(&with(0)).vertex_fields().len(), 1);
        let message = refused_with(&with(20), Status::Unsupported);
        assert!(message.contains(": array \"q") && message.contains("\": data are shared: "), "{message}");
    }
}

fn position(bytes: &[u8], part: &[u8]) -> usize {
    bytes.windows(part.len()).position(|w| w == part).expect("it is there")
}

#[test]
fn names_of_tags_must_fit_their_numbers() {
    let with = |from: &str, to: &str| {
        let mut vtp = Vtp::new(ASCII);
        vtp.tag_names(&[(11, "a"), (22, "b")]);
        vtp.piece(&triangle());
        let text = String::from_utf8(vtp.finish()).unwrap();
        assert!(text.contains(from));
        read(text.replace(from, to).as_bytes())
    };
    let names = |from: &str, to: &str| with(from, to).unwrap().tag_names().to_vec();
    assert_eq!(names("97 0 98 0", "97 0 0"), [(11, "a".to_owned())]);
    assert_eq!(names("11 22 ", "22 22 "), [(22, "a".to_owned())]);
    assert_eq!(names("\"tag_names\"", "\"names\""), []);
    let message = |from: &str, to: &str| with(from, to).unwrap_err().message().to_owned();
    assert!(message("97 0 98 0", "97 0").ends_with("array \"tag_names\": 1 names of 2 tags"));
    assert!(message("11 22 ", "11 2.5 ").ends_with("\"2.5\" is not a number of the type Int32"));
    let wide = "\"Float64\" Name=\"tag_numbers\" NumberOfComponents=\"1\" NumberOfTuples=\"2\" format=\"ascii\">2.5 7</DataArray>\
                <DataArray type=\"Int8\" Name=\"x\"";
    let named = message("\"Int32\" Name=\"tag_numbers\"", wide);
    assert!(named.ends_with("\"a\" is the name of 2.5, which is no tag"), "{named}");
    assert!(message("11 22 ", "11 22 3 ").contains("array \"tag_numbers\": more than 2 numbers"));
}

/// The head of a file whose one array of points has these data.
fn points(style: Style, packed: &[u8]) -> Vec<u8> {
    let order = if style.big_endian { "Big" } else { "Little" };
    let header = if style.wide { 64 } else { 32 };
    let compressor = if style.block > 0 { "compressor=\"vtkZLibDataCompressor\"" } else { "" };
    let head = format!(
        "<VTKFile type=\"PolyData\" byte_order=\"{order}Endian\" header_type=\"UInt{header}\" {compressor}><PolyData>\
         <Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float64\" Name=\"p\" \
         NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points></Piece></PolyData>\
         <AppendedData encoding=\"raw\">_"
    );
    [head.as_bytes(), packed].concat()
}

#[test]
fn sizes_that_lie_are_refused_before_anything_is_reserved() {
    let narrow = Style::new(Form::AppendedRaw);
    let wide = Style { wide: true, ..narrow };
    let zlib = Style { block: 72, ..narrow };
    let words = |words: &[u32]| words.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<u8>>();
    let good = zlib.packed(&[0; 72]);
    let mut wrong_sum = good.concat();
    *wrong_sum.last_mut().unwrap() ^= 1;
    for (style, packed, wanted) in [
        (narrow, words(&[]), "offset 281: array \"p\": 4 bytes, of which 0 can be there"),
        (narrow, words(&[71]), "71 bytes, not 72"),
        (narrow, words(&[u32::MAX]), "4294967295 bytes, not 72"),
        (narrow, words(&[72, 0]), "72 bytes, of which 4 can be there"),
        (wide, words(&[u32::MAX, u32::MAX]), "18446744073709551615 bytes, not 72"),
        (zlib, words(&[0]), "0 bytes, not 72"),
        (zlib, words(&[1, 72]), "8 bytes, of which 4 can be there"),
        (zlib, words(&[u32::MAX, 0, 72]), "of which 0 can be there"),
        (zlib, words(&[2, 72, 0, 1, 1]), "144 bytes, not 72"),
        (zlib, words(&[1, 72, 0, 100]), "72 bytes in 100 of zlib, of which 0 can be there"),
        (zlib, words(&[2, u32::MAX, 72, 1, 1]), "4294967367 bytes, not 72"),
        (zlib, words(&[1, 72, 0, 4, 0]), "block 0: zlib gives no 72 bytes"),
        (
            zlib,
            [words(&[1, 72, 0, good[1].len() as u32 - 1]), good[1].clone()].concat(),
            "block 0: zlib gives no 72 bytes",
        ),
        (zlib, Style { block: 72, ..narrow }.packed(&[0; 71]).concat(), "71 bytes, not 72"),
        (
            zlib,
            [words(&[1, 72, 0, good[1].len() as u32]), zlib.packed(&[0; 71])[1].clone(), vec![0; 9]].concat(),
            "zlib gives 71 bytes",
        ),
        (zlib, wrong_sum, "block 0: zlib gives no 72 bytes: Adler32Mismatch"),
    ] {
        let message = refused(&points(style, &packed));
        assert!(message.contains(wanted), "{wanted}: {message}");
    }
    // With all zeros read the points are there, and the next array is missing.
    assert!(refused(&points(zlib, &good.concat())).contains("Polys have no array \"offsets\""));
}

#[test]
fn a_small_file_cannot_claim_large_data() {
    let zlib = Style { block: 1 << 20, wide: true, ..Style::new(Form::AppendedRaw) };
    let words: Vec<u8> = [1u64, 1 << 40, 0, 8].iter().flat_map(|w| w.to_le_bytes()).chain([0; 8]).collect();
    let bytes = points(zlib, &words);
    let many = String::from_utf8_lossy(&bytes).replace("NumberOfPoints=\"3\"", "NumberOfPoints=\"45812984490\"");
    let message = refused(many.replace('\u{fffd}', "").as_bytes());
    assert!(message.contains("bytes, not 1099511627760"), "{message}");
    let many = many.replace("Float64", "Int8").replace("\"45812984490\"", "\"366503875925\"");
    let message = refused(many.as_bytes());
    assert!(message.contains("bytes, not 1099511627775"), "{message}");
}

#[test]
fn appended_data_begin_with_an_underscore() {
    let bytes = rich(Style::new(Form::AppendedBase64));
    let text = String::from_utf8(bytes).unwrap();
    assert!(
        refused(text.replace("   _", "   ").as_bytes()).ends_with("no underscore where the appended data should begin")
    );
    let message = refused(text.replace("\"base64\"", "\"hex\"").as_bytes());
    assert!(message.ends_with("<AppendedData>: encoding: \"hex\" is neither base64 nor raw"), "{message}");
    assert!(
        refused(text.replace("offset=\"0\"", "offset=\"999999\"").as_bytes()).contains("is beyond the appended data")
    );
    assert_eq!(mesh(text.replace(" encoding=\"base64\"", "").as_bytes()).face_count(), 11);
}

#[test]
fn a_file_cut_at_any_byte_is_refused_unless_all_data_are_there() {
    for style in Style::all().into_iter().filter(|s| !s.big_endian) {
        let whole = rich(style);
        let wanted = mesh(&whole);
        let mut whole_data = 0;
        for cut in 0..whole.len() {
            match read(&whole[..cut]) {
                Ok(mesh) => {
                    same::assert_same(&mesh, &wanted);
                    whole_data += 1;
                }
                Err(e) => {
                    assert!(matches!(e.status(), Status::Parse | Status::Unsupported), "{cut}: {e}");
                    assert!(!e.message().contains(['\n', '\r']), "{cut}: {e}");
                }
            }
        }
        // Behind the last byte of data come nothing but closing tags.
        assert!(whole_data < 40, "{style:?}: {whole_data}");
    }
}
