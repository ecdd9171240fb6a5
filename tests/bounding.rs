// SPDX-License-Identifier: MIT OR Apache-2.0
//! Boxes and balls around bodies that do not know their own, and trees cut down to a box.

mod common;

use common::random::Random;
use embound::Status;
use embound::geometry::{Blend, ExpressionOptions, Function, FunctionOptions, Geometry, Kind};
use embound::math::{Aabb, Vec3};
use embound::parallel::Run;
use embound::query::{Bounding, bounding_box, bounding_sphere};
use std::sync::Arc;

struct Closure<F>(F);

impl<F: Fn(Vec3) -> f64 + Send + Sync> Function for Closure<F> {
    fn value(&self, p: Vec3) -> f64 {
        self.0(p)
    }
}

fn function(f: impl Fn(Vec3) -> f64 + Send + Sync + 'static, lipschitz: f64) -> Geometry {
    let options = FunctionOptions { lipschitz, ..FunctionOptions::default() };
    Geometry::function(Arc::new(Closure(f)), &options).unwrap()
}

fn cube(half: f64) -> Aabb {
    Aabb::new(Vec3::splat(-half), Vec3::splat(half))
}

fn boxed(g: &Geometry, start: Aabb, depth: i32) -> Bounding<Aabb> {
    bounding_box(g, start, depth, 0.0, &Run::SERIAL).unwrap()
}

#[test]
fn the_box_of_a_function_closes_in_on_the_body() {
    let ball = |p: Vec3| (p - Vec3::new(0.3, -0.2, 0.1)).length() - 0.5;
    for (g, what) in [(function(ball, 1.0), "Lipschitz"), (function(ball, 0.0), "nothing known")] {
        let mut last = f64::INFINITY;
        for depth in [2, 4, 6, 8] {
            let Bounding::Found(b) = boxed(&g, cube(2.0), depth) else { panic!("{what}, {depth}: not found") };
            assert!(b.lo.cmple(Vec3::new(-0.2, -0.7, -0.4)).all() && b.hi.cmpge(Vec3::new(0.8, 0.3, 0.6)).all());
            // A cell is kept where the surface comes within half its diagonal of its middle.
            let cell = 4.0 / f64::from(1 << depth);
            assert!((b.hi - b.lo).max_element() <= 1.0 + 4.0 * cell, "{what}, {depth}: {b:?}");
            assert!(b.diagonal() <= last);
            last = b.diagonal();
        }
        let Bounding::Found((center, radius)) = bounding_sphere(&g, cube(2.0), 7, 0.0, &Run::SERIAL).unwrap() else {
            panic!("{what}: not found")
        };
        let off = (center - Vec3::new(0.3, -0.2, 0.1)).length();
        assert!(off < 0.1 && radius >= 0.5 + off && radius < 0.66, "{what}: {center} {radius}");
    }
}

#[test]
fn an_expression_of_unknown_slope_is_bounded_by_what_is_proved() {
    let text = "(x-1)^2 + y^2 + z^2 - 1";
    let alone = Geometry::expression(text, &ExpressionOptions::default()).unwrap();
    let both = Geometry::union(&[alone.clone(), Geometry::sphere([-2.0, 0.0, 0.0], 1.0).unwrap()]).unwrap();
    for (g, least) in [(alone, 0.0), (both, -3.0)] {
        let Bounding::Found(b) = boxed(&g, cube(5.0), 6) else { panic!("not found") };
        assert!(b.lo.x <= least && b.lo.x > least - 0.5 && b.hi.x >= 2.0 && b.hi.x < 2.5, "{b:?}");
    }
}

#[test]
fn safety_widens_by_cells() {
    let g = Geometry::sphere([0.0; 3], 0.5).unwrap();
    let Bounding::Found(tight) = boxed(&g, cube(1.0), 5) else { panic!() };
    let Bounding::Found(wide) = bounding_box(&g, cube(1.0), 5, 1.5, &Run::SERIAL).unwrap() else { panic!() };
    assert!(((wide.hi - tight.hi) - Vec3::splat(1.5 / 16.0)).length() < 1e-12);
}

