// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shapes, placements and CSG: values, closest points, bounds, properties, bad input.

mod common;

use common::random::Random;
use embound::Status;
use embound::geometry::{Function, FunctionOptions, Geometry, Kind};
use embound::math::{Aabb, Vec3};
use std::sync::Arc;

const QUARTER_TURN: [f64; 9] = [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];

struct Plane;

impl Function for Plane {
    fn value(&self, p: Vec3) -> f64 {
        if p.x > 9.0 { f64::NAN } else { p.z }
    }
}

fn sphere() -> Geometry {
    Geometry::sphere([1.0, 2.0, 3.0], 2.0).unwrap()
}

fn cuboid() -> Geometry {
    Geometry::cuboid([0.0, 0.0, 0.0], [1.0, 2.0, 3.0]).unwrap()
}

fn plane(options: FunctionOptions) -> Geometry {
    Geometry::function(Arc::new(Plane), &options).unwrap()
}

fn at(g: &Geometry, x: f64, y: f64, z: f64) -> f64 {
    g.value(Vec3::new(x, y, z))
}

/// A composite of everything.
fn composite() -> Geometry {
    let drilled = cuboid().difference(&Geometry::sphere([0.5, 1.0, 3.0], 0.75).unwrap()).unwrap();
    let turned = drilled.part(4).unwrap().place(QUARTER_TURN, [3.0, 0.25, -1.0]).unwrap();
    let both = Geometry::intersection(&[sphere(), cuboid().translate([0.5, 0.5, 1.0]).unwrap()]).unwrap();
    Geometry::union(&[turned, both.part(7).unwrap(), cuboid().complement().unwrap().complement().unwrap()]).unwrap()
}

#[test]
fn spheres_and_boxes_have_their_textbook_values() {
    assert_eq!(at(&sphere(), 1.0, 2.0, 3.0), -2.0);
    assert_eq!(at(&sphere(), 1.0, 2.0, 8.0), 3.0);
    assert_eq!(at(&sphere(), 1.0, 4.0, 3.0), 0.0);
    assert_eq!(at(&cuboid(), 0.5, 1.0, 1.5), -0.5);
    assert_eq!(at(&cuboid(), 4.0, 6.0, 1.0), 5.0);
    assert_eq!(at(&cuboid(), 0.5, -3.0, 1.0), 3.0);
    assert_eq!(at(&cuboid(), 1.0, 2.0, 3.0), 0.0);
}

#[test]
fn transforms_act_on_the_body_in_call_order() {
    let first = cuboid().translate([1.0, 0.0, 0.0]).unwrap().place(QUARTER_TURN, [0.0; 3]).unwrap();
    // The body at x in [1, 2] turns to y in [1, 2], x in [-2, 0].
    assert_eq!(first.bounds().lo.y.round(), 1.0);
    assert!(at(&first, -1.0, 1.5, 1.0) < 0.0 && at(&first, 1.5, 1.0, 1.0) > 0.0);
    let last = cuboid().place(QUARTER_TURN, [0.0; 3]).unwrap().translate([1.0, 0.0, 0.0]).unwrap();
    assert!(at(&last, 0.0, 0.5, 1.0) < 0.0);
}

#[test]
fn set_operations_are_minimum_maximum_and_complement() {
    let (a, b) = (sphere(), cuboid());
    let mut random = Random(1);
    for _ in 0..1000 {
        let p = Vec3::from_array(random.point([-3.0; 3], [6.0; 3]));
        let (fa, fb) = (a.value(p), b.value(p));
        assert_eq!(Geometry::union(&[a.clone(), b.clone()]).unwrap().value(p), fa.min(fb));
        assert_eq!(Geometry::intersection(&[a.clone(), b.clone()]).unwrap().value(p), fa.max(fb));
        assert_eq!(a.difference(&b).unwrap().value(p), fa.max(0.0 - fb));
        // De Morgan, to the bit.
        let parts = [a.complement().unwrap(), b.complement().unwrap()];
        let other = Geometry::union(&parts).unwrap().complement().unwrap();
        assert_eq!(other.value(p), fa.max(fb));
    }
}

