// SPDX-License-Identifier: MIT OR Apache-2.0
//! Smooth set operations: the order of the parts, the formula, its bounds, its range.

use super::scenes::{CROWDS, Crowd, crowd};
use super::{direction, same, vector};
use crate::common::random::Random;
use embound::geometry::{Blend, BlendFunction, CustomBlend, Geometry, Kind};
use embound::math::Vec3;
use std::sync::Arc;

/// Cubic: `a - h^3 s / 6`.
struct Cubic(f64);

impl BlendFunction for Cubic {
    fn blend(&self, a: f64, b: f64) -> (f64, f64, f64) {
        let h = (self.0 - (b - a)).max(0.0) / self.0;
        (a - h * h * h * self.0 / 6.0, f64::NAN, f64::NAN)
    }
}

fn cubic(s: f64, n: usize) -> Blend {
    Blend::Custom(CustomBlend {
        function: Arc::new(Cubic(s)),
        support: s,
        depth: s / 6.0 * n as f64,
        lipschitz: 1.0,
        thread_safe: true,
    })
}

fn blends(s: f64, n: usize) -> [Blend; 3] {
    [Blend::Smooth(s), Blend::Exponential(s), cubic(s, n)]
}

fn support(blend: &Blend) -> f64 {
    match blend {
        Blend::Smooth(s) => *s,
        Blend::Exponential(s) => 37.0 * s,
        Blend::Custom(c) => c.support,
    }
}

/// Of two values, as a textbook has it.
fn textbook(blend: &Blend, a: f64, b: f64) -> f64 {
    match blend {
        Blend::Smooth(s) => {
            let h = (s - (a - b).abs()).max(0.0) / s;
            a.min(b) - h * h * s * 0.25
        }
        Blend::Exponential(s) => a.min(b) - s * ((a.min(b) - a.max(b)) / s).exp().ln_1p(),
        Blend::Custom(c) => c.function.blend(a.min(b), a.max(b)).0,
    }
}

/// Rising values blended until the next is too far behind: with the library's own two-part blend at each step.
fn folded(blend: &Blend, mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let mut value = values[0];
    for next in &values[1..] {
        if next - value >= support(blend) {
            break;
        }
        value = two(blend, value.min(*next), value.max(*next));
    }
    value
}

/// The step, with the bits that `docs` promise.
fn two(blend: &Blend, a: f64, b: f64) -> f64 {
    match blend {
        Blend::Smooth(s) => {
            let behind = s - (b - a);
            let h = if behind > 0.0 { behind / s } else { 0.0 };
            a - h * h * s * 0.25
        }
        Blend::Exponential(s) => a - s * libm::log1p(libm::exp((a - b) / s)),
        Blend::Custom(c) => c.function.blend(a, b).0,
    }
}

fn shuffled(parts: &[Geometry], random: &mut Random) -> Vec<Geometry> {
    let mut all = parts.to_vec();
    for k in (1..all.len()).rev() {
        all.swap(k, random.below(k + 1));
    }
    all
}

/// The maximal depth of so many equal values.
fn depth(blend: &Blend, n: usize) -> f64 {
    match blend {
        Blend::Exponential(s) => s * (n as f64).ln(),
        Blend::Smooth(s) => *s,
        Blend::Custom(c) => c.depth,
    }
}

#[test]
fn the_order_of_the_parts_makes_no_difference_to_the_bit() {
    let mut random = Random(161);
    for kind in CROWDS {
        for n in [2, 3, 4, 5, 9, 20] {
            let parts = crowd(kind, n, &mut random);
            for blend in blends(random.range(0.05, 0.8), n) {
                let first = Geometry::smooth_union(&parts, &blend).unwrap();
                let others: Vec<Geometry> =
                    (0..4).map(|_| Geometry::smooth_union(&shuffled(&parts, &mut random), &blend).unwrap()).collect();
                for _ in 0..60 {
                    let p = vector(&mut random, 1.5);
                    let (value, near) = (first.value(p), first.closest(p));
                    assert!(same(near.value, value));
                    for g in &others {
                        assert!(same(g.value(p), value), "{n} {kind:?}, {blend:?} at {p}: {} {value}", g.value(p));
                    }
                }
            }
        }
    }
}

