// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cursors: the bits of single points in whatever order points come, from rows of a grid to points all over the place.

mod common;

use common::random::Random;
use common::{Soup, bodies};
use embound::geometry::{Accelerator, Cursor, Geometry, SdfOptions, SignMethod};
use embound::math::Vec3;
use embound::parallel::Run;

fn geometry(body: &Soup, sign: SignMethod, accelerator: Accelerator) -> Geometry {
    let options = SdfOptions { sign, accelerator, ..SdfOptions::default() };
    Geometry::from_mesh(&body.mesh(), &options, &Run::SERIAL).unwrap()
}

/// The points of a lattice over the box scaled, x fastest.
fn lattice((lo, hi): ([f64; 3], [f64; 3]), n: [usize; 3], factor: f64) -> Vec<Vec3> {
    let at = |axis: usize, k: usize| {
        let (middle, half) = (0.5 * (lo[axis] + hi[axis]), 0.5 * factor * (hi[axis] - lo[axis]));
        middle - half + 2.0 * half * (k as f64 + 0.5) / n[axis] as f64
    };
    let mut points = Vec::new();
    for k in 0..n[2] {
        for j in 0..n[1] {
            for i in 0..n[0] {
                points.push(Vec3::new(at(0, i), at(1, j), at(2, k)));
            }
        }
    }
    points
}

#[track_caller]
fn assert_same_bits(g: &Geometry, cursor: &Cursor, points: &[Vec3]) {
    for p in points {
        let (value, own) = (cursor.value(*p), g.value(*p));
        assert_eq!(value.to_bits(), own.to_bits(), "{p}: {value} instead of {own}");
    }
}

/// One cursor through every kind of walk, so that cells change size and are forgotten on the way.
#[track_caller]
fn walk(g: &Geometry, bounds: ([f64; 3], [f64; 3]), size: usize) {
    let cursor = Cursor::new(g);
    let (lo, hi) = bounds;
    let mut random = Random(7);
    assert_same_bits(g, &cursor, &lattice(bounds, [size, size, size / 2], 1.3));
    let scattered: Vec<Vec3> = (0..2000).map(|_| Vec3::from_array(random.point(lo, hi))).collect();
    assert_same_bits(g, &cursor, &scattered);
    assert_same_bits(g, &cursor, &lattice(bounds, [2 * size, size, 3], 0.1));
    // Searches along edges.
    for pair in scattered.chunks(2).take(100) {
        let (mut a, mut b) = (pair[0], pair[1]);
        for _ in 0..40 {
            let middle = (a + b) * 0.5;
            assert_same_bits(g, &cursor, &[middle]);
            if g.value(middle) <= 0.0 { a = middle } else { b = middle }
        }
    }
    // The same cells again and again, from far away, and points that are none.
    let few: Vec<Vec3> = lattice(bounds, [5, 5, 5], 0.01);
    for factor in [1.0, 1e2, 1e5, 1e9, 1e200] {
        let far: Vec<Vec3> = few.iter().map(|p| *p * factor).collect();
        for _ in 0..3 {
            assert_same_bits(g, &cursor, &far);
        }
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(cursor.value(Vec3::new(bad, 0.0, 0.0)).is_nan());
    }
    assert_same_bits(g, &cursor, &lattice(bounds, [size, size, size / 2], 1.3));
}

#[test]
fn cursors_have_the_bits_of_single_points() {
    for body in [
        bodies::icosphere(4),
        bodies::bracket(),
        bodies::torus(1.0, 0.3, 60, 30),
        bodies::overlapping_spheres(3),
        bodies::with_flat_triangles(&bodies::icosphere(3)),
        bodies::book(5),
        bodies::icosphere(3).duplicated(),
        bodies::icosphere(3).flipped(),
    ] {
        for sign in [SignMethod::Auto, SignMethod::Ray, SignMethod::None] {
            let options = SdfOptions { sign, ..SdfOptions::default() };
            let Ok(g) = Geometry::from_mesh(&body.mesh(), &options, &Run::SERIAL) else {
                continue;
            };
            walk(&g, body.bounds(), 24);
        }
    }
}

#[test]
fn every_layout_and_scale_has_them() {
    let body = bodies::torus(1.0, 0.3, 60, 30);
    for accelerator in [Accelerator::Auto, Accelerator::Compact, Accelerator::None] {
        walk(&geometry(&body, SignMethod::Auto, accelerator), body.bounds(), 20);
    }
    for scale in [1e-30, 1e-6, 1e3, 1e30] {
        let body = body.scaled(scale);
        walk(&geometry(&body, SignMethod::Auto, Accelerator::Auto), body.bounds(), 20);
    }
    let body = body.translated([1e6, -2e6, 3e5]);
    walk(&geometry(&body, SignMethod::Auto, Accelerator::Auto), body.bounds(), 20);
}

#[test]
fn trees_have_them() {
    let body = bodies::torus(1.0, 0.3, 60, 30);
    let mesh = geometry(&body, SignMethod::Auto, Accelerator::Auto);
    let ball = Geometry::sphere([1.0, 0.0, 0.0], 0.5).unwrap();
    let turned = mesh.rotate([1.0, 2.0, 3.0], 40.0, [0.1, 0.2, 0.3]).unwrap();
    let moved = turned.translate([0.3, -0.2, 0.1]).unwrap();
    let many: Vec<Geometry> = (0..20).map(|k| ball.translate([0.1 * f64::from(k); 3]).unwrap()).collect();
    for g in [
        mesh.complement().unwrap(),
        moved.clone(),
        mesh.offset(0.05).unwrap(),
        mesh.part(3).unwrap(),
        mesh.scale(2.0).unwrap(),
        mesh.difference(&ball).unwrap(),
        Geometry::union(&[mesh.clone(), moved.clone(), ball.clone()]).unwrap(),
        Geometry::intersection(&[mesh.complement().unwrap(), moved]).unwrap(),
        Geometry::union(&many).unwrap(),
        mesh.annular(0.02).unwrap(),
    ] {
        walk(&g, ([-1.5, -1.5, -0.6], [1.5, 1.5, 0.6]), 20);
    }
}

#[test]
fn threads_that_share_one_get_the_same_bits() {
    let body = bodies::icosphere(4);
    let g = geometry(&body, SignMethod::Auto, Accelerator::Auto);
    let cursor = Cursor::new(&g);
    let points = lattice(body.bounds(), [30, 30, 10], 1.2);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| assert_same_bits(&g, &cursor, &points));
        }
    });
}
