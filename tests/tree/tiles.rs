// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lattices of trees are filled tile by tile, with what matters in each tile: the bits of single points.

use super::batches::fill as filled;
use super::scenes::{CROWDS, crowd, one};
use super::trees::{each, places};
use super::{direction, placed, same, vector};
use crate::common::bodies;
use crate::common::random::Random;
use embound::Status;
use embound::geometry::{Accelerator, Blend, Geometry, Kind, SdfOptions};
use embound::math::Vec3;
use embound::parallel::{Pool, Run};
use embound::query::{self, FillMode, Lattice};
use std::sync::Mutex;

/// Exact, and for narrow and wide bands.
#[track_caller]
fn assert_same_bits(what: &str, g: &Geometry, axes: [&[f64]; 3], runs: &[Run]) {
    let lattice = Lattice::new(axes[0], axes[1], axes[2]).unwrap();
    let mut single = Vec::new();
    for z in axes[2] {
        for y in axes[1] {
            single.extend(axes[0].iter().map(|x| g.value(Vec3::new(*x, *y, *z))));
        }
    }
    let most = single.iter().fold(0.0f64, |most, v| if v.is_finite() { most.max(v.abs()) } else { most });
    for run in runs {
        let exact = filled(g, &lattice, FillMode::Exact, run);
        for (k, (a, b)) in exact.iter().zip(&single).enumerate() {
            assert!(same(*a, *b), "{what}: point {k} of {:?}: {a} instead of {b}", lattice.n());
        }
        for part in [1e-3, 0.03, 0.2, 2.0] {
            let band = part * most + f64::MIN_POSITIVE;
            let banded = filled(g, &lattice, FillMode::Band(band), run);
            for (k, (a, b)) in banded.iter().zip(&single).enumerate() {
                let wanted = if b.abs() < band { *b } else { band.copysign(*b) };
                assert!(same(*a, wanted), "{what}: point {k} of {:?}, band {band}: {a} for {b}", lattice.n());
            }
        }
    }
}

fn axis(n: usize, lo: f64, hi: f64) -> Vec<f64> {
    (0..n).map(|k| lo + (hi - lo) * k as f64 / (n.max(2) - 1) as f64).collect()
}

fn cube(g: &Geometry, n: usize, middle: Vec3, reach: f64) {
    let [x, y, z] = middle.to_array().map(|c| axis(n, c - reach, c + reach));
    assert_same_bits("cube", g, [&x, &y, &z], &[Run::SERIAL]);
}

fn torus() -> Geometry {
    Geometry::from_mesh(&bodies::torus(0.8, 0.3, 12, 7).mesh(), &SdfOptions::default(), &Run::SERIAL).unwrap()
}

#[test]
fn random_trees_on_lattices_of_any_shape_and_order() {
    let pool = Pool::new(2, || ()).unwrap();
    let mut asked = 0;
    each(131, 400, |k, g, random| {
        let g = if g.kind() == Kind::SignOnly { g.lower_bound() } else { Ok(g.clone()) };
        let Ok(g) = g else { return };
        asked += usize::from(!g.has_functions() && !g.may_fail());
        let sides = [[1, 1, 1], [17, 16, 9], [1, 19, 20], [33, 1, 7], [8, 9, 10], [40, 3, 2]];
        let n = sides[random.below(sides.len())];
        let (middle, reach) = (vector(random, 1.0), [0.3, 2.0, 2.0, 9.0][random.below(4)]);
        let axes: [Vec<f64>; 3] = std::array::from_fn(|d| {
            let mut axis = axis(n[d], middle[d] - reach, middle[d] + reach);
            match random.below(4) {
                0 => axis.reverse(),
                1 => axis.iter_mut().for_each(|c| *c = (*c * 2.0).round() * 0.5),
                2 => axis.iter_mut().for_each(|c| *c *= c.abs()),
                _ => {}
            }
            axis
        });
        let runs = [Run::SERIAL, Run { pool: Some(&pool), progress: None }];
        assert_same_bits(&format!("tree {k}"), &g, [&axes[0], &axes[1], &axes[2]], &runs);
    });
    assert!(asked > 100, "{asked}");
}

