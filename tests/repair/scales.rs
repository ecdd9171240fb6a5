// SPDX-License-Identifier: MIT OR Apache-2.0
//! Each fault alone and all of them together, at several scales, against the clean body.

use super::{assert_clean, repaired};
use crate::common::random::Random;
use crate::common::{Soup, bodies, described};
use embound::mesh::{Field, FieldType, Mesh, MeshOptions, Orient, RepairOptions, Repairs};

const NOTHING: RepairOptions = RepairOptions::NOTHING;

/// As it came: nothing oriented.
fn raw(soup: &Soup) -> Mesh {
    soup.mesh_with(&MeshOptions { orient: Orient::Keep, ..MeshOptions::default() })
}

fn values(mesh: &Mesh) -> Vec<u64> {
    let (lo, hi) = (mesh.bounds().lo.to_array(), mesh.bounds().hi.to_array());
    let mut random = Random(5);
    let points: Vec<[f64; 3]> = (0..400).map(|_| random.point(lo, hi)).collect();
    super::bits(&super::values(mesh, &points))
}

/// To rounding: triangles may be cut otherwise, or begin with another corner.
fn assert_same_distance(a: &Mesh, b: &Mesh) {
    let size = b.bounds().diagonal();
    for (x, y) in values(a).into_iter().zip(values(b)) {
        let (x, y) = (f64::from_bits(x), f64::from_bits(y));
        assert!((x - y).abs() < 1e-14 * size && (x < 0.0) == (y < 0.0), "{x} {y}");
    }
}

const SCALES: [f64; 3] = [1.0, 1e-6, 1e6];

#[test]
fn a_clean_mesh_comes_back_as_it_was() {
    for body in [bodies::icosphere(2), bodies::bracket(), bodies::nested_shells(1)] {
        for scale in SCALES {
            let mesh = body.scaled(scale).mesh();
            for options in [RepairOptions::default(), NOTHING] {
                let (again, done) = repaired(&mesh, &options);
                assert_eq!(done, Repairs::default());
                assert!(again.vertices() == mesh.vertices() && described(&again) == described(&mesh));
                assert_eq!(values(&again), values(&mesh));
            }
        }
    }
}

/// Splits the edge between the first two corners of a triangle by its middle, for that triangle alone, and fills
/// the crack with a triangle without area.
fn with_a_flat_face(body: &Soup, t: usize) -> Soup {
    let mut body = body.clone();
    let [a, b, c] = body.triangles[t];
    let (p, q) = (body.vertices[a as usize], body.vertices[b as usize]);
    let m = body.vertices.len() as u32;
    body.vertices.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
    body.triangles[t] = [a, m, c];
    body.triangles.insert(t + 1, [m, b, c]);
    body.triangles.push([a, b, m]);
    body
}

#[test]
fn a_face_without_area_inside_a_clean_mesh_leaves_no_crack() {
    // Coordinates of few digits: the middle of an edge lies on it exactly.
    for scale in [1.0, 2f64.powi(-20), 2f64.powi(20)] {
        let clean = bodies::cuboid([-1.0; 3], [1.0, 2.0, 4.0]).scaled(scale);
        for t in [0, 7, 11] {
            let mesh = raw(&with_a_flat_face(&clean, t));
            assert_eq!(mesh.report().degenerate_faces, 1);
            let (fixed, done) = repaired(&mesh, &RepairOptions { degenerate: true, ..NOTHING });
            assert_eq!(done, Repairs { degenerate_faces: 1, corners_added: 1, ..Repairs::default() });
            assert_clean(&fixed);
            assert_eq!(fixed.report().faces, mesh.report().faces - 1);
            let bare = repaired(&mesh, &NOTHING).0;
            assert_eq!(bare.report().degenerate_faces, 1, "nothing is done unasked");
            assert_same_distance(&fixed, &clean.mesh());
        }
    }
}

