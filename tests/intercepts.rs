// SPDX-License-Identifier: MIT OR Apache-2.0
//! Crossings of segments and lattice edges: against closed forms, against the values, and against each
//! other.

mod common;

use common::edges::crossings;
use common::random::Random;
use common::{Soup, bodies};
use embound::geometry::{Function, FunctionOptions, Geometry, SdfOptions, SignMethod};
use embound::math::Vec3;
use embound::parallel::{Pool, Run};
use embound::query::{self, CrossingForm, Intercept, Lattice};
use std::sync::{Arc, Mutex};

fn distance(soup: &Soup, sign: SignMethod) -> Geometry {
    let options = SdfOptions { sign, ..SdfOptions::default() };
    Geometry::from_mesh(&soup.mesh(), &options, &Run::SERIAL).unwrap()
}

fn intercept(g: &Geometry, a: Vec3, b: Vec3) -> Intercept {
    let out = Mutex::new(None);
    query::intercepts(g, &a.to_array(), &b.to_array(), &Run::SERIAL, &|_, found| {
        *out.lock().unwrap() = Some(found[0]);
    })
    .unwrap();
    out.into_inner().unwrap().unwrap()
}

struct Ball;

impl Function for Ball {
    fn value(&self, p: Vec3) -> f64 {
        p.length() - 1.0
    }
}

fn scenes() -> Vec<Geometry> {
    let turn = [0.36, 0.48, -0.8, -0.8, 0.60, 0.0, 0.48, 0.64, 0.60];
    let ring = distance(&bodies::torus(0.8, 0.3, 24, 12), SignMethod::Auto);
    let cuboid = Geometry::cuboid([-0.5, -0.4, -0.9], [0.3, 0.6, 0.8]).unwrap();
    let sphere = Geometry::sphere([0.1, 0.2, 0.3], 0.7).unwrap();
    vec![
        sphere.clone(),
        cuboid.clone(),
        ring.clone(),
        ring.place(turn, [0.1, 0.2, -0.1]).unwrap(),
        cuboid.place(turn, [0.0; 3]).unwrap().complement().unwrap(),
        distance(&bodies::overlapping_spheres(2), SignMethod::Auto),
        distance(&bodies::leaning_pyramid(), SignMethod::Ray),
        Geometry::union(&[ring.clone(), sphere.clone(), cuboid.translate([0.8, 0.0, 0.0]).unwrap()]).unwrap(),
        ring.difference(&cuboid).unwrap(),
        Geometry::intersection(&[ring, sphere]).unwrap(),
        Geometry::function(Arc::new(Ball), &FunctionOptions::default()).unwrap(),
    ]
}

#[test]
fn a_crossing_lies_between_its_ends_on_the_surface_and_turns_with_them() {
    let mut random = Random(41);
    for (scene, g) in scenes().iter().enumerate() {
        let mut crossed = 0;
        for _ in 0..2000 {
            let a = Vec3::from_array(random.point([-1.5; 3], [1.5; 3]));
            let b = Vec3::from_array(random.point([-1.5; 3], [1.5; 3]));
            let (there, back) = (intercept(g, a, b), intercept(g, b, a));
            assert_eq!((there.count, there.status, there.primitive), (back.count, back.status, back.primitive));
            let opposite = (g.value(a) <= 0.0) != (g.value(b) <= 0.0);
            assert_eq!(opposite, !there.t.is_nan(), "scene {scene}");
            assert_eq!(opposite, there.status != 0);
            if !opposite {
                continue;
            }
            crossed += 1;
            assert!((0.0..=1.0).contains(&there.t));
            assert!((there.t + back.t - 1.0).abs() < 1e-15);
            let p = a + (b - a) * there.t;
            assert!(g.value(p).abs() < 1e-12, "scene {scene}: {} at {p}", g.value(p));
            assert!(there.count >= 1 && (there.count > 1) == (there.status == 2), "scene {scene}: {there:?}");
            // The outward normal points to the outside end's side of the surface.
            let outward = if g.value(a) > 0.0 { a - b } else { b - a };
            assert!(there.normal.dot(outward) > 0.0, "scene {scene}: {there:?}");
        }
        assert!(crossed > 20, "scene {scene}: {crossed}");
    }
}