#[test]
fn crowds_of_parts_united_intersected_subtracted_blended_and_repeated() {
    let mut random = Random(132);
    for kind in CROWDS {
        for n in [2, 12, 50, 300] {
            let parts = crowd(kind, n, &mut random);
            let body = Geometry::rounded_box([0.0; 3], [0.9, 0.8, 0.7], 0.1, None).unwrap();
            let all = [
                Geometry::union(&parts).unwrap(),
                body.difference_of_many(&parts).unwrap(),
                torus().difference_of_many(&parts).unwrap(),
                Geometry::intersection(&parts).unwrap(),
                Geometry::smooth_union(&parts, &Blend::Smooth(0.1)).unwrap(),
                body.smooth_difference(&parts, &Blend::Exponential(0.01)).unwrap(),
            ];
            for g in all {
                cube(&g, 18, Vec3::ZERO, 1.2);
                cube(&g, 9, vector(&mut random, 1.0), 0.05);
                cube(&g, 9, Vec3::ZERO, 10.0);
            }
            let tile = Geometry::union(&parts[..n.min(12)]).unwrap().scale(0.3).unwrap();
            let many = tile.repeat([0.5, 0.6, -0.4], [5, 4, 6]).unwrap();
            cube(&many.difference(&body).unwrap(), 20, Vec3::new(1.0, 1.0, -1.0), 1.5);
            cube(&many.offset(0.05).unwrap(), 20, Vec3::new(1.0, 1.0, -1.0), 3.0);
        }
    }
}

#[test]
fn ten_thousand_balls() {
    let mut random = Random(133);
    let balls = |radius: f64, random: &mut Random| -> Vec<Geometry> {
        (0..10_000).map(|_| Geometry::sphere(vector(random, 1.0).to_array(), radius).unwrap()).collect()
    };
    for radius in [0.01, 0.1] {
        let parts = balls(radius, &mut random);
        let all = Geometry::union(&parts).unwrap();
        cube(&all, 35, Vec3::ZERO, 1.1);
        cube(&all, 17, Vec3::splat(0.3), 0.05);
        cube(&all.complement().unwrap(), 17, Vec3::ZERO, 4.0);
        cube(&torus().difference_of_many(&parts).unwrap(), 33, Vec3::ZERO, 1.1);
        cube(&Geometry::smooth_union(&parts, &Blend::Smooth(0.01)).unwrap(), 20, Vec3::ZERO, 1.1);
    }
}

#[test]
fn microns_kilometres_and_places_far_away() {
    let mut random = Random(134);
    for (scale, shift) in [(1e-6, 0.0), (1e3, 0.0), (1e6, 1e7), (1e-6, 1.0), (1.0, 1e9), (1e-300, 0.0), (1e150, 0.0)] {
        let middle = Vec3::new(shift, -shift, 0.5 * shift);
        for kind in CROWDS {
            let moved = |g: &Geometry| g.scale(scale).unwrap().translate(middle.to_array()).unwrap();
            let parts: Vec<Geometry> = crowd(kind, 60, &mut random).iter().map(moved).collect();
            let body = moved(&torus());
            for g in [
                Geometry::union(&parts).unwrap(),
                body.difference_of_many(&parts).unwrap(),
                Geometry::smooth_union(&parts, &Blend::Smooth(0.1 * scale)).unwrap(),
            ] {
                cube(&g, 18, middle, 1.2 * scale);
                cube(&g, 9, middle, 300.0 * scale);
            }
        }
    }
    // Balls and boxes that stand there themselves, where squares overflow or underflow.
    for size in [1e-160, 1e-6, 1e6, 1e160] {
        let ball = Geometry::sphere([0.0; 3], size).unwrap();
        let slab = Geometry::cuboid([-size, -size, -0.5 * size], [size, 2.0 * size, 0.5 * size]).unwrap();
        for g in [ball.difference(&slab).unwrap(), slab.difference(&ball).unwrap(), ball, slab] {
            cube(&g, 17, Vec3::ZERO, 2.0 * size);
            cube(&g, 16, Vec3::ZERO, 1e-3 * size);
        }
    }
}

