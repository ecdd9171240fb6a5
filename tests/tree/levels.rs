// SPDX-License-Identifier: MIT OR Apache-2.0
//! Offsets, shells, means, and what turns into a lower bound.

use super::scenes::exact;
use super::{between, same, vector};
use crate::common::random::Random;
use embound::geometry::{Blend, Geometry, Kind};
use embound::math::{Aabb, Vec3};
use embound::query;

/// Convex bodies: exact outward; ball and plane and torus both ways.
const CONVEX: [&str; 12] = [
    "sphere",
    "cuboid",
    "plane",
    "plane z",
    "cylinder",
    "infinite cylinder",
    "capsule",
    "cone",
    "box",
    "rounded box",
    "prism",
    "ellipsoid",
];

fn ball() -> Geometry {
    Geometry::sphere([0.5, 0.0, 0.0], 1.0).unwrap()
}

#[test]
fn offsets_and_shells_have_their_formulas_to_the_bit() {
    let mut random = Random(141);
    for (name, g) in exact(&mut random) {
        let d = random.range(0.01, 0.5);
        let (out, thin, shell) = (g.offset(d).unwrap(), g.offset(-d).unwrap(), g.annular(d).unwrap());
        for _ in 0..100 {
            let p = vector(&mut random, 4.0);
            let f = g.value(p);
            assert!(same(out.value(p), f - d) && same(thin.value(p), f + d), "{name}");
            assert!(same(shell.value(p), f.abs() - d), "{name}");
        }
    }
}

#[test]
fn what_is_exact_says_so_after_an_offset() {
    let mut random = Random(142);
    for _ in 0..5 {
        for (name, g) in exact(&mut random) {
            if CONVEX.contains(&name) {
                assert_eq!(g.offset(0.4).unwrap().kind(), Kind::Exact, "{name}");
            }
        }
    }
    let torus = Geometry::torus([0.0; 3], [0.0, 0.0, 1.0], 1.0, 0.25).unwrap();
    let plane = Geometry::plane([0.0; 3], [1.0, 2.0, 3.0]).unwrap();
    let cube = Geometry::cuboid([-1.0; 3], [1.0; 3]).unwrap();
    for (g, d, kind) in [
        (&torus, 0.5, Kind::Exact),
        (&torus, -0.2, Kind::Exact),
        (&torus, 0.8, Kind::LowerBound),
        (&torus, -0.3, Kind::LowerBound),
        (&plane, -1e9, Kind::Exact),
        (&plane, 1e9, Kind::Exact),
        (&ball(), -0.5, Kind::Exact),
        (&ball(), 1e3, Kind::Exact),
        (&cube, -0.1, Kind::LowerBound),
        (&cube.complement().unwrap(), 0.1, Kind::LowerBound),
        (&cube.complement().unwrap(), -0.1, Kind::Exact),
    ] {
        assert_eq!(g.offset(d).unwrap().kind(), kind, "by {d}");
    }
    for (g, d, kind) in [
        (&torus, 0.2, Kind::Exact),
        (&torus, 0.3, Kind::LowerBound),
        (&plane, 7.0, Kind::Exact),
        (&cube, 0.1, Kind::LowerBound),
        (&ball(), 0.9, Kind::Exact),
        (&ball(), 1.1, Kind::LowerBound),
    ] {
        assert_eq!(g.annular(d).unwrap().kind(), kind, "shell of {d}");
    }
}

