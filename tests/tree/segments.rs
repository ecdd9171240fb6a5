// SPDX-License-Identifier: MIT OR Apache-2.0
//! Crossings of segments and lattice edges with random trees.

use super::trees::{each, places};
use super::{direction, same, vector};
use crate::common::edges::{crossings, every_edge};
use crate::common::random::Random;
use embound::geometry::Geometry;
use embound::math::Vec3;
use embound::parallel::Run;
use embound::query::{self, CrossingForm, Intercept, Lattice};
use std::sync::Mutex;

fn intercepts(g: &Geometry, segments: &[(Vec3, Vec3)]) -> Vec<Intercept> {
    let end = |k: usize| segments.iter().flat_map(|s| [s.0, s.1][k].to_array()).collect::<Vec<f64>>();
    let out = Mutex::new(vec![None; segments.len()]);
    query::intercepts(g, &end(0), &end(1), &Run::SERIAL, &|first, found| {
        for (k, hit) in found.iter().enumerate() {
            out.lock().unwrap()[first + k] = Some(*hit);
        }
    })
    .unwrap();
    out.into_inner().unwrap().into_iter().map(|hit| hit.expect("every segment answered")).collect()
}

/// Between any points, between near ones, along axes, from the surface, along it.
fn segments(g: &Geometry, count: usize, random: &mut Random) -> Vec<(Vec3, Vec3)> {
    let points = places(g, count, random);
    let mut all = Vec::new();
    for (k, p) in points.iter().enumerate() {
        let any = points[random.below(points.len())];
        let near = 10f64.powf(random.range(-6.0, 0.5));
        all.push(match k % 5 {
            0 | 1 => (*p, any),
            2 => (*p, *p + direction(random) * near),
            3 => {
                let mut q = *p;
                q[random.below(3)] += random.range(-3.0, 3.0);
                (*p, q)
            }
            _ => {
                let normal = g.closest(*p).gradient;
                let along = normal.cross(direction(random));
                if along.is_finite() { (*p - along * near, *p + along * near) } else { (*p, any) }
            }
        });
    }
    all.retain(|(a, b)| a != b);
    all
}

#[test]
fn a_crossing_of_a_random_tree_is_where_the_side_changes() {
    let mut crossed = 0;
    each(21, 300, |k, g, random| {
        let there = segments(g, 80, random);
        let back: Vec<(Vec3, Vec3)> = there.iter().map(|(a, b)| (*b, *a)).collect();
        let (hits, backs) = (intercepts(g, &there), intercepts(g, &back));
        for (((a, b), hit), turned) in there.iter().zip(&hits).zip(&backs) {
            let what = format!("tree {k}, {a} to {b}: {hit:?}");
            assert_eq!(
                (hit.count, hit.status, hit.part, hit.tag),
                (turned.count, turned.status, turned.part, turned.tag)
            );
            let (fa, fb) = (g.value(*a), g.value(*b));
            let opposite = (fa <= 0.0) != (fb <= 0.0);
            assert_eq!(opposite, !hit.t.is_nan(), "{what}");
            assert!(hit.count >= i32::from(opposite) && (0..=3).contains(&hit.status), "{what}");
            assert_eq!(opposite, hit.status != 0, "{what}");
            if !opposite {
                continue;
            }
            crossed += 1;
            assert!((0.0..=1.0).contains(&hit.t), "{what}");
            assert!(same(turned.t, 1.0 - hit.t) || same(hit.t, 1.0 - turned.t), "{what} {turned:?}");
            let at = |t: f64| g.value(*a + (*b - *a) * t);
            let step = 1e-8f64.max(1e-13 / (*b - *a).length());
            let sides = (at((hit.t - step).max(0.0)) <= 0.0, at((hit.t + step).min(1.0)) <= 0.0);
            let sides =
                (if hit.t < step { fa <= 0.0 } else { sides.0 }, if hit.t > 1.0 - step { fb <= 0.0 } else { sides.1 });
            let flat = at(hit.t).abs() <= 1e-9 * g.properties().lipschitz.clamp(1.0, 10.0);
            assert!(flat || sides.0 != sides.1, "{what}: {} there, sides {sides:?}", at(hit.t));
            // An end of zero is the crossing: the other one is outside.
            assert!(fa != 0.0 || hit.t == 0.0, "{what}");
            assert!(fb != 0.0 || hit.t == 1.0, "{what}");
        }
    });
    assert!(crossed > 4000, "{crossed}");
}

#[test]
fn lattice_edges_of_random_trees_have_the_crossings_of_segments_and_the_sides_of_the_values() {
    each(22, 90, |k, g, random| {
        let axis = |random: &mut Random, n: usize| {
            let mut x: Vec<f64> = (0..n).map(|_| random.range(-2.5, 2.5)).collect();
            x.sort_by(f64::total_cmp);
            if random.below(2) == 0 {
                x.reverse();
            }
            x
        };
        let (x, y, z) = (axis(random, 7), axis(random, 5), axis(random, 4));
        let lattice = Lattice::new(&x, &y, &z).unwrap();
        for direction in 0..3 {
            let mut n = lattice.n();
            n[direction] -= 1;
            for form in [CrossingForm::Coordinate, CrossingForm::Fraction] {
                let seen = Mutex::new(0);
                query::crossings(g, &lattice, direction, form, &Run::SERIAL, &|at, count, found| {
                    for (d, crossing) in every_edge(count, found).iter().enumerate() {
                        *seen.lock().unwrap() += 1;
                        let from = [at[0] + d, at[1], at[2]];
                        let mut to = from;
                        to[direction] += 1;
                        let point = |i: [usize; 3]| Vec3::new(x[i[0]], y[i[1]], z[i[2]]);
                        let (a, b) = (point(from), point(to));
                        let hit = intercepts(g, &[(a, b)])[0];
                        assert_eq!((crossing.count, crossing.part, crossing.tag), (hit.count, hit.part, hit.tag));
                        assert_eq!(crossing.at.is_nan(), (g.value(a) <= 0.0) == (g.value(b) <= 0.0), "tree {k}");
                        match form {
                            CrossingForm::Fraction => assert!(same(crossing.at, hit.t), "tree {k}"),
                            CrossingForm::Coordinate if crossing.at.is_nan() => {}
                            CrossingForm::Coordinate => {
                                let (a, b) = (a[direction], b[direction]);
                                assert!(a.min(b) <= crossing.at && crossing.at <= a.max(b), "tree {k}");
                                assert!((a + (b - a) * hit.t - crossing.at).abs() < 1e-14, "tree {k}");
                            }
                        }
                    }
                })
                .unwrap();
                assert_eq!(*seen.lock().unwrap(), n[0] * n[1] * n[2]);
            }
        }
    });
}

