// SPDX-License-Identifier: MIT OR Apache-2.0
//! Maps that are no placements: affine ones, elongation, twist, slice.

use super::scenes::exact;
use super::{between, direction, rotation, vector};
use crate::common::random::Random;
use embound::geometry::{Geometry, Kind};
use embound::math::{Mat3, Vec3};

fn rows(m: Mat3) -> [f64; 9] {
    m.transpose().to_cols_array()
}

fn matrix(rows: [f64; 9]) -> Mat3 {
    Mat3::from_cols_array(&rows).transpose()
}

/// With these stretches along random directions.
fn stretching(stretches: [f64; 3], random: &mut Random) -> Mat3 {
    let (a, b) = (matrix(rotation(random)), matrix(rotation(random)));
    a * Mat3::from_diagonal(Vec3::from_array(stretches)) * b
}

#[test]
fn an_affine_map_has_the_sign_of_the_body_at_the_mapped_point() {
    let mut random = Random(151);
    for _ in 0..10 {
        for (name, home) in exact(&mut random) {
            let m = stretching(random.point([0.2; 3], [3.0; 3]), &mut random);
            let shift = vector(&mut random, 1.0);
            let g = home.affine(rows(m), shift.to_array()).unwrap();
            assert_eq!(g.kind(), Kind::LowerBound);
            for _ in 0..50 {
                let q = vector(&mut random, 3.0);
                let (p, f) = (m * q + shift, home.value(q));
                if f.abs() > 1e-9 {
                    assert_eq!(g.value(p) > 0.0, f > 0.0, "{name} at {p}");
                }
                let c = g.closest(p);
                assert!(c.point.x.is_nan() && c.gradient.length() < 1.0 + 1e-9);
            }
        }
    }
}

#[test]
fn an_affine_map_and_its_inverse_leave_the_body() {
    let mut random = Random(152);
    for (name, home) in exact(&mut random) {
        let m = stretching(random.point([0.5; 3], [2.0; 3]), &mut random);
        let shift = vector(&mut random, 1.0);
        let back = m.inverse();
        let g = home.affine(rows(m), shift.to_array()).unwrap();
        let g = g.affine(rows(back), (back * -shift).to_array()).unwrap();
        assert_eq!(g.kind(), Kind::LowerBound, "{name}: {:?}", g.properties());
        for _ in 0..200 {
            let p = vector(&mut random, 3.0);
            let (a, b) = (g.value(p), home.value(p));
            assert!(a.abs() <= b.abs() * (1.0 + 1e-12) + 1e-13, "{name} at {p}: {a} of {b}");
            assert!(b.abs() < 1e-12 || (a > 0.0) == (b > 0.0), "{name} at {p}: {a} of {b}");
        }
    }
}

/// Down to where matrices are refused, at any scale.
#[test]
fn maps_that_squeeze_hard_are_lower_bounds_with_bounds_that_hold() {
    let mut random = Random(153);
    let mut inside = 0;
    for k in 0..400 {
        let thin = 10f64.powf(random.range(-9.0, 0.0));
        let other = [1.0, thin, thin.sqrt()][k % 3];
        let scale = [1.0, 1e-120, 1e120, 1e6][k % 4];
        let m = stretching([1.0, other, thin], &mut random) * scale;
        let home = Geometry::sphere([0.3, -0.2, 0.1], 1.0).unwrap();
        let g = home.affine(rows(m), [0.0; 3]).unwrap();
        let what = format!("1, {other:e}, {thin:e} times {scale:e}");
        assert!(g.bounds().is_finite(), "{what}");
        let l = g.properties().lipschitz;
        for _ in 0..40 {
            let q = Vec3::new(0.3, -0.2, 0.1) + direction(&mut random) * random.range(0.9, 1.1);
            let p = m * q;
            let f = g.value(p);
            assert!(f.is_finite(), "{what}: {f} at {p}");
            if f <= 0.0 {
                inside += 1;
                assert!(g.bounds().contains(p), "{what}: {p} off {:?}", g.bounds());
            }
            let step = direction(&mut random) * scale * 10f64.powf(random.range(-12.0, 0.0));
            let change = (g.value(p + step) - f).abs();
            let rounding = 1e-13 * scale;
            let length = ((p + step) - p).length();
            assert!(change <= l * length * (1.0 + 1e-12) + rounding, "{what}: {change} over {length} at {p}");
        }
        // The surface is where the matrix puts it, to within what it squeezes.
        let wrong = g.value(m * Vec3::new(0.3, -0.2, 1.1)).abs();
        assert!(wrong < 1e-12 * scale, "{what}: {wrong} on the surface");
    }
    assert!(inside > 1000, "{inside}");
}

#[test]
fn matrices_without_an_inverse_are_refused_at_any_scale() {
    let mut random = Random(154);
    let home = Geometry::sphere([0.0; 3], 1.0).unwrap();
    for scale in [1.0, 1e-100, 1e100, 1e-300] {
        for stretches in [[1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3], [1.0, 1e-14, 1.0], [1.0, 1.0, 1e-13]] {
            let m = stretching(stretches, &mut random) * scale;
            let error = home.affine(rows(m), [0.0; 3]).err().unwrap_or_else(|| panic!("{stretches:?} times {scale:e}"));
            assert!(error.message().starts_with("matrix: "), "{error}");
        }
    }
}