#[test]
fn progress_is_told_and_stops_a_fill() {
    let ball = Geometry::sphere([0.0; 3], 0.5).unwrap();
    let g = ball.difference(&Geometry::cuboid([0.0; 3], [1.0; 3]).unwrap()).unwrap();
    let axis = axis(64, -1.0, 1.0);
    let lattice = Lattice::new(&axis, &axis, &axis).unwrap();
    for mode in [FillMode::Exact, FillMode::Band(0.1)] {
        let told = Mutex::new(Vec::new());
        let note = |done: f64| {
            told.lock().unwrap().push(done);
            false
        };
        filled(&g, &lattice, mode, &Run { pool: None, progress: Some(&note) });
        let told = told.into_inner().unwrap();
        assert!(told.len() > 2 && told.is_sorted() && told.last() == Some(&1.0), "{told:?}");
        let stopped = Run { pool: None, progress: Some(&|done| done > 0.25) };
        let points = Mutex::new(0);
        let result = query::fill(&g, &lattice, mode, &stopped, &|_, values| *points.lock().unwrap() += values.len());
        assert_eq!(result.unwrap_err().status(), Status::Cancelled);
        assert!((1..64 * 64 * 64 / 2).contains(&*points.lock().unwrap()));
    }
}

#[test]
fn surfaces_that_coincide_and_lattices_through_them() {
    let mut random = Random(135);
    let block = |lo: f64, hi: f64| Geometry::cuboid([lo; 3], [hi; 3]).unwrap();
    let ball = Geometry::sphere([0.25; 3], 0.5).unwrap();
    let all = [
        Geometry::union(&[block(0.0, 1.0), block(0.0, 1.0), block(-1.0, 0.0)]).unwrap(),
        block(0.0, 1.0).difference(&block(0.0, 1.0)).unwrap(),
        Geometry::smooth_union(&[block(0.0, 1.0), ball.clone(), block(0.0, 1.0)], &Blend::Smooth(0.25)).unwrap(),
        Geometry::union(&[ball.clone(), ball.clone()]).unwrap().annular(0.125).unwrap(),
    ];
    for g in &all {
        cube(g, 33, Vec3::ZERO, 2.0);
        // Points that are the surface's to the last digit.
        let at = places(g, 30, &mut random);
        at.iter().for_each(|p| cube(g, 5, *p, 4.0 * f64::EPSILON));
    }
}

#[test]
fn every_accelerator_and_method_of_a_mesh_within_a_tree() {
    let mut random = Random(136);
    let soup = bodies::icosphere(1);
    for accelerator in [Accelerator::Auto, Accelerator::Compact, Accelerator::None] {
        let options = SdfOptions { accelerator, ..SdfOptions::default() };
        let mesh = Geometry::from_mesh(&soup.mesh(), &options, &Run::SERIAL).unwrap();
        let shapes: Vec<Geometry> = (0..5).map(|_| one(&mut random).scale(0.5).unwrap()).collect();
        let turned = mesh.rotate(direction(&mut random).to_array(), 33.0, [0.1, 0.2, 0.3]).unwrap();
        let all = [
            mesh.difference_of_many(&shapes).unwrap(),
            Geometry::union(&[placed(&mesh, &mut random).0, turned.clone(), shapes[0].clone()]).unwrap(),
            turned.difference(&mesh).unwrap().offset(0.05).unwrap(),
            Geometry::smooth_union(&[turned, shapes[1].clone()], &Blend::Smooth(0.2)).unwrap().annular(0.1).unwrap(),
            mesh.translate([0.1, 0.0, 0.0]).unwrap().difference(&mesh).unwrap().blur(0.1, 0.5).unwrap(),
        ];
        for g in all {
            cube(&g, 17, Vec3::ZERO, 1.4);
            cube(&g, 5, Vec3::ZERO, 40.0);
        }
    }
}
