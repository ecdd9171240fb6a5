// SPDX-License-Identifier: MIT OR Apache-2.0
//! A file is the same mesh in every encoding.

use super::*;

#[test]
fn every_encoding_gives_the_same_mesh_to_the_bit() {
    let wanted = mesh(&rich(ASCII));
    assert!(wanted.report().closed && wanted.report().consistent && wanted.report().volume == 1.0);
    let styles = Style::all();
    assert_eq!(styles.len(), 37);
    for style in styles {
        same::assert_same(&mesh(&rich(style)), &wanted);
    }
}

#[test]
fn large_arrays_of_many_blocks_are_read_whole() {
    let soup = bodies::torus(2.0, 0.5, 60, 40);
    let wanted = soup.mesh_kept();
    for block in [0, 999, 32768] {
        for form in [Form::Binary, Form::AppendedRaw, Form::AppendedBase64] {
            let style = Style { form, big_endian: false, wide: true, block };
            same::assert_same(&mesh(&file(style, &[Piece::of(&soup)])), &wanted);
        }
    }
}

#[test]
fn every_type_of_numbers_is_read_in_both_byte_orders() {
    let types = [
        ("Int8", FieldType::I8, [-128.0, 127.0]),
        ("UInt8", FieldType::U8, [0.0, 255.0]),
        ("Int16", FieldType::I16, [-32768.0, 32767.0]),
        ("UInt16", FieldType::U16, [0.0, 65535.0]),
        ("Int32", FieldType::I32, [-2147483648.0, 2147483647.0]),
        ("UInt32", FieldType::U32, [0.0, 4294967295.0]),
        ("Int64", FieldType::I64, [-9007199254740992.0, 9007199254740992.0]),
        ("UInt64", FieldType::I64, [0.0, 9007199254740992.0]),
        ("UInt64", FieldType::F64, [0.0, 18446744073709547520.0]),
        ("Float32", FieldType::F32, [-1.5e-45, 3.4028234663852886e38]),
        ("Float64", FieldType::F64, [-5e-324, 1.7976931348623157e308]),
    ];
    for (kind, read_as, [a, b]) in types {
        let values = [a, b, 1.0].map(|x| if kind == "Float32" { f64::from(x as f32) } else { x });
        let piece = Piece { point_data: vec![Array::new("x", kind, 1, &values)], ..triangle() };
        for style in Style::all() {
            let mesh = mesh(&file(style, std::slice::from_ref(&piece)));
            let field = &mesh.vertex_fields()[0];
            assert_eq!((field.kind, &field.values[..]), (read_as, &values[..]), "{kind} {style:?}");
        }
    }
}

#[test]
fn text_comes_with_any_white_space_and_line_ends() {
    let wanted = mesh(&rich(ASCII));
    let plain = String::from_utf8(rich(ASCII)).unwrap();
    for text in [
        plain.replace('\n', "\r\n"),
        plain.replace("> ", ">\t \n\n"),
        plain.replace(" Name", "\n   Name").replace("=\"", " = \""),
        plain.replace("<Piece", "<!-- <Piece NumberOfPoints=\"9\"> - -> --><?pi > ?><Piece"),
        format!("\u{feff}{plain}"),
        plain.replace('"', "'"),
        plain.replace("inlet", "&#105;nlet").replace("\"id\"", "\"&#x69;d\""),
        plain.replace("</Piece>", "<Unknown a=\"&\"><DataArray/></Unknown></Piece><Piece></Piece>"),
        plain.replace("<?xml version=\"1.0\"?>\n", ""),
        plain.trim_end().to_owned() + "\n<!-- no end",
    ] {
        same::assert_same(&mesh(text.as_bytes()), &wanted);
    }
}

#[test]
fn base64_comes_in_lines_and_with_the_size_encoded_by_itself() {
    let style = Style::new(Form::Binary);
    let wanted = mesh(&rich(style));
    let plain = String::from_utf8(rich(style)).unwrap();
    let mut lines = String::new();
    let mut within = false;
    for c in plain.chars() {
        within = within && c != '<' || c == '>';
        lines.push(c);
        if within && c.is_alphanumeric() {
            lines.push_str("\r\n ");
        }
    }
    same::assert_same(&mesh(lines.as_bytes()), &wanted);

    let [packed, _] = style.packed(&[0u8, 0, 128, 63].repeat(3));
    let by_itself = base64(&packed[..4]) + &base64(&packed[4..]);
    assert_ne!(by_itself, base64(&packed));
    for data in [by_itself, base64(&packed)] {
        let array = format!("<PointData><DataArray type=\"Float32\" Name=\"x\" format=\"binary\">{data}</DataArray>");
        let text = text(&triangle()).replace("<PointData>", &array);
        assert_eq!(mesh(text.as_bytes()).vertex_fields()[0].values, [1.0; 3]);
    }
}

#[test]
fn information_of_arrays_is_not_their_data() {
    let key = "<InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" length=\"2\"><Value index=\"0\"> 0 \
               </Value></InformationKey></DataArray>";
    for form in [Form::Ascii, Form::Binary] {
        let plain = String::from_utf8(rich(Style::new(form))).unwrap();
        same::assert_same(&mesh(plain.replace("</DataArray>", key).as_bytes()), &mesh(plain.as_bytes()));
    }
}

#[test]
fn raw_data_may_look_like_tags() {
    // 0x3c is '<': the bytes of this coordinate are "<<<<<<<<".
    let x = f64::from_bits(0x3c3c_3c3c_3c3c_3c3c);
    let mut piece = triangle();
    piece.points[1][0] = x;
    let bytes = file(Style::new(Form::AppendedRaw), &[piece]);
    assert_eq!(mesh(&bytes).vertices()[1].x, x);
}
