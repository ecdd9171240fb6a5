// SPDX-License-Identifier: MIT OR Apache-2.0
//! Named data, tags and their names.

use super::*;

#[test]
fn data_keep_name_type_and_components() {
    let mesh = mesh(&rich(ASCII));
    let points: Vec<_> = mesh.vertex_fields().iter().map(|f| (f.name.as_str(), f.kind, f.components)).collect();
    assert_eq!(points, [("temperature", FieldType::F32, 1), ("wind", FieldType::F64, 3)]);
    let faces: Vec<_> = mesh.face_fields().iter().map(|f| (f.name.as_str(), f.kind, f.components)).collect();
    assert_eq!(faces, [("id", FieldType::U16, 1)]);
    // Each of the four triangles of the strip has its cell's.
    assert_eq!(mesh.face_fields()[0].values, [1.0, 2.0, 3.0, 4.0, 4.0, 4.0, 4.0, 5.0, 6.0, 7.0, 65535.0]);
}

#[test]
fn cell_data_tag_are_the_tags_and_field_data_name_them() {
    for style in Style::all() {
        let mesh = mesh(&rich(style));
        let tags: Vec<i32> = (0..11).map(|f| mesh.tag(f)).collect();
        assert_eq!(tags, [9, 9, 9, 7, 7, 7, 7, 3, 3, 7, 3]);
        assert_eq!(mesh.tag_names(), [(3, "hot wall".to_owned()), (7, "inlet".to_owned())]);
    }
}

#[test]
fn only_one_integer_a_cell_is_a_tag() {
    let with = |kind, components, values: &[f64]| {
        let piece = Piece { cell_data: vec![Array::new("tag", kind, components, values)], ..triangle() };
        let mesh = mesh(&file(ASCII, &[piece]));
        (mesh.tag(0), mesh.face_fields().len())
    };
    assert_eq!(with("Int64", 1, &[-5.0]), (-5, 0));
    assert_eq!(with("UInt8", 1, &[200.0]), (200, 0));
    assert_eq!(with("Int32", 1, &[0.0]), (0, 0));
    assert_eq!(with("Float64", 1, &[5.0]), (0, 1));
    assert_eq!(with("Int32", 2, &[5.0, 6.0]), (0, 1));
    assert_eq!(with("Int64", 1, &[3e9]), (0, 1));
}

#[test]
fn strings_bits_and_arrays_without_a_name_are_left_out() {
    let others = "<PointData><Array type=\"String\" Name=\"label\" format=\"ascii\">97 0 0 0</Array>\
                  <DataArray type=\"Bit\" Name=\"mask\" format=\"ascii\">1 0 1</DataArray>\
                  <DataArray type=\"Int8\" format=\"ascii\">1 2 3</DataArray>\
                  <DataArray type=\"Int8\" Name=\"kept\" format=\"ascii\">1 2 3</DataArray>";
    let mesh = mesh(text(&triangle()).replace("<PointData>", others).as_bytes());
    assert_eq!(mesh.vertex_fields().iter().map(|f| f.name.as_str()).collect::<Vec<_>>(), ["kept"]);
}

#[test]
fn names_have_no_references_and_no_ends_of_lines() {
    // VTK does not write references for all that would need them.
    for (name, wanted) in [("rgb <&>", "rgb <&>"), ("&#xd800;&;&x", "&#xd800;&;&x"), ("a&&amp;", "a&&")] {
        let array = format!("<PointData><DataArray type=\"Int8\" Name=\"{name}\">1 2 3</DataArray>");
        let mesh = mesh(text(&triangle()).replace("<PointData>", &array).as_bytes());
        assert_eq!(mesh.vertex_fields()[0].name, wanted);
    }
    let array = "<PointData><DataArray type=\"Int8\" Name=\" &lt;p&gt; &amp;&quot;&apos;&#10;&#956; \" format=\"ascii\">1 2 3</DataArray>";
    let mesh = mesh(text(&triangle()).replace("<PointData>", array).as_bytes());
    assert_eq!(mesh.vertex_fields()[0].name, "<p> &\"' \u{3bc}");
}