#[test]
fn elongation_twist_and_slice_are_the_body_at_the_mapped_point() {
    let mut random = Random(155);
    for _ in 0..5 {
        for (name, home) in exact(&mut random) {
            let e = Vec3::from_array(random.point([0.0; 3], [1.0; 3]));
            let rate = random.range(-200.0, 200.0);
            let (origin, u) = (vector(&mut random, 1.0), direction(&mut random));
            let w = direction(&mut random);
            let v = (w - u * w.dot(u)).normalize();
            let longer = home.elongate(e.to_array()).unwrap();
            let twisted = home.twist(rate).unwrap();
            let slice = home.slice(origin.to_array(), (u * 3.0).to_array(), w.to_array()).unwrap();
            assert_eq!((longer.kind(), slice.kind()), (Kind::LowerBound, Kind::LowerBound));
            // Within bounds a twist stretches by no more than so much; without, without limit.
            let is_bounded = home.bounds().is_finite();
            assert_eq!(twisted.kind(), if is_bounded { Kind::LowerBound } else { Kind::SignOnly }, "{name}");
            for _ in 0..50 {
                let p = vector(&mut random, 3.0);
                assert_eq!(longer.value(p).to_bits(), home.value(p - p.clamp(-e, e)).to_bits(), "{name} at {p}");
                let (s, c) = (rate.to_radians() * p.z).sin_cos();
                let q = Vec3::new(c * p.x + s * p.y, c * p.y - s * p.x, p.z);
                let (bent, straight) = (twisted.value(p), home.value(q));
                if !is_bounded {
                    assert!((bent - straight).abs() < 1e-13 * 20.0, "{name} at {p}");
                } else if straight.abs() > 1e-11 {
                    assert!((bent > 0.0) == (straight > 0.0), "{name} at {p}: {bent}, not {straight}");
                    let is_within = twisted.bounds().contains(p);
                    assert!(!is_within || bent.abs() <= straight.abs() + 1e-12, "{name} at {p}: {bent}, {straight}");
                }
                let q = origin + u * p.x + v * p.y;
                assert!((slice.value(p) - home.value(q)).abs() < 1e-13 * 20.0, "{name} at {p}");
                assert_eq!(slice.value(p).to_bits(), slice.value(p.with_z(77.0)).to_bits(), "{name}");
            }
        }
    }
}

#[test]
fn gradients_of_mapped_bodies_are_those_of_the_values() {
    let mut random = Random(156);
    let mut compared = 0;
    for (name, home) in exact(&mut random) {
        let m = rows(stretching(random.point([0.5; 3], [2.0; 3]), &mut random));
        let all = [
            home.affine(m, [0.3; 3]).unwrap(),
            home.elongate([0.3, 0.0, 0.5]).unwrap(),
            home.twist(70.0).unwrap(),
            home.slice([0.1; 3], direction(&mut random).to_array(), direction(&mut random).to_array()).unwrap(),
            home.annular(0.1).unwrap(),
            home.blur(0.2, 0.4).unwrap(),
            home.mollify(0.2, 3).unwrap(),
            home.scale(1.5).unwrap().complement().unwrap().offset(0.1).unwrap(),
        ];
        for (which, g) in all.iter().enumerate() {
            for _ in 0..60 {
                let p = vector(&mut random, 2.0);
                let gradient = g.closest(p).gradient;
                let axes = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| axis * 1e-5);
                let bent = |q: Vec3| (g.closest(q).gradient - gradient).length() > 1e-3;
                if axes.iter().any(|d| bent(p + *d) || bent(p - *d)) {
                    continue;
                }
                compared += 1;
                for d in axes {
                    let slope = (g.value(p + d) - g.value(p - d)) / 2e-5;
                    assert!((slope - gradient.dot(d) / 1e-5).abs() < 2e-3, "{name} {which} at {p}: {slope}");
                }
            }
        }
    }
    assert!(compared > 5000, "{compared}");
}

#[test]
fn bounds_of_mapped_bodies_hold_them_and_are_not_far_too_large() {
    let mut random = Random(157);
    for (name, home) in exact(&mut random) {
        if !home.bounds().is_finite() {
            continue;
        }
        let m = stretching(random.point([0.5; 3], [2.0; 3]), &mut random);
        for g in [
            home.affine(rows(m), [0.3; 3]).unwrap(),
            home.elongate([0.3, 0.0, 0.5]).unwrap(),
            home.twist(70.0).unwrap(),
            home.affine(rows(m), [0.3; 3]).unwrap().offset(0.2).unwrap(),
            home.affine(rows(m), [0.3; 3]).unwrap().complement().unwrap().offset(-0.2).unwrap().complement().unwrap(),
            home.blur(0.2, 0.3).unwrap(),
            home.elongate([0.2; 3]).unwrap().annular(0.3).unwrap(),
        ] {
            let b = g.bounds();
            assert!(b.diagonal() < 12.0 * home.bounds().diagonal() + 2.0, "{name}: {b:?}");
            let Some(inside) = (0..3000).map(|_| vector(&mut random, 2.0)).find(|p| g.value(*p) <= 0.0) else {
                continue;
            };
            for _ in 0..200 {
                let p = between(&g, inside, inside + direction(&mut random) * 40.0);
                assert!(g.value(p) > 0.0 || b.contains(p), "{name}: {p} off {b:?}");
            }
        }
    }
}
