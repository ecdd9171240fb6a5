// SPDX-License-Identifier: MIT OR Apache-2.0
//! Open meshes that are closed when a geometry is made of them: every question sees the same closed body.

#[path = "../common/mod.rs"]
mod common;

mod cap;
mod pipes;
mod refused;
mod sweep;

use common::random::Random;
use common::{Soup, points, winding};
use embound::geometry::{Accelerator, Geometry, SdfOptions};
use embound::math::{Aabb, Vec3};
use embound::mesh::{Mesh, MeshOptions};
use embound::parallel::{Pool, Run};
use embound::query::{self, CrossingForm, FillMode, Lattice, Rays};
use std::sync::Mutex;

const ACCELERATORS: [Accelerator; 3] = [Accelerator::Auto, Accelerator::None, Accelerator::Compact];

fn build(mesh: &Mesh, options: &SdfOptions) -> Geometry {
    Geometry::from_mesh(mesh, options, &Run::SERIAL).expect("a geometry")
}

/// The body as files have it: outward, inward, every second face turned, every face twice.
fn as_given(soup: &Soup) -> [Soup; 4] {
    [soup.clone(), soup.flipped(), soup.flipped_where(|k| k % 2 == 1), soup.duplicated()]
}

fn mesh_of(soup: &Soup) -> Mesh {
    let tags: Vec<i32> = (0..soup.triangles.len() as i32).map(|t| 1 + t % 5).collect();
    Mesh::from_triangles(&soup.xyz(), &soup.indices(), Some(&tags), &MeshOptions::default()).expect("a mesh")
}

/// Points all over a box, on the surface and near it.
fn points_in(soup: &Soup, b: Aabb, count: usize, random: &mut Random) -> Vec<[f64; 3]> {
    let mut all = points::all_kinds(soup, count, random);
    all.extend(points::near(soup, 1e-3, count, random));
    all.retain(|p| b.contains(Vec3::from_array(*p)));
    all.extend((0..2 * count).map(|_| random.point(b.lo.to_array(), b.hi.to_array())));
    all
}

/// The same body with every layout, to the bit, and unpacked from a block.
fn same_with_every_layout(mesh: &Mesh, options: &SdfOptions, at: &[[f64; 3]]) -> Geometry {
    let all = ACCELERATORS.map(|accelerator| build(mesh, &SdfOptions { accelerator, ..options.clone() }));
    let [g, ..] = &all;
    let block = g.pack().expect("a block");
    let back = Geometry::unpack(&block, embound::geometry::UnpackCheck::Check, &Run::SERIAL).expect("a geometry");
    assert_eq!(back.fingerprint(), g.fingerprint());
    for p in at {
        let p = Vec3::from_array(*p);
        let a = g.closest(p);
        for other in all[1..].iter().chain([&back]) {
            let b = other.closest(p);
            assert_eq!(
                (a.value.to_bits(), a.primitive, a.piece, a.tag),
                (b.value.to_bits(), b.primitive, b.piece, b.tag)
            );
            assert_eq!(other.value(p).to_bits(), a.value.to_bits(), "{p}");
            assert_eq!(a.point.to_array().map(f64::to_bits), b.point.to_array().map(f64::to_bits), "{p}");
        }
        let of_a_face = a.primitive >= 0;
        assert_eq!(
            (a.tag > 0, a.piece >= 0, a.feature >= 0, !a.barycentric.is_nan()),
            (of_a_face, of_a_face, of_a_face, of_a_face)
        );
        assert!(!a.point.is_nan() && !a.gradient.is_nan() && a.primitive < mesh.face_count() as i64);
    }
    all.into_iter().next().expect("three")
}

/// Signs against solid angles of the body that is meant.
fn signs_are_those_of(whole: &Soup, g: &Geometry, at: &[[f64; 3]], size: f64) -> usize {
    let mut clear = 0;
    for p in at {
        let value = g.value(Vec3::from_array(*p));
        if value.abs() > 1e-6 * size {
            let winding = winding::winding_number(whole, *p);
            assert_eq!(value < 0.0, winding > 0.5, "{p:?}: {value} and {winding}");
            clear += 1;
        }
    }
    clear
}

