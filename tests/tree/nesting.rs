// SPDX-License-Identifier: MIT OR Apache-2.0
//! A thousand levels on a small stack, one more refused; millions of parts dropped.

use super::vector;
use crate::common::random::Random;
use embound::Status;
use embound::geometry::{Blend, Geometry};
use embound::math::{Aabb, Vec3};
use embound::parallel::Run;
use embound::query;

const DEEPEST: usize = 1000;

fn ball(random: &mut Random) -> Geometry {
    Geometry::sphere(vector(random, 1.0).to_array(), random.range(0.1, 0.5)).unwrap()
}

/// One level more.
type Level = fn(&Geometry, &mut Random) -> embound::Result<Geometry>;

const LEVELS: [Level; 14] = [
    |g, _| g.part(7),
    |g, r| Geometry::union(&[ball(r), g.clone(), ball(r), ball(r), ball(r)]),
    |g, _| g.translate([0.01, 0.0, 0.0]),
    |g, _| g.complement(),
    |g, r| Geometry::smooth_union(&[g.clone(), ball(r)], &Blend::Smooth(0.1)),
    |g, _| g.rotate([1.0, 2.0, 3.0], 10.0, [0.0; 3]),
    |g, _| g.offset(0.001),
    |g, r| g.difference(&ball(r).scale(0.1).unwrap()),
    |g, r| g.smooth_difference(&[ball(r)], &Blend::Exponential(0.01)),
    |g, _| g.annular(2.0),
    |g, _| g.elongate([0.01, 0.0, 0.0]),
    |g, _| g.repeat([0.0; 3], [1; 3]),
    |g, _| g.affine([1.0, 0.01, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], [0.0; 3]),
    |g, r| {
        Geometry::intersection(&[
            g.clone(),
            ball(r).offset(3.0).unwrap(),
            ball(r).offset(4.0).unwrap(),
            ball(r).offset(4.0).unwrap(),
        ])
    },
];

/// As many levels as are allowed.
fn deepest(levels: &[Level], random: &mut Random) -> (Geometry, embound::Error) {
    let mut g = ball(random);
    for k in 0..2 * DEEPEST {
        match levels[k % levels.len()](&g, random) {
            Ok(deeper) => g = deeper,
            Err(error) => return (g, error),
        }
    }
    panic!("no end");
}

fn on_a_small_stack(work: impl FnOnce() + Send + 'static) {
    std::thread::Builder::new().stack_size(1 << 20).spawn(work).unwrap().join().unwrap();
}

fn ask(g: &Geometry) {
    let mut random = Random(41);
    for _ in 0..4 {
        let (a, b) = (vector(&mut random, 2.0), vector(&mut random, 2.0));
        assert!(!g.value(a).is_nan());
        assert_eq!(g.closest(a).value, g.value(a));
        query::classify_box(g, Aabb::new(a.min(b), a.max(b)));
        query::intercepts(g, &a.to_array(), &b.to_array(), &Run::SERIAL, &|_, _| ()).unwrap();
    }
    g.fingerprint();
    g.properties();
    g.simplified(Aabb::new(Vec3::splat(-0.5), Vec3::splat(0.5))).unwrap();
}

#[test]
fn a_thousand_levels_of_everything_work_on_a_small_stack() {
    on_a_small_stack(|| {
        let (g, error) = deepest(&LEVELS, &mut Random(42));
        assert_eq!(error.status(), Status::Unsupported);
        assert!(error.message().contains("1000"), "{error}");
        ask(&g);
        drop(g);
    });
}

#[test]
fn a_thousand_levels_of_each_kind_work_on_a_small_stack() {
    // Placements collapse: a label keeps them apart.
    for (k, level) in LEVELS.into_iter().enumerate() {
        on_a_small_stack(move || {
            let (g, error) = deepest(&[level, LEVELS[0]], &mut Random(43));
            assert_eq!(error.status(), Status::Unsupported, "level {k}");
            ask(&g);
        });
    }
}

#[test]
fn exactly_a_thousand_levels_are_allowed() {
    let mut g = Geometry::sphere([0.0; 3], 1.0).unwrap();
    for _ in 1..DEEPEST {
        g = g.complement().unwrap();
    }
    assert_eq!(g.value(Vec3::X * 3.0).abs(), 2.0);
    let error = g.complement().err().expect("refused");
    assert_eq!(error.status(), Status::Unsupported);
    assert!(error.message().contains("1001"), "{error}");
    let nested = |g: &Geometry| {
        [g.part(1), Geometry::union(std::slice::from_ref(g)), g.offset(0.1), g.annular(0.1), g.blur(0.1, 0.5)]
    };
    assert!(nested(&g).iter().all(|g| g.is_err()));
    // What collapses is no deeper.
    let placed = Geometry::sphere([0.0; 3], 1.0).unwrap().translate([1.0; 3]).unwrap();
    assert!((0..3000).try_fold(placed, |g, _| g.translate([0.1; 3])).is_ok());
}

#[test]
fn a_million_spheres_are_built_asked_and_dropped() {
    on_a_small_stack(|| {
        let mut random = Random(44);
        let balls: Vec<Geometry> =
            (0..1_000_000).map(|_| Geometry::sphere(vector(&mut random, 1.0).to_array(), 0.004).unwrap()).collect();
        let g = Geometry::union(&balls).unwrap();
        assert_eq!(g.properties().primitives, 1_000_000);
        for p in (0..3).map(|_| vector(&mut random, 1.2)) {
            let least = balls.iter().map(|g| g.value(p)).fold(f64::INFINITY, f64::min);
            assert_eq!(g.value(p), least);
        }
        drop(balls);
        drop(g);
    });
}