#[test]
fn no_negative_zero_leaves_the_library() {
    let surface = Vec3::new(1.0, 4.0, 3.0);
    for g in [sphere(), sphere().complement().unwrap(), Geometry::union(&[sphere().complement().unwrap()]).unwrap()] {
        assert_eq!(g.value(surface).to_bits(), 0.0f64.to_bits());
        assert_eq!(g.closest(surface).value.to_bits(), 0.0f64.to_bits());
    }
    let middle = Geometry::cuboid([-1.0; 3], [1.0; 3]).unwrap().complement().unwrap().closest(Vec3::ZERO);
    for v in [middle.point, middle.gradient] {
        assert!(v.to_array().iter().all(|c| *c != 0.0 || c.is_sign_positive()), "{v:?}");
    }
}

#[test]
fn a_point_that_is_not_finite_has_no_value() {
    for g in [sphere(), cuboid(), composite(), Geometry::union(&[]).unwrap()] {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(at(&g, bad, 0.0, 0.0).is_nan() && at(&g, 0.0, 0.0, bad).is_nan());
            assert!(g.closest(Vec3::new(0.0, bad, 0.0)).value.is_nan());
        }
    }
}

#[test]
fn the_empty_union_is_nowhere_and_the_empty_intersection_everywhere() {
    let (none, all) = (Geometry::union(&[]).unwrap(), Geometry::intersection(&[]).unwrap());
    assert_eq!(at(&none, 1.0, 2.0, 3.0), f64::INFINITY);
    assert_eq!(at(&all, 1.0, 2.0, 3.0), f64::NEG_INFINITY);
    assert_eq!(none.bounds(), Aabb::EMPTY);
    assert_eq!(all.bounds(), Aabb::ALL);
    assert_eq!(none.complement().unwrap().bounds(), Aabb::ALL);
    assert_eq!(all.complement().unwrap().bounds(), Aabb::EMPTY);
}

#[test]
fn closest_points_lie_on_the_surface_and_gradients_match_differences() {
    let mut random = Random(2);
    for g in [sphere(), cuboid(), sphere().complement().unwrap(), cuboid().place(QUARTER_TURN, [1.0; 3]).unwrap()] {
        for _ in 0..500 {
            let p = Vec3::from_array(random.point([-4.0; 3], [6.0; 3]));
            let c = g.closest(p);
            assert_eq!(c.value, g.value(p));
            assert!((c.gradient.length() - 1.0).abs() < 1e-12);
            assert!(g.value(c.point).abs() < 1e-12, "{} at {p}", g.value(c.point));
            assert!(((p - c.point).length() - c.value.abs()).abs() < 1e-12);
            let ahead = g.value(p + c.gradient * 1e-7) - g.value(p - c.gradient * 1e-7);
            assert!((ahead - 2e-7).abs() < 1e-8, "{ahead} at {p}");
            assert_eq!((c.primitive, c.tag, c.part, c.feature), (-1, -1, -1, -1));
        }
    }
}

#[test]
fn the_innermost_label_wins() {
    let inner = cuboid().part(3).unwrap();
    let g = Geometry::union(&[inner.translate([10.0, 0.0, 0.0]).unwrap(), sphere()]).unwrap().part(9).unwrap();
    assert_eq!(g.closest(Vec3::new(10.5, 1.0, 1.0)).part, 3);
    assert_eq!(g.closest(Vec3::new(1.0, 2.0, 3.0)).part, 9);
    assert_eq!(sphere().closest(Vec3::ZERO).part, -1);
}

