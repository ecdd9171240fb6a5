// SPDX-License-Identifier: MIT OR Apache-2.0
//! Data of vertices and faces, interpolated at closest points.

use super::*;
use embound::geometry::{Geometry, SdfOptions, SignMethod};
use embound::mesh::{Field, FieldType};
use embound::parallel::Run;

fn linear(p: Vec3) -> [f64; 2] {
    [1.0 + 2.0 * p.x - 3.0 * p.y + 0.5 * p.z, -p.x]
}

fn with_linear(mesh: &Mesh) -> Mesh {
    let values = mesh.vertices().iter().flat_map(|p| linear(*p)).collect();
    mesh.with_field(false, Field { name: "linear".into(), kind: FieldType::F64, components: 2, values }).unwrap()
}

/// A linear function of the vertices is the same function at every closest point, whatever the faces' number
/// of corners and orientation.
fn assert_linear(mesh: &Mesh) {
    let mesh = with_linear(mesh);
    let g = Geometry::from_mesh(&mesh, &SdfOptions::default(), &Run::default()).unwrap();
    let (lo, hi) = (mesh.bounds().lo.to_array(), mesh.bounds().hi.to_array());
    let mut random = Random(11);
    for _ in 0..500 {
        let c = g.closest(Vec3::from_array(random.point(lo, hi)));
        let mut found = [0.0; 2];
        mesh.interpolate(&mesh.vertex_fields()[0], c.primitive, c.piece, c.barycentric, &mut found);
        let wanted = linear(c.point);
        let size = 1e-12 * (1.0 + mesh.bounds().diagonal());
        assert!((0..2).all(|k| (found[k] - wanted[k]).abs() < size), "{found:?} {wanted:?} {c:?}");
    }
}

#[test]
fn a_linear_function_of_the_vertices_is_linear_on_the_surface() {
    assert_linear(&bodies::icosphere(2).mesh());
    assert_linear(&bodies::icosphere(2).flipped().mesh());
    assert_linear(&bodies::bracket().flipped_where(|t| t % 2 == 0).mesh());
    assert_linear(&bodies::bracket().duplicated().mesh());
}

#[test]
fn corners_of_polygons_have_their_own_weights() {
    let (xyz, offsets, indices) = super::polygons::prism(&super::polygons::L_SHAPE, 2.0);
    for flip in [false, true] {
        let mut indices = indices.clone();
        if flip {
            offsets.windows(2).for_each(|w| indices[w[0]..w[1]].reverse());
        }
        let mesh = Mesh::from_polygons(&xyz, &offsets, &indices, None, &MeshOptions::default()).unwrap();
        assert!(mesh.triangles().len() > mesh.face_count());
        assert_linear(&mesh);
    }
}

#[test]
fn values_of_faces_and_of_nothing() {
    let mesh = with_linear(&bodies::icosphere(0).mesh());
    let numbers = (0..20).map(f64::from).collect();
    let mesh = mesh
        .with_field(true, Field { name: "n".into(), kind: FieldType::F64, components: 1, values: numbers })
        .unwrap();
    let mut one = [0.0];
    for f in 0..20 {
        mesh.face_value(&mesh.face_fields()[0], f, &mut one);
        assert_eq!(one, [f as f64]);
    }
    for (face, piece) in [(-1, 0), (20, 0), (i64::MAX, 0), (3, 1), (3, -1)] {
        let mut two = [0.0; 2];
        mesh.interpolate(&mesh.vertex_fields()[0], face, piece, Vec3::X, &mut two);
        assert!(two.iter().all(|x| x.is_nan()), "{face} {piece}");
    }
    mesh.face_value(&mesh.face_fields()[0], 20, &mut one);
    assert!(one[0].is_nan());
}

#[test]
fn a_field_replaces_one_of_its_name_and_must_fit() {
    let mesh = with_linear(&with_linear(&bodies::icosphere(0).mesh()));
    assert_eq!(mesh.vertex_fields().len(), 1);
    let refused = |name: &str, components, values: Vec<f64>| {
        let field = Field { name: name.into(), kind: FieldType::F64, components, values };
        mesh.with_field(true, field).unwrap_err().message().to_owned()
    };
    assert_eq!(refused("", 1, vec![0.0; 20]), "name: \"\" is empty, not one line or has white space around it");
    assert_eq!(refused("a", 1, vec![0.0; 12]), "values: 12 are not 1 for each of 20 items");
    assert_eq!(refused("a", 0, vec![]), "values: 0 are not 0 for each of 20 items");
    assert_eq!(mesh.with_tags(&[1], vec![]).unwrap_err().message(), "tags: 1 values for 20 faces");
    let twice = vec![(1, "a".to_owned()), (1, "b".to_owned())];
    assert_eq!(mesh.with_tags(&[1; 20], twice).unwrap_err().message(), "names: tag 1 has two names");
}

