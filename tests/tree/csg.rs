// SPDX-License-Identifier: MIT OR Apache-2.0
//! Set operations over many parts have the bits of asking each of them.

use super::scenes::{CROWDS, Crowd, crowd};
use super::{direction, same, vector};
use crate::common::random::Random;
use embound::geometry::{ExpressionOptions, Geometry};
use embound::math::{Aabb, Vec3};

/// Anywhere, far off, in the middle of parts, on their surfaces and close to them.
fn points(parts: &[Geometry], middle: Vec3, size: f64, count: usize, random: &mut Random) -> Vec<Vec3> {
    let mut all = Vec::new();
    for k in 0..count {
        let any = middle + vector(random, 1.6) * size;
        all.push(match k % 6 {
            _ if parts.is_empty() => any,
            0 | 1 => any,
            2 => {
                let b = parts[random.below(parts.len())].bounds();
                if b.is_finite() { b.center() } else { any }
            }
            3 => parts[random.below(parts.len())].closest(any).point,
            4 => parts[random.below(parts.len())].closest(any).point + vector(random, 1e-7) * size,
            _ => middle + direction(random) * size * [30.0, 1e3, 1e9][k / 6 % 3],
        });
    }
    all.retain(|p| p.is_finite());
    all
}

/// The least of the parts' values, and whose it is first.
fn least(values: impl Iterator<Item = f64>) -> (f64, usize) {
    let first = (f64::INFINITY, usize::MAX);
    values.enumerate().fold(first, |best, (k, v)| if v < best.0 { (v, k) } else { best })
}

fn labelled(parts: &[Geometry]) -> Vec<Geometry> {
    parts.iter().enumerate().map(|(k, g)| g.part(k as i32).unwrap()).collect()
}

fn assert_least(kind: Crowd, parts: &[Geometry], points: &[Vec3]) {
    let named = labelled(parts);
    let (plain, union) = (Geometry::union(parts).unwrap(), Geometry::union(&named).unwrap());
    let both = Geometry::intersection(&named).unwrap();
    let turned: Vec<Geometry> = named.iter().map(|g| g.complement().unwrap()).collect();
    let (cut, none) = (Geometry::intersection(&turned).unwrap(), Geometry::union(&turned).unwrap());
    let n = parts.len();
    let rest = (n > 0).then(|| named[0].difference_of_many(&named[1..]).unwrap());
    for p in points {
        let values: Vec<f64> = parts.iter().map(|g| g.value(*p)).collect();
        let (low, winner) = least(values.iter().copied());
        let (high, top) = least(values.iter().map(|v| -v));
        let high = 0.0 - high;
        let what = format!("{n} {kind:?} at {p}");
        assert!(same(plain.value(*p), low), "{what}: {} for {low}", plain.value(*p));
        assert!(same(union.value(*p), low), "{what}: {} for {low} of labelled parts", union.value(*p));
        assert!(same(both.value(*p), high), "{what}: {} for {high}", both.value(*p));
        // De Morgan, to the bit.
        assert!(same(cut.value(*p), 0.0 - low), "{what}: {} for {}", cut.value(*p), -low);
        assert!(same(none.value(*p), 0.0 - high), "{what}: {} for {}", none.value(*p), -high);
        for (g, value, part) in [(&union, low, winner), (&both, high, top), (&cut, 0.0 - low, winner)] {
            let near = g.closest(*p);
            assert!(same(near.value, value), "{what}: {near:?} for {value}");
            assert_eq!(near.part, if n == 0 { -1 } else { part as i32 }, "{what}: {values:?}");
        }
        if let Some(rest) = &rest {
            let removed = least(values[1..].iter().copied()).0;
            assert!(same(rest.value(*p), values[0].max(0.0 - removed)), "{what}: difference");
        }
    }
}

#[test]
fn many_parts_have_the_bits_of_the_plain_least_and_greatest() {
    let mut random = Random(101);
    for kind in CROWDS {
        for n in [0, 1, 2, 3, 4, 5, 9, 50, 3000] {
            let parts = crowd(kind, n, &mut random);
            let count = if n > 1000 { 120 } else { 300 };
            let points = points(&parts, Vec3::ZERO, 1.0, count, &mut random);
            assert_least(kind, &parts, &points);
        }
    }
}

