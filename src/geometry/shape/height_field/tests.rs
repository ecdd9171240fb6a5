// SPDX-License-Identifier: MIT OR Apache-2.0
//! Terrain against direct interpolation, sampled surfaces and differences.

use super::*;
use crate::geometry::shape::samples::Random;
use crate::math::length;

/// Rough ground with cliffs over uneven axes, scaled.
fn terrain(nx: usize, ny: usize, scale: f64, seed: u64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let mut random = Random(seed);
    let mut axis = |n: usize| {
        let mut at = random.between(-2.0, -1.0);
        let nodes = (0..n).map(|_| {
            at += random.between(0.05, 0.5);
            at * scale
        });
        nodes.collect::<Vec<f64>>()
    };
    let (x, y) = (axis(nx), axis(ny));
    let mut random = Random(seed + 1);
    let cliff = |i: usize| if i.is_multiple_of(5) { 3.0 } else { 0.0 };
    let heights = (0..nx * ny).map(|i| scale * (random.unit() + cliff(i))).collect();
    (x, y, heights)
}

fn around(field: &HeightField) -> Aabb {
    let [x, y] = &field.axes;
    let size = Vec3::new(x.hi() - x.lo(), y.hi() - y.lo(), 0.0) * 0.3;
    let all = field.pyramid.all();
    let grow = all.hi - all.lo + size.x;
    let lo = Vec3::new(x.lo() - size.x, y.lo() - size.y, all.lo - grow);
    Aabb::new(lo, Vec3::new(x.hi() + size.x, y.hi() + size.y, all.hi + grow))
}

/// The height by search from the start and the plain formula.
fn direct(x: &[f64], y: &[f64], heights: &[f64], at: (f64, f64)) -> f64 {
    let cell = |axis: &[f64], c: f64| {
        let c = c.clamp(axis[0], axis[axis.len() - 1]);
        let i = (0..axis.len() - 1).rev().find(|&i| axis[i] <= c).unwrap();
        (i, (c - axis[i]) / (axis[i + 1] - axis[i]))
    };
    let ((i, u), (j, v)) = (cell(x, at.0), cell(y, at.1));
    let h = |i: usize, j: usize| heights[j * x.len() + i];
    let row = |j: usize| h(i, j) * (1.0 - u) + h(i + 1, j) * u;
    row(j) * (1.0 - v) + row(j + 1) * v
}

#[test]
fn the_sign_is_that_of_the_height_above_the_patch() {
    for scale in [1e-6, 1.0, 1e6] {
        let (x, y, heights) = terrain(17, 9, scale, 5);
        let field = HeightField::new([&x, &y], &heights).unwrap();
        let mut random = Random(3);
        for _ in 0..20_000 {
            let mut p = random.point(around(&field));
            let h = direct(&x, &y, &heights, (p.x, p.y));
            // Beyond the last node the cell differs, and the last bit with it.
            assert!((field.height(p.x, p.y) - h).abs() <= 4.0 * f64::EPSILON * 4.0 * scale);
            let h = field.height(p.x, p.y);
            for z in [p.z, h, h.next_up(), h.next_down()] {
                p.z = z;
                assert_eq!(field.value(p).partial_cmp(&0.0), z.partial_cmp(&h));
            }
        }
        for (j, i) in (0..9).flat_map(|j| (0..17).map(move |i| (j, i))) {
            assert_eq!(field.value(Vec3::new(x[i], y[j], heights[j * 17 + i])), 0.0);
        }
    }
}

#[test]
fn the_value_is_not_above_the_distance() {
    let (x, y, heights) = terrain(7, 6, 1.0, 11);
    let field = HeightField::new([&x, &y], &heights).unwrap();
    let b = around(&field);
    let surface: Vec<Vec3> = (0..300)
        .flat_map(|i| (0..300).map(move |j| (f64::from(i) / 299.0, f64::from(j) / 299.0)))
        .map(|(u, v)| (b.lo.x + u * (b.hi.x - b.lo.x), b.lo.y + v * (b.hi.y - b.lo.y)))
        .map(|(x, y)| Vec3::new(x, y, field.height(x, y)))
        .collect();
    let mut random = Random(8);
    for _ in 0..300 {
        let p = random.point(b);
        let near = surface.iter().map(|q| length(*q - p)).fold(f64::INFINITY, f64::min);
        assert!(field.value(p).abs() <= near * (1.0 + 1e-12));
        let q = random.point(b);
        assert!((field.value(p) - field.value(q)).abs() <= length(p - q) * (1.0 + 1e-12));
    }
}

