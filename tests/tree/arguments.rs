// SPDX-License-Identifier: MIT OR Apache-2.0
//! Arguments of transforms and set operations that make no sense: each error names one and its value.

use embound::Status;
use embound::geometry::{Blend, BlendFunction, CustomBlend, Function, FunctionOptions, Geometry};
use embound::math::{Aabb, Vec3};
use std::sync::Arc;

const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;
const ONE: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

struct Nothing;

impl Function for Nothing {
    fn value(&self, _: Vec3) -> f64 {
        1.0
    }
}

impl BlendFunction for Nothing {
    fn blend(&self, a: f64, _: f64) -> (f64, f64, f64) {
        (a, 1.0, 0.0)
    }
}

fn ball() -> Geometry {
    Geometry::sphere([0.0; 3], 1.0).unwrap()
}

fn with(k: usize, x: f64) -> [f64; 9] {
    let mut m = ONE;
    m[k] = x;
    m
}

fn custom(support: f64, depth: f64, lipschitz: f64) -> Blend {
    Blend::Custom(CustomBlend { function: Arc::new(Nothing), support, depth, lipschitz, thread_safe: true })
}

fn function(change: impl FnOnce(&mut FunctionOptions)) -> embound::Result<Geometry> {
    let mut options = FunctionOptions::default();
    change(&mut options);
    Geometry::function(Arc::new(Nothing), &options)
}

#[test]
fn every_argument_is_named_with_its_value() {
    let g = ball();
    let pair = [ball(), ball()];
    let cases = vec![
        (g.translate([0.0, INF, 0.0]), "shift[1]: inf"),
        (g.place(with(4, NAN), [0.0; 3]), "rotation[4]: NaN"),
        (g.place(ONE, [0.0, 0.0, -INF]), "shift[2]: -inf"),
        (g.place(with(0, 1.00001), [0.0; 3]), "rotation: off"),
        (g.place(with(8, -1.0), [0.0; 3]), "rotation: determinant -1"),
        (g.rotate([0.0; 3], 10.0, [0.0; 3]), "axis: (0, 0, 0)"),
        (g.rotate([0.0, NAN, 0.0], 10.0, [0.0; 3]), "axis[1]: NaN"),
        (g.rotate([1.0; 3], INF, [0.0; 3]), "degrees: inf"),
        (g.rotate([1.0; 3], 10.0, [NAN, 0.0, 0.0]), "point[0]: NaN"),
        (g.scale(0.0), "factor: 0"),
        (g.scale(-2.0), "factor: -2"),
        (g.scale(INF), "factor: inf"),
        (g.scale(1e-310), "factor: "),
        (g.scale(1e-200).unwrap().scale(1e-200), "factor: "),
        (g.reflect(3), "plane: 3"),
        (g.reflect(-1), "plane: -1"),
        (g.reflect_in([0.0, 0.0, NAN], [1.0; 3]), "point[2]: NaN"),
        (g.reflect_in([0.0; 3], [0.0; 3]), "normal: (0, 0, 0)"),
        (g.affine(with(5, INF), [0.0; 3]), "matrix[5]: inf"),
        (g.affine(with(4, 0.0), [0.0; 3]), "matrix: "),
        (g.affine([0.0; 9], [0.0; 3]), "matrix: "),
        (g.affine(ONE, [NAN; 3]), "shift[0]: NaN"),
        (g.offset(NAN), "distance: NaN"),
        (g.annular(0.0), "half_thickness: 0"),
        (g.annular(-1.0), "half_thickness: -1"),
        (g.blur(0.0, 0.5), "h: 0"),
        (g.blur(0.1, 1.5), "alpha: 1.5"),
        (g.blur(0.1, NAN), "alpha: NaN"),
        (g.mollify(-0.5, 3), "d: -0.5"),
        (g.mollify(0.5, 0), "samples: 0"),
        (g.mollify(0.5, 33), "samples: 33"),
        (g.mollify(0.5, -3), "samples: -3"),
        (g.elongate([0.0, -0.5, 0.0]), "extent[1]: -0.5"),
        (g.elongate([0.0, 0.0, INF]), "extent[2]: inf"),
        (g.twist(INF), "degrees: inf"),
        (g.slice([NAN; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), "origin[0]: NaN"),
        (g.slice([0.0; 3], [0.0; 3], [0.0, 1.0, 0.0]), "u_axis: (0, 0, 0)"),
        (g.slice([0.0; 3], [1.0, 0.0, 0.0], [0.0, INF, 0.0]), "v_axis[1]: inf"),
        (g.slice([0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]), "v_axis: (2, 0, 0)"),
        (g.repeat([1.0, NAN, 1.0], [2; 3]), "period[1]: NaN"),
        (g.repeat([1.0; 3], [2, 0, 2]), "counts[1]: 0"),
        (g.repeat([1.0; 3], [2, 2, -7]), "counts[2]: -7"),
        (g.repeat([1e300, 1.0, 1.0], [i32::MAX, 1, 1]), "period[0]: "),
        (g.repeat([1.0; 3], [i32::MAX; 3]), "counts: 2147483647"),
        (Geometry::smooth_union(&pair, &Blend::Smooth(0.0)), "blend.width: 0"),
        (Geometry::smooth_union(&pair, &Blend::Exponential(NAN)), "blend.width: NaN"),
        (Geometry::smooth_intersection(&pair, &Blend::Smooth(-1.0)), "blend.width: -1"),
        (g.smooth_difference(&pair, &Blend::Smooth(INF)), "blend.width: inf"),
        (Geometry::smooth_union(&pair, &custom(NAN, 0.0, 1.0)), "blend.support: NaN"),
        (Geometry::smooth_union(&pair, &custom(1.0, -2.0, 1.0)), "blend.depth: -2"),
        (Geometry::smooth_union(&pair, &custom(1.0, 0.0, -3.0)), "blend.lipschitz: -3"),
        (function(|o| o.lipschitz = -1.0), "options.lipschitz: -1"),
        (function(|o| o.gradient_step = NAN), "options.gradient_step: NaN"),
        (function(|o| o.bounds = Aabb::new(Vec3::ONE, Vec3::new(2.0, 0.5, 2.0))), "options.lo[1], hi[1]: 1 to 0.5"),
    ];
    for (k, (result, text)) in cases.into_iter().enumerate() {
        let error = result.err().unwrap_or_else(|| panic!("case {k} is not refused: {text}"));
        assert_eq!(error.status(), Status::InvalidArgument, "{error}");
        assert!(error.message().contains(text), "{} does not name {text}", error.message());
        assert!(!error.message().contains('\n'));
    }
}

#[test]
fn nothing_to_divide_by_and_too_many_unbounded_copies_are_unsupported() {
    let plane = Geometry::plane([0.0; 3], [1.0, 1.0, 0.0]).unwrap();
    let flat = Geometry::union(&[]).unwrap();
    for (result, text) in [
        (plane.repeat([1.0; 3], [2000, 2000, 1]), "counts: 4000000"),
        (plane.twist(3.0).unwrap().lower_bound(), "g: its Lipschitz constant is inf"),
    ] {
        let error = result.err().expect("refused");
        assert_eq!(error.status(), Status::Unsupported, "{error}");
        assert!(error.message().contains(text), "{error}");
    }
    assert_eq!(flat.offset(3.0).unwrap().value(Vec3::ZERO), INF);
    assert_eq!(flat.complement().unwrap().annular(3.0).unwrap().value(Vec3::ZERO), INF);
}