#[test]
fn many_parts_have_the_bits_of_blending_them_one_after_another() {
    let mut random = Random(162);
    for kind in CROWDS {
        for n in [1, 2, 3, 5, 40, 400] {
            let parts = crowd(kind, n, &mut random);
            let steps: Vec<Geometry> = parts.iter().enumerate().map(|(k, g)| g.part(k as i32).unwrap()).collect();
            for blend in blends(random.range(0.02, 0.3), n) {
                let g = Geometry::smooth_union(&steps, &blend).unwrap();
                for k in 0..100 {
                    let p = vector(&mut random, 1.5) * [1.0, 1.0, 1.0, 1e3][k % 4];
                    let values: Vec<f64> = parts.iter().map(|g| g.value(p)).collect();
                    let wanted = folded(&blend, values.clone());
                    let found = g.value(p);
                    assert!(same(found, wanted), "{n} {kind:?}, {blend:?} at {p}: {found} for {wanted}");
                    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
                    assert!(found <= least && found >= least - depth(&blend, n) * (1.0 + 1e-12), "{found} of {least}");
                    let winner = values.iter().position(|v| *v == least).unwrap();
                    assert_eq!(g.closest(p).part, winner as i32);
                }
            }
        }
    }
}

#[test]
fn two_parts_have_the_textbook_value_and_further_apart_that_of_the_union() {
    let mut random = Random(163);
    let parts =
        [Geometry::sphere([0.0; 3], 1.0).unwrap(), Geometry::cuboid([0.5, -0.3, -0.4], [2.0, 0.8, 0.9]).unwrap()];
    let (mut sharp, mut smooth) = (0, 0);
    for _ in 0..20 {
        for blend in blends(random.range(0.01, 1.0), 2) {
            let g = Geometry::smooth_union(&parts, &blend).unwrap();
            let common = Geometry::smooth_intersection(&parts, &blend).unwrap();
            let rest = parts[0].smooth_difference(&parts[1..], &blend).unwrap();
            for _ in 0..50 {
                let p = vector(&mut random, 2.0);
                let (a, b) = (parts[0].value(p), parts[1].value(p));
                assert!((g.value(p) - textbook(&blend, a, b)).abs() < 1e-14, "{blend:?} at {p}");
                assert!((common.value(p) + textbook(&blend, -a, -b)).abs() < 1e-14, "{blend:?} at {p}");
                assert!((rest.value(p) + textbook(&blend, -a, b)).abs() < 1e-14, "{blend:?} at {p}");
                if (a - b).abs() >= support(&blend) {
                    sharp += 1;
                    assert_eq!((g.value(p), common.value(p)), (a.min(b), a.max(b)));
                    let near = g.closest(p);
                    let alone = if a < b { parts[0].closest(p) } else { parts[1].closest(p) };
                    assert_eq!((near.point, near.gradient), (alone.point, alone.gradient));
                } else if (a - b).abs() < 0.5 * support(&blend) && !matches!(blend, Blend::Exponential(_)) {
                    smooth += 1;
                    assert!(g.value(p) < a.min(b) && common.value(p) > a.max(b));
                }
            }
        }
    }
    assert!(sharp > 300 && smooth > 300, "{sharp} {smooth}");
}

#[test]
fn smooth_intersections_and_differences_are_complements_of_smooth_unions_to_the_bit() {
    let mut random = Random(164);
    for kind in [Crowd::Mixed, Crowd::Balls, Crowd::WithPlanes] {
        for n in [2, 3, 7, 30] {
            let parts = crowd(kind, n, &mut random);
            let turned: Vec<Geometry> = parts.iter().map(|g| g.complement().unwrap()).collect();
            for blend in blends(0.2, n) {
                let common = Geometry::smooth_intersection(&parts, &blend).unwrap();
                let other = Geometry::smooth_union(&turned, &blend).unwrap();
                let rest = parts[0].smooth_difference(&parts[1..], &blend).unwrap();
                let mut all = parts.clone();
                all[0] = turned[0].clone();
                for _ in 0..50 {
                    let p = vector(&mut random, 1.5);
                    assert!(same(common.value(p), 0.0 - other.value(p)));
                    let values = all.iter().map(|g| g.value(p)).collect();
                    assert!(same(rest.value(p), 0.0 - folded(&blend, values)));
                }
            }
        }
    }
}

