// SPDX-License-Identifier: MIT OR Apache-2.0
//! The ellipsoid's distance where it is hard: extreme axes, symmetry planes, the medial surface.

use super::super::{Ellipsoid, Shape};
use super::Random;
use crate::math::{Vec3, length, unit};

const AXES: [[f64; 3]; 8] = [
    [1.0, 1.0, 1.0],
    [2.0, 1.0, 0.5],
    [1.0, 3.0, 3.0],
    [1.0, 1.0 + 1e-15, 1.0 - 1e-15],
    [1e4, 1.0, 1.0],
    [1e-4, 1.0, 1e-2],
    [1.0, 1e6, 1e6],
    [3e-7, 2e-6, 1e-6],
];

/// The foot lies on the surface and its normal is the gradient, which makes the value the distance or, inside,
/// that to a point that is nearest at least locally; comparison with other points of the surface settles it.
#[test]
fn shape_ellipsoid_feet_are_on_the_surface_and_square_to_it() {
    let mut random = Random(3);
    for axes in AXES {
        let shape = Ellipsoid::new([0.0; 3], axes, None).unwrap();
        let (axes, unit_of_rounding) = (Vec3::from_array(axes), shape.facts().rounding);
        let most = axes.max_element();
        let some: Vec<Vec3> = (0..2000).map(|_| unit(random.vector()) * axes).collect();
        for k in 0..4000 {
            let mut p = random.vector() * axes * [0.1, 0.9, 1.0, 1.5, 20.0][k % 5];
            for axis in 0..3 {
                // On and near the planes of symmetry.
                match random.word() % 8 {
                    0 => p[axis] = 0.0,
                    1 => p[axis] *= 1e-12,
                    2 => p[axis] *= 1e-200,
                    _ => {}
                }
            }
            let (value, gradient) = (shape.value(p), shape.gradient(p));
            let bound = unit_of_rounding.0 * p.abs().max_element() + unit_of_rounding.1;
            let foot = p - gradient * value;
            let (scaled, steep) = (foot / axes, foot / axes / axes);
            let off = (scaled.dot(scaled) - 1.0) / (2.0 * length(steep));
            assert!(off.abs() <= bound, "{axes} at {p}: {off} off, bound {bound}");
            let square = length(unit(steep).cross(gradient));
            // A foot known to within `bound` turns the normal by the greatest curvature times as much.
            let least = axes.min_element();
            let turned = bound * most / (least * least) + 1e-7;
            assert!(square <= turned, "{axes} at {p}: {square} > {turned}");
            for q in &some[k % 100 * 20..k % 100 * 20 + 20] {
                assert!(length(*q - p) >= value.abs() - bound, "{axes}: {q} is nearer to {p} than {value}");
            }
        }
    }
}

#[test]
fn shape_ellipsoid_of_equal_axes_is_a_ball() {
    let mut random = Random(5);
    let shape = Ellipsoid::new([1.0, 2.0, 3.0], [0.5; 3], None).unwrap();
    for _ in 0..1000 {
        let d = random.vector();
        let value = shape.value(d + Vec3::new(1.0, 2.0, 3.0));
        assert!((value - (length(d) - 0.5)).abs() < 1e-15 * 8.0, "{d}: {value}");
    }
    assert_eq!(shape.value(Vec3::new(1.0, 2.0, 3.0)), -0.5);
}

#[test]
fn shape_ellipsoid_centre_and_tips() {
    let shape = Ellipsoid::new([0.0; 3], [4.0, 2.0, 1.0], None).unwrap();
    assert_eq!(shape.value(Vec3::ZERO), -1.0);
    assert_eq!(shape.gradient(Vec3::ZERO), Vec3::Z);
    for (tip, normal) in [(Vec3::X * 4.0, Vec3::X), (Vec3::Y * 2.0, Vec3::Y), (Vec3::NEG_Z, Vec3::NEG_Z)] {
        assert_eq!((shape.value(tip), shape.gradient(tip)), (0.0, normal));
        assert!((shape.value(tip * 3.0) - 2.0 * length(tip)).abs() < 1e-14);
    }
    // The centre of curvature of the long tip is 1/4 away: from there the tip is nearest, before it the sides are.
    assert!((shape.value(Vec3::X * 3.75) + 0.25).abs() < 1e-15);
    assert!(shape.value(Vec3::X * 3.5) > -0.5 && shape.gradient(Vec3::X * 3.5).z > 0.0);
    assert_eq!(shape.facts().reach_inward, 0.25);
}

#[test]
fn axes_too_different_are_refused_and_points_too_far_for_them_answered() {
    let error = Ellipsoid::new([0.0; 3], [1e-155, 1.0, 1.0], None).err().unwrap();
    assert!(error.message().starts_with("semi_axes: "), "{error}");
    let thin = Ellipsoid::new([0.0; 3], [1e-90, 1.0, 1.0], None).unwrap();
    assert!((thin.value(Vec3::new(0.0, 2.0, 0.0)) - 1.0).abs() < 1e-12);
    let tiny = Ellipsoid::new([0.0; 3], [1e-300, 2e-300, 3e-300], None).unwrap();
    assert_eq!(tiny.value(Vec3::new(1e100, 0.0, 0.0)), 1e100);
}