#[test]
fn chains_of_faces_without_area_are_merged() {
    // A cube whose upper side is cut by flat faces stacked on one edge.
    let mut body = bodies::unit_cube();
    let [a, b, c] = body.triangles[0];
    let at = |body: &Soup, v: u32| body.vertices[v as usize];
    let along = |body: &Soup, x: f64| {
        let (p, q) = (at(body, a), at(body, b));
        [0, 1, 2].map(|k| p[k] + x * (q[k] - p[k]))
    };
    let n = body.vertices.len() as u32;
    for x in [0.25, 0.5, 0.75] {
        let p = along(&body, x);
        body.vertices.push(p);
    }
    body.triangles[0] = [a, n, c];
    body.triangles.extend([[n, n + 1, c], [n + 1, n + 2, c], [n + 2, b, c]]);
    body.triangles.extend([[a, b, n + 1], [a, n + 1, n], [n + 1, b, n + 2]]);
    let mesh = raw(&body);
    assert_eq!((mesh.report().degenerate_faces, mesh.report().boundary_edges), (3, 0));
    let (fixed, done) = repaired(&mesh, &RepairOptions { degenerate: true, ..NOTHING });
    assert_eq!(done.degenerate_faces, 3);
    assert_clean(&fixed);
    assert_eq!(fixed.report().volume, 1.0);
}

#[test]
fn repeated_faces_leave_whichever_way_they_run() {
    for body in [bodies::icosphere(2), bodies::bracket()] {
        for dirty in [body.duplicated(), body.double_sided(), body.duplicated().double_sided()] {
            let mesh = raw(&dirty);
            let (fixed, done) = repaired(&mesh, &RepairOptions { duplicates: true, ..NOTHING });
            assert_eq!(done.duplicate_faces, dirty.triangles.len() - body.triangles.len());
            assert_clean(&fixed);
            assert!(described(&fixed) == described(&body.mesh()));
        }
    }
}

#[test]
fn faces_turned_over_run_outward_again() {
    for body in [bodies::icosphere(2), bodies::bracket(), bodies::torus(1.0, 0.3, 12, 8)] {
        let mesh = raw(&body.flipped_where(|t| t % 2 == 1));
        let (fixed, done) = repaired(&mesh, &RepairOptions { orient: true, ..NOTHING });
        assert_eq!((done.faces_turned, done.components_turned), (body.triangles.len() / 2, 0));
        assert_clean(&fixed);
        assert_eq!(values(&fixed), values(&body.mesh()));
        let (fixed, done) = repaired(&raw(&body.flipped()), &RepairOptions { orient: true, ..NOTHING });
        assert_eq!((done.faces_turned, done.components_turned), (body.triangles.len(), 1));
        assert_eq!(values(&fixed), values(&body.mesh()));
    }
}

#[test]
fn nested_shells_alternate_whatever_way_they_were_given() {
    let shell = |r: f64| bodies::sphere_at(2, [0.0; 3], r);
    let wanted = shell(3.0).and(&shell(2.0).flipped()).and(&shell(1.0));
    for turned in 0..8 {
        let part = |k: usize, r: f64| if turned >> k & 1 == 1 { shell(r).flipped() } else { shell(r) };
        let mesh = raw(&part(0, 3.0).and(&part(1, 2.0)).and(&part(2, 1.0)));
        let (fixed, done) = repaired(&mesh, &RepairOptions { orient: true, ..NOTHING });
        assert_eq!(done.components_turned, [2, 0, 1].iter().map(|k| (turned ^ 2) >> k & 1).sum::<usize>());
        assert!(described(&fixed).iter().map(|f| &f.0).eq(described(&raw(&wanted)).iter().map(|f| &f.0)), "{turned}");
        assert_eq!(values(&fixed), values(&raw(&wanted)));
    }
}

#[test]
fn a_missing_triangle_is_filled() {
    for scale in SCALES {
        let body = bodies::icosphere(2).scaled(scale);
        let mesh = raw(&body.without(|t| t == 17));
        let (fixed, done) = repaired(&mesh, &RepairOptions { holes: true, ..NOTHING });
        assert_eq!((done.holes_filled, done.faces_added, done.holes_left), (1, 1, 0));
        assert_clean(&fixed);
        assert_eq!((mesh.face_count(), fixed.face_count()), (319, 320));
        assert_same_distance(&fixed, &body.mesh());
        let (left, done) = repaired(&mesh, &RepairOptions { holes: true, hole_edges: 2, ..NOTHING });
        assert_eq!((done.holes_filled, done.holes_left, left.report().boundary_edges), (0, 1, 3));
    }
}