#[test]
fn large_values_and_small_widths_do_not_overflow() {
    let mut random = Random(165);
    for reach in [1e4, 1e15, 1e100, 1e300] {
        let planes: Vec<Geometry> = (0..3)
            .map(|_| Geometry::plane((direction(&mut random) * 0.01).to_array(), direction(&mut random).to_array()))
            .map(|g| g.unwrap())
            .collect();
        for s in [1e-3, 1e-300, 1.0] {
            for blend in blends(s, 3) {
                let g = Geometry::smooth_union(&planes, &blend).unwrap();
                for _ in 0..50 {
                    let p = vector(&mut random, reach);
                    let near = g.closest(p);
                    let least = planes.iter().map(|g| g.value(p)).fold(f64::INFINITY, f64::min);
                    assert!(near.value.is_finite() && near.gradient.is_finite(), "{blend:?}: {near:?} at {p}");
                    assert!(near.value <= least && near.value >= least - depth(&blend, 3) * 1.01 - least.abs() * 1e-15);
                }
            }
        }
    }
}

#[test]
fn blended_bodies_are_lower_bounds_with_the_gradients_of_their_values() {
    let mut random = Random(166);
    let mut compared = 0;
    for kind in [Crowd::Balls, Crowd::Mixed, Crowd::Heap] {
        for n in [2, 3, 6, 12] {
            let parts = crowd(kind, n, &mut random);
            for blend in blends(0.3, n) {
                for g in [Geometry::smooth_union(&parts, &blend), Geometry::smooth_intersection(&parts, &blend)] {
                    let g = g.unwrap();
                    assert_eq!((g.kind(), g.properties().lipschitz), (Kind::LowerBound, 1.0));
                    for k in 0..40 {
                        let p = vector(&mut random, 1.5);
                        let q = p + vector(&mut random, 1.5) * 0.1f64.powi(k % 7);
                        let change = (g.value(p) - g.value(q)).abs();
                        assert!(change <= (p - q).length() + 1e-13, "{n} {kind:?}, {blend:?}: {change}");
                        let gradient = g.closest(p).gradient;
                        let axes = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| axis * 1e-5);
                        let bent = |q: Vec3| (g.closest(q).gradient - gradient).length() > 2e-3;
                        if axes.iter().any(|d| bent(p + *d) || bent(p - *d)) {
                            continue;
                        }
                        compared += 1;
                        for d in axes {
                            let slope = (g.value(p + d) - g.value(p - d)) / 2e-5;
                            let wrong = (slope - gradient.dot(d) / 1e-5).abs();
                            assert!(wrong < 3e-3, "{n} {kind:?}, {blend:?} at {p}: {slope} for {gradient}");
                        }
                    }
                }
            }
        }
    }
    assert!(compared > 1500, "{compared}");
}

#[test]
fn blends_within_blends_take_no_longer_with_every_level() {
    let mut g = Geometry::sphere([0.0; 3], 0.5).unwrap();
    let mut random = Random(167);
    for k in 0..200 {
        let c = vector(&mut random, 1.0).to_array();
        let other = Geometry::sphere(c, 0.3).unwrap();
        let blend = if k % 2 == 0 { Blend::Smooth(0.1) } else { Blend::Exponential(0.05) };
        g = if k % 3 == 0 {
            g.smooth_difference(&[other], &blend)
        } else {
            Geometry::smooth_union(&[g, other], &blend)
        }
        .unwrap();
    }
    for _ in 0..20 {
        let p = vector(&mut random, 1.0);
        assert!(same(g.value(p), g.closest(p).value));
    }
}