#[test]
fn values_that_are_no_numbers_are_data_too() {
    let array = "<PointData><DataArray type=\"Float32\" Name=\"x\">nan -inf +Inf</DataArray>";
    let mesh = mesh(text(&triangle()).replace("<PointData>", array).as_bytes());
    let values = &mesh.vertex_fields()[0].values;
    assert!(values[0].is_nan() && values[1..] == [f64::NEG_INFINITY, f64::INFINITY]);
}

#[test]
fn numbers_of_a_text_are_rounded_as_the_bytes_of_their_type() {
    let with = |kind: &str, values: &str| {
        let array = format!("<PointData><DataArray type=\"{kind}\" Name=\"x\">{values}</DataArray>");
        text(&triangle()).replace("<PointData>", &array)
    };
    assert_eq!(
        mesh(with("Float32", "0.1 16777217 -1e-60").as_bytes()).vertex_fields()[0].values,
        [f64::from(0.1f32), 16_777_216.0, 0.0]
    );
    let large = mesh(with("UInt64", "18446744073709551615 0 1").as_bytes());
    assert_eq!((large.vertex_fields()[0].kind, large.vertex_fields()[0].values[0]), (FieldType::F64, 2f64.powi(64)));
    for (kind, value) in [("Int8", "128"), ("UInt8", "-1"), ("Int64", "0.5"), ("UInt32", "nan"), ("Float32", "1e39")] {
        let message = refused(with(kind, &format!("1 {value} 3")).as_bytes());
        assert!(
            message.ends_with(&format!("array \"x\": \"{value}\" is not a number of the type {kind}")),
            "{message}"
        );
    }
}

#[test]
fn strings_of_a_text_are_signed_or_unsigned_bytes() {
    let with = |bytes: &str| {
        let names = format!(
            "<PolyData><FieldData><DataArray type=\"Int32\" Name=\"tag_numbers\" NumberOfTuples=\"2\">4 2</DataArray>\
             <Array type=\"String\" Name=\"tag_names\" NumberOfTuples=\"2\" format=\"ascii\">{bytes}</Array></FieldData>"
        );
        text(&triangle()).replace("<PolyData>", &names)
    };
    for bytes in ["-61 -87 0 97 10 98 0", "195 169 0 97 10 98 0"] {
        assert_eq!(mesh(with(bytes).as_bytes()).tag_names(), [(2, "a b".to_owned()), (4, "é".to_owned())]);
    }
    for bytes in ["97 0 256 0", "97 0 -129 0"] {
        assert!(refused(with(bytes).as_bytes()).ends_with(" is not a byte of a string"));
    }
    assert!(refused(with("97 0 0.5 0").as_bytes()).ends_with("\"0.5\" is not a number of the type Int16"));
}

#[test]
fn data_of_strips_stay_in_proportion_to_the_file() {
    let points: Vec<[f64; 3]> = (0..100).map(|k| [f64::from(k), f64::from(k % 2), 0.0]).collect();
    let strip: Vec<u32> = (0..20_000).map(|k| k % 100).collect();
    let with = |components| {
        let cell_data = vec![Array::new("x", "Int8", components, &vec![1.0; components])];
        let strips = vec![strip.clone()];
        file(Style::new(Form::AppendedRaw), &[Piece { points: points.clone(), strips, cell_data, ..Piece::default() }])
    };
    assert_eq!(mesh(&with(2)).face_fields()[0].values.len(), 2 * 19_998);
    let wide = with(1000);
    assert_eq!(
        refused_with(&wide, Status::Unsupported),
        format!(
            "array \"x\": 19998000 values of the triangles of strips are too many for {} bytes of data",
            wide.len()
        )
    );
}
