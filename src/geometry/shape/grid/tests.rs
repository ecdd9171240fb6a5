// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sampled grids against linear functions, differences and dense sampling.

use super::*;
use crate::geometry::shape::samples::Random;
use crate::math::length;

fn axis(n: usize, seed: u64) -> Vec<f64> {
    let mut random = Random(seed);
    let mut at = -1.0;
    (0..n)
        .map(|_| {
            at += random.between(0.1, 0.4);
            at
        })
        .collect()
}

fn sampled(n: [usize; 3], f: impl Fn(Vec3) -> f64) -> Grid {
    let axes: [Vec<f64>; 3] = std::array::from_fn(|k| axis(n[k], k as u64 + 1));
    let mut values = Vec::new();
    for z in &axes[2] {
        for y in &axes[1] {
            values.extend(axes[0].iter().map(|x| f(Vec3::new(*x, *y, *z))));
        }
    }
    Grid::new([&axes[0], &axes[1], &axes[2]], &values).unwrap()
}

fn all(grid: &Grid, grow: f64) -> Aabb {
    let corner = |f: fn(&Axis) -> f64| Vec3::new(f(&grid.axes[0]), f(&grid.axes[1]), f(&grid.axes[2]));
    Aabb::new(corner(Axis::lo) - grow, corner(Axis::hi) + grow)
}

fn rough(seed: u64) -> Grid {
    let noise = move |p: Vec3| {
        Random((p.x * 1e6) as i64 as u64 ^ ((p.y * 3e6) as i64 as u64) << 20 ^ ((p.z * 7e6) as i64 as u64) << 9 ^ seed)
    };
    sampled([9, 7, 6], move |p| {
        let mut noise = noise(p);
        noise.unit();
        noise.unit() + length(p - Vec3::splat(0.2)) - 0.9
    })
}

#[test]
fn linear_functions_are_reproduced_and_so_is_their_slope() {
    let linear = |p: Vec3| 0.3 * p.x - 0.4 * p.y + 1.2 * p.z + 0.1;
    let grid = sampled([5, 8, 3], linear);
    assert!((grid.lipschitz - 1.3).abs() < 1e-12 && grid.lipschitz >= 1.3 - 1e-15);
    let mut random = Random(1);
    for _ in 0..2000 {
        let p = random.point(all(&grid, 0.0));
        assert!((grid.value(p) - linear(p)).abs() < 4e-15);
        assert!(length(grid.gradient(p) - Vec3::new(0.3, -0.4, 1.2)) < 1e-13);
        let far = random.point(all(&grid, 3.0));
        let near = far.clamp(all(&grid, 0.0).lo, all(&grid, 0.0).hi);
        assert_eq!(grid.value(far), grid.value(near));
    }
}

#[test]
fn the_lipschitz_constant_is_never_exceeded_and_nearly_reached() {
    let grid = rough(7);
    let mut random = Random(1);
    let mut most = 0.0f64;
    for _ in 0..200_000 {
        let p = random.point(all(&grid, 0.3));
        let q = p + (random.point(Aabb::new(Vec3::splat(-1.0), Vec3::splat(1.0)))) * 0.01;
        most = most.max((grid.value(p) - grid.value(q)).abs() / length(p - q));
    }
    assert!(most <= grid.lipschitz * (1.0 + 1e-9) && most > 0.5 * grid.lipschitz, "{most} {}", grid.lipschitz);
}

#[test]
fn bounds_hold_the_body_and_ranges_hold_the_values() {
    for seed in 0..10 {
        let grid = rough(seed);
        let facts = grid.facts();
        let mut random = Random(seed);
        for _ in 0..100 {
            let b = random.aabb(all(&grid, 0.4));
            let range = grid.range(b);
            for _ in 0..300 {
                let p = random.point(b);
                let value = grid.value(p);
                assert!(range.lo <= value && value <= range.hi);
                assert!(value > 0.0 || facts.bounds.contains(p));
                assert!(value < 0.0 || facts.rest.contains(p));
            }
        }
    }
    let ball = sampled([20, 20, 20], |p| length(p - Vec3::splat(0.8)) - 0.5);
    let bounds = ball.facts().bounds;
    assert!(bounds.is_finite() && bounds.diagonal() < 4.0);
    assert!(sampled([3, 3, 3], |_| 1.0).facts().bounds.is_empty());
}

#[test]
fn the_gradient_is_that_of_differences() {
    let grid = rough(3);
    let mut random = Random(8);
    let step = 1e-7;
    for _ in 0..2000 {
        let p = random.point(all(&grid, 0.2));
        let near = |k: usize| grid.axes[k].nodes().iter().any(|node| (node - p[k]).abs() < 2.0 * step);
        if (0..3).any(near) || !all(&grid, 0.0).contains(p) {
            continue;
        }
        let difference = |d: Vec3| (grid.value(p + d * step) - grid.value(p - d * step)) / (2.0 * step);
        let numeric = Vec3::new(difference(Vec3::X), difference(Vec3::Y), difference(Vec3::Z));
        assert!(length(numeric - grid.gradient(p)) < 1e-6);
    }
}

#[test]
fn unfit_values_are_named() {
    let axis: &[f64] = &[0.0, 1.0];
    let message = |values: &[f64]| Grid::new([axis; 3], values).err().unwrap().message().to_owned();
    assert_eq!(message(&[0.0; 9]), "values: 9 numbers, 8 needed");
    assert_eq!(message(&[0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]), "values[1]: NaN is not finite");
}