/// A mesh of unwelded polygons with one number for each vertex, then welded.
fn welded(xyz: &[Vec3], offsets: &[usize], indices: &[u32], values: Vec<f64>, orient: Orient) -> Mesh {
    let xyz: Vec<f64> = xyz.iter().flat_map(|p| p.to_array()).collect();
    let apart = options(|o| (o.weld_tolerance, o.orient) = (-1.0, Orient::Keep));
    let mesh = Mesh::from_polygons(&xyz, offsets, indices, None, &apart).unwrap();
    let field = Field { name: "own".into(), kind: FieldType::F64, components: 1, values };
    mesh.with_field(false, field)
        .unwrap()
        .rebuilt(&options(|o| (o.orient, o.weld_tolerance) = (orient, 1e-12)))
        .unwrap()
}

/// The same of triangles of vertices of their own.
fn welded_soup(corners: &[Vec3], values: Vec<f64>) -> Mesh {
    let offsets: Vec<usize> = (0..=corners.len() / 3).map(|t| 3 * t).collect();
    let indices: Vec<u32> = (0..corners.len() as u32).collect();
    welded(corners, &offsets, &indices, values, Orient::Keep)
}

#[test]
fn rows_are_those_of_a_plain_search() {
    let mut random = Random(5);
    let kinds = [0.0, -0.0, 1.0, f64::NAN, f64::from_bits(f64::NAN.to_bits() ^ 1), f64::INFINITY, 1e-310, -1.0];
    let mut seams = 0;
    for round in 0..300 {
        let (spots, values, triangles) = (3 + random.below(8), 1 + random.below(8), 1 + random.below(60));
        let mut corners = Vec::new();
        for _ in 0..triangles {
            let first = random.below(spots);
            let second = (first + 1 + random.below(spots - 1)) % spots;
            let third = (0..spots).find(|k| *k != first && *k != second).unwrap();
            corners.extend([first, second, third].map(|k| Vec3::new(k as f64, (k * k) as f64, (k % 3) as f64)));
        }
        let given: Vec<f64> = corners.iter().map(|_| kinds[random.below(values)]).collect();
        let mesh = welded_soup(&corners, given.clone());
        let topology = mesh.half_edges();
        assert_eq!(topology.count(), corners.len());
        // The rows of the vertices are first, each the value of its lowest corner; others follow as they turn up.
        let vertices = mesh.vertices().len() as u32;
        let lowest = |v: u32| (0..).find(|h| topology.origin(*h) == v).unwrap() as usize;
        let mut rows: Vec<(u32, u64)> = (0..vertices).map(|v| (v, given[lowest(v)].to_bits())).collect();
        for h in 0..topology.count() as u32 {
            let wanted = (topology.origin(h), given[h as usize].to_bits());
            let row = rows.iter().position(|row| *row == wanted).unwrap_or(rows.len());
            if row == rows.len() {
                rows.push(wanted);
            }
            assert_eq!(mesh.vertex_data_row(h), row as u32, "round {round}, corner {h}");
        }
        let found: Vec<u64> = mesh.vertex_fields()[0].values.iter().map(|x| x.to_bits()).collect();
        assert_eq!(found, rows.iter().map(|row| row.1).collect::<Vec<_>>(), "round {round}");
        seams += rows.len() - vertices as usize;
    }
    assert!(seams > 3000, "{seams}");
}

#[test]
fn a_vertex_may_have_many_rows() {
    // The tip of a cone has another value in each of its faces, but for every seventh; a look at each pair of them
    // would take minutes.
    let count = 150_000;
    let rim = |k: usize| {
        let angle = std::f64::consts::TAU * (k % count) as f64 / count as f64;
        Vec3::new(libm::cos(angle), libm::sin(angle), 0.0)
    };
    let corners: Vec<Vec3> = (0..count).flat_map(|k| [Vec3::Z, rim(k), rim(k + 1)]).collect();
    let value = |k: usize| if k % 7 == 3 { 0.5 } else { (count - k) as f64 };
    let mesh = welded_soup(&corners, (0..count).flat_map(|k| [value(k), -1.0, -1.0]).collect());
    let field = &mesh.vertex_fields()[0];
    let shared = (0..count).filter(|k| k % 7 == 3).count();
    assert_eq!((mesh.vertices().len(), field.values.len()), (count + 1, count + 1 + count - shared));
    let mut last = 0;
    for k in 0..count {
        let row = mesh.vertex_data_row(3 * k as u32);
        assert_eq!(field.values[row as usize], value(k));
        // In the order in which they turn up; the shared one is that of face 3.
        let wanted = if k == 0 {
            0
        } else if k % 7 == 3 {
            count + 3
        } else {
            count + k - (k + 3) / 7 + usize::from(k > 3)
        };
        assert_eq!(row as usize, wanted, "{k}");
        last = last.max(wanted);
    }
    assert_eq!(last + 1, field.values.len());
}

