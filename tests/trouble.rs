// SPDX-License-Identifier: MIT OR Apache-2.0
//! The search against brute force, bit for bit, where f32 tells little: far from the origin, tiny and huge, needles, specks
//! and slivers beside large triangles, flat triangles, copies; from points on the surface to the end of the range of f64.

mod common;

use common::random::Random;
use common::{Soup, bodies, points};
use embound::geometry::{Accelerator, Geometry, SdfOptions, SignMethod};
use embound::math::Vec3;
use embound::parallel::Run;

fn geometry(body: &Soup, sign: SignMethod, accelerator: Accelerator) -> Option<Geometry> {
    let options = SdfOptions { sign, accelerator, ..SdfOptions::default() };
    Geometry::from_mesh(&body.mesh_kept(), &options, &Run::SERIAL).ok()
}

/// Triangles of sizes from 1 to 1e-13, every third one 1e-12 as wide.
fn specks_and_slivers() -> Soup {
    let mut random = Random(4);
    let mut soup = Soup { vertices: vec![], triangles: vec![] };
    for k in 0..600u32 {
        let middle = random.point([-1.0; 3], [1.0; 3]);
        let size = [1.0, 1e-3, 1e-8, 1e-13][k as usize % 4];
        let width = if k % 3 == 0 { 1e-12 } else { 1.0 };
        for _ in 0..3 {
            let d = random.point([-size; 3], [size; 3]);
            soup.vertices.push([middle[0] + d[0], middle[1] + d[1] * width, middle[2] + d[2] * width]);
        }
        soup.triangles.push([3 * k, 3 * k + 1, 3 * k + 2]);
    }
    soup
}

#[test]
fn trouble_changes_no_bit() {
    let ball = bodies::icosphere(3);
    let mixed =
        ball.and(&ball.scaled(1e-8).translated([2.0, 0.0, 0.0])).and(&ball.scaled(1e4).translated([2e4, 0.0, 0.0]));
    let all = [
        ball.translated([1e9, -2e9, 3e9]),
        ball.scaled(1e-3).translated([1e9, 0.0, 0.0]),
        ball.scaled(1e-60),
        ball.scaled(1e60),
        ball.map(|p| [p[0], p[1] * 1e-9, p[2] * 1e-6]),
        specks_and_slivers(),
        mixed,
        ball.duplicated().double_sided(),
        bodies::with_flat_triangles(&bodies::unit_cube()),
        bodies::with_flat_triangles(&ball).scaled(1.0 / 3.0).translated([0.1, 0.2, 0.3]),
        bodies::lattice_soup(600),
        bodies::lattice_soup(600).scaled(1.0 / 7.0).translated([0.1, 1e3, -0.3]),
        bodies::lattice_soup(600).map(|p| [p[0] * 0.6 - p[1] * 0.8, p[0] * 0.8 + p[1] * 0.6, p[2] / 3.0]),
    ];
    let mut random = Random(11);
    let mut asked = 0;
    for (k, body) in all.iter().enumerate() {
        for sign in [SignMethod::Auto, SignMethod::Ray, SignMethod::None] {
            let all = [Accelerator::Auto, Accelerator::Compact, Accelerator::None];
            let [Some(fast), Some(compact), Some(slow)] = all.map(|accelerator| geometry(body, sign, accelerator))
            else {
                continue;
            };
            let (lo, hi) = body.bounds();
            let size = (0..3).map(|k| hi[k] - lo[k]).fold(0.0, f64::max);
            let mut points = points::all_kinds(body, 300, &mut random);
            for reach in [1e-9, 1.0, 10.0, 1e3, 1e5, 1e8, 1e15, 1e100, 1e200] {
                points.extend((0..20).map(|_| {
                    let q = random.point([-reach * size; 3], [reach * size; 3]);
                    [0, 1, 2].map(|k| 0.5 * (lo[k] + hi[k]) + q[k])
                }));
            }
            // Where squares of f32 become infinite.
            points.extend((0..200).map(|k| {
                let q = random.point([-1.0; 3], [1.0; 3]);
                let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
                let scale = 2f64.powi((size.log2() + 2.0).floor() as i32) * f32::MAX.sqrt() as f64;
                q.map(|c| c / length * scale * [0.25, 0.5, 1.0, 2.0][k % 4] * (1.0 + 3e-7 * (random.unit() - 0.5)))
            }));
            points.extend([[1e300, 0.0, 0.0], [-1e300, 1e300, 1e-300], [0.0; 3], [f64::MAX, 0.0, 0.0]]);
            for p in points.into_iter().map(Vec3::from_array) {
                let b = slow.closest(p);
                for fast in [&fast, &compact] {
                    let a = fast.closest(p);
                    assert_eq!(a.value.to_bits(), b.value.to_bits(), "body {k} {sign:?} {p}: {} {}", a.value, b.value);
                    assert_eq!((a.primitive, a.feature), (b.primitive, b.feature), "body {k} {sign:?} {p}");
                    assert_eq!(fast.value(p).to_bits(), a.value.to_bits());
                }
                asked += 1;
            }
        }
    }
    assert!(asked > 20_000, "{asked}");
}
