// SPDX-License-Identifier: MIT OR Apache-2.0
//! Fills of meshes go tile by tile: the bits of single points, on lattices of any shape, place and order, for every mode,
//! sign method and number of threads.

mod common;

use common::{Soup, bodies};
use embound::geometry::{Accelerator, Geometry, SdfOptions, SignMethod};
use embound::math::Vec3;
use embound::parallel::{Pool, Run};
use embound::query::{self, FillMode, Lattice};
use std::sync::Mutex;

fn axis(n: usize, lo: f64, hi: f64) -> Vec<f64> {
    (0..n).map(|k| lo + (hi - lo) * k as f64 / (n.max(2) - 1) as f64).collect()
}

fn around(body: &Soup, n: [usize; 3], factor: f64) -> [Vec<f64>; 3] {
    let (lo, hi) = body.bounds();
    std::array::from_fn(|k| {
        let (middle, half) = (0.5 * (lo[k] + hi[k]), 0.5 * factor * (hi[k] - lo[k]));
        axis(n[k], middle - half, middle + half)
    })
}

fn filled(g: &Geometry, axes: &[Vec<f64>; 3], mode: FillMode, run: &Run) -> Vec<f64> {
    let n = [0, 1, 2].map(|k| axes[k].len());
    let out = Mutex::new(vec![f64::NAN; n[0] * n[1] * n[2]]);
    let lattice = Lattice::new(&axes[0], &axes[1], &axes[2]).unwrap();
    query::fill(g, &lattice, mode, run, &|[i, j, k], values| {
        let from = i + n[0] * (j + n[1] * k);
        out.lock().unwrap()[from..from + values.len()].copy_from_slice(values);
    })
    .unwrap();
    out.into_inner().unwrap()
}

#[track_caller]
fn assert_same_bits(g: &Geometry, axes: &[Vec<f64>; 3]) {
    let [x, y, z] = axes;
    let exact = filled(g, axes, FillMode::Exact, &Run::SERIAL);
    let mut at = 0;
    for z in z {
        for y in y {
            for x in x {
                let value = g.value(Vec3::new(*x, *y, *z));
                assert_eq!(exact[at].to_bits(), value.to_bits(), "{x} {y} {z}: {} instead of {value}", exact[at]);
                at += 1;
            }
        }
    }
    let band = 0.1 * exact.iter().fold(0.0f64, |most, v| most.max(v.abs())) + 1e-300;
    let banded = filled(g, axes, FillMode::Band(band), &Run::SERIAL);
    let signs = filled(g, axes, FillMode::Sign, &Run::SERIAL);
    for ((exact, banded), sign) in exact.iter().zip(&banded).zip(&signs) {
        let wanted = if exact.abs() < band { *exact } else { band.copysign(*exact) };
        assert_eq!(banded.to_bits(), wanted.to_bits());
        assert_eq!(*sign, if *exact == 0.0 { 0.0 } else { exact.signum() });
    }
}

fn geometry(body: &Soup, sign: SignMethod, accelerator: Accelerator) -> Geometry {
    let options = SdfOptions { sign, accelerator, ..SdfOptions::default() };
    Geometry::from_mesh(&body.mesh(), &options, &Run::SERIAL).unwrap()
}

const SIGNS: [SignMethod; 3] = [SignMethod::Auto, SignMethod::Ray, SignMethod::None];

#[test]
fn tiles_have_the_bits_of_single_points_from_coarse_to_fine() {
    for body in [
        bodies::icosphere(3),
        bodies::bracket(),
        bodies::torus(1.0, 0.3, 40, 20),
        bodies::overlapping_spheres(3),
        bodies::with_flat_triangles(&bodies::icosphere(3)),
    ] {
        for sign in SIGNS {
            let g = geometry(&body, sign, Accelerator::Auto);
            for (n, factor) in [([9, 10, 11], 1.2), ([33, 21, 40], 1.2), ([24, 24, 24], 0.1), ([17, 16, 15], 6.0)] {
                assert_same_bits(&g, &around(&body, n, factor));
            }
        }
    }
}

#[test]
fn tiles_have_the_bits_of_brute_force() {
    let body = bodies::icosphere(2);
    let axes = around(&body, [20, 20, 20], 1.3);
    for sign in SIGNS {
        let slow = filled(&geometry(&body, sign, Accelerator::None), &axes, FillMode::Exact, &Run::SERIAL);
        for accelerator in [Accelerator::Auto, Accelerator::Compact] {
            let fast = filled(&geometry(&body, sign, accelerator), &axes, FillMode::Exact, &Run::SERIAL);
            assert!(fast.iter().zip(&slow).all(|(a, b)| a.to_bits() == b.to_bits()));
        }
    }
}