/// Each piece has the values of corners of its own: seen by their corners, all sides of the pieces cancel but for those
/// of the face.
fn assert_own_corners(ring: &[Vec3], face_before: bool) {
    for orient in [Orient::Keep, Orient::Flip] {
        // A triangle before or after, so that numbers of faces, pieces and corners differ.
        let far = [7.0, 8.0, 9.0].map(|x| Vec3::new(x, x * x, 99.0));
        let n = ring.len();
        let (xyz, start, f) = match face_before {
            true => ([&far[..], ring].concat(), 3, 1),
            false => ([ring, &far[..]].concat(), 0, 0),
        };
        let offsets = if face_before { [0, 3, 3 + n] } else { [0, n, n + 3] };
        let indices: Vec<u32> = (0..n as u32 + 3).collect();
        let mesh = welded(&xyz, &offsets, &indices, indices.iter().map(|k| f64::from(*k)).collect(), orient);
        let mut sides = Vec::new();
        for piece in 0..n as i32 - 2 {
            let corners = [Vec3::X, Vec3::Y, Vec3::Z].map(|at| {
                let mut value = [0.0];
                mesh.interpolate(&mesh.vertex_fields()[0], f, piece, at, &mut value);
                value[0] as usize - start
            });
            sides.extend((0..3).map(|k| (corners[k], corners[(k + 1) % 3])));
        }
        let mut left: Vec<_> = sides.iter().filter(|(a, b)| !sides.contains(&(*b, *a))).copied().collect();
        left.sort_unstable();
        assert_eq!(left, (0..n).map(|k| (k, (k + 1) % n)).collect::<Vec<_>>(), "{orient:?}");
        for h in mesh.half_edges().around_face(f as u32) {
            let row = mesh.vertex_data_row(h) as usize;
            assert!(
                mesh.vertices()[mesh.half_edges().origin(h) as usize]
                    == xyz[mesh.vertex_fields()[0].values[row] as usize]
            );
        }
    }
}

#[test]
fn faces_that_touch_themselves_keep_the_data_of_each_corner() {
    let flat = |points: &[[f64; 2]]| points.iter().map(|p| Vec3::new(p[0], p[1], 0.0)).collect::<Vec<_>>();
    let bow = flat(&[[0.0, 0.0], [1.0, -1.0], [1.0, 1.0], [0.0, 0.0], [-1.0, 1.0], [-1.0, -1.0]]);
    // A hole joined to the rim by a bridge, which both of its ends come to twice.
    let keyhole = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0], [0.0, 0.0], [1.0, 1.0], [1.0, 2.0], [2.0, 2.0]];
    let keyhole = flat(&[&keyhole[..], &[[2.0, 1.0], [1.0, 1.0]]].concat());
    // Lobes that run against each other, so that the face crosses itself; of few corners and of many.
    let lobes = |n: usize| {
        let lobe = |center: f64, clockwise: bool| {
            let turn = std::f64::consts::TAU / n as f64 * if clockwise { -1.0 } else { 1.0 };
            (0..n).map(move |k| {
                let at = turn * k as f64;
                Vec3::new(center * (1.0 - libm::cos(at)), -center * libm::sin(at), 0.1 * center * libm::sin(at))
            })
        };
        lobe(1.0, false).chain(lobe(-1.0, true)).chain(lobe(0.3, false)).collect::<Vec<_>>()
    };
    let star = lobes(40).into_iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect();
    for mut ring in [bow, keyhole, lobes(4), lobes(40), star, lobes(100), lobes(300)] {
        for shift in [0, 1, 3] {
            ring.rotate_left(shift);
            assert_own_corners(&ring, false);
            assert_own_corners(&ring, true);
        }
    }
}

#[test]
fn what_a_closest_point_gets_is_of_its_side_of_the_seam() {
    // A square with a hole, joined by a bridge from (0, 0) to (1, 1); other values on either side of it.
    let ring = [[0, 0], [3, 0], [3, 3], [0, 3], [0, 0], [1, 1], [1, 2], [2, 2], [2, 1], [1, 1]];
    let ring = ring.map(|[x, y]| Vec3::new(f64::from(x), f64::from(y), 0.0));
    let values = vec![100.0, 50.0, 50.0, 50.0, 0.0, 1.0, 50.0, 50.0, 50.0, 101.0];
    let indices: Vec<u32> = (0..10).collect();
    for orient in [Orient::Keep, Orient::Flip] {
        let mesh = welded(&ring, &[0, 10], &indices, values.clone(), orient);
        assert_eq!((mesh.vertices().len(), mesh.vertex_fields()[0].values.len()), (8, 10));
        let unsigned = SdfOptions { sign: SignMethod::None, ..SdfOptions::default() };
        let g = Geometry::from_mesh(&mesh, &unsigned, &Run::default()).unwrap();
        for k in 1..100 {
            let at = f64::from(k) / 100.0;
            for (off, more) in [(1e-5, 100.0), (-1e-5, 0.0)] {
                let c = g.closest(Vec3::new(at + off, at - off, 0.5));
                let mut found = [0.0];
                mesh.interpolate(&mesh.vertex_fields()[0], c.primitive, c.piece, c.barycentric, &mut found);
                assert!((found[0] - more - at).abs() < 1e-2, "{found:?} at {c:?}");
            }
        }
    }
}
