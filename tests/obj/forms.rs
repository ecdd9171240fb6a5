// SPDX-License-Identifier: MIT OR Apache-2.0
//! The forms in which the statements of OBJ come.

use super::*;

const TRIANGLE: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];

#[test]
fn every_form_of_a_corner_names_the_same_vertex() {
    for face in [
        "f 1 2 3",
        "f 1/1 2/2 3/3",
        "f 1//1 2//2 3//3",
        "f 1/4/1 2/5/2 3/6/3",
        "f 1/ 2/ 3/",
        "f 1// 2// 3//",
        "f 1/-1 2/-2/-3 3//-1",
        "f -4 -3 -2",
        "f -4/-1/-1 2 -2//7",
        "fo 1 2 3",
        "F 1 2 3",
        "  f\t1\x0b2 \x0c 3  ",
        "f 1 2 3 \\",
        "f 1 2 \\\n 3",
        "f \\\n1\\\n2\\\r\n3",
        "f \\\r1 \\\r 2 3\r",
        "\\\nf 1 2 3",
        "f +1 +2 +3",
        "f 01 002 3",
    ] {
        assert_eq!(faces(face), [TRIANGLE.to_vec()], "{face:?}");
    }
}

#[test]
fn numbers_are_read_to_the_nearest_double_in_every_form() {
    let forms = [
        ("1", 1.0),
        ("+1.", 1.0),
        (".5", 0.5),
        ("-0", 0.0),
        ("1e-5", 1e-5),
        ("1E+05", 1e5),
        ("0.1", 0.1),
        ("0.1000000000000000055511151231257827", 0.1),
        ("2.2250738585072011e-308", 2.225_073_858_507_201e-308),
        ("9007199254740993", 9_007_199_254_740_992.0),
        ("1e100", 1e100),
        ("00012.500", 12.5),
    ];
    for (form, value) in forms {
        let mesh = mesh(&format!("v {form} 0 0\nv 1e30 2 0\nv 0 2 5e40\nf 1 2 3\n"));
        assert_eq!(mesh.vertices()[0].x.to_bits(), f64::to_bits(value), "{form}");
    }
}

#[test]
fn lines_end_in_any_way_and_comments_and_empty_lines_are_passed_over() {
    let soup = bodies::bracket();
    let plain = obj_files::plain(&soup);
    let wanted = mesh(&plain);
    assert_eq!(wanted.triangle_count(), soup.triangles.len());
    for text in [
        plain.replace('\n', "\r\n"),
        plain.replace('\n', "\r"),
        plain.replace('\n', "\n\n   \n# C:\\models\\\n"),
        plain.replace(' ', " \t "),
        plain.trim_end().to_owned(),
        format!("\u{feff}{plain}"),
        format!("#\n#comment f 1\n{plain}# the end"),
    ] {
        same::assert_same(&mesh(&text), &wanted);
    }
}

#[test]
fn other_statements_are_skipped_with_their_second_lines() {
    let others = "mtllib a.mtl\nvt 0 0\nvn 0 0 1\nvp 1 2\ns 1\nmg 1 0.5\nl 1 2 3\np 1\nlod 2\nusemap x\n\
                  curv 0 1 \\\n 1 2 3\ncstype bezier\nend\nbevel on\nshadow_obj a.obj\n";
    assert_eq!(faces(&format!("{others}f 1 2 3\n{others}")), [TRIANGLE.to_vec()]);
}

#[test]
fn faces_may_come_before_their_vertices() {
    let soup = bodies::icosphere(1);
    let text = obj_files::plain(&soup);
    let (vertices, faces): (Vec<&str>, Vec<&str>) = text.lines().partition(|line| line.starts_with('v'));
    same::assert_same(&mesh(&[faces, vertices].concat().join("\n")), &mesh(&text));
}

#[test]
fn relative_indices_count_from_the_face_and_not_from_the_end() {
    let text = format!("{VERTICES}f -4 -3 -2\nv 5 5 5\nf -5 -4 -1\n");
    let wanted = [TRIANGLE.to_vec(), vec![[0.0; 3], [1.0, 0.0, 0.0], [5.0; 3]]];
    assert_eq!(same::faces(&mesh(&text)), wanted);
}

