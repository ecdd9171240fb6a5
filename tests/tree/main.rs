// SPDX-License-Identifier: MIT OR Apache-2.0
//! The tree of implicit functions, from outside: shapes under transforms, set operations, blends, repetition,
//! and what random trees of all of them say of themselves.

#[path = "../common/mod.rs"]
mod common;

mod arguments;
mod batches;
mod blends;
mod boxes;
mod chains;
mod csg;
mod disjoint;
mod exact;
mod levels;
mod nesting;
mod packing;
mod promises;
mod repeats;
mod scenes;
mod segments;
mod tiles;
mod transforms;
mod trees;

use common::random::Random;
use embound::geometry::Geometry;
use embound::math::Vec3;

/// Uniform in the cube of this half size.
fn vector(random: &mut Random, reach: f64) -> Vec3 {
    Vec3::from_array(random.point([-reach; 3], [reach; 3]))
}

/// Of length 1.
fn direction(random: &mut Random) -> Vec3 {
    loop {
        let v = vector(random, 1.0);
        if v.length() > 0.1 && v.length() < 1.0 {
            return v.normalize();
        }
    }
}

/// A rotation, row-major, from a random quaternion.
fn rotation(random: &mut Random) -> [f64; 9] {
    let (v, w) = (direction(random), random.range(-1.0, 1.0));
    let norm = (1.0 + w * w).sqrt();
    let ([x, y, z], w) = ((v / norm).to_array(), w / norm);
    [
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    ]
}

/// Turned, moved, mirrored and scaled at random; by how much it was scaled.
fn placed(g: &Geometry, random: &mut Random) -> (Geometry, f64) {
    let (mut g, mut scale) = (g.clone(), 1.0);
    for _ in 0..1 + random.below(5) {
        let v = vector(random, 2.0).to_array();
        g = match random.below(6) {
            0 => g.translate(v),
            1 => g.rotate(direction(random).to_array(), random.range(-400.0, 400.0), v),
            2 => {
                let factor = random.range(-1.0, 1.0).exp2();
                scale *= factor;
                g.scale(factor)
            }
            3 => g.reflect(random.below(3) as i32),
            4 => g.reflect_in(v, direction(random).to_array()),
            _ => g.place(rotation(random), v),
        }
        .unwrap();
    }
    (g, scale)
}

/// Equal to the bit; NaN is NaN.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// A place between where the sides of the ends change, to the last digit.
fn between(g: &Geometry, mut inside: Vec3, mut outside: Vec3) -> Vec3 {
    for _ in 0..60 {
        let middle = inside * 0.5 + outside * 0.5;
        *(if g.value(middle) <= 0.0 { &mut inside } else { &mut outside }) = middle;
    }
    inside
}