#[test]
fn the_gradient_is_that_of_differences() {
    let (x, y, heights) = terrain(12, 5, 1.0, 2);
    let field = HeightField::new([&x, &y], &heights).unwrap();
    let mut random = Random(8);
    for _ in 0..2000 {
        let p = random.point(around(&field));
        let step = 1e-7;
        // Not across an edge of a patch.
        let near = |axis: &[f64], c: f64| axis.iter().any(|node| (node - c).abs() < 2.0 * step);
        if near(&x, p.x) || near(&y, p.y) {
            continue;
        }
        let difference = |d: Vec3| (field.value(p + d * step) - field.value(p - d * step)) / (2.0 * step);
        let numeric = Vec3::new(difference(Vec3::X), difference(Vec3::Y), difference(Vec3::Z));
        assert!(length(numeric - field.gradient(p)) < 1e-6, "{p} {numeric} {}", field.gradient(p));
    }
}

#[test]
fn the_range_holds_every_value_and_is_tight() {
    for (nx, ny, scale) in [(2, 2, 1.0), (40, 30, 1e-6), (40, 30, 1e6)] {
        let (x, y, heights) = terrain(nx, ny, scale, 21);
        let field = HeightField::new([&x, &y], &heights).unwrap();
        let (all, facts) = (around(&field), field.facts());
        let mut random = Random(4);
        for round in 0..60 {
            let b = random.aabb(all);
            let range = field.range(b);
            let mut seen = Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY };
            let mut see = |p: Vec3| {
                let value = field.value(p);
                assert!(range.lo <= value && value <= range.hi);
                assert!(value > 0.0 || facts.bounds.contains(p));
                assert!(value < 0.0 || facts.rest.contains(p));
                seen = seen.hull(Interval { lo: value, hi: value });
            };
            // A fine lattice, borders included, and the nodes within.
            let n = 60;
            let places = |nodes: &[f64], lo: f64, hi: f64| {
                let mut places: Vec<f64> = (0..=n).map(|i| lo + (hi - lo) * (f64::from(i) / f64::from(n))).collect();
                places.extend(nodes.iter().filter(|c| lo <= **c && **c <= hi));
                places.iter().map(|c| c.clamp(lo, hi)).collect::<Vec<f64>>()
            };
            for x in places(&x, b.lo.x, b.hi.x) {
                for y in places(&y, b.lo.y, b.hi.y) {
                    see(Vec3::new(x, y, b.lo.z));
                    see(Vec3::new(x, y, b.hi.z));
                }
            }
            let slack = 1e-12 * (1.0 + scale);
            assert!(seen.lo - range.lo < slack && range.hi - seen.hi < slack, "{round}: {seen:?} {range:?}");
        }
    }
}

#[test]
fn falling_axes_are_read_backwards() {
    let (x, y, heights) = terrain(6, 4, 1.0, 9);
    let field = HeightField::new([&x, &y], &heights).unwrap();
    let (falling_x, falling_y): (Vec<f64>, Vec<f64>) =
        (x.iter().rev().copied().collect(), y.iter().rev().copied().collect());
    let turned: Vec<f64> = heights.iter().rev().copied().collect();
    let other = HeightField::new([&falling_x, &falling_y], &turned).unwrap();
    let rows: Vec<f64> = heights.chunks(6).flat_map(|row| row.iter().rev().copied()).collect();
    let third = HeightField::new([&falling_x, &y], &rows).unwrap();
    let mut random = Random(4);
    for _ in 0..1000 {
        let p = random.point(around(&field));
        assert_eq!(field.value(p), other.value(p));
        assert_eq!(field.value(p), third.value(p));
    }
}

#[test]
fn unfit_heights_are_named() {
    let message =
        |heights: &[f64]| HeightField::new([&[0.0, 1.0], &[0.0, 1.0]], heights).err().unwrap().message().to_owned();
    assert_eq!(message(&[0.0; 3]), "heights: 3 numbers, 4 needed");
    assert_eq!(message(&[0.0, 1.0, f64::INFINITY, 0.0]), "heights[2]: inf is not finite");
    assert_eq!(message(&[-1e308, 1e308, 0.0, 0.0]), "heights: a slope is above 1e150");
}
