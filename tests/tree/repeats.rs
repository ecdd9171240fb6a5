// SPDX-License-Identifier: MIT OR Apache-2.0
//! A repeated body answers as the union of its copies does, to the bit.

use super::scenes::{exact, one};
use super::{same, vector};
use crate::common::random::Random;
use embound::geometry::{Blend, ExpressionOptions, Geometry, Kind};
use embound::math::{Aabb, Vec3};
use embound::parallel::Run;
use embound::query;
use std::sync::Mutex;

/// Not placed: a copy's shift would collapse with the placement, and round otherwise.
fn bodies(random: &mut Random) -> Vec<(&'static str, Geometry)> {
    let mut all = exact(random);
    let (a, b) = (one(random), one(random));
    let bounds = Aabb::new(Vec3::splat(-1.0), Vec3::splat(0.7));
    let steep = ExpressionOptions { bounds, lipschitz: 0.0 };
    all.push(("labels", Geometry::union(&[a.part(1).unwrap(), b.part(2).unwrap()]).unwrap()));
    all.push(("difference", a.difference(&b).unwrap()));
    all.push(("complement", a.complement().unwrap()));
    all.push(("smooth", Geometry::smooth_union(&[a.clone(), b.clone()], &Blend::Smooth(0.3)).unwrap()));
    all.push(("offset", a.offset(0.1).unwrap()));
    all.push(("shell", a.annular(0.05).unwrap()));
    all.push(("longer", a.elongate([0.2, 0.0, 0.1]).unwrap()));
    all.push(("affine", a.affine([1.0, 0.5, 0.0, 0.0, 1.5, 0.0, 0.2, 0.0, 0.7], [0.1; 3]).unwrap()));
    all.push(("disjoint", Geometry::intersection(&[a.translate([9.0, 0.0, 0.0]).unwrap(), b]).unwrap()));
    all.push(("nothing", Geometry::union(&[]).unwrap()));
    all.push(("steep", Geometry::expression("9*(x^2+y^2+z^2-0.3)", &steep).unwrap()));
    all.push(("steeper", Geometry::expression("30*((x^2+2*y^2+z^2)^0.2-0.7)", &steep).unwrap()));
    all
}

fn copies(g: &Geometry, period: [f64; 3], counts: [i32; 3]) -> Geometry {
    let mut all = Vec::new();
    for k in 0..counts[2] {
        for j in 0..counts[1] {
            for i in 0..counts[0] {
                let at = [f64::from(i), f64::from(j), f64::from(k)];
                all.push(g.translate([0, 1, 2].map(|d| period[d] * at[d])).unwrap());
            }
        }
    }
    Geometry::union(&all).unwrap()
}

fn intercept(g: &Geometry, a: Vec3, b: Vec3) -> query::Intercept {
    let out = Mutex::new(None);
    query::intercepts(g, &a.to_array(), &b.to_array(), &Run::SERIAL, &|_, found| {
        *out.lock().unwrap() = Some(found[0]);
    })
    .unwrap();
    out.into_inner().unwrap().unwrap()
}

/// Periods without a copy, closer than the body, far apart, backwards.
fn lattice(random: &mut Random) -> ([f64; 3], [i32; 3]) {
    let period = [0, 1, 2].map(|_| match random.below(6) {
        0 => 0.0,
        1 => random.range(0.01, 0.3),
        2 => random.range(3.0, 9.0),
        _ => random.range(-2.0, 2.0),
    });
    (period, [0, 1, 2].map(|_| 1 + random.below(7) as i32))
}

fn points(period: [f64; 3], counts: [i32; 3], random: &mut Random) -> Vec<Vec3> {
    let last = Vec3::from_array([0, 1, 2].map(|d| period[d] * f64::from(counts[d] - 1)));
    let (lo, hi) = (last.min(Vec3::ZERO) - Vec3::splat(2.0), last.max(Vec3::ZERO) + Vec3::splat(2.0));
    let size = (hi - lo).length();
    (0..25)
        .map(|k| {
            let p = Vec3::from_array(random.point(lo.to_array(), hi.to_array()));
            let i = [0, 1, 2].map(|d| period[d] * random.below(counts[d] as usize) as f64);
            match k % 5 {
                0 | 1 => p,
                // Near a copy's middle; half way between copies.
                2 => Vec3::from_array(i) + vector(random, 0.5),
                3 => Vec3::from_array(i) + Vec3::from_array(period) * 0.5,
                _ => p + vector(random, size) * [10.0, 1e3, 1e9][k / 5 % 3],
            }
        })
        .collect()
}

