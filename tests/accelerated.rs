// SPDX-License-Identifier: MIT OR Apache-2.0
//! The hierarchy against its brute-force twin, bit for bit.

mod common;

use common::random::Random;
use common::{Soup, bodies, points};
use embound::geometry::{Accelerator, Geometry, SdfOptions, SignMethod};
use embound::math::{Aabb, Vec3};
use embound::parallel::Run;
use embound::query::{self, Intercept};
use std::sync::Mutex;

/// With each layout of the hierarchy, and without one.
fn layouts(soup: &Soup, sign: SignMethod) -> ([Geometry; 2], Geometry) {
    let build = |accelerator| {
        let options = SdfOptions { accelerator, sign, ..SdfOptions::default() };
        Geometry::from_mesh(&soup.mesh(), &options, &Run::SERIAL).unwrap()
    };
    ([build(Accelerator::Auto), build(Accelerator::Compact)], build(Accelerator::None))
}

fn closed_bodies() -> Vec<Soup> {
    vec![
        bodies::tetrahedron(),
        bodies::unit_cube(),
        bodies::icosphere(3),
        bodies::torus(1.0, 0.25, 48, 16),
        bodies::leaning_pyramid(),
        bodies::bracket(),
        bodies::plate(4, 3, 0.2, 0.45, 6),
        bodies::nested_shells(2),
        bodies::overlapping_spheres(2),
        // Slivers: a torus pressed flat.
        bodies::torus(1.0, 0.25, 48, 16).map(|p| [p[0], p[1], p[2] * 1e-5]),
    ]
}

fn assert_same(soup: &Soup, sign: SignMethod, points: &[[f64; 3]]) {
    let (fast, slow) = layouts(soup, sign);
    for p in points {
        let p = Vec3::from_array(*p);
        let b = slow.closest(p);
        for fast in &fast {
            let a = fast.closest(p);
            assert_eq!(a.value.to_bits(), b.value.to_bits(), "{p}: {} {}", a.value, b.value);
            assert_eq!((a.primitive, a.feature), (b.primitive, b.feature), "{p}");
            assert_eq!(a.point.to_array().map(f64::to_bits), b.point.to_array().map(f64::to_bits), "{p}");
            assert_eq!(fast.value(p).to_bits(), a.value.to_bits(), "value and closest differ at {p}");
        }
    }
}

#[test]
fn every_body_at_every_scale_and_place_answers_as_brute_force_does() {
    let mut random = Random(11);
    for soup in closed_bodies() {
        for scale in [1e-6, 1.0, 1e6] {
            let (lo, hi) = soup.bounds();
            let away = 1e3 * (0..3).map(|d| (hi[d] - lo[d]).powi(2)).sum::<f64>().sqrt();
            for shift in [[0.0; 3], [away, -away, 0.5 * away]] {
                let body = soup.translated(shift).scaled(scale);
                assert_same(&body, SignMethod::Auto, &points::all_kinds(&body, 60, &mut random));
            }
        }
    }
}

#[test]
fn open_sheets_and_soups_answer_as_brute_force_does_without_a_sign() {
    let mut random = Random(12);
    for soup in [bodies::sheet(9), bodies::moebius_strip(20), bodies::book(5), bodies::unit_cube().duplicated()] {
        assert_same(&soup, SignMethod::None, &points::all_kinds(&soup, 300, &mut random));
    }
}

#[test]
fn the_centre_of_a_sphere_where_all_triangles_are_equally_near() {
    let mut random = Random(13);
    for level in 0..5 {
        let sphere = bodies::icosphere(level);
        let mut points = vec![[0.0; 3]];
        points.extend((0..50).map(|_| random.point([-1e-9; 3], [1e-9; 3])));
        points.extend((0..50).map(|_| random.point([-1e-3; 3], [1e-3; 3])));
        assert_same(&sphere, SignMethod::Auto, &points);
        assert_same(&sphere.scaled(1e-6), SignMethod::Auto, &[[0.0; 3]]);
    }
}

#[test]
fn deliberate_ties_go_to_the_lowest_face() {
    // Points straight above vertices and edges of a grid of coplanar triangles, and faces given twice.
    let cube = bodies::cells(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0], |_, _, _| true);
    let mut points = Vec::new();
    for i in 0..13 {
        for j in 0..13 {
            points.push([i as f64 * 0.25, j as f64 * 0.25, 1.5]);
            points.push([i as f64 * 0.25, j as f64 * 0.25, 0.5]);
        }
    }
    assert_same(&cube, SignMethod::Auto, &points);
    assert_same(&cube.duplicated(), SignMethod::None, &points);
    let ([fast, _], _) = layouts(&cube.duplicated(), SignMethod::None);
    let original = cube.triangles.len() as i64;
    assert!(points.iter().all(|p| fast.closest(Vec3::from_array(*p)).primitive < original));
}