/// Lattices, edges, segments, rays and boxes say what values say.
fn questions_agree(g: &Geometry, b: Aabb, random: &mut Random) {
    let n = [14, 12, 13];
    let axis = |k: usize| -> Vec<f64> {
        let step = (b.hi[k] - b.lo[k]) / n[k] as f64;
        (0..=n[k]).map(|i| b.lo[k] + step * (i as f64 + 0.03 * random_of(i + 31 * k))).collect()
    };
    let axes = [axis(0), axis(1), axis(2)];
    let lattice = Lattice::new(&axes[0], &axes[1], &axes[2]).expect("a lattice");
    let counts = axes.each_ref().map(Vec::len);
    let index = |[i, j, k]: [usize; 3]| (k * counts[1] + j) * counts[0] + i;
    let point = |[i, j, k]: [usize; 3]| Vec3::new(axes[0][i], axes[1][j], axes[2][k]);
    let pool = Pool::new(3, || ()).expect("a pool");
    for run in [Run::SERIAL, Run { pool: Some(&pool), progress: None }] {
        let band = 0.2 * b.diagonal();
        for mode in [FillMode::Exact, FillMode::Band(band), FillMode::Sign] {
            let out = Mutex::new(vec![f64::NAN; counts.iter().product()]);
            query::fill(g, &lattice, mode, &run, &|at, values| {
                out.lock().unwrap()[index(at)..][..values.len()].copy_from_slice(values);
            })
            .expect("filled");
            let out = out.into_inner().unwrap();
            for at in all(counts) {
                let value = g.value(point(at));
                let expected = match mode {
                    FillMode::Exact => value,
                    FillMode::Band(band) => {
                        if value.abs() < band {
                            value
                        } else {
                            band.copysign(value)
                        }
                    }
                    FillMode::Sign => {
                        if value == 0.0 {
                            0.0
                        } else {
                            1f64.copysign(value)
                        }
                    }
                };
                assert_eq!(out[index(at)].to_bits(), expected.to_bits(), "{at:?} {mode:?}");
            }
        }
        for along in 0..3 {
            let found = Mutex::new(std::collections::BTreeMap::new());
            query::crossings(g, &lattice, along, CrossingForm::Fraction, &run, &|at, _, some| {
                some.iter().for_each(|(d, c)| {
                    found.lock().unwrap().insert([at[0] + d, at[1], at[2]], c.count);
                });
            })
            .expect("crossings");
            let found = found.into_inner().unwrap();
            for at in all(counts).filter(|at| at[along] + 1 < counts[along]) {
                let mut to = at;
                to[along] += 1;
                // What lies on the surface is neither.
                let values = [at, to].map(|at| g.value(point(at)));
                let differ = values[0] * values[1] < 0.0;
                if !values.contains(&0.0) {
                    assert_eq!(found.get(&at).is_some_and(|count| count % 2 == 1), differ, "{at:?} {along}");
                }
            }
        }
    }
    for _ in 0..300 {
        let [p, q] = [0, 1].map(|_| random.point(b.lo.to_array(), b.hi.to_array()));
        let sides = [p, q].map(|p| g.value(Vec3::from_array(p)) < 0.0);
        let direction = [0, 1, 2].map(|k| q[k] - p[k]);
        let rays = Rays::new(&p, &direction, &[], &[1.0]).expect("rays");
        let counts = Mutex::new(0);
        query::count_hits(g, &rays, &Run::SERIAL, &|_, found| *counts.lock().unwrap() += found[0]).expect("hits");
        assert_eq!(counts.into_inner().unwrap() % 2 == 1, sides[0] != sides[1], "{p:?} {q:?}");
    }
    for k in 0..400 {
        let middle = Vec3::from_array(random.point(b.lo.to_array(), b.hi.to_array()));
        let half = Vec3::from_array(random.point([0.01; 3], [1.0; 3])) * (b.hi - b.lo) * 0.5f64.powi(1 + k % 6);
        let around = Aabb::new(middle - half, middle + half);
        let class = query::classify_box(g, around);
        for _ in 0..if class == 0 { 0 } else { 60 } {
            let p = Vec3::from_array(random.point(around.lo.to_array(), around.hi.to_array()));
            assert_eq!(g.value(p) < 0.0, class < 0, "{around:?} is {class}");
        }
    }
}

fn all(n: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..n[2]).flat_map(move |k| (0..n[1]).flat_map(move |j| (0..n[0]).map(move |i| [i, j, k])))
}

/// Steps that are not all the same.
fn random_of(k: usize) -> f64 {
    libm::sin(12.9898 * k as f64)
}
