// SPDX-License-Identifier: MIT OR Apache-2.0
//! Classification against dense sampling: never a lie, and not shy where the value is a distance.

mod common;

use common::random::Random;
use common::{Soup, bodies};
use embound::geometry::{ExpressionOptions, Geometry, Kind, SdfOptions};
use embound::math::{Aabb, Vec3};
use embound::parallel::Run;
use embound::query;

const TURN: [f64; 9] = [0.36, 0.48, -0.8, -0.8, 0.60, 0.0, 0.48, 0.64, 0.60];

fn distance(soup: &Soup) -> Geometry {
    Geometry::from_mesh(&soup.mesh(), &SdfOptions::default(), &Run::SERIAL).unwrap()
}

fn scenes() -> Vec<Geometry> {
    let sphere = Geometry::sphere([0.1, 0.2, 0.3], 0.7).unwrap();
    let cuboid = Geometry::cuboid([-0.5, -0.4, -0.9], [0.3, 0.6, 0.8]).unwrap();
    let ring = distance(&bodies::torus(0.8, 0.3, 24, 12));
    let apart = ring.place(TURN, [0.2, 0.1, -0.3]).unwrap();
    vec![
        sphere.clone(),
        cuboid.place(TURN, [0.3, -0.1, 0.2]).unwrap(),
        ring.clone(),
        apart.clone(),
        distance(&bodies::leaning_pyramid()),
        distance(&bodies::torus(0.8, 0.3, 24, 12).scaled(1e-6)),
        distance(&bodies::torus(0.8, 0.3, 24, 12).scaled(1e6)),
        distance(&bodies::torus(0.8, 0.3, 24, 12).translated([2600.0, 0.0, 0.0])),
        cuboid.difference(&sphere).unwrap(),
        Geometry::union(&[apart, sphere.complement().unwrap().translate([0.5; 3]).unwrap()]).unwrap(),
        Geometry::intersection(&[ring, cuboid]).unwrap().complement().unwrap(),
    ]
}

/// The box to look at: around the body or around the rest of space.
fn region(g: &Geometry) -> Aabb {
    let b = g.bounds();
    let b = if b.is_finite() { b } else { g.complement().unwrap().bounds() };
    let b = if b.is_finite() { b } else { Aabb::new(Vec3::splat(-2.0), Vec3::splat(2.0)) };
    let room = (b.hi - b.lo) * 0.4;
    Aabb::new(b.lo - room, b.hi + room)
}

/// Corners, edges, faces and inside, evenly and at random.
fn samples(random: &mut Random, b: Aabb) -> Vec<Vec3> {
    let mut points = Vec::new();
    for code in 0..27 {
        let f = Vec3::new((code % 3) as f64, (code / 3 % 3) as f64, (code / 9) as f64) * 0.5;
        points.push(Vec3::select(f.cmpeq(Vec3::ONE), b.hi, b.lo + (b.hi - b.lo) * f));
    }
    points.extend((0..40).map(|_| Vec3::from_array(random.point(b.lo.to_array(), b.hi.to_array()))));
    points.iter().map(|p| p.clamp(b.lo, b.hi)).collect()
}

#[test]
fn a_box_called_uniform_is_uniform_at_every_sample() {
    let mut random = Random(5);
    for (scene, g) in scenes().iter().enumerate() {
        let space = region(g);
        let mut uniform = 0;
        for k in 0..3000 {
            let size = (space.hi - space.lo) * 0.5f64.powi(1 + k % 12);
            let center = Vec3::from_array(random.point(space.lo.to_array(), space.hi.to_array()));
            let extent = Vec3::from_array(random.point([0.0; 3], [1.0; 3])) * size;
            let b = Aabb::new(center - extent, center + extent);
            let class = query::classify_box(g, b);
            if class == 0 {
                let middle = b.center();
                let half = b.diagonal() * 0.5;
                if g.properties().kind == Kind::Exact {
                    assert!(g.value(middle).abs() <= 1.0001 * half, "scene {scene}: shy at {b:?}");
                }
                continue;
            }
            uniform += 1;
            for p in samples(&mut random, b) {
                let v = g.value(p);
                assert!(if class < 0 { v < 0.0 } else { v > 0.0 }, "scene {scene}: {class}, but {v} at {p} of {b:?}");
            }
        }
        assert!(uniform > 500, "scene {scene}: only {uniform} uniform");
    }
}

