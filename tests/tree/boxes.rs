// SPDX-License-Identifier: MIT OR Apache-2.0
//! Classification of boxes of all sizes over random trees: never a lie, and not shy where the value is a
//! distance.

use super::trees::{each, places};
use super::vector;
use crate::common::random::Random;
use embound::geometry::{Geometry, Kind};
use embound::math::{Aabb, Vec3};
use embound::query;

/// Corners, middles of edges and faces, the neighbours of the corners within, and places at random.
fn samples(b: Aabb, random: &mut Random) -> Vec<Vec3> {
    let mut points = Vec::new();
    for code in 0..27 {
        let f = Vec3::from_array([code % 3, code / 3 % 3, code / 9].map(f64::from)) * 0.5;
        points.push(Vec3::select(f.cmpeq(Vec3::ONE), b.hi, b.lo + (b.hi - b.lo) * f));
    }
    points.extend((0..8).map(|_| Vec3::from_array(random.point(b.lo.to_array(), b.hi.to_array()))));
    points.push(b.lo.map(f64::next_up));
    points.push(b.hi.map(f64::next_down));
    points.iter().map(|p| p.clamp(b.lo, b.hi)).collect()
}

fn cuboid(middle: Vec3, size: f64, random: &mut Random) -> Aabb {
    let mut half = Vec3::from_array(random.point([0.0; 3], [1.0; 3])) * size;
    // Flat ones, and needles.
    for k in 0..3 {
        if random.below(6) == 0 {
            half[k] = 0.0;
        }
    }
    // The place is anywhere within: at a corner as well.
    let off = Vec3::from_array([0, 1, 2].map(|_| [-1.0, 0.0, 1.0, random.range(-1.0, 1.0)][random.below(4)]));
    let middle = middle + half * off;
    Aabb::new(middle - half, middle + half)
}

fn assert_true(what: &str, g: &Geometry, b: Aabb, random: &mut Random) -> i32 {
    let class = query::classify_box(g, b);
    if class != 0 {
        for p in samples(b, random) {
            let v = g.value(p);
            assert!(v * f64::from(class) > 0.0, "{what}: {class}, but {v} at {p} of {b:?}");
        }
    }
    class
}

#[test]
fn a_box_called_uniform_is_so_for_random_trees() {
    let mut known = [0; 3];
    each(11, 500, |k, g, random| {
        for (at, p) in places(g, 60, random).into_iter().enumerate() {
            let size = if at % 2 == 0 { random.range(-3.0, 1.5) } else { random.range(-40.0, 1.0) };
            let b = cuboid(p, size.exp2(), random);
            known[(assert_true(&format!("tree {k}"), g, b, random) + 1) as usize] += 1;
        }
    });
    assert!(known.iter().all(|n| *n > 3000), "{known:?}");
}

#[test]
fn a_mixed_box_is_near_the_surface_where_the_value_is_a_distance() {
    let mut mixed = 0;
    each(12, 1000, |k, g, random| {
        if g.kind() != Kind::Exact || g.has_functions() {
            return;
        }
        for p in places(g, 60, random) {
            let b = cuboid(p, random.range(-22.0, 1.5).exp2(), random);
            let value = g.value(b.center());
            if assert_true(&format!("tree {k}"), g, b, random) == 0 {
                mixed += 1;
                let half = 0.5 * b.diagonal();
                let close = value.abs() <= 1.0001 * half + 1e-12;
                assert!(close, "tree {k}: shy of {value} at {b:?}, half {half}");
            }
        }
    });
    assert!(mixed > 2000, "{mixed}");
}

/// Sides that rounding alone decides: boxes of a few doubles around the surface.
#[test]
fn boxes_of_a_few_doubles_on_the_surface_are_not_called_uniform_wrongly() {
    each(13, 300, |k, g, random| {
        for p in places(g, 60, random) {
            let mut b = Aabb::new(p, p);
            for _ in 0..random.below(6) {
                (b.lo, b.hi) = (b.lo.map(f64::next_down), b.hi.map(f64::next_up));
            }
            assert_true(&format!("tree {k}"), g, b, random);
        }
    });
}

/// x + by * z.
fn shear(by: f64) -> [f64; 9] {
    [1.0, 0.0, by, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
}

/// The shift that such a one the other way makes of another.
fn undone(by: f64, back: [f64; 3]) -> [f64; 3] {
    [back[0] - by * back[2], back[1], back[2]]
}

/// Offsets by much more than the body is large, and back: values round to what is large.
#[test]
fn boxes_of_bodies_that_went_through_large_numbers_are_classified_soundly() {
    let mut random = Random(14);
    for round in 0..60 {
        let home = super::scenes::one(&mut random);
        let d = 10f64.powf(random.range(2.0, 9.0));
        let far = vector(&mut random, d).to_array();
        let back = far.map(|x| -x);
        let all = [
            home.offset(d).unwrap().offset(-d).unwrap(),
            home.offset(d).unwrap().blur(0.1, 0.3).unwrap().offset(-d).unwrap(),
            home.offset(-d).unwrap().mollify(0.1, 6).unwrap().offset(d).unwrap(),
            home.scale(d).unwrap().part(1).unwrap().scale(1.0 / d).unwrap(),
            home.translate(far).unwrap().part(1).unwrap().translate(back).unwrap(),
            home.translate(far)
                .unwrap()
                .part(1)
                .unwrap()
                .rotate([1.0, 2.0, 3.0], 40.0, far)
                .unwrap()
                .translate(back)
                .unwrap(),
            home.affine(shear(0.1 * d.sqrt()), far)
                .unwrap()
                .affine(shear(-0.1 * d.sqrt()), undone(0.1 * d.sqrt(), back))
                .unwrap(),
            home.annular(d).unwrap().offset(d).unwrap().offset(-0.01).unwrap(),
        ];
        for (which, g) in all.iter().enumerate() {
            for p in places(g, 30, &mut random) {
                let b = cuboid(p, random.range(-40.0, 1.0).exp2(), &mut random);
                assert_true(&format!("round {round}, {which}, {d:e}"), g, b, &mut random);
                let c = g.bounds();
                assert!(g.value(p) > 0.0 || c.contains(p), "round {round}, {which}, {d:e}: {p} off {c:?}");
            }
        }
    }
}

#[test]
fn infinite_boxes_are_classified_soundly() {
    each(15, 300, |k, g, random| {
        for _ in 0..20 {
            let mut b = cuboid(vector(random, 4.0), 1.0, random);
            for d in 0..3 {
                match random.below(4) {
                    0 => b.lo[d] = f64::NEG_INFINITY,
                    1 => b.hi[d] = f64::INFINITY,
                    _ => {}
                }
            }
            let class = query::classify_box(g, b);
            for _ in 0..20 {
                let reach = 10f64.powf(random.range(0.0, 6.0));
                let p = vector(random, reach).clamp(b.lo, b.hi);
                let v = g.value(p);
                assert!(class == 0 || v * f64::from(class) > 0.0, "tree {k}: {class}, but {v} at {p} of {b:?}");
            }
        }
    });
}
