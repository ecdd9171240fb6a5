// SPDX-License-Identifier: MIT OR Apache-2.0
//! Shapes with extreme proportions, and polygons where the sign is hard.

use super::super::{Extruded, Revolved, Shape};
use super::Random;
use crate::math::{Vec3, length};

const O: [f64; 3] = [0.0; 3];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

#[test]
fn shape_cones_of_extreme_angles() {
    for angle in [1e-9, 1e-3, 90.0, 179.0, 180.0 - 1e-9] {
        let cone = Revolved::cone(O, Z, 2.0, angle).unwrap();
        let infinite = Revolved::infinite_cone(O, Z, angle).unwrap();
        let (bounds, size) = (cone.facts().bounds, cone.facts().rounding.1);
        let half = angle * (std::f64::consts::PI / 360.0);
        let rim = 2.0 * libm::tan(half);
        for shape in [&cone as &dyn Shape, &infinite] {
            assert_eq!(shape.value(Vec3::Z * -3.0), 3.0, "{angle}");
            assert_eq!(shape.value(Vec3::ZERO), 0.0, "{angle}");
            assert!(shape.value(Vec3::Z) < 0.0, "{angle}");
        }
        assert!((cone.value(Vec3::Z * 5.0) - 3.0).abs() <= size, "{angle}");
        assert!((cone.value(Vec3::new(rim + 1.0, 0.0, 2.0)) - 1.0).abs() <= 2.0 * size, "{angle}");
        assert!((infinite.value(Vec3::Y * 2.0) - 2.0 * libm::cos(half)).abs() < 1e-14, "{angle}");
        let corner = Vec3::new(rim, rim, 2.0);
        assert!(length(bounds.hi - corner) < 1e-12 * length(corner) && bounds.hi.x >= rim * (1.0 - 1e-15), "{angle}");
    }
}

#[test]
fn shape_prism_of_many_sides_is_nearly_a_cylinder() {
    let (a, b) = ([0.0, 1.0, -1.0], [2.0, 0.5, 1.0]);
    let prism = Extruded::prism(a, b, [0.0, 0.0, 1.0], 1000, 2.0).unwrap();
    let cylinder = Revolved::cylinder(a, b, 2.0).unwrap();
    let mut random = Random(4);
    for _ in 0..2000 {
        let p = random.vector() * 4.0;
        let more = prism.value(p) - cylinder.value(p);
        // The sides are within the circle by 2 (1 - cos(pi / 1000)).
        assert!((-1e-14..=1e-5).contains(&more), "{p}: {more}");
    }
}

#[test]
fn shape_prism_puts_its_first_corner_where_it_is_asked_to() {
    let prism = Extruded::prism(O, Z, [0.0, 3.0, 9.0], 5, 2.0).unwrap();
    let corner = Vec3::new(0.0, 2.0, 0.5);
    assert!(prism.value(corner).abs() < 1e-15 && (prism.value(corner * 2.0) - 2.0).abs() < 0.2);
    assert!(prism.value(-corner) > 0.3);
}

/// A fine saw: on its edges and corners the value is 0, off them the sign is that of the exact test.
#[test]
fn shape_polygon_is_zero_on_its_corners_and_signed_beside_them() {
    let mut saw = vec![[0.1, -1.0], [30.1, -1.0]];
    for k in (0..100).rev() {
        let x = 0.1 + 0.3 * f64::from(k);
        saw.extend([[x + 0.3, 1.0 / 3.0], [x + 0.2, 1e-3]]);
    }
    saw.push([0.1, 1.0 / 3.0]);
    let shape = Extruded::polygon(O, None, &saw, -1.0, 1.0).unwrap();
    saw.reverse();
    let turned = Extruded::polygon(O, None, &saw, -1.0, 1.0).unwrap();
    for (k, a) in saw.iter().enumerate() {
        let b = saw[(k + 1) % saw.len()];
        assert_eq!(shape.value(Vec3::new(a[0], a[1], 0.0)), 0.0);
        let middle = Vec3::new(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.0);
        assert!(shape.value(middle).abs() < 1e-14);
        let normal = shape.gradient(middle);
        for step in [1e-12, 1e-6, 1e-3] {
            let (out, within) = (middle + normal * step, middle - normal * step);
            assert!((shape.value(out) - step).abs() < 1e-14, "{out}");
            assert!((shape.value(within) + step).abs() < 1e-14, "{within}");
            assert!((turned.value(out) - step).abs() < 1e-14, "{out}");
        }
    }
}
