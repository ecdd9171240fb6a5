// SPDX-License-Identifier: MIT OR Apache-2.0
//! Random trees of every kind of node, near the origin.

use super::scenes::one;
use super::{direction, placed, rotation, vector};
use crate::common::bodies;
use crate::common::random::Random;
use embound::geometry::{Blend, ExpressionOptions, Function, FunctionOptions, Geometry, Kind, SdfOptions};
use embound::math::{Aabb, Interval, Vec3};
use embound::parallel::Run;
use std::sync::Arc;

/// A wavy ball.
pub struct Callback {
    pub center: Vec3,
    pub radius: f64,
    pub wave: f64,
    pub ranged: bool,
    pub batched: bool,
}

impl Function for Callback {
    fn value(&self, p: Vec3) -> f64 {
        let d = p - self.center;
        (d.x * d.x + d.y * d.y + d.z * d.z).sqrt() - self.radius + self.wave * libm::sin(5.0 * p.x)
    }

    fn is_batched(&self) -> bool {
        self.batched
    }

    fn range(&self, b: Aabb) -> Option<Interval> {
        self.ranged.then(|| {
            let near = self.center - self.center.clamp(b.lo, b.hi);
            let far = (self.center - b.lo).abs().max((b.hi - self.center).abs());
            let room = self.wave + 1e-12 * (1.0 + far.length());
            Interval::new(near.length() - self.radius - room, far.length() - self.radius + room)
        })
    }
}

fn callback(random: &mut Random) -> Geometry {
    let wave = if random.below(2) == 0 { 0.0 } else { random.range(0.0, 0.4) };
    let function = Callback {
        center: vector(random, 1.0),
        radius: random.range(0.3, 1.2),
        wave,
        ranged: random.below(2) == 0,
        batched: random.below(2) == 0,
    };
    let room = Vec3::splat(function.radius + wave + 1e-9);
    let bounds =
        if random.below(2) == 0 { Aabb::ALL } else { Aabb::new(function.center - room, function.center + room) };
    let (kind, lipschitz) = match random.below(4) {
        0 if wave == 0.0 => (Kind::Exact, 0.0),
        1 if wave == 0.0 => (Kind::LowerBound, 1.0),
        2 => (Kind::SignOnly, 1.0 + 5.0 * wave),
        _ => (Kind::SignOnly, 0.0),
    };
    let options = FunctionOptions { bounds, lipschitz, kind, thread_safe: true, ..FunctionOptions::default() };
    Geometry::function(Arc::new(function), &options).unwrap()
}

fn expression(random: &mut Random) -> Geometry {
    let r = random.range(0.3, 1.0);
    let (text, bounds) = match random.below(5) {
        0 => (format!("x^2 + 2*y^2 + z^2 - {r}"), 1.3),
        1 => (format!("sqrt(x^2+y^2) - 0.4*{r} - 0.2*sin(4*z)"), 1.2),
        2 => (format!("max(abs(x), abs(y), z) - {r} + 0.1*cos(3*x*y)"), 1.5),
        3 => (format!("4*(abs(x)^1.5 + abs(y) + z^4 - {r})"), 1.4),
        _ => (format!("(x^2+y^2+z^2)^0.25 - {r}"), 1.1),
    };
    let bounds = Aabb::new(Vec3::splat(-bounds), Vec3::splat(bounds));
    let bounds = if random.below(4) == 0 { Aabb::ALL } else { bounds };
    Geometry::expression(&text, &ExpressionOptions { bounds, lipschitz: 0.0 }).unwrap()
}

fn axis(random: &mut Random, n: usize) -> Vec<f64> {
    let uneven = random.below(2) == 0;
    let mut x: Vec<f64> =
        (0..n).map(|i| 3.0 * (i as f64 + if uneven { random.unit() * 0.7 } else { 0.0 }) / n as f64 - 1.5).collect();
    if random.below(3) == 0 {
        x.reverse();
    }
    x
}

fn sampled(random: &mut Random) -> Geometry {
    let [x, y, z] = [0, 1, 2].map(|_| {
        let n = 2 + random.below(8);
        axis(random, n)
    });
    if random.below(2) == 0 {
        let heights: Vec<f64> = (0..x.len() * y.len()).map(|_| random.range(-0.8, 0.8)).collect();
        return Geometry::height_field([&x, &y], &heights).unwrap();
    }
    let (c, r, steep) = (vector(random, 0.4), random.range(0.4, 1.2), [0.5, 1.0, 3.0][random.below(3)]);
    let mut values = Vec::new();
    for z in &z {
        for y in &y {
            values.extend(x.iter().map(|x| steep * ((Vec3::new(*x, *y, *z) - c).length() - r)));
        }
    }
    Geometry::grid([&x, &y, &z], &values).unwrap()
}