#[test]
fn bounds_hold_the_body() {
    let mut random = Random(3);
    let g = composite();
    let b = g.bounds();
    assert!(b.is_finite());
    let mut inside = 0;
    for _ in 0..20_000 {
        let p = Vec3::from_array(random.point([-4.0; 3], [6.0; 3]));
        if g.value(p) <= 0.0 {
            inside += 1;
            assert!(b.contains(p), "{p} {b:?}");
        }
    }
    assert!(inside > 100);
    assert_eq!(g.complement().unwrap().bounds(), Aabb::ALL);
    assert_eq!(cuboid().difference(&sphere()).unwrap().bounds(), cuboid().bounds());
}

#[test]
fn bounds_hold_points_that_rounding_brings_to_the_surface() {
    let mut random = Random(9);
    let mut touched = 0;
    for _ in 0..2000 {
        let (c, r, d) = (random.range(-1.0, 1.0), random.range(0.1, 2.0), random.range(-9.0, 9.0));
        for g in [Geometry::sphere([c; 3], r).unwrap(), Geometry::cuboid([c - r; 3], [c + r; 3]).unwrap()] {
            let moved = g.translate([d; 3]).unwrap();
            for (g, middle) in [(g, c), (moved, c + d)] {
                let mut x = middle + r * (1.0 - 1e-15);
                for _ in 0..64 {
                    let p = Vec3::new(x, middle, middle);
                    if g.value(p) <= 0.0 {
                        touched += 1;
                        assert!(g.bounds().contains(p), "{p} {:?}", g.bounds());
                    }
                    x = x.next_up();
                }
            }
        }
    }
    assert!(touched > 1000);
}

#[test]
fn parts_shared_many_times_over_are_counted_at_once() {
    let mut g = sphere();
    for _ in 0..200 {
        g = Geometry::union(&[g.clone(), g]).unwrap();
    }
    let properties = g.properties();
    assert_eq!(properties.primitives, u64::MAX);
    assert!(properties.bytes < 100_000, "{}", properties.bytes);
    assert_ne!(g.fingerprint(), sphere().fingerprint());
}

#[test]
fn properties_say_what_a_value_means() {
    assert_eq!(sphere().properties().kind, Kind::Exact);
    assert_eq!(sphere().place(QUARTER_TURN, [1.0; 3]).unwrap().properties().kind, Kind::Exact);
    let union = Geometry::union(&[sphere(), cuboid()]).unwrap();
    assert_eq!(union.properties().kind, Kind::LowerBound);
    assert_eq!(union.properties().primitives, 2);
    assert_eq!(Geometry::union(&[sphere()]).unwrap().properties().kind, Kind::Exact);
    assert_eq!(plane(FunctionOptions::default()).properties().kind, Kind::SignOnly);
    // A shared part counts once in memory; the hierarchy over the parts counts as well.
    let shared = sphere();
    let many = Geometry::union(&vec![shared.clone(); 1000]).unwrap().properties();
    let own: Vec<Geometry> = (0..1000).map(|_| sphere()).collect();
    let apart = Geometry::union(&own).unwrap().properties();
    assert!(many.bytes < 80_000 && many.primitives == 1000, "{many:?}");
    assert_eq!(apart.bytes - many.bytes, 999 * shared.properties().bytes);
}

#[test]
fn user_functions_take_part_and_may_fail() {
    let body = Aabb::new(Vec3::new(-5.0, -5.0, -5.0), Vec3::new(20.0, 5.0, 0.0));
    let g = plane(FunctionOptions { kind: Kind::Exact, bounds: body, ..FunctionOptions::default() });
    assert_eq!(at(&g, 0.0, 0.0, -2.0), -2.0);
    let c = g.closest(Vec3::new(1.0, 1.0, -2.0));
    assert!((c.gradient - Vec3::Z).length() < 1e-6 && c.point.z.abs() < 1e-6);
    assert!(at(&g, 10.0, 0.0, 0.0).is_nan());
    assert!(at(&Geometry::union(&[sphere(), g.clone()]).unwrap(), 10.0, 0.0, 0.0).is_nan());
    assert_eq!(g.classify(Aabb::new(Vec3::new(0.0, 0.0, -4.0), Vec3::new(1.0, 1.0, -2.0))), -1);
    assert_eq!(g.fingerprint(), 0);
}