#[test]
fn bodies_that_leave_the_start_box_and_bodies_that_are_not_there_are_told_apart() {
    let plane = Geometry::plane([0.0; 3], [0.0, 0.0, 1.0]).unwrap();
    assert_eq!(boxed(&plane, cube(1.0), 5), Bounding::ReachesStart);
    assert_eq!(boxed(&Geometry::sphere([0.9, 0.0, 0.0], 0.5).unwrap(), cube(1.0), 5), Bounding::ReachesStart);
    assert_eq!(boxed(&Geometry::sphere([9.0, 0.0, 0.0], 0.5).unwrap(), cube(1.0), 5), Bounding::Nothing);
    // Everything is inside.
    assert_eq!(boxed(&Geometry::sphere([0.0; 3], 9.0).unwrap(), cube(1.0), 5), Bounding::ReachesStart);
    let nothing = bounding_sphere(&Geometry::union(&[]).unwrap(), cube(1.0), 3, 0.0, &Run::SERIAL).unwrap();
    assert_eq!(nothing, Bounding::Nothing);
}

#[test]
fn a_speck_is_found_at_any_depth() {
    let speck = Geometry::sphere([0.123, 0.456, -0.321], 1e-7).unwrap();
    for depth in [1, 5, 10, 16] {
        let Bounding::Found(b) = boxed(&speck, cube(1.0), depth) else { panic!("{depth}") };
        assert!(b.contains(Vec3::new(0.123, 0.456, -0.321)), "{depth}: {b:?}");
    }
}

#[test]
fn bad_starts_are_named() {
    let g = Geometry::sphere([0.0; 3], 1.0).unwrap();
    let of = |start: Aabb, depth: i32, safety: f64| {
        let error = bounding_box(&g, start, depth, safety, &Run::SERIAL).unwrap_err();
        assert_eq!(error.status(), Status::InvalidArgument);
        error.message().to_owned()
    };
    assert!(of(Aabb::new(Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0)), 5, 0.0).contains("start_lo[1]"));
    assert!(of(Aabb::ALL, 5, 0.0).contains("inf"));
    assert!(of(cube(1.0), 0, 0.0).contains("depth: 0"));
    assert!(of(cube(1.0), 17, 0.0).contains("depth: 17"));
    assert!(of(cube(1.0), 5, f64::NAN).contains("safety: NaN"));
}

#[test]
fn a_function_that_fails_is_an_error() {
    let g = function(|p| if p.x > 0.0 { f64::NAN } else { 1.0 }, 0.0);
    assert_eq!(bounding_box(&g, cube(1.0), 4, 0.0, &Run::SERIAL).unwrap_err().status(), Status::Callback);
}

#[test]
fn a_tree_cut_down_to_a_box_keeps_its_bits_there() {
    let mut random = Random(12);
    let balls: Vec<Geometry> =
        (0..300).map(|k| Geometry::sphere(random.point([-1.0; 3], [1.0; 3]), 0.05).unwrap().part(k).unwrap()).collect();
    let shape = Geometry::torus([0.0; 3], [1.0, 2.0, 3.0], 0.7, 0.2).unwrap();
    let scenes = [
        Geometry::union(&balls).unwrap(),
        shape.difference_of_many(&balls).unwrap(),
        Geometry::smooth_union(&balls, &Blend::Smooth(0.1)).unwrap().rotate([1.0, 1.0, 0.0], 30.0, [0.1; 3]).unwrap(),
        Geometry::smooth_union(&balls, &Blend::Exponential(0.01)).unwrap().scale(2.0).unwrap(),
        Geometry::union(&balls).unwrap().offset(0.02).unwrap().translate([0.1, 0.2, 0.3]).unwrap(),
    ];
    for (scene, g) in scenes.iter().enumerate() {
        let mut smaller = 0;
        for _ in 0..60 {
            let lo = Vec3::from_array(random.point([-1.0; 3], [1.0; 3]));
            let b = Aabb::new(lo, lo + Vec3::splat(0.2));
            let cut = g.simplified(b).unwrap();
            assert!(cut.properties().primitives <= g.properties().primitives);
            smaller += i32::from(cut.properties().primitives * 4 < g.properties().primitives);
            for _ in 0..50 {
                let p = Vec3::from_array(random.point(b.lo.to_array(), b.hi.to_array()));
                assert_eq!(cut.value(p).to_bits(), g.value(p).to_bits(), "scene {scene} at {p}");
                assert_eq!(cut.closest(p).part, g.closest(p).part);
            }
        }
        assert!(smaller > 30, "scene {scene}: only {smaller} became smaller");
    }
    assert!(scenes[0].simplified(Aabb::ALL).is_err());
    assert_eq!(scenes[0].kind(), Kind::LowerBound);
}