fn mesh(random: &mut Random) -> Geometry {
    let soup = if random.below(2) == 0 { bodies::torus(0.8, 0.3, 12, 7) } else { bodies::icosphere(1) };
    Geometry::from_mesh(&soup.mesh(), &SdfOptions::default(), &Run::SERIAL).unwrap()
}

fn leaf(random: &mut Random) -> Geometry {
    match random.below(12) {
        0 | 1 => callback(random),
        2 => expression(random),
        3 => sampled(random),
        4 => {
            let g = Geometry::perlin(0.5, [1.0, 0.7, 1.3], 0.5, 2, random.bits()).unwrap();
            if random.below(2) == 0 { g } else { g.lower_bound().unwrap() }
        }
        5 => mesh(random),
        6 => Geometry::union(&[]).unwrap(),
        _ => one(random),
    }
}

/// Means multiply the cost: one a tree.
pub fn tree(depth: usize, random: &mut Random) -> Geometry {
    grown(depth, &mut true, random)
}

fn grown(depth: usize, mean: &mut bool, random: &mut Random) -> Geometry {
    if depth == 0 {
        return leaf(random);
    }
    let mut below = |random: &mut Random| {
        let depth = random.below(depth);
        grown(depth, mean, random)
    };
    let n = [2, 2, 3, 6, 12][random.below(5)];
    let g = below(random);
    match random.below(22) {
        0 => Geometry::union(&[g, below(random)]),
        1 => Geometry::union(&(0..n).map(|_| below(random)).collect::<Vec<_>>()),
        2 => Geometry::intersection(&[g, below(random)]),
        3 => Geometry::intersection(&(0..n).map(|_| below(random)).collect::<Vec<_>>()),
        4 | 5 => g.difference(&below(random)),
        6 => Geometry::smooth_union(&[g, below(random)], &Blend::Smooth(0.3)),
        7 => Geometry::smooth_union(&(0..n).map(|_| below(random)).collect::<Vec<_>>(), &Blend::Exponential(0.05)),
        8 => Geometry::smooth_intersection(&[g, below(random)], &Blend::Exponential(0.1)),
        9 => g.smooth_difference(&[below(random)], &Blend::Smooth(0.2)),
        10 => g.complement(),
        11 | 12 => Ok(placed(&g, random).0),
        13 => g.offset(random.range(-0.3, 0.3)),
        14 => g.annular(random.range(0.01, 0.3)),
        15 => g.elongate([random.unit() * 0.5, 0.0, random.unit() * 0.5]),
        16 => g.twist(random.range(-60.0, 60.0)),
        17 => {
            let mut m = rotation(random);
            (0..9).for_each(|k| m[k] *= [1.0, 1.7, 0.6][k % 3]);
            g.affine(m, vector(random, 0.5).to_array())
        }
        18 => g.repeat(vector(random, 1.5).to_array(), [1 + random.below(3) as i32, 1, 1 + random.below(2) as i32]),
        19 => g.slice(vector(random, 0.3).to_array(), direction(random).to_array(), direction(random).to_array()),
        20 if std::mem::take(mean) => match random.below(2) {
            0 => g.blur(0.1, 0.4),
            _ => g.mollify(0.1, 3),
        },
        _ => g.part(random.below(9) as i32),
    }
    .unwrap()
}

/// Calls `test` with many trees, each with its number and random numbers of its own.
pub fn each(seed: u64, count: u64, mut test: impl FnMut(u64, &Geometry, &mut Random)) {
    for k in 0..count {
        let mut random = Random(seed * 1_000_003 + k);
        let depth = random.below(6);
        let g = tree(depth, &mut random);
        test(k, &g, &mut random);
    }
}

/// Where something happens: points on both sides, and on the surface.
pub fn places(g: &Geometry, count: usize, random: &mut Random) -> Vec<Vec3> {
    let mut all: Vec<Vec3> = (0..count).map(|_| vector(random, 3.0)).collect();
    let (inside, outside): (Vec<Vec3>, Vec<Vec3>) = all.iter().partition(|p| g.value(**p) <= 0.0);
    if !inside.is_empty() && !outside.is_empty() {
        for _ in 0..count / 2 {
            let (a, b) = (inside[random.below(inside.len())], outside[random.below(outside.len())]);
            all.push(super::between(g, a, b));
        }
    }
    all
}