/// Chains of offsets, shells, complements and placements.
#[test]
fn whatever_says_exact_has_closest_points_on_its_surface() {
    let mut random = Random(143);
    let mut exact_ones = 0;
    for _ in 0..30 {
        for (name, mut g) in exact(&mut random) {
            let mut path = name.to_string();
            for _ in 0..1 + random.below(4) {
                let d = random.range(-0.6, 0.6);
                let which = random.below(5);
                path += &format!(", {} {d}", ["offset", "annular", "complement", "scale", "offset"][which]);
                g = match which {
                    1 => g.annular(d.abs() + 0.01),
                    2 => g.complement(),
                    3 => g.rotate([1.0, 1.0, 0.0], 50.0 * d, [0.2; 3]).unwrap().scale(d.exp2()),
                    _ => g.offset(d),
                }
                .unwrap();
            }
            if g.kind() != Kind::Exact {
                continue;
            }
            exact_ones += 1;
            let points: Vec<Vec3> = (0..60).map(|_| vector(&mut random, 3.0)).collect();
            let (inside, outside): (Vec<Vec3>, Vec<Vec3>) = points.iter().partition(|p| g.value(**p) <= 0.0);
            let near: Vec<Vec3> = inside.iter().zip(outside.iter().cycle()).map(|(a, b)| between(&g, *a, *b)).collect();
            for p in points {
                let c = g.closest(p);
                assert!(g.value(c.point).abs() < 1e-11, "{path} at {p}: {c:?}: {}", g.value(c.point));
                for q in &near {
                    assert!(c.value.abs() <= (p - *q).length() + 1e-11, "{path} at {p}: {c:?}, but surface at {q}");
                }
                let mut beside = || g.value(c.point + super::direction(&mut random) * 1e-6) <= 0.0;
                let first = beside();
                assert!((0..20_000).any(|_| beside() != first), "{path} at {p}: no surface at {}", c.point);
            }
        }
    }
    assert!(exact_ones > 150, "{exact_ones}");
}

#[test]
fn the_mean_of_a_linear_function_is_that_function() {
    let mut random = Random(144);
    for _ in 0..20 {
        let (point, normal) = (vector(&mut random, 1.0).to_array(), super::direction(&mut random).to_array());
        let g = Geometry::plane(point, normal).unwrap();
        let h = random.range(0.01, 2.0);
        let mut means: Vec<Geometry> =
            [0.0, 0.25, 1.0, random.unit()].iter().map(|alpha| g.blur(h, *alpha).unwrap()).collect();
        means.extend([1, 2, 3, 8, 32].iter().map(|n| g.mollify(h, *n).unwrap()));
        for mean in means {
            assert_eq!(mean.kind(), Kind::LowerBound);
            for _ in 0..20 {
                let p = vector(&mut random, 4.0);
                let (a, b) = (mean.closest(p), g.closest(p));
                assert!((a.value - b.value).abs() < 1e-13 * 4.0, "{} for {}", a.value, b.value);
                assert!((a.gradient - b.gradient).length() < 1e-13);
                assert_eq!(a.value.to_bits(), mean.value(p).to_bits());
            }
        }
    }
}

#[test]
fn means_are_the_sums_their_formulas_say() {
    let mut random = Random(145);
    let g = Geometry::union(&[ball(), Geometry::cuboid([-1.0; 3], [0.0; 3]).unwrap()]).unwrap();
    for _ in 0..20 {
        let (h, alpha) = (random.range(0.01, 0.5), random.unit());
        let n = 1 + random.below(6);
        let (blur, mollified) = (g.blur(h, alpha).unwrap(), g.mollify(h, n as i32).unwrap());
        let weights = |k: i32| if k == 0 { alpha } else { 0.5 * (1.0 - alpha) };
        let choose = |k: usize| (0..k).fold(1.0, |c, i| c * (n - 1 - i) as f64 / (i + 1) as f64);
        let place = |k: usize| if n == 1 { 0.0 } else { h * (2.0 * k as f64 / (n - 1) as f64 - 1.0) };
        for _ in 0..20 {
            let p = vector(&mut random, 2.0);
            let (mut a, mut b) = (0.0, 0.0);
            for code in 0..27 {
                let k = [code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1];
                let d = Vec3::from_array(k.map(f64::from)) * h;
                a += k.map(weights).iter().product::<f64>() * g.value(p + d);
            }
            for code in 0..n * n * n {
                let k = [code % n, code / n % n, code / n / n];
                let weight = k.map(choose).iter().product::<f64>() / f64::from(1 << (3 * (n - 1)));
                b += weight * g.value(p + Vec3::from_array(k.map(place)));
            }
            assert!((blur.value(p) - a).abs() < 1e-13, "blur {h} {alpha}: {} for {a}", blur.value(p));
            assert!((mollified.value(p) - b).abs() < 1e-13, "mollify {h} {n}: {} for {b}", mollified.value(p));
        }
    }
}