/// Thinner than any step, grazed, met in one point only.
#[test]
fn thin_and_tangent_things_end_the_search() {
    let wafer = Geometry::sphere([0.0; 3], 1.0).unwrap().annular(1e-9).unwrap();
    let needle = Geometry::capsule([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 1e-12).unwrap();
    let torus = Geometry::torus([0.0; 3], [0.0, 0.0, 1.0], 1.0, 0.25).unwrap();
    let twisted = Geometry::cuboid([-0.5, -0.001, -1.0], [0.5, 0.001, 1.0]).unwrap().twist(900.0).unwrap();
    let pair = Geometry::union(&[torus.clone(), needle.clone(), wafer.clone()]).unwrap();
    let cut = torus.difference(&torus.offset(-1e-10).unwrap()).unwrap();
    let mut random = Random(23);
    for g in [wafer, needle, torus, twisted, pair, cut] {
        let mut all = segments(&g, 200, &mut random);
        // Tangents of the outer and inner circles; along the axis; on the surface from end to end.
        all.push((Vec3::new(1.25, -2.0, 0.0), Vec3::new(1.25, 2.0, 0.0)));
        all.push((Vec3::new(-2.0, 0.0, 0.25), Vec3::new(2.0, 0.0, 0.25)));
        all.push((Vec3::new(0.75, -2.0, 0.0), Vec3::new(0.75, 2.0, 0.0)));
        all.push((Vec3::new(0.0, 0.0, -2.0), Vec3::new(0.0, 0.0, 2.0)));
        all.push((Vec3::new(-1e9, 0.0, 0.0), Vec3::new(1e9, 1.0, 0.5)));
        all.push((Vec3::new(0.0, 0.0, 0.0), Vec3::new(5e-324, 0.0, 0.0)));
        all.push((vector(&mut random, 1.0), Vec3::splat(1e300)));
        for ((a, b), hit) in all.iter().zip(intercepts(&g, &all)) {
            let opposite = (g.value(*a) <= 0.0) != (g.value(*b) <= 0.0);
            assert_eq!(opposite, (0.0..=1.0).contains(&hit.t), "{a} to {b}: {hit:?}");
            assert!(hit.count >= i32::from(opposite), "{a} to {b}: {hit:?}");
        }
    }
}

#[test]
fn whole_lattices_of_random_trees_have_the_signs_and_crossings_of_points_and_edges() {
    let (mut crossed, mut left_out) = (0, 0);
    each(24, 60, |k, g, random| {
        let axis = |random: &mut Random, n: usize| {
            let (from, to) = (random.range(-2.5, -1.0), random.range(1.0, 2.5));
            (0..n).map(|i| from + (to - from) * i as f64 / (n - 1) as f64).collect::<Vec<f64>>()
        };
        let (mut x, y, z) = (axis(random, 21), axis(random, 19), axis(random, 18));
        if random.below(2) == 0 {
            x.reverse();
        }
        let lattice = Lattice::new(&x, &y, &z).unwrap();
        let point = |i: [usize; 3]| Vec3::new(x[i[0]], y[i[1]], z[i[2]]);
        query::fill_signs(g, &lattice, &Run::SERIAL, &|at, signs| {
            for (d, sign) in signs.iter().enumerate() {
                let value = g.value(point([at[0] + d, at[1], at[2]]));
                assert_eq!(*sign, i8::from(value > 0.0) - i8::from(value < 0.0), "tree {k}");
            }
        })
        .unwrap();
        let direction = random.below(3);
        let mut n = lattice.n();
        n[direction] -= 1;
        let found = crossings(g, &lattice, direction, CrossingForm::Fraction, &Run::SERIAL);
        let ends = |e: usize| {
            let from = [e % n[0], e / n[0] % n[1], e / n[0] / n[1]];
            let mut to = from;
            to[direction] += 1;
            (point(from), point(to))
        };
        let segments: Vec<(Vec3, Vec3)> = (0..found.len()).map(ends).collect();
        for ((crossing, hit), ends) in found.iter().zip(intercepts(g, &segments)).zip(&segments) {
            let same = (crossing.at.to_bits(), crossing.count, crossing.part, crossing.tag);
            assert_eq!(same, (hit.t.to_bits(), hit.count, hit.part, hit.tag), "tree {k}, {ends:?}");
            crossed += usize::from(hit.count > 0);
            left_out += usize::from(hit.count == 0);
        }
    });
    assert!(crossed > 1000 && left_out > 10_000, "{crossed} {left_out}");
}