#[test]
fn a_repeated_body_has_the_bits_of_the_union_of_its_copies() {
    let mut random = Random(171);
    for round in 0..12 {
        for (name, g) in bodies(&mut random) {
            let (period, counts) = lattice(&mut random);
            let (repeated, union) = (g.repeat(period, counts).unwrap(), copies(&g, period, counts));
            for p in points(period, counts, &mut random) {
                let (a, b) = (repeated.value(p), union.value(p));
                assert!(same(a, b), "{round} {name} {period:?} {counts:?} at {p}: {a} for {b}");
                let (a, b) = (repeated.closest(p), union.closest(p));
                let numbers = |c: &embound::geometry::Closest| {
                    let v = [c.point, c.gradient, c.barycentric].map(|v| v.to_array().map(f64::to_bits));
                    (c.value.to_bits(), v[0], v[1], c.part, c.tag, c.primitive, c.feature)
                };
                assert!(same(a.value, b.value) && a.part == b.part, "{name} at {p}: {a:?} for {b:?}");
                if a.point.is_finite() && b.point.is_finite() {
                    assert_eq!(numbers(&a), numbers(&b), "{name} {period:?} {counts:?} at {p}");
                }
            }
        }
    }
}

#[test]
fn a_repeated_body_is_crossed_where_the_union_of_its_copies_is() {
    let mut random = Random(172);
    for _ in 0..4 {
        for (name, g) in bodies(&mut random) {
            let (period, counts) = lattice(&mut random);
            let (repeated, union) = (g.repeat(period, counts).unwrap(), copies(&g, period, counts));
            let ends = points(period, counts, &mut random);
            for pair in ends.windows(2).filter(|pair| pair[0].length() < 1e3 && pair[1].length() < 1e3) {
                let (a, b) = (intercept(&repeated, pair[0], pair[1]), intercept(&union, pair[0], pair[1]));
                let what = format!("{name} {period:?} {counts:?} {} {}", pair[0], pair[1]);
                assert!(same(a.t, b.t), "{what}: {a:?} for {b:?}");
                assert_eq!((a.count, a.status, a.part), (b.count, b.status, b.part), "{what}");
            }
        }
    }
}

#[test]
fn classes_of_a_repeated_body_are_those_of_its_values() {
    let mut random = Random(173);
    let mut known = [0; 3];
    for _ in 0..6 {
        for (name, g) in bodies(&mut random) {
            let (period, counts) = lattice(&mut random);
            let (repeated, union) = (g.repeat(period, counts).unwrap(), copies(&g, period, counts));
            for (k, p) in points(period, counts, &mut random).into_iter().enumerate() {
                let half = Vec3::from_array(random.point([0.0; 3], [1.0; 3])) * 0.3f64.powi(k as i32 % 9);
                let b = Aabb::new(p - half, p + half);
                let class = query::classify_box(&repeated, b);
                assert!(class * query::classify_box(&union, b) >= 0, "{name}");
                known[(class + 1) as usize] += 1;
                for _ in 0..30 {
                    let q = p + half * vector(&mut random, 1.0);
                    let v = repeated.value(q.clamp(b.lo, b.hi));
                    assert!(class == 0 || v * f64::from(class) > 0.0, "{name}: {class} but {v} at {q}");
                }
            }
        }
    }
    assert!(known.iter().all(|n| *n > 100), "{known:?}");
}

#[test]
fn too_many_copies_at_one_point_are_refused() {
    let ball = Geometry::sphere([0.0; 3], 1.0).unwrap();
    let error = ball.repeat([1e-7, 1e-7, 1.0], [100_000, 100_000, 2]).err().expect("refused");
    assert_eq!(error.status(), embound::Status::Unsupported);
    assert!(error.message().contains("copies may be at one point"), "{error}");
    let many = ball.repeat([3.0; 3], [1_000_000; 3]).unwrap();
    assert_eq!(many.value(Vec3::splat(2.4e6)), -1.0);
    assert_eq!(ball.repeat([0.0; 3], [i32::MAX, 1, 1]).unwrap().value(Vec3::ZERO), -1.0);
}

#[test]
fn a_repeated_body_is_exact_where_its_copies_keep_apart() {
    let ball = Geometry::sphere([0.3, 0.0, 0.0], 1.0).unwrap();
    for (period, kind) in [
        ([2.1, -2.1, 3.0], Kind::Exact),
        ([2.1, 2.1, 1.9], Kind::LowerBound),
        ([2.0, 3.0, 3.0], Kind::LowerBound),
        // Copies in one place are one.
        ([0.0, 3.0, 3.0], Kind::Exact),
    ] {
        assert_eq!(ball.repeat(period, [2, 3, 4]).unwrap().kind(), kind, "{period:?}");
    }
    assert_eq!(ball.repeat([0.0; 3], [1; 3]).unwrap().kind(), Kind::Exact);
}

#[test]
fn lattices_within_lattices_are_answered_at_once() {
    let mut g = Geometry::sphere([0.0; 3], 0.3).unwrap();
    for _ in 0..60 {
        g = g.repeat([0.5, 0.0, 0.0], [1, 1, 1]).unwrap();
    }
    assert_eq!(g.value(Vec3::X), 0.7);
    // A thousand to the third copies.
    let many = Geometry::sphere([0.0; 3], 0.3).unwrap().repeat([1.0, -1.0, 1.0], [1000; 3]).unwrap();
    let p = Vec3::new(500.25, -700.0, 10.0);
    assert!((many.value(p) - (0.25 - 0.3)).abs() < 1e-12);
    assert!((many.value(Vec3::new(-4.0, 3.0, 0.0)) - 4.7).abs() < 1e-12);
}