#[test]
fn a_box_of_one_point_has_the_sign_of_the_value() {
    let mut random = Random(6);
    for g in scenes() {
        let space = region(&g);
        for _ in 0..200 {
            let p = Vec3::from_array(random.point(space.lo.to_array(), space.hi.to_array()));
            let v = g.value(p);
            let sign = i32::from(v > 0.0) - i32::from(v < 0.0);
            assert_eq!(query::classify_box(&g, Aabb::new(p, p)), sign);
        }
    }
}

#[test]
fn what_is_no_box_is_mixed_or_an_error() {
    let g = Geometry::sphere([0.0; 3], 1.0).unwrap();
    let nan = Aabb::new(Vec3::NAN, Vec3::ONE);
    let turned = Aabb::new(Vec3::splat(9.0), Vec3::splat(8.0));
    assert_eq!((query::classify_box(&g, nan), query::classify_box(&g, turned)), (0, 0));
    let result = query::classify_boxes(
        &g,
        &[5.0, 5.0, 5.0, 9.0, 9.0, 9.0],
        &[6.0, 6.0, 6.0, 9.0, 8.0, 9.0],
        &Run::SERIAL,
        &|_, _| panic!("nothing may be written"),
    );
    let message = result.unwrap_err().to_string();
    assert!(message.contains("box 1") && message.contains('8'), "{message}");
}

#[test]
fn unbounded_boxes_are_answered() {
    let g = Geometry::sphere([0.0; 3], 1.0).unwrap();
    let far = Aabb::new(Vec3::new(2.0, -9.0, -9.0), Vec3::INFINITY);
    assert_eq!(query::classify_box(&g, far), 1);
    assert_eq!(query::classify_box(&g, Aabb::ALL), 0);
    assert_eq!(query::classify_box(&Geometry::union(&[]).unwrap(), Aabb::ALL), 1);
}

#[test]
fn bodies_apart_by_rounding_alone_are_not_called_outside() {
    let mut random = Random(5);
    let mut inside = 0;
    for _ in 0..4000 {
        let (shift, hi) = (random.range(-1.0, 1.0), random.range(0.1, 1.0));
        let moved =
            Geometry::cuboid([hi - 1.0, 0.0, 0.0], [hi, 1.0, 1.0]).unwrap().translate([shift, 0.0, 0.0]).unwrap();
        let x = moved.bounds().hi.x.next_up();
        let beside = Geometry::cuboid([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]).unwrap();
        let both = Geometry::intersection(&[moved, beside]).unwrap();
        if query::classify_box(&both, Aabb::new(Vec3::new(x - 1.0, 0.0, 0.0), Vec3::new(x + 1.0, 1.0, 1.0))) == 1 {
            let value = both.value(Vec3::new(x, 0.5, 0.5));
            assert!(value > 0.0, "{value} at {x}");
        } else {
            inside += 1;
        }
        let far = Aabb::new(Vec3::splat(3.0), Vec3::splat(9.0));
        assert_eq!(query::classify_box(&both, far), 1);
    }
    assert!(inside > 0);
}

#[test]
fn the_angle_of_a_vector_that_shrinks_to_nothing_jumps() {
    let b = Aabb::new(Vec3::splat(-2.0), Vec3::splat(2.0));
    let options = ExpressionOptions { bounds: b, lipschitz: 0.0 };
    let g = Geometry::expression("atan2(z*0,-1) + 0.1*x", &options).unwrap();
    assert!(!g.properties().lipschitz.is_finite());
    assert_eq!(query::classify_box(&g, Aabb::new(Vec3::NEG_ONE, Vec3::ONE)), 0);
}

#[test]
fn the_smallest_numbers_are_not_called_positive_where_they_are_not() {
    let g = Geometry::sphere([0.0; 3], 1e-308).unwrap().offset(1e-308).unwrap();
    let b = Aabb::new(Vec3::new(1.05e-308, -1e-312, -1e-312), Vec3::new(4e-308, 1e-312, 1e-312));
    assert!(g.value(Vec3::new(1.05e-308, 0.0, 0.0)) < 0.0);
    assert_ne!(query::classify_box(&g, b), 1);
}

#[test]
fn what_has_no_value_outside_of_its_bounds_is_not_called_outside_there() {
    let options = ExpressionOptions { bounds: Aabb::new(Vec3::ZERO, Vec3::ONE), lipschitz: 0.0 };
    let g = Geometry::expression("acos(y + 3) + x", &options).unwrap();
    assert!(g.value(Vec3::new(0.5, 3.0, 0.5)).is_nan());
    assert_eq!(query::classify_box(&g, Aabb::new(Vec3::new(0.1, 3.0, 0.1), Vec3::new(0.9, 4.0, 0.9))), 0);
}
