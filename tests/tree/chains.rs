// SPDX-License-Identifier: MIT OR Apache-2.0
//! Placements undo each other, act in the order of the calls, and collapse into one.

use super::scenes::exact;
use super::{direction, rotation, vector};
use crate::common::random::Random;
use embound::geometry::{Geometry, Kind};
use embound::math::Vec3;

fn transposed(m: [f64; 9]) -> [f64; 9] {
    [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]]
}

fn assert_same_body(name: &str, g: &Geometry, home: &Geometry, tolerance: f64, random: &mut Random) {
    for _ in 0..20 {
        let p = vector(random, 4.0);
        let (a, b) = (g.value(p), home.value(p));
        assert!((a - b).abs() < tolerance, "{name} at {p}: {a} for {b}");
    }
}

#[test]
fn a_transform_and_its_inverse_leave_the_body() {
    let mut random = Random(131);
    for _ in 0..10 {
        for (name, home) in exact(&mut random) {
            let (axis, point) = (direction(&mut random).to_array(), vector(&mut random, 2.0).to_array());
            let (degrees, m) = (random.range(-720.0, 720.0), rotation(&mut random));
            let back = vector(&mut random, 9.0);
            let factor = random.range(-20.0, 20.0).exp2();
            let pairs = [
                home.rotate(axis, degrees, point).unwrap().rotate(axis, -degrees, point).unwrap(),
                home.rotate(axis, degrees, point)
                    .unwrap()
                    .rotate((-Vec3::from_array(axis)).to_array(), degrees, point)
                    .unwrap(),
                home.reflect(1).unwrap().reflect(1).unwrap(),
                home.reflect_in(point, axis).unwrap().reflect_in(point, axis).unwrap(),
                home.scale(factor).unwrap().scale(1.0 / factor).unwrap(),
                home.translate(back.to_array()).unwrap().translate((-back).to_array()).unwrap(),
                home.place(m, [0.0; 3]).unwrap().place(transposed(m), [0.0; 3]).unwrap(),
                home.elongate([0.0; 3]).unwrap(),
                home.offset(0.25).unwrap().offset(-0.25).unwrap(),
                home.complement().unwrap().complement().unwrap(),
            ];
            for g in &pairs {
                assert_same_body(name, g, &home, 2e-14 * 40.0, &mut random);
            }
            assert!(pairs[..7].iter().all(|g| g.kind() == Kind::Exact), "{name}");
            for p in (0..10).map(|_| vector(&mut random, 4.0)) {
                assert_eq!(pairs[7].value(p).to_bits(), home.value(p).to_bits(), "{name} at {p}: elongated by nothing");
                assert_eq!(pairs[9].value(p).to_bits(), home.value(p).to_bits(), "{name} at {p}: complement");
            }
        }
    }
}

#[test]
fn exact_quarter_turns_and_reflections_keep_the_bits() {
    let mut random = Random(132);
    for (name, home) in exact(&mut random) {
        let turned = home.rotate([0.0, 0.0, 3.0], 90.0, [0.0; 3]).unwrap();
        let mirrored = home.reflect(0).unwrap();
        for _ in 0..100 {
            let p = vector(&mut random, 4.0);
            assert_eq!(turned.value(Vec3::new(-p.y, p.x, p.z)).to_bits(), home.value(p).to_bits(), "{name} at {p}");
            assert_eq!(mirrored.value(Vec3::new(-p.x, p.y, p.z)).to_bits(), home.value(p).to_bits(), "{name} at {p}");
        }
    }
}

#[test]
fn a_body_that_is_moved_and_then_turned_turns_about_the_origin() {
    let ball = Geometry::sphere([0.0; 3], 0.5).unwrap();
    let moved = ball.translate([2.0, 0.0, 0.0]).unwrap().rotate([0.0, 0.0, 1.0], 90.0, [0.0; 3]).unwrap();
    assert!((moved.value(Vec3::new(0.0, 2.0, 0.0)) + 0.5).abs() < 1e-15);
    let turned = ball.rotate([0.0, 0.0, 1.0], 90.0, [0.0; 3]).unwrap().translate([2.0, 0.0, 0.0]).unwrap();
    assert!((turned.value(Vec3::new(2.0, 0.0, 0.0)) + 0.5).abs() < 1e-15);
    let scaled = ball.translate([2.0, 0.0, 0.0]).unwrap().scale(3.0).unwrap().reflect(0).unwrap();
    assert!((scaled.value(Vec3::new(-6.0, 0.0, 0.0)) + 1.5).abs() < 1e-15);
    let about = ball.rotate([0.0, 0.0, 1.0], 90.0, [1.0, 0.0, 0.0]).unwrap();
    assert!((about.value(Vec3::new(1.0, -1.0, 0.0)) + 0.5).abs() < 1e-15);
}

#[test]
fn a_hundred_thousand_placements_are_one_and_stay_accurate() {
    let mut random = Random(133);
    let box_at_home = Geometry::cuboid([-1.0, -0.5, -0.25], [0.5, 1.0, 0.75]).unwrap();
    let mut g = box_at_home.clone();
    let mut undo = Vec::new();
    for k in 0..50_000 {
        let (axis, point) = (direction(&mut random).to_array(), vector(&mut random, 1.0));
        let degrees = random.range(-180.0, 180.0);
        let factor = if k % 8 == 3 { 1.25 } else { 0.8 };
        g = match k % 4 {
            0 => g.rotate(axis, degrees, point.to_array()),
            1 => g.translate(point.to_array()),
            2 => g.reflect_in(point.to_array(), axis),
            _ => g.scale(factor),
        }
        .unwrap();
        undo.push((axis, point, degrees, factor));
    }
    let one = box_at_home.rotate([1.0, 0.0, 0.0], 5.0, [0.0; 3]).unwrap();
    assert_eq!(g.properties().bytes, one.properties().bytes, "the chain is one node over the body");
    for (k, (axis, point, degrees, factor)) in undo.into_iter().enumerate().rev() {
        g = match k % 4 {
            0 => g.rotate(axis, -degrees, point.to_array()),
            1 => g.translate((-point).to_array()),
            2 => g.reflect_in(point.to_array(), axis),
            _ => g.scale(1.0 / factor),
        }
        .unwrap();
    }
    assert_eq!(g.properties().kind, Kind::Exact);
    assert_same_body("chain", &g, &box_at_home, 1e-9, &mut random);
}
