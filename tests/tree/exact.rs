// SPDX-License-Identifier: MIT OR Apache-2.0
//! Exact shapes stay so under any chain of placements.

use super::scenes::exact;
use super::{placed, vector};
use crate::common::random::Random;
use embound::geometry::{Geometry, Kind};
use embound::math::Vec3;

/// Every exact shape, placed at random, with a random number of points around it.
fn each(seed: u64, rounds: usize, mut test: impl FnMut(&str, &Geometry, f64, &mut Random)) {
    let mut random = Random(seed);
    for _ in 0..rounds {
        for (name, home) in exact(&mut random) {
            let (g, scale) = placed(&home, &mut random);
            test(name, &g, scale, &mut random);
        }
    }
}

#[test]
fn placed_shapes_are_exact() {
    each(121, 20, |name, g, _, _| {
        let properties = g.properties();
        assert_eq!((properties.kind, properties.lipschitz, properties.primitives), (Kind::Exact, 1.0, 1), "{name}");
    });
}

#[test]
fn placed_shapes_have_gradients_of_length_one_and_closest_points_on_the_surface() {
    each(122, 20, |name, g, scale, random| {
        for _ in 0..100 {
            let p = vector(random, 8.0);
            let c = g.closest(p);
            assert_eq!(c.value, g.value(p), "{name}");
            assert!((c.gradient.length() - 1.0).abs() < 1e-12, "{name} at {p}: {c:?}");
            assert!(((p - c.point).length() - c.value.abs()).abs() < 1e-11 * (1.0 + scale), "{name} at {p}: {c:?}");
            assert!(g.value(c.point).abs() < 1e-11 * (1.0 + scale), "{name} at {p}: {c:?}: {}", g.value(c.point));
        }
    });
}

#[test]
fn placed_shapes_change_no_faster_than_places() {
    each(123, 20, |name, g, scale, random| {
        for k in 0..200 {
            let p = vector(random, 8.0);
            let q = p + vector(random, 8.0) * 0.1f64.powi(k % 8);
            let change = (g.value(p) - g.value(q)).abs();
            assert!(change <= (p - q).length() + 1e-12 * (1.0 + scale), "{name}: {p} to {q}: {change}");
        }
    });
}

#[test]
fn gradients_of_placed_shapes_are_those_of_the_values() {
    let mut compared = 0;
    each(124, 10, |name, g, _, random| {
        let step = 1e-5;
        for _ in 0..60 {
            let p = vector(random, 5.0);
            let gradient = g.closest(p).gradient;
            let axes = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| axis * step);
            // Away from where the surface, or the medial axis, turns.
            if axes.iter().flat_map(|d| [p + *d, p - *d]).any(|q| (g.closest(q).gradient - gradient).length() > 1e-3) {
                continue;
            }
            compared += 1;
            for d in axes {
                let slope = (g.value(p + d) - g.value(p - d)) / (2.0 * step);
                assert!((slope - gradient.dot(d) / step).abs() < 2e-3, "{name} at {p}: {slope} for {gradient}");
            }
        }
    });
    assert!(compared > 8000, "{compared}");
}

#[test]
fn placed_shapes_have_the_values_of_the_shape_where_it_was() {
    let mut random = Random(125);
    for _ in 0..10 {
        for (name, home) in exact(&mut random) {
            let (degrees, factor) = (random.range(-360.0, 360.0), random.range(0.1, 9.0));
            let (axis, point, shift) = (vector(&mut random, 1.0), vector(&mut random, 2.0), vector(&mut random, 2.0));
            let turned = home.rotate(axis.to_array(), degrees, point.to_array()).unwrap();
            let g = turned.scale(factor).unwrap().translate(shift.to_array()).unwrap().reflect(2).unwrap();
            for _ in 0..30 {
                let q = vector(&mut random, 3.0);
                // Rodrigues: q - point turned about the axis.
                let (u, d) = (axis.normalize(), q - point);
                let (s, c) = degrees.to_radians().sin_cos();
                let turned = d * c + u.cross(d) * s + u * u.dot(d) * (1.0 - c) + point;
                let p = (turned * factor + shift) * Vec3::new(1.0, 1.0, -1.0);
                let wrong = (g.value(p) - factor * home.value(q)).abs();
                assert!(wrong < 1e-12 * factor.max(1.0) * 10.0, "{name}: off by {wrong} at {p}");
            }
        }
    }
}