#[test]
fn a_lower_bound_is_the_value_over_its_lipschitz_constant() {
    let noise = Geometry::perlin(2.0, [1.5, 1.0, 0.5], 0.5, 3, 7).unwrap();
    let l = noise.properties().lipschitz;
    let g = noise.lower_bound().unwrap();
    assert_eq!(noise.kind(), Kind::SignOnly);
    assert_eq!(g.kind(), Kind::LowerBound);
    assert!(g.properties().lipschitz <= 1.0 + 1e-12, "{}", g.properties().lipschitz);
    let mut random = Random(146);
    for _ in 0..200 {
        let p = vector(&mut random, 5.0);
        assert_eq!(g.value(p), noise.value(p) / l);
    }
    let unknown =
        Geometry::plane([0.0; 3], [1.0, 1.0, 0.0]).unwrap().twist(30.0).unwrap().lower_bound().err().expect("refused");
    assert_eq!(unknown.status(), embound::Status::Unsupported);
}

/// A grid of positive values has no body, and one close by.
#[test]
fn what_is_nowhere_may_be_somewhere_when_it_grows() {
    let axis = [-1.0, 1.0];
    let values = [0.1, 0.1, 0.2, 0.2, 0.1, 0.1, 0.2, 0.3];
    let g = Geometry::grid([&axis; 3], &values).unwrap();
    let all = Geometry::grid([&axis; 3], &values.map(|x| -x)).unwrap();
    let here = Aabb::new(Vec3::splat(-0.5), Vec3::splat(0.5));
    assert_eq!((g.bounds(), query::classify_box(&g, here)), (Aabb::EMPTY, 1));
    let blend = Blend::Exponential(1.0);
    for g in [
        g.offset(0.5).unwrap(),
        g.annular(0.5).unwrap(),
        all.offset(-0.5).unwrap().complement().unwrap(),
        Geometry::smooth_union(&[g.clone(), g.clone()], &blend).unwrap(),
    ] {
        assert!(g.value(Vec3::ZERO) < 0.0 && g.bounds().contains(Vec3::ZERO), "{:?}", g.bounds());
        assert_ne!(query::classify_box(&g, here), 1);
    }
}

/// What is made of a lower bound by operations that keep it one.
#[test]
fn a_lower_bound_stays_one_under_everything_that_keeps_it() {
    let m = [1.0, 0.3, 0.0, 0.0, 0.8, 0.1, 0.0, 0.0, 1.4];
    type Keeps = (&'static str, fn(&Geometry) -> embound::Result<Geometry>);
    let keeps: [Keeps; 9] = [
        ("affine", |g| g.affine([1.0, 0.3, 0.0, 0.0, 0.8, 0.1, 0.0, 0.0, 1.4], [0.1; 3])),
        ("offset", |g| g.offset(0.1)),
        ("annular", |g| g.annular(0.1)),
        ("blur", |g| g.blur(0.1, 0.5)),
        ("elongate", |g| g.elongate([0.1, 0.2, 0.0])),
        ("slice", |g| g.slice([0.1; 3], [1.0, 1.0, 0.0], [0.0, 0.3, 1.0])),
        ("rotate", |g| g.rotate([1.0, 0.0, 1.0], 20.0, [0.0; 3])),
        ("complement", |g| g.complement()),
        ("lower bound", |g| g.lower_bound()),
    ];
    let noise = Geometry::perlin(2.0, [1.0; 3], 0.5, 2, 1).unwrap().lower_bound().unwrap();
    for home in
        [ball().affine(m, [0.0; 3]).unwrap(), noise, ball().slice([0.1; 3], [1.0, 2.0, 0.0], [0.0, 0.0, 1.0]).unwrap()]
    {
        assert_eq!(home.kind(), Kind::LowerBound);
        for (first, a) in &keeps {
            for (second, b) in &keeps {
                let g = b(&a(&home).unwrap()).unwrap();
                assert_eq!(g.kind(), Kind::LowerBound, "{second} of {first}: {:?}", g.properties());
            }
        }
    }
}
