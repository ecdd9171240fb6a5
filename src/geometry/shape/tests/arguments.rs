// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bad arguments: the error names the argument and the value.

use super::super::{Cuboid, Ellipsoid, Extruded, Perlin, Plane, Revolved, RoundedBox, Shape, Sphere};
use crate::error::Result;

const O: [f64; 3] = [0.0; 3];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;

fn refused<S: Shape>(shape: Result<S>, message: &str) {
    assert_eq!(shape.err().map(|e| e.message().to_owned()).as_deref(), Some(message));
}

#[test]
fn shape_arguments_are_checked() {
    refused(Sphere::new(O, 0.0), "radius: 0 is not finite and > 0");
    refused(Cuboid::new(O, [1.0, 0.0, 1.0]), "hi[1]: 0 is not above lo[1] = 0");
    refused(Plane::new([0.0, NAN, 0.0], Z), "point[1]: NaN is not finite");
    refused(Plane::new(O, O), "normal: (0, 0, 0) has no direction");
    refused(Plane::new(O, [INF, 0.0, 0.0]), "normal[0]: inf is not finite");
    refused(Revolved::torus(O, Z, 1.0, 1.0), "minor: 1 is not below major = 1");
    refused(Revolved::torus(O, Z, 1.0, 0.0), "minor: 0 is not finite and > 0");
    refused(Revolved::torus(O, O, 1.0, 0.5), "axis: (0, 0, 0) has no direction");
    refused(Revolved::cylinder(O, Z, -1.0), "radius: -1 is not finite and > 0");
    refused(Revolved::cylinder(Z, Z, 1.0), "b - a: (0, 0, 0) has no direction");
    refused(Revolved::cylinder([-1e308, 0.0, 0.0], [1e308, 0.0, 0.0], 1.0), "b - a[0]: inf is not finite");
    refused(Revolved::infinite_cylinder(O, Z, INF), "radius: inf is not finite and > 0");
    refused(Revolved::capsule(O, [0.0, NAN, 1.0], 1.0), "b[1]: NaN is not finite");
    refused(Revolved::capsule_tips(O, Z, 0.5), "radius: 0.5 is not below half the distance 1 of the tips");
    refused(Revolved::capsule_tips(O, Z, NAN), "radius: NaN is not finite and > 0");
    refused(Revolved::infinite_cone(O, Z, 180.0), "angle: 180 is not above 0 and below 180");
    refused(Revolved::infinite_cone(O, Z, NAN), "angle: NaN is not above 0 and below 180");
    refused(Revolved::cone(O, Z, 1.0, 0.0), "angle: 0 is not above 0 and below 180");
    refused(Revolved::cone(O, Z, 0.0, 60.0), "height: 0 is not finite and > 0");
    refused(
        Revolved::rounded_cylinder(O, Z, 1.0, 1.0, 0.75),
        "rounding: 0.75 is above 0.5, the lesser of radius and height / 2",
    );
    refused(Revolved::rounded_cylinder(O, Z, 1.0, 1.0, -0.5), "rounding: -0.5 is not finite and >= 0");
    refused(RoundedBox::new(O, [1.0, -1.0, 1.0], 0.0, None), "half[1]: -1 is not finite and > 0");
    refused(RoundedBox::new(O, [1.0, 0.5, 1.0], 0.75, None), "radius: 0.75 is above the least half size 0.5");
    refused(
        RoundedBox::new(O, [1.0; 3], 0.0, Some([-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])),
        "rotation: determinant -1 is a reflection",
    );
    refused(Ellipsoid::new(O, [1.0, 1.0, 0.0], None), "semi_axes[2]: 0 is not finite and > 0");
    refused(Extruded::prism(O, Z, [1.0, 0.0, 0.0], 2, 1.0), "sides: 2 is not between 3 and 1000");
    refused(Extruded::prism(O, Z, [0.0, 0.0, -2.0], 6, 1.0), "toward: (0, 0, -2) is along b - a");
    refused(Perlin::new(0.0, Z, 0.5, 1, 0), "amplitude: 0 is not finite and > 0");
    refused(Perlin::new(1.0, [1.0, -1.0, 0.0], 0.5, 1, 0), "frequency[1]: -1 is not finite and >= 0");
    refused(Perlin::new(1.0, Z, NAN, 1, 0), "persistence: NaN is not finite and > 0");
    refused(Perlin::new(1.0, Z, 0.5, 17, 0), "octaves: 17 is not between 1 and 16");
    refused(Perlin::new(1e300, Z, 1e10, 2, 0), "amplitude: 1e300 makes values without bound");
}

