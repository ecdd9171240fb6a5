// SPDX-License-Identifier: MIT OR Apache-2.0
//! Points in polygons: in the plane, on boundaries of whatever polygons, and in faces that lie askew in space.

use super::polygons::L_SHAPE;
use super::*;
use embound::primitive::inside::{Inside, contains};

const WAYS: [Inside; 3] = [Inside::Crossing, Inside::Winding, Inside::Angle];

/// How often a polygon of whole coordinates below 16 winds around a point a little to the right and, by far less, above
/// `p`, and how often a ray downwards crosses it: whole numbers throughout.
fn wound(polygon: &[[i64; 2]], p: [i64; 2]) -> (i64, usize) {
    let fine = |q: [i64; 2]| q.map(|c| c * 1_000_000);
    let [x, y] = [p[0] * 1_000_000 + 1000, p[1] * 1_000_000 + 1];
    let (mut turns, mut crossings) = (0, 0);
    for k in 0..polygon.len() {
        let (a, b) = (fine(polygon[k]), fine(polygon[(k + 1) % polygon.len()]));
        if (a[0] <= x) != (b[0] <= x) {
            let left = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
            assert_ne!(left, 0);
            // Above the side: the ray meets it.
            if (left > 0) == (b[0] > a[0]) {
                turns += if b[0] > a[0] { 1 } else { -1 };
                crossings += 1;
            }
        }
    }
    (turns, crossings)
}

#[test]
fn whatever_the_polygon_and_wherever_on_it_the_point_is_moved_right_and_above() {
    let mut random = Random(77);
    let (mut on, mut covered_twice) = (0, 0);
    for round in 0..1500 {
        let n = 3 + random.below(8);
        let size = 3 + random.below(6);
        let mut polygon: Vec<[i64; 2]> =
            (0..n).map(|_| [random.below(size) as i64, random.below(size) as i64]).collect();
        match round % 5 {
            // Every side twice, as often there as back, and the other way round.
            0 => polygon = [polygon.clone(), polygon].concat(),
            1 => polygon.extend(polygon.clone().iter().rev()),
            2 => polygon.reverse(),
            _ => {}
        }
        for x in -1..=size as i64 {
            for y in -1..=size as i64 {
                let (turns, crossings) = wound(&polygon, [x, y]);
                on += usize::from(polygon.contains(&[x, y]));
                covered_twice += usize::from(turns.abs() > 1);
                // Powers of two from the least to the largest coordinates.
                for scale in [1.0, libm::exp2(-1000.0), libm::exp2(300.0), libm::exp2(1018.0)] {
                    let flat = |q: [i64; 2]| q.map(|c| c as f64 * scale);
                    let told = WAYS.map(|how| contains(polygon.iter().map(|q| flat(*q)), flat([x, y]), how));
                    let wanted = [crossings % 2 == 1, turns != 0, turns != 0];
                    assert_eq!(told, wanted, "{x} {y} in {polygon:?} at {scale:e}");
                }
            }
        }
    }
    assert!(on > 1000 && covered_twice > 1000, "{on} {covered_twice}");
}

#[test]
fn angles_tell_points_next_to_sides_apart() {
    // A sliver of a rounding's width along a slanted side: each neighbour of a point on the side.
    let mut random = Random(5);
    for _ in 0..2000 {
        let [x, y, t] = random.point([0.0; 3], [1.0; 3]);
        let polygon = [[0.1, 0.2], [3.3 + x, 1.7 + y], [0.4, 5.1]];
        let on = [0, 1].map(|k| polygon[0][k] + t * (polygon[1][k] - polygon[0][k]));
        for p in [on, [on[0].next_up(), on[1]], [on[0], on[1].next_up()], [on[0].next_down(), on[1]]] {
            let [crossing, winding, angle] = WAYS.map(|how| contains(polygon.iter().copied(), p, how));
            assert!(crossing == winding && winding == angle, "{p:?} of {polygon:?}");
        }
    }
    for p in [[f64::NAN, 0.5], [0.5, f64::INFINITY], [f64::NEG_INFINITY, 0.5]] {
        for how in WAYS {
            let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
            assert!(!contains(square.iter().copied(), p, how));
        }
    }
}

/// The L in the plane of two directions, first corner at `origin`.
fn tilted_l(origin: Vec3, u: Vec3, v: Vec3) -> Mesh {
    let xyz: Vec<f64> = L_SHAPE.iter().flat_map(|p| (origin + u * p[0] + v * p[1]).to_array()).collect();
    Mesh::from_polygons(&xyz, &[0, 6], &[0, 1, 2, 3, 4, 5], None, &options(|o| o.orient = Orient::Keep)).unwrap()
}