#[test]
fn of_several_crossings_the_one_nearest_the_outside_end_is_given() {
    let balls: Vec<Geometry> = (0..3).map(|k| Geometry::sphere([2.0 * k as f64, 0.0, 0.0], 0.5).unwrap()).collect();
    let row = Geometry::union(&balls).unwrap();
    let mesh = distance(
        &bodies::sphere_at(3, [0.0, 0.0, 0.0], 0.5)
            .and(&bodies::sphere_at(3, [2.0, 0.0, 0.0], 0.5))
            .and(&bodies::sphere_at(3, [4.0, 0.0, 0.0], 0.5)),
        SignMethod::Auto,
    );
    for (g, tolerance) in [(&row, 1e-3), (&mesh, 1e-2)] {
        let (outside, inside) = (Vec3::new(-1.0, 0.01, 0.02), Vec3::new(4.0, 0.01, 0.02));
        let hit = intercept(g, outside, inside);
        assert_eq!((hit.count, hit.status), (5, 2));
        assert!((hit.t * 5.0 - 0.5).abs() < tolerance, "{}", hit.t);
        let back = intercept(g, inside, outside);
        assert!((back.t * 5.0 - 4.5).abs() < tolerance, "{}", back.t);
        // Ends on one side: no crossing, but how often the surface was met.
        let through = intercept(g, outside, Vec3::new(5.0, 0.01, 0.02));
        assert!(through.t.is_nan() && through.count == 6 && through.status == 0);
    }
}

#[test]
fn a_zero_end_is_the_crossing() {
    let g = Geometry::sphere([0.0; 3], 1.0).unwrap();
    let (on, outside, inside) = (Vec3::X, Vec3::X * 2.0, Vec3::ZERO);
    assert_eq!(intercept(&g, on, outside).t, 0.0);
    assert_eq!(intercept(&g, outside, on).t, 1.0);
    // Zero counts as inside: no crossing between the surface and the inside.
    assert!(intercept(&g, on, inside).t.is_nan());
    // Outside the complement's body is inside the sphere.
    assert_eq!(intercept(&g.complement().unwrap(), on, inside).t, 0.0);
}

#[test]
fn ends_that_are_equal_or_not_finite_have_no_crossing() {
    for g in scenes() {
        for (a, b) in [(Vec3::X, Vec3::X), (Vec3::NAN, Vec3::X), (Vec3::X, Vec3::INFINITY)] {
            let hit = intercept(&g, a, b);
            assert!(hit.t.is_nan() && hit.status == 0 && hit.normal.x.is_nan());
        }
    }
}

#[test]
fn a_baffle_is_met_but_has_no_sides() {
    let g = distance(&bodies::sheet(4), SignMethod::None);
    let (lo, hi) = bodies::sheet(4).bounds();
    let middle = Vec3::new(lo[0] * 0.45 + hi[0] * 0.55, lo[1] * 0.6 + hi[1] * 0.4, 0.0);
    let hit = intercept(&g, middle - Vec3::Z * 9.0, middle + Vec3::Z * 9.0);
    assert!(hit.t.is_nan() && hit.count == 1, "{hit:?}");
}

/// Axes that pass exactly through vertices, edges and faces of bodies with round coordinates.
fn round_axes() -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let axis = |lo: f64, n: usize, step: f64| (0..n).map(|k| lo + step * k as f64).collect();
    (axis(-1.5, 13, 0.25), axis(-1.5, 25, 0.125), axis(-1.0, 9, 0.25))
}