#[test]
fn holes_of_any_shape_are_filled_and_large_ones_left() {
    // A ball with the faces round four vertices gone.
    let body = bodies::icosphere(3);
    let near = |v: usize, r: f64| {
        let p = body.vertices[v];
        move |q: [f64; 3]| (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum::<f64>() < r * r
    };
    let holes = [near(0, 0.3), near(50, 0.2), near(100, 0.45), near(200, 0.25)];
    let open = body.without(|t| {
        let c = body.corners(t);
        holes.iter().any(|h| c.iter().all(|p| h(*p)))
    });
    let mesh = raw(&open);
    assert!(mesh.report().boundary_edges > 30);
    let (_, done) = repaired(&mesh, &RepairOptions { holes: true, ..NOTHING });
    assert_eq!((done.holes_filled, done.holes_left), (2, 1), "two of them are one, which is large");
    let (fixed, done) = repaired(&mesh, &RepairOptions { holes: true, hole_length: 1.0, ..NOTHING });
    assert_eq!((done.holes_filled, done.holes_left), (3, 0));
    assert_clean(&fixed);
    assert!(
        fixed.report().volume < body.mesh().report().volume
            && fixed.report().volume > 0.95 * body.mesh().report().volume
    );
    // The open end of a pipe stays.
    let pipe = bodies::torus(1.0, 0.3, 24, 12);
    let half = raw(&pipe.without(|t| pipe.corners(t).iter().all(|p| p[0] > 0.0)));
    let (left, done) = repaired(&half, &RepairOptions { holes: true, hole_length: 0.2, ..NOTHING });
    assert_eq!((done.holes_filled, done.holes_left), (0, 2));
    assert_eq!(left.report().boundary_edges, half.report().boundary_edges);
}

#[test]
fn rims_that_touch_in_a_vertex_are_filled_one_by_one() {
    // Two triangles that share only a vertex are gone.
    let body = bodies::icosphere(2);
    let [a, ..] = body.triangles[0];
    let around: Vec<usize> = (0..body.triangles.len()).filter(|&t| body.triangles[t].contains(&a)).collect();
    let apart = around
        .iter()
        .copied()
        .find(|&t| t != 0 && body.triangles[t].iter().filter(|v| body.triangles[0].contains(v)).count() == 1);
    let gone = [0, apart.expect("six triangles meet")];
    let mesh = raw(&body.without(|t| gone.contains(&t)));
    for split in [false, true] {
        let (fixed, done) = repaired(&mesh, &RepairOptions { holes: true, split, ..NOTHING });
        assert_eq!((done.holes_left, fixed.report().boundary_edges), (0, 0), "{done:?}");
        assert!(fixed.report().closed);
    }
}

#[test]
fn bodies_that_share_a_vertex_or_an_edge_come_apart() {
    let cube = |lo: [f64; 3]| bodies::cuboid(lo, lo.map(|c| c + 1.0));
    let at_a_vertex = raw(&cube([0.0; 3]).and(&cube([1.0; 3])));
    let (fixed, done) = repaired(&at_a_vertex, &RepairOptions { split: true, ..NOTHING });
    assert_eq!((done.vertices_split, fixed.vertices().len()), (1, 16));
    assert_clean(&fixed);
    assert_eq!(values(&fixed), values(&at_a_vertex));
    let at_an_edge = raw(&bodies::cubes_sharing_an_edge());
    assert_eq!(at_an_edge.report().nonmanifold_edges, 1);
    let (fixed, done) = repaired(&at_an_edge, &RepairOptions { split: true, ..NOTHING });
    assert_eq!(done.vertices_split, 2);
    assert_clean(&fixed);
    assert_eq!(fixed.report().components, 2);
    // Sheets that meet in an edge stay together.
    let book = raw(&bodies::book(3));
    let (same, done) = repaired(&book, &RepairOptions { split: true, ..NOTHING });
    assert_eq!(done, Repairs::default());
    assert!(described(&same) == described(&book));
}

#[test]
fn cracks_are_welded_within_the_tolerance() {
    for scale in SCALES {
        let mut body = bodies::icosphere(2).unshared().scaled(scale);
        let mut random = Random(9);
        for p in &mut body.vertices {
            let d = random.point([-1e-7 * scale; 3], [1e-7 * scale; 3]);
            *p = [0, 1, 2].map(|k| p[k] + d[k]);
        }
        let mesh = raw(&body);
        assert_eq!(mesh.report().components, 320);
        let (fixed, done) = repaired(&mesh, &RepairOptions { weld: true, weld_tolerance: 1e-6, ..NOTHING });
        assert_eq!((done.vertices_welded, done.faces_collapsed), (960 - 162, 0));
        assert_clean(&fixed);
    }
}

#[test]
fn everything_at_once_and_what_belongs_to_faces_stays() {
    for scale in [1.0, 2f64.powi(-20), 2f64.powi(20)] {
        let clean = bodies::bracket().scaled(scale);
        let dirty = with_a_flat_face(&clean, 3).without(|t| t == 5);
        let far = clean.bounds().1[0] + 3.0 * scale;
        let dirty = dirty.and(&clean.translated([far, 0.0, 0.0])).flipped_where(|t| t % 5 < 2);
        let n = dirty.triangles.len();
        let dirty = Soup { triangles: [dirty.triangles.clone(), dirty.triangles[..9].to_vec()].concat(), ..dirty };
        let tags: Vec<i32> = (0..dirty.triangles.len() as i32).map(|t| 10 + t % 2).collect();
        let mesh = raw(&dirty).with_tags(&tags, vec![(10, "even".into())]).unwrap();
        let x = mesh.vertices().iter().map(|p| p.x).collect();
        let field = |name: &str, values| Field { name: name.into(), kind: FieldType::F64, components: 1, values };
        let mesh = mesh.with_field(false, field("x", x)).unwrap();
        let mesh = mesh.with_field(true, field("number", (0..tags.len()).map(|k| k as f64).collect())).unwrap();
        let (fixed, done) = repaired(&mesh, &RepairOptions { fill_tag: Some(99), ..RepairOptions::default() });
        assert_clean(&fixed);
        assert_eq!((done.degenerate_faces, done.duplicate_faces, done.holes_filled, done.faces_added), (1, 9, 1, 1));
        assert_eq!(fixed.report().components, 2);
        let topology = fixed.half_edges();
        for f in 0..topology.face_count() as u32 {
            let number = topology.input_face(f) as usize;
            let new = number >= tags.len();
            assert_eq!(fixed.tag(number as u32), if new { 99 } else { tags[number] });
            let value = fixed.face_fields()[0].item(number)[0];
            assert!(if new { value.is_nan() } else { value == number as f64 });
            for h in topology.around_face(f) {
                let row = fixed.vertex_data_row(h) as usize;
                assert_eq!(fixed.vertex_fields()[0].item(row)[0], fixed.vertices()[topology.origin(h) as usize].x);
            }
        }
        assert_eq!((fixed.tag_name(10), fixed.face_count()), (Some("even"), n + 9 + 1));
        let both = clean.and(&clean.translated([far, 0.0, 0.0])).mesh();
        assert!((fixed.report().volume / both.report().volume - 1.0).abs() < 1e-12);
    }
}

#[test]
fn options_out_of_their_range_are_named() {
    let mesh = bodies::icosphere(0).mesh();
    let refused = |o: RepairOptions| mesh.repaired(&o).unwrap_err().message().to_owned();
    assert_eq!(
        refused(RepairOptions { hole_length: f64::NAN, ..NOTHING }),
        "options.hole_length: NaN is not 0 or above"
    );
    assert!(refused(RepairOptions { weld_tolerance: 0.7, ..NOTHING }).starts_with("options.weld_tolerance: 0.7"));
}