#[test]
fn polygons_keep_their_corners() {
    let text = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 0.5 0\nv 0 1 0\nf 1 2 3 4 5\nf 5/1 4/2 3/1\n";
    let mesh = mesh(text);
    assert_eq!((mesh.half_edges().corners(0).len(), mesh.half_edges().corners(1).len()), (5, 3));
    assert_eq!((mesh.report().triangles, mesh.report().area), (4, 2.0));
}

#[test]
fn a_weight_is_no_coordinate_and_colours_are_vertex_data() {
    let text = "v 0 0 0 0.5\nv 1 0 0 0.25 0.5 1\nv 1 1 0\nv 0 1 0 nan 255 -1e300\nf 1 2 3 4\n";
    let mesh = mesh(text);
    assert_eq!(same::faces(&mesh)[0][..3], TRIANGLE);
    let fields = mesh.vertex_fields();
    assert_eq!(fields.iter().map(|f| f.name.as_str()).collect::<Vec<_>>(), ["red", "green", "blue"]);
    assert!(fields.iter().all(|f| f.components == 1 && f.values.len() == 4));
    let nan = f64::NAN;
    let wanted = [[nan, 0.25, nan, nan], [nan, 0.5, nan, 255.0], [nan, 1.0, nan, -1e300]];
    for (field, wanted) in fields.iter().zip(wanted) {
        assert!(field.values.iter().zip(wanted).all(|(a, b)| a.to_bits() == b.to_bits()), "{field:?}");
    }
    let plain = super::mesh(&format!("{VERTICES}f 1 2 3 4\n"));
    assert!(plain.vertex_fields().is_empty() && plain.face_fields().is_empty());
}

#[test]
fn colours_that_differ_where_positions_are_equal_are_a_seam() {
    let text =
        "v 0 0 0 1 1 1\nv 1 0 0 2 2 2\nv 1 1 0 3 3 3\nv 0 0 0 4 4 4\nv 1 1 0 3 3 3\nv 0 1 0 5 5 5\nf 1 2 3\nf 4 5 6\n";
    let mesh = mesh(text);
    assert_eq!(mesh.vertices().len(), 4);
    assert_eq!(mesh.vertex_fields()[0].values, [1.0, 2.0, 3.0, 5.0, 4.0]);
}

#[test]
fn the_format_is_found_by_content() {
    for text in [
        obj_files::rich(),
        obj_files::plain(&bodies::icosphere(0)),
        "# a\n\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3".into(),
        "usemap x\ncurv 0 1 \\\n 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3".into(),
    ] {
        let found = io::read_memory(text.as_bytes(), Format::Detect, &MeshOptions::default()).unwrap();
        assert!(found.triangle_count() > 0);
    }
}

#[test]
fn a_file_of_many_forms_is_read_whole() {
    let mesh = mesh(&obj_files::rich());
    let r = mesh.report();
    assert!(r.closed && r.consistent && !r.inside_out, "{r:?}");
    assert_eq!((r.faces, r.triangles, r.vertices, r.volume), (6, 12, 8, 4.0));
    assert_eq!((0..6).map(|f| mesh.tag(f)).collect::<Vec<_>>(), [0, 1, 2, 2, 2, 3]);
    let names: Vec<&str> = mesh.tag_names().iter().map(|(_, n)| n.as_str()).collect();
    assert_eq!(names, ["floor:steel", "lid:glass", "sides:glass", "sides:steel"]);
    assert_eq!(mesh.vertex_fields()[2].values, [0.0, 0.5, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0]);
}

#[test]
fn a_hundred_thousand_triangles_read_closed() {
    let text = obj_files::plain(&bodies::torus(2.0, 0.5, 250, 200));
    let report = mesh(&text).report().clone();
    assert_eq!((report.triangles, report.vertices, report.components), (100_000, 50_000, 1));
    assert!(report.closed && report.consistent && report.volume > 0.0);
}
