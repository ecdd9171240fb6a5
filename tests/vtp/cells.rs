// SPDX-License-Identifier: MIT OR Apache-2.0
//! Polygons, strips, other cells, pieces, and how faces are numbered.

use super::*;

#[test]
fn polygons_keep_their_corners_and_every_kind_of_cell_counts() {
    let mesh = mesh(&rich(ASCII));
    // Two verts, a line, four triangles of a strip, four polygons.
    assert_eq!(numbers_of_faces(&mesh), [3, 4, 5, 6, 7, 8, 9, 10]);
    assert_eq!(mesh.face_count(), 11);
    assert_eq!(mesh.report().faces, 8);
    let points = &rich_piece().points;
    assert_eq!(same::faces(&mesh)[4], [0, 2, 3, 1].map(|k| points[k]));
    assert_eq!(same::faces(&mesh)[1], [2, 4, 6].map(|k| points[k]));
}

#[test]
fn strips_alternate_and_their_flat_triangles_are_no_faces() {
    let points = (0..8).map(|k| [f64::from(k / 2), f64::from(k % 2), 0.0]).collect();
    let strips = vec![vec![0, 1, 2, 3, 3, 5, 4, 5, 6, 7], vec![0, 1], vec![6, 7, 5]];
    let mesh = mesh(&file(ASCII, &[Piece { points, strips, ..Piece::default() }]));
    let p = |k: u32| [f64::from(k / 2), f64::from(k % 2), 0.0];
    let wanted = [[0, 1, 2], [2, 1, 3], [3, 5, 4], [4, 5, 6], [6, 5, 7], [6, 7, 5]].map(|t| t.map(p));
    assert_eq!(same::faces(&mesh), wanted);
    assert_eq!(numbers_of_faces(&mesh), [0, 1, 4, 6, 7, 8]);
    assert_eq!(mesh.report().degenerate_faces, 0);
}

#[test]
fn polygons_of_fewer_than_three_corners_only_count() {
    let mut piece = triangle();
    piece.polys = vec![vec![], vec![0, 1], vec![0, 1, 2], vec![2]];
    piece.cell_data = vec![Array::new("id", "Int8", 1, &[1.0, 2.0, 3.0, 4.0])];
    let mesh = mesh(&file(ASCII, &[piece]));
    assert_eq!((numbers_of_faces(&mesh), mesh.face_count()), (vec![2], 4));
    assert_eq!(mesh.face_fields()[0].values, [1.0, 2.0, 3.0, 4.0]);
}

#[test]
fn pieces_are_joined_with_their_data() {
    let cube = rich_piece();
    let mut moved = cube.clone();
    moved.points.iter_mut().for_each(|p| p[2] += 5.0);
    moved.cell_data.swap(0, 1);
    moved.point_data[0].values[0] = 100.0;
    for style in [ASCII, Style { block: 64, ..Style::new(Form::AppendedRaw) }] {
        let mesh = mesh(&file(style, &[Piece::default(), cube.clone(), moved.clone(), Piece::default()]));
        let r = mesh.report();
        assert_eq!((r.faces, r.vertices, r.components, r.volume), (16, 16, 2, 2.0));
        assert_eq!(numbers_of_faces(&mesh)[7..9], [10, 14]);
        assert_eq!(mesh.vertex_fields()[0].values.len(), 16);
        assert!(mesh.vertex_fields()[0].values.contains(&100.0));
        assert_eq!(mesh.face_fields().len(), 1);
        assert_eq!(mesh.face_fields()[0].values[..11], mesh.face_fields()[0].values[11..]);
        assert_eq!((mesh.tag(10), mesh.tag(21), mesh.tag(3), mesh.tag(14)), (3, 3, 7, 7));
    }
}

#[test]
fn indices_may_be_of_any_type() {
    for kind in ["Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Float32", "Float64"] {
        let plain = text(&triangle()).replace("\"Int64\"", &format!("\"{kind}\""));
        assert_eq!(mesh(plain.as_bytes()).triangle_count(), 1);
    }
}
