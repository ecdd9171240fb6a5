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
fn data_of_strips_stay_in_proportion_to_the_file() {
    let points: Vec<[f64; 3]> = (0..100).map(|k| [f64::from(k), f64::from(k % 2), 0.0]).collect();
    let strip: Vec<u32> = (0..20_000).map(|k| k % 100).collect();
    let with = |components| {
        let cell_data = vec![Array::new("x", "Int8", components, &vec![1.0; components])];
        let strips = vec![strip.clone()];
        file(Style::new(Form::AppendedRaw), &[Piece { points: points.clone(), strips, cell_data, ..Piece::default() }])
    };
    assert_eq!(mesh(&with(2)).face_fields()[0].values.len(), 2 * 19_998);
    let message = refused_with(&with(1000), Status::Unsupported);
    assert_eq!(
        message,
        "array \"x\": 19998000 values of the triangles of strips are too many for 163404 bytes of data"
    );
}