#[test]
fn a_point_off_the_plane_of_a_face_counts_by_its_foot_along_the_normal() {
    let mut random = Random(9);
    for scale in [1e-6, 1.0, 1e6] {
        for toward in [Vec3::new(1.0, 1.0, 1.0), Vec3::new(-1.0, 0.9, -0.8), Vec3::new(0.3, -1.0, 0.2)] {
            let normal = toward.normalize();
            let u = normal.any_orthonormal_vector();
            let v = normal.cross(u);
            let origin = Vec3::new(7.0, -3.0, 2.0) * scale;
            let mesh = tilted_l(origin, u * scale, v * scale);
            for _ in 0..500 {
                let [x, y, height] = random.point([-1.0, -1.0, -10.0], [4.0, 4.0, 10.0]);
                let wanted = x > 0.0 && y > 0.0 && ((x < 3.0 && y < 1.0) || (x < 1.0 && y < 3.0));
                let p = origin + (u * x + v * y + normal * height) * scale;
                for how in WAYS {
                    assert_eq!(mesh.face_contains(0, p, how), wanted, "{x} {y} {height} at {scale:e}");
                }
            }
        }
    }
}

#[test]
fn corners_off_the_plane_count_by_their_feet() {
    // A saddle over a square of side 2 with corners 1 off, seen along (1, 1, 1).
    let normal = Vec3::ONE.normalize();
    let u = normal.any_orthonormal_vector();
    let v = normal.cross(u);
    let corner = |x: f64, y: f64, h: f64| u * x + v * y + normal * h;
    let ring = [corner(-1.0, -1.0, 1.0), corner(1.0, -1.0, -1.0), corner(1.0, 1.0, 1.0), corner(-1.0, 1.0, -1.0)];
    let xyz: Vec<f64> = ring.iter().flat_map(|p| p.to_array()).collect();
    let keep = options(|o| o.orient = Orient::Keep);
    let mesh = Mesh::from_polygons(&xyz, &[0, 4], &[0, 1, 2, 3], None, &keep).unwrap();
    for (x, y, wanted) in [(0.9, 0.9, true), (0.9, -0.9, true), (1.1, 0.9, false), (-0.9, 1.1, false)] {
        for h in [-5.0, 0.0, 5.0] {
            for how in WAYS {
                assert_eq!(mesh.face_contains(0, corner(x, y, h), how), wanted, "{x} {y} {h}");
            }
        }
    }
}

#[test]
fn of_faces_side_by_side_in_a_slanted_plane_one_holds_each_point_between_them() {
    for scale in [0.1, 1e-6, 1e6 / 3.0] {
        let at = |i: u32, j: u32| {
            let (i, j) = (f64::from(i), f64::from(j));
            Vec3::new(3.0 * i - 4.0 * j, 4.0 * i + 3.0 * j, 12.0 * j + 5.0) * scale
        };
        let xyz: Vec<f64> = (0..25).flat_map(|k| at(k % 5, k / 5).to_array()).collect();
        let quad = |k: u32| {
            let a = k % 4 + 5 * (k / 4);
            [a, a + 1, a + 6, a + 5]
        };
        let indices: Vec<u32> = (0..16).flat_map(quad).collect();
        let offsets: Vec<usize> = (0..=16).map(|k| 4 * k).collect();
        let keep = options(|o| o.orient = Orient::Keep);
        let mesh = Mesh::from_polygons(&xyz, &offsets, &indices, None, &keep).unwrap();
        for i in 1..4 {
            for j in 1..4 {
                let p = at(i, j);
                for q in [p, (p + at(i + 1, j)) * 0.5, (p + at(i, j + 1)) * 0.5] {
                    for how in WAYS {
                        let holding = (0..16).filter(|&f| mesh.face_contains(f, q, how)).count();
                        assert_eq!(holding, 1, "{i} {j} {q} {how:?} at {scale:e}");
                    }
                }
            }
        }
    }
}

#[test]
fn points_off_faces_along_an_axis_keep_the_exact_answers() {
    let mesh = tilted_l(Vec3::new(0.1, 0.2, 0.3), Vec3::X, Vec3::Y);
    for how in WAYS {
        for h in [-1e3, 0.0, 1e-9, 7.7] {
            // The lower left corner and side hold their points, the upper right ones do not.
            let inside = |x: f64, y: f64| mesh.face_contains(0, Vec3::new(x, y, 0.3 + h), how);
            assert!(inside(0.1, 0.2) && inside(0.1, 1.0) && inside(1.0, 0.2));
            assert!(!inside(0.1f64.next_down(), 1.0) && !inside(1.0, 0.2f64.next_down()));
            assert!(!inside(0.1 + 3.0, 0.5) && inside((0.1f64 + 3.0).next_down(), 0.5));
        }
    }
}