#[test]
fn neither_scale_nor_place_changes_that() {
    let mut random = Random(102);
    for kind in CROWDS {
        for (scale, shift) in [(1e6, 0.0), (1e-6, 0.0), (1.0, 1e6), (1e-6, 1.0), (1e-3, -1e3)] {
            let parts: Vec<Geometry> = crowd(kind, 60, &mut random)
                .iter()
                .map(|g| g.scale(scale).unwrap().translate([shift, -shift, 0.5 * shift]).unwrap())
                .collect();
            let middle = Vec3::new(shift, -shift, 0.5 * shift);
            let points = points(&parts, middle, scale, 200, &mut random);
            assert_least(kind, &parts, &points);
        }
    }
    // Balls that stand there themselves, not moved.
    for (scale, shift) in [(1e6, 0.0), (1e-6, 0.0), (1.0, 1e6), (1e-6, 1.0), (1e-150, 0.0), (1e150, 0.0)] {
        let middle = Vec3::new(shift, -shift, 0.5 * shift);
        let balls: Vec<Geometry> = (0..200)
            .map(|_| {
                let c = middle + vector(&mut random, 1.0) * scale;
                Geometry::sphere(c.to_array(), scale * random.range(0.01, 0.2)).unwrap()
            })
            .collect();
        let points = points(&balls, middle, scale, 300, &mut random);
        assert_least(Crowd::Balls, &balls, &points);
    }
}

#[test]
fn a_union_under_transforms_and_complements_has_the_bits_of_its_parts_under_them() {
    let mut random = Random(103);
    for kind in CROWDS {
        let parts = crowd(kind, 40, &mut random);
        let wrap = |g: &Geometry| {
            let turned = g.rotate([1.0, 2.0, -0.5], 33.0, [0.1, 0.2, 0.3]).unwrap().scale(1.7).unwrap();
            let back = turned.part(-5).unwrap().complement().unwrap().translate([0.3, 0.2, 0.1]).unwrap();
            back.reflect(1).unwrap().complement().unwrap().offset(0.03).unwrap()
        };
        let union = wrap(&Geometry::union(&parts).unwrap());
        // Each in a union of its own, so that its placements do not collapse with the outer ones.
        let alone: Vec<Geometry> =
            parts.iter().map(|g| wrap(&Geometry::union(std::slice::from_ref(g)).unwrap())).collect();
        for p in points(&alone, Vec3::ZERO, 2.0, 400, &mut random) {
            let (low, _) = least(alone.iter().map(|g| g.value(p)));
            assert!(same(union.value(p), low), "{kind:?} at {p}: {} for {low}", union.value(p));
        }
    }
}

#[test]
fn unions_of_unions_have_the_bits_of_one() {
    let mut random = Random(104);
    for kind in CROWDS {
        let parts = labelled(&crowd(kind, 343, &mut random));
        let groups: Vec<Geometry> = parts.chunks(7).map(|some| Geometry::union(some).unwrap()).collect();
        let nested: Vec<Geometry> = groups.chunks(7).map(|some| Geometry::union(some).unwrap()).collect();
        let (flat, nested) = (Geometry::union(&parts).unwrap(), Geometry::union(&nested).unwrap());
        for p in points(&parts, Vec3::ZERO, 1.0, 400, &mut random) {
            let (a, b) = (flat.closest(p), nested.closest(p));
            assert!(same(a.value, b.value) && a.part == b.part, "{kind:?} at {p}: {a:?} {b:?}");
        }
    }
}

/// Of these the value inside is deeper than the box around them.
#[test]
fn parts_steeper_than_a_distance_have_the_bits_of_the_plain_least() {
    let mut random = Random(105);
    for steep in [0.01, 0.3, 3.0, 40.0, 1e6] {
        for n in [5, 40] {
            let parts: Vec<Geometry> = (0..n)
                .map(|k| {
                    let (c, r) = (vector(&mut random, 1.0), random.range(0.1, 0.6));
                    let room = Vec3::splat(r * 1.1);
                    let bounds = Aabb::new(c - room, c + room);
                    let own = steep * random.range(0.2, 1.0);
                    let text = match k % 3 {
                        0 => format!("{own}*(sqrt((x-{})^2+(y-{})^2+(z-{})^2)-{r})", c.x, c.y, c.z),
                        1 => format!("{own}*((x-{})^2+(y-{})^2+(z-{})^2-{})", c.x, c.y, c.z, r * r),
                        // Of unbounded slope in the middle.
                        _ => format!("{own}*(((x-{})^2+(y-{})^2+(z-{})^2)^0.25-{})*3", c.x, c.y, c.z, r.sqrt()),
                    };
                    Geometry::expression(&text, &ExpressionOptions { bounds, lipschitz: 0.0 }).unwrap()
                })
                .collect();
            let points = points(&parts, Vec3::ZERO, 1.0, 100, &mut random);
            let some: Vec<Vec3> = points.into_iter().chain((0..500).map(|_| vector(&mut random, 1.0))).collect();
            assert_least(Crowd::Mixed, &parts, &some);
        }
    }
}
