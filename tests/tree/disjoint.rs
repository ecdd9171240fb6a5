// SPDX-License-Identifier: MIT OR Apache-2.0
//! A union says EXACT only where its value is the distance to its surface.

use super::scenes::{CROWDS, crowd, one};
use super::{between, direction, placed, vector};
use crate::common::random::Random;
use embound::geometry::{Geometry, Kind};
use embound::math::Vec3;

fn ball(x: f64, r: f64) -> Geometry {
    Geometry::sphere([x, 0.0, 0.0], r).unwrap()
}

/// Points of the surface: where lines between random points change sides.
fn surface(g: &Geometry, reach: f64, count: usize, random: &mut Random) -> Vec<Vec3> {
    let points: Vec<Vec3> = (0..count).map(|_| vector(random, reach)).collect();
    let (inside, outside): (Vec<Vec3>, Vec<Vec3>) = points.iter().partition(|p| g.value(**p) <= 0.0);
    inside.iter().zip(outside.iter().cycle()).filter(|_| !outside.is_empty()).map(|(a, b)| between(g, *a, *b)).collect()
}

/// Not above the distance to any point of the surface, and a point of the surface at that distance.
fn assert_distance(g: &Geometry, what: &str, reach: f64, random: &mut Random) {
    let near = surface(g, reach, 300, random);
    for k in 0..200 {
        let any = vector(random, reach);
        let p = if k % 2 == 0 || near.is_empty() { any } else { near[random.below(near.len())] + any * 0.1 };
        let c = g.closest(p);
        for q in &near {
            assert!(c.value.abs() <= (p - *q).length() + 1e-10 * reach, "{what}: {c:?} at {p}, but surface at {q}");
        }
        assert!(((p - c.point).length() - c.value.abs()).abs() < 1e-10 * reach, "{what}: {c:?} at {p}");
        assert!(g.value(c.point).abs() < 1e-10 * reach, "{what}: {} at the closest point of {p}", g.value(c.point));
        // There the sides meet: the point is no place within, where two parts touch. Tips may be sharp.
        let beside = g.value(c.point + direction(random) * 1e-6 * reach) <= 0.0;
        let mut around = (0..20_000).map(|_| g.value(c.point + direction(random) * 1e-6 * reach) <= 0.0);
        assert!(around.any(|inside| inside != beside), "{what}: no surface at {} of {p}", c.point);
    }
}

#[test]
fn what_is_called_exact_is_the_distance_to_the_surface() {
    let mut random = Random(111);
    let mut exact = 0;
    for kind in CROWDS {
        for n in [2, 3, 6] {
            for _ in 0..6 {
                let parts = crowd(kind, n, &mut random);
                for g in [Geometry::union(&parts).unwrap(), Geometry::intersection(&parts).unwrap()] {
                    if g.properties().kind == Kind::Exact {
                        exact += 1;
                        assert_distance(&g, &format!("{n} {kind:?}"), 2.0, &mut random);
                    }
                }
            }
        }
    }
    assert!(exact > 20, "{exact}");
}

#[test]
fn shapes_far_enough_apart_are_exact_and_overlapping_ones_are_not() {
    let mut random = Random(112);
    for _ in 0..60 {
        let (a, b) = (one(&mut random), one(&mut random));
        let overlapping = [a.clone(), placed(&b, &mut random).0.translate([0.01, 0.0, 0.0]).unwrap()];
        let union = Geometry::union(&overlapping).unwrap();
        if union.kind() == Kind::Exact {
            assert_distance(&union, "overlapping", 3.0, &mut random);
        }
        if a.bounds().is_finite() && b.bounds().is_finite() {
            let far = a.bounds().diagonal() + b.bounds().diagonal() + 2.0;
            let apart = Geometry::union(&[a, b.translate([far, 0.0, 0.0]).unwrap()]).unwrap();
            assert_eq!(apart.kind(), Kind::Exact);
            assert_distance(&apart, "apart", 4.0, &mut random);
        }
    }
    for distance in [1.9, 1.999_999_999, 2.0] {
        assert_eq!(Geometry::union(&[ball(0.0, 1.0), ball(distance, 1.0)]).unwrap().kind(), Kind::LowerBound);
    }
    assert_eq!(Geometry::union(&[ball(0.0, 1.0), ball(2.000_001, 1.0)]).unwrap().kind(), Kind::Exact);
    assert_eq!(Geometry::union(&[ball(0.0, 1.0), ball(0.0, 1.0)]).unwrap().kind(), Kind::LowerBound);
    assert_eq!(Geometry::union(&[ball(0.0, 2.0), ball(0.1, 1.0)]).unwrap().kind(), Kind::LowerBound);
}

#[test]
fn a_shell_is_exact_where_the_hole_is_wholly_within() {
    let mut random = Random(113);
    for (inner, outer, shift, kind) in [
        (1.0, 2.0, 0.3, Kind::Exact),
        (1.0, 2.0, 0.99, Kind::Exact),
        (1.0, 2.0, 1.2, Kind::LowerBound),
        (2.0, 1.0, 0.0, Kind::LowerBound),
    ] {
        let shell = ball(0.0, outer).difference(&ball(shift, inner)).unwrap();
        if shell.kind() == Kind::Exact {
            assert_eq!(kind, Kind::Exact, "{inner} {outer} {shift}");
            assert_distance(&shell, "shell", 3.0, &mut random);
        }
    }
    for _ in 0..40 {
        let (a, b) = (one(&mut random), one(&mut random).scale(0.3).unwrap());
        let g = a.difference(&b.translate(a.bounds().center().clamp(Vec3::splat(-1.0), Vec3::ONE).to_array()).unwrap());
        let g = g.unwrap();
        if g.kind() == Kind::Exact {
            assert_distance(&g, "hole", 3.0, &mut random);
        }
    }
}