#[test]
fn thin_uneven_falling_and_repeating_lattices_are_filled_alike() {
    let body = bodies::torus(1.0, 0.3, 24, 12);
    let g = geometry(&body, SignMethod::Auto, Accelerator::Auto);
    for n in [[1, 1, 1], [1, 9, 4], [5, 1, 17], [40, 3, 1], [2, 2, 2], [8, 8, 8], [9, 4, 33]] {
        assert_same_bits(&g, &around(&body, n, 1.1));
    }
    let [x, y, z] = around(&body, [20, 20, 20], 1.2);
    let falling: Vec<f64> = x.iter().rev().copied().collect();
    let squared: Vec<f64> = y.iter().map(|c| c * c.abs()).collect();
    let repeating: Vec<f64> = z.iter().flat_map(|c| [*c, *c]).collect();
    assert_same_bits(&g, &[falling, squared, repeating]);
}

#[test]
fn points_on_the_surface_in_its_middle_and_far_away_are_filled_alike() {
    // Lattices through vertices, edges and planes of faces; the middle of a ball, from which all triangles are as far.
    let cube = bodies::unit_cube();
    let coarse = [0.0, 0.25, 0.5, 0.75, 1.0].to_vec();
    for sign in SIGNS {
        let g = geometry(&cube, sign, Accelerator::Auto);
        assert_same_bits(&g, &[coarse.clone(), coarse.clone(), coarse.clone()]);
        let far = [-1e200, -1e6, -1e3, 0.5, 1e2, 1e5, 1e9, 1e150].to_vec();
        assert_same_bits(&g, &[far.clone(), far.clone(), far]);
    }
    let ball = geometry(&bodies::icosphere(4), SignMethod::Auto, Accelerator::Auto);
    let near = axis(9, -1e-9, 1e-9);
    assert_same_bits(&ball, &[near.clone(), near.clone(), near]);
}

#[test]
fn scale_and_place_change_nothing_of_that() {
    for scale in [1e-6, 1e6] {
        let body = bodies::bracket().scaled(scale).translated([1e3 * scale, -2e3 * scale, 1e6 * scale]);
        let g = geometry(&body, SignMethod::Auto, Accelerator::Auto);
        assert_same_bits(&g, &around(&body, [24, 17, 20], 1.2));
    }
    // Coordinates so large beside the body that nearest points are rounded onto points of the lattice.
    for far in [3e9, 1e10, 1e11, 1e12, 1e13] {
        let body = bodies::icosphere(2).translated([far, -0.5 * far, 0.3 * far]);
        let g = Geometry::from_mesh(
            &body.mesh_kept(),
            &SdfOptions { sign: SignMethod::None, ..SdfOptions::default() },
            &Run::SERIAL,
        );
        let g = g.unwrap();
        for ulps in [1.0, 7.0, 1000.0] {
            let ulp = f64::EPSILON * far;
            let at = |c: f64, off: f64| axis(9, c + off - 4.0 * ulps * ulp, c + off + 4.0 * ulps * ulp);
            assert_same_bits(&g, &[at(far, 0.4), at(-0.5 * far, 0.3), at(0.3 * far, 0.7)]);
        }
        assert_same_bits(&g, &around(&body, [17, 16, 15], 1.2));
    }
    let o = 2f64.powi(35);
    let corner = Soup {
        vertices: vec![[o, o, o], [o + 1.0, o, o], [o, o + 1.0, o], [o, o, o + 1.0]],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    };
    let g = Geometry::from_mesh(&corner.mesh_kept(), &SdfOptions::default(), &Run::SERIAL).unwrap();
    assert_same_bits(&g, &[vec![o + 0.25], vec![o + 0.25], vec![o + 0.5 + f64::EPSILON * o; 3]]);
    // A speck on a large plate: its triangles are far below the error of an estimate.
    let mixed = bodies::cuboid([-1.0; 3], [1.0; 3]).and(&bodies::icosphere(2).scaled(1e-8).translated([3.0, 0.0, 0.0]));
    let g = geometry(&mixed, SignMethod::Auto, Accelerator::Auto);
    let x = axis(20, 3.0 - 2e-8, 3.0 + 2e-8);
    let y = axis(12, -2e-8, 2e-8);
    assert_same_bits(&g, &[x, y.clone(), y]);
    assert_same_bits(&g, &around(&mixed, [20, 20, 20], 1.2));
}

#[test]
fn complements_translations_and_parts_are_filled_by_the_tiles_of_their_body() {
    let body = bodies::torus(1.0, 0.3, 24, 12);
    let g = geometry(&body, SignMethod::Auto, Accelerator::Auto);
    let axes = around(&body, [20, 21, 22], 1.3);
    let moved = g.complement().unwrap().translate([0.1, -0.2, 0.3]).unwrap();
    assert_same_bits(&moved, &axes);
}

#[test]
fn any_number_of_threads_fills_the_same_bits() {
    let body = bodies::overlapping_spheres(3);
    let g = geometry(&body, SignMethod::Auto, Accelerator::Auto);
    let axes = around(&body, [50, 40, 70], 1.2);
    let serial = filled(&g, &axes, FillMode::Exact, &Run::SERIAL);
    for threads in [2, 3] {
        let pool = Pool::new(threads, || ()).unwrap();
        let parallel = filled(&g, &axes, FillMode::Exact, &Run { pool: Some(&pool), progress: None });
        assert!(serial.iter().zip(&parallel).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
}