#[test]
fn fingerprints_tell_content() {
    assert_eq!(composite().fingerprint(), composite().fingerprint());
    let others = [sphere(), cuboid(), sphere().part(1).unwrap(), sphere().part(2).unwrap(), composite()];
    for (i, a) in others.iter().enumerate() {
        assert_ne!(a.fingerprint(), 0);
        assert!(others.iter().skip(i + 1).all(|b| a.fingerprint() != b.fingerprint()));
    }
}

#[test]
fn bad_arguments_are_named() {
    let cases: Vec<(embound::Result<Geometry>, &str)> = vec![
        (Geometry::sphere([0.0, f64::NAN, 0.0], 1.0), "center[1]: NaN"),
        (Geometry::sphere([0.0; 3], 0.0), "radius: 0"),
        (Geometry::sphere([0.0; 3], -1.0), "radius: -1"),
        (Geometry::sphere([0.0; 3], f64::INFINITY), "radius: inf"),
        (Geometry::cuboid([0.0; 3], [1.0, 0.0, 1.0]), "hi[1]: 0"),
        (Geometry::cuboid([0.0; 3], [1.0, 1.0, f64::INFINITY]), "hi[2]: inf"),
        (sphere().translate([f64::NAN, 0.0, 0.0]), "shift[0]: NaN"),
        (sphere().place([2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], [0.0; 3]), "rotation"),
        (sphere().place([-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], [0.0; 3]), "reflection"),
    ];
    for (result, text) in cases {
        let error = result.err().expect("refused");
        assert_eq!(error.status(), Status::InvalidArgument);
        assert!(error.message().contains(text), "{} does not name {text}", error.message());
    }
}

#[test]
fn long_chains_of_placements_collapse_and_deep_nesting_is_refused() {
    let (s, c) = (0.01f64.sin(), 0.01f64.cos());
    let turn = [c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0];
    let mut moved = sphere();
    for _ in 0..100_000 {
        moved = moved.place(turn, [0.0; 3]).unwrap().translate([1e-3, 0.0, 0.0]).unwrap();
    }
    assert_eq!(moved.properties().kind, Kind::Exact);
    let center = moved.bounds().center();
    assert!((moved.value(center) + 2.0).abs() < 1e-9, "{}", moved.value(center));
    let mut nested = sphere();
    let refused = (0..1100).find_map(|_| match nested.complement() {
        Ok(deeper) => {
            nested = deeper;
            None
        }
        Err(error) => Some(error),
    });
    assert_eq!(refused.expect("an end").status(), Status::Unsupported);
    assert_eq!(at(&nested, 1.0, 2.0, 3.0).abs(), 2.0);
}

#[test]
fn placements_that_add_up_beyond_all_numbers_are_refused() {
    let far = sphere().place(QUARTER_TURN, [1.5e308, 0.0, 0.0]).unwrap();
    for moved in [far.place(QUARTER_TURN, [0.0, 1.5e308, 0.0]), far.translate([1.5e308, 0.0, 0.0])] {
        let error = moved.map(|_| ()).unwrap_err();
        assert_eq!(error.status(), Status::InvalidArgument);
        assert!(error.message().starts_with("shift["), "{error}");
    }
}

#[test]
fn no_negative_zero_in_vectors() {
    let turned = cuboid().complement().unwrap();
    let near = turned.closest(Vec3::new(0.0, 1.0, 4.0));
    for c in near.gradient.to_array().into_iter().chain(near.point.to_array()) {
        assert!(c != 0.0 || c.is_sign_positive(), "{near:?}");
    }
}