#[test]
fn lattice_crossings_have_the_bits_of_intercepts_and_the_sides_of_the_fill() {
    let (x, y, z) = round_axes();
    let lattice = Lattice::new(&x, &y, &z).unwrap();
    let pool = Pool::new(2, || ()).unwrap();
    let pooled = Run { pool: Some(&pool), progress: None };
    let mut all = scenes();
    all.push(distance(&bodies::unit_cube(), SignMethod::Auto));
    all.push(distance(&bodies::bracket(), SignMethod::Auto));
    for g in all {
        for axis in 0..3 {
            let by_fraction = crossings(&g, &lattice, axis, CrossingForm::Fraction, &Run::SERIAL);
            let by_coordinate = crossings(&g, &lattice, axis, CrossingForm::Coordinate, &pooled);
            let mut n = lattice.n();
            n[axis] -= 1;
            for (e, (fraction, coordinate)) in by_fraction.iter().zip(&by_coordinate).enumerate() {
                let at = [e % n[0], e / n[0] % n[1], e / n[0] / n[1]];
                let mut to = at;
                to[axis] += 1;
                let point = |at: [usize; 3]| Vec3::new(x[at[0]], y[at[1]], z[at[2]]);
                let (a, b) = (point(at), point(to));
                let single = intercept(&g, a, b);
                assert_eq!(fraction.at.to_bits(), single.t.to_bits());
                assert_eq!((fraction.count, fraction.tag, fraction.part), (single.count, single.tag, single.part));
                let opposite = (g.value(a) <= 0.0) != (g.value(b) <= 0.0);
                assert_eq!(opposite, !coordinate.at.is_nan());
                if opposite {
                    assert!(a[axis] <= coordinate.at && coordinate.at <= b[axis]);
                    let mut p = a;
                    p[axis] = coordinate.at;
                    assert!(g.value(p).abs() < 1e-12, "{} at {p}", g.value(p));
                }
            }
        }
    }
}

#[test]
fn a_falling_axis_gives_the_same_coordinates() {
    let (x, y, z) = round_axes();
    let falling: Vec<f64> = y.iter().rev().copied().collect();
    let rising = Lattice::new(&x, &y, &z).unwrap();
    let turned = Lattice::new(&x, &falling, &z).unwrap();
    let g = distance(&bodies::torus(0.8, 0.3, 24, 12), SignMethod::Auto);
    let a = crossings(&g, &rising, 1, CrossingForm::Coordinate, &Run::SERIAL);
    let b = crossings(&g, &turned, 1, CrossingForm::Coordinate, &Run::SERIAL);
    let (nx, ny) = (x.len(), y.len() - 1);
    for (e, c) in a.iter().enumerate() {
        let (i, j, k) = (e % nx, e / nx % ny, e / nx / ny);
        let mirrored = b[i + nx * (ny - 1 - j + ny * k)];
        assert_eq!(c.at.to_bits(), mirrored.at.to_bits());
    }
}

#[test]
fn along_any_line_the_sides_change_as_often_as_the_surface_is_met() {
    // Lines along an axis, exactly through vertices and edges: the counts of a closed mesh have the parity
    // of its ends' sides.
    for soup in [bodies::unit_cube(), bodies::icosphere(2), bodies::bracket(), bodies::torus(0.75, 0.25, 16, 8)] {
        let g = distance(&soup, SignMethod::Ray);
        for v in soup.vertices.iter().take(200) {
            for axis in 0..3 {
                let (mut a, mut b) = (Vec3::from_array(*v), Vec3::from_array(*v));
                (a[axis], b[axis]) = (a[axis] - 50.0, b[axis] + 50.0);
                let hit = intercept(&g, a, b);
                assert!(hit.t.is_nan() && hit.count % 2 == 0, "{hit:?}");
            }
        }
    }
}

#[test]
fn no_negative_zero_among_crossings() {
    let cube = Geometry::cuboid([0.0; 3], [1.0; 3]).unwrap();
    for x in [[-1.0, -0.0], [-0.0, -1.0]] {
        let lattice = Lattice::new(&x, &[0.5], &[0.5]).unwrap();
        let found = crossings(&cube, &lattice, 0, CrossingForm::Coordinate, &Run::SERIAL);
        assert_eq!(found[0].at.to_bits(), 0, "{:?}", found[0]);
    }
    let hit = intercept(&cube.complement().unwrap(), Vec3::new(0.5, 0.5, 0.5), Vec3::new(2.0, 0.5, 0.5));
    for c in hit.normal.to_array() {
        assert!(c != 0.0 || c.is_sign_positive(), "{hit:?}");
    }
}