#[test]
fn far_away_points_are_answered() {
    let cube = bodies::unit_cube();
    for far in [1e3, 1e10, 1e100, 1e153, 1e160, 1e300] {
        let p = [far, 0.25, 0.5];
        assert_same(&cube, SignMethod::Auto, &[p]);
        let value = layouts(&cube, SignMethod::Auto).0[0].value(Vec3::from_array(p));
        assert!((value / far - 1.0).abs() < 2e-3, "{value} at {far}");
    }
}

#[test]
fn crossings_and_classes_do_not_depend_on_the_hierarchy() {
    let mut random = Random(14);
    for soup in closed_bodies() {
        let (fast, slow) = layouts(&soup, SignMethod::Auto);
        let (a, b) = (
            points::uniform(&soup, 1.2, 150, &mut random).concat(),
            points::near(&soup, 0.05, 150, &mut random).concat(),
        );
        let slow_hits = intercepts(&slow, &a, &b);
        for fast in &fast {
            for (f, s) in intercepts(fast, &a, &b).iter().zip(&slow_hits) {
                assert_eq!(f.t.to_bits(), s.t.to_bits());
                assert_eq!((f.count, f.status, f.primitive), (s.count, s.status, s.primitive));
            }
            for p in a.chunks(3) {
                let p = Vec3::from_slice(p);
                let b = Aabb::new(p - Vec3::splat(0.05), p + Vec3::splat(0.05));
                assert_eq!(query::classify_box(fast, b), query::classify_box(&slow, b));
            }
        }
    }
}

#[test]
fn the_compact_layout_is_half_of_the_fast_one() {
    let ([fast, compact], _) = layouts(&bodies::icosphere(5), SignMethod::Auto);
    let [fast, compact] = [fast, compact].map(|g| {
        let properties = g.properties();
        properties.bytes as f64 / properties.primitives as f64
    });
    assert!(fast < 250.0 && compact < 100.0, "{fast} and {compact} bytes a triangle");
}

#[test]
fn many_points_of_a_large_mesh_are_answered_in_the_order_they_came() {
    let mut random = Random(15);
    let ([fast, compact], _) = layouts(&bodies::icosphere(5), SignMethod::Auto);
    for count in [255, 256, 257, 4096, 4097, 20_000] {
        let mut points: Vec<[f64; 3]> = (0..count).map(|_| random.point([-2.0; 3], [2.0; 3])).collect();
        points[count / 2] = [f64::NAN, 0.0, 0.0];
        points[count / 3] = [0.0, f64::INFINITY, 0.0];
        let flat = points.concat();
        let source = query::Strided::new(count, [&flat[..], &flat[1..], &flat[2..]], 3).unwrap();
        let pool = embound::parallel::Pool::new(3, || ()).unwrap();
        for run in [Run::SERIAL, Run { pool: Some(&pool), progress: None }] {
            for g in [&fast, &compact] {
                let values = Mutex::new(vec![0.0; count]);
                let emit = |first: usize, found: &[f64]| {
                    values.lock().unwrap()[first..first + found.len()].copy_from_slice(found);
                };
                query::values(g, &source, &run, &emit).unwrap();
                let nearest = Mutex::new(vec![-2; count]);
                let emit = |first: usize, found: &[query::Closest]| {
                    let mut nearest = nearest.lock().unwrap();
                    found.iter().zip(&mut nearest[first..]).for_each(|(c, slot)| *slot = c.primitive);
                };
                query::closest(g, &source, f64::INFINITY, &run, &emit).unwrap();
                let (values, nearest) = (values.into_inner().unwrap(), nearest.into_inner().unwrap());
                for (p, (value, primitive)) in points.iter().zip(values.iter().zip(&nearest)).step_by(7) {
                    let closest = fast.closest(Vec3::from_array(*p));
                    assert_eq!((value.to_bits(), *primitive), (closest.value.to_bits(), closest.primitive), "{p:?}");
                }
            }
        }
    }
}

fn intercepts(g: &Geometry, a: &[f64], b: &[f64]) -> Vec<Intercept> {
    let out = Mutex::new(vec![None; a.len() / 3]);
    query::intercepts(g, a, b, &Run::SERIAL, &|first, found| {
        for (k, hit) in found.iter().enumerate() {
            out.lock().unwrap()[first + k] = Some(*hit);
        }
    })
    .unwrap();
    out.into_inner().unwrap().into_iter().map(|hit| hit.expect("every segment answered")).collect()
}