#[test]
fn shape_polygons_are_checked() {
    let polygon = |points: &[[f64; 2]]| Extruded::polygon(O, None, points, 0.0, 1.0);
    refused(polygon(&[[0.0, 0.0], [1.0, 0.0]]), "points: 2 are fewer than 3");
    refused(polygon(&[[0.0, 0.0], [1.0, INF], [1.0, 1.0]]), "points[1][1]: inf is not finite");
    refused(polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), "points[2]: (1, 0) repeats points[1]");
    refused(polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]), "points[0]: (0, 0) repeats points[3]");
    refused(polygon(&[[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]]), "points: all 3 are on one line");
    refused(polygon(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), "points: edges 0 and 2 meet");
    // A spike, and a corner that touches another edge.
    refused(polygon(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]]), "points: edges 0 and 1 meet");
    refused(polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), "points: edges 0 and 2 meet");
    refused(polygon(&vec![[0.0, 0.0]; 10_001]), "points: 10001 are more than 10000");
    refused(Extruded::polygon(O, None, &[[0.0, 0.0]; 3], 1.0, 1.0), "z_hi: 1 is not above z_lo = 1");
    refused(Extruded::polygon(O, None, &[[0.0, 0.0]; 3], NAN, 1.0), "z_lo: NaN is not finite");
    let turned = [[-1.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
    refused(Revolved::polygon(O, Z, &turned), "points[0][0]: -1 is not >= 0");
    // Ten thousand corners are fine, and quick enough.
    let circle: Vec<[f64; 2]> = (0..10_000)
        .map(|k| f64::from(k) * (std::f64::consts::PI / 5000.0))
        .map(|t| [libm::cos(t), libm::sin(t)])
        .collect();
    assert!(polygon(&circle).is_ok_and(|shape| shape.facts().reach_outward == f64::INFINITY));
}

#[test]
fn shape_reach_is_that_of_the_surface() {
    let reach = |shape: &dyn Shape| (shape.facts().reach_outward, shape.facts().reach_inward);
    assert_eq!(reach(&Sphere::new(O, 2.0).unwrap()), (INF, 2.0));
    assert_eq!(reach(&Plane::new(O, Z).unwrap()), (INF, INF));
    assert_eq!(reach(&Revolved::torus(O, Z, 2.0, 0.5).unwrap()), (1.5, 0.5));
    assert_eq!(reach(&Revolved::capsule(O, Z, 0.5).unwrap()), (INF, 0.5));
    assert_eq!(reach(&Revolved::cylinder(O, Z, 0.5).unwrap()), (INF, 0.0));
    assert_eq!(reach(&RoundedBox::new(O, [1.0; 3], 0.25, None).unwrap()), (INF, 0.25));
    assert_eq!(reach(&Ellipsoid::new(O, [1.0, 2.0, 4.0], None).unwrap()), (INF, 0.25));
    let revolved = |points: &[[f64; 2]]| reach(&Revolved::polygon(O, Z, points).unwrap());
    assert_eq!(revolved(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]), (INF, 0.0));
    // Convex polygons whose solids are not: a dent around the axis, a ring.
    assert_eq!(revolved(&[[0.0, 0.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]]), (0.0, 0.0));
    assert_eq!(revolved(&[[0.5, 0.0], [1.0, 0.0], [1.0, 1.0]]), (0.0, 0.0));
}

#[test]
fn shape_words_take_both_zeros_for_one() {
    let words = |shape: &dyn Shape| {
        let mut all = Vec::new();
        shape.words(&mut |word| all.push(word));
        all
    };
    let capsule = |x: f64| words(&Revolved::capsule([x, 0.0, 0.0], [x, x, 1.0], 0.5).unwrap());
    assert_eq!(capsule(0.0), capsule(-0.0));
    let polygon = |x: f64| words(&Revolved::polygon(O, Z, &[[x, x], [1.0, x], [0.0, 1.0]]).unwrap());
    assert_eq!(polygon(0.0), polygon(-0.0));
    let cuboid = |x: f64| words(&Cuboid::new([x; 3], [1.0; 3]).unwrap());
    assert_eq!(cuboid(0.0), cuboid(-0.0));
}
