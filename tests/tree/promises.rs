// SPDX-License-Identifier: MIT OR Apache-2.0
//! What random trees say of themselves holds: bounds, Lipschitz constant, kind, gradient's value.

use super::trees::{each, places};
use super::{direction, same};
use crate::common::random::Random;
use embound::geometry::{Geometry, Kind};
use embound::math::Vec3;

const TREES: u64 = 400;

/// Surface points, and those within a few roundings of them.
fn close(g: &Geometry, random: &mut Random) -> Vec<Vec3> {
    let mut all = places(g, 60, random);
    for p in all.clone() {
        let step = direction(random) * 10f64.powf(random.range(-16.0, -2.0));
        all.push(p + step);
        all.push(p.map(f64::next_up));
        all.push(p.map(f64::next_down));
    }
    all
}

#[test]
fn bounds_hold_every_point_that_is_not_outside() {
    let (mut finite, mut inside) = (0, 0);
    each(1, TREES, |k, g, random| {
        let turned = g.complement().unwrap();
        let (bounds, rest) = (g.bounds(), turned.bounds());
        finite += usize::from(bounds.is_finite()) + usize::from(rest.is_finite());
        for p in close(g, random) {
            let v = g.value(p);
            inside += usize::from(v <= 0.0);
            assert!(v > 0.0 || bounds.contains(p), "tree {k}: {v} at {p} off {bounds:?}");
            assert!(v < 0.0 || rest.contains(p), "tree {k}: {v} at {p} off the rest {rest:?}");
        }
    });
    assert!(finite > 100 && inside > 10_000, "{finite} {inside}");
}

#[test]
fn no_value_changes_faster_than_the_lipschitz_constant() {
    let mut known = 0;
    each(2, TREES, |k, g, random| {
        let l = g.properties().lipschitz;
        assert!(l >= 0.0, "tree {k}");
        if !l.is_finite() {
            return;
        }
        known += 1;
        for p in places(g, 80, random) {
            let f = g.value(p);
            let q = p + direction(random) * 10f64.powf(random.range(-9.0, 0.7));
            let change = (g.value(q) - f).abs();
            if f.is_finite() {
                assert!(
                    change <= l * (p - q).length() * (1.0 + 1e-9) + 1e-11,
                    "tree {k}: {change} from {p} to {q}, {l}"
                );
            }
        }
    });
    assert!(known > 150, "{known}");
}

#[test]
fn a_lower_bound_is_never_above_the_distance_to_the_other_side() {
    let mut bounds = 0;
    each(3, TREES, |k, g, random| {
        if g.kind() == Kind::SignOnly {
            return;
        }
        bounds += 1;
        let points = places(g, 100, random);
        let values: Vec<f64> = points.iter().map(|p| g.value(*p)).collect();
        for (p, f) in points.iter().zip(&values) {
            for (q, h) in points.iter().zip(&values) {
                let opposite = (*f <= 0.0) != (*h <= 0.0);
                assert!(!opposite || f.abs() <= (*p - *q).length() + 1e-11, "tree {k}: {f} at {p}, {h} at {q}");
            }
        }
    });
    assert!(bounds > 100, "{bounds}");
}

#[test]
fn an_exact_value_is_the_distance_to_the_closest_point() {
    let mut exact = 0;
    each(4, 2 * TREES, |k, g, random| {
        if g.kind() != Kind::Exact || g.has_functions() {
            return;
        }
        for p in places(g, 60, random) {
            let c = g.closest(p);
            if !c.value.is_finite() {
                continue;
            }
            exact += 1;
            assert!(g.value(c.point).abs() < 1e-10, "tree {k}: {c:?} at {p}: {}", g.value(c.point));
            assert!(((c.point - p).length() - c.value.abs()).abs() < 1e-10, "tree {k}: {c:?} at {p}");
            assert!((c.gradient.length() - 1.0).abs() < 1e-9, "tree {k}: {c:?} at {p}");
        }
    });
    assert!(exact > 5000, "{exact}");
}

#[test]
fn the_closest_point_comes_with_the_value_and_no_negative_zero() {
    each(5, TREES, |k, g, random| {
        for p in places(g, 40, random) {
            let (value, c) = (g.value(p), g.closest(p));
            assert!(same(value, c.value), "tree {k} at {p}: {value} {c:?}");
            assert!(value.to_bits() != (-0.0f64).to_bits(), "tree {k} at {p}");
            let zeros = c.point.to_array().into_iter().chain(c.gradient.to_array());
            assert!(zeros.into_iter().all(|x| x.to_bits() != (-0.0f64).to_bits()), "tree {k} at {p}: {c:?}");
            assert!(
                !value.is_nan() && !c.gradient.is_nan() || g.may_fail() || value.is_infinite(),
                "tree {k} at {p}: {c:?}"
            );
        }
    });
}

#[test]
fn trees_of_equal_content_have_equal_fingerprints() {
    for k in 0..200 {
        let build = || super::trees::tree(4, &mut Random(k));
        let (a, b) = (build(), build());
        assert_eq!(a.fingerprint(), b.fingerprint());
        assert_eq!(a.fingerprint() == 0, a.has_functions());
        if !a.has_functions() {
            assert_ne!(a.fingerprint(), a.offset(1e-9).unwrap().fingerprint());
            assert_ne!(a.fingerprint(), a.part(0).unwrap().translate([1e-300, 0.0, 0.0]).unwrap().fingerprint());
        }
    }
}
