// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sign of meshes that may be open, against the sum of all solid angles (van Oosterom & Strackee 1983); what each way of
//! finding it costs; and that boxes classified across holes hold what was said of them:
//!
//!     cargo bench --bench signs -- [--points N] mesh ...     (without a mesh: the costs, on a ball of 81,920 triangles)
//!
//! Every point and edge of a lattice is asked for alone and together. Fails where answers differ, where a sign differs from the winding number of the mesh where that is not within 1e-6 of 1/2, or a class lies.

#[path = "../tests/common/mod.rs"]
mod common;

use common::lattices::{around, compared};
use common::random::Random;
use common::winding::winding_number;
use common::{Soup, bodies, points};
use embound::geometry::{Geometry, SdfOptions, SignMethod};
use embound::io::{self, Format};
use embound::math::{Aabb, Vec3};
use embound::mesh::{Mesh, MeshOptions};
use embound::parallel::Run;
use embound::query::{self, Lattice};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|a| a != "--bench");
    let (mut count, mut files) = (5_000usize, Vec::new());
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--points" => count = arguments.next().and_then(|n| n.parse().ok()).expect("a number after --points"),
            _ => files.push(argument),
        }
    }
    if files.is_empty() {
        return costs();
    }
    println!("isa {}", embound::isa());
    let faults: usize = files.iter().map(|file| examine(file, count)).sum();
    println!("{} meshes, {faults} faults", files.len());
    std::process::exit(i32::from(faults > 0));
}

fn build(mesh: &Mesh, sign: SignMethod) -> embound::Result<Geometry> {
    Geometry::from_mesh(mesh, &SdfOptions { sign, axis: 2, ..SdfOptions::default() }, &Run::SERIAL)
}

/// The winding numbers of points, on two threads.
fn windings(soup: &Soup, points: &[[f64; 3]]) -> Vec<f64> {
    let (low, high) = points.split_at(points.len() / 2);
    let of = |points: &[[f64; 3]]| points.iter().map(|p| winding_number(soup, *p)).collect::<Vec<f64>>();
    std::thread::scope(|scope| {
        let other = scope.spawn(|| of(high));
        let mut all = of(low);
        all.extend(other.join().expect("a thread"));
        all
    })
}

fn examine(file: &str, count: usize) -> usize {
    let mesh = io::read(Path::new(file), Format::Detect, &MeshOptions::default()).expect("a readable mesh");
    println!("{file}: {} triangles, {} boundary edges", mesh.triangle_count(), mesh.surface().boundary_edges);
    match build(&mesh, SignMethod::Auto) {
        Ok(g) => println!("  AUTO takes {:?}", g.properties().sign_method),
        Err(error) => println!("  AUTO: {}", error.message()),
    }
    let vertices = mesh.vertices().iter().map(|v| v.to_array()).collect();
    let soup = Soup { vertices, triangles: mesh.triangles().iter().map(|t| t.vertices).collect() };
    let mut random = Random(5);
    let asked =
        [points::uniform(&soup, 1.1, count, &mut random), points::near(&soup, 0.02, count, &mut random)].concat();
    let (lo, hi) = soup.bounds();
    let size = (Vec3::from(hi) - Vec3::from(lo)).length();
    let windings = windings(&soup, &asked);
    let is_inside_box = |p: &[f64; 3]| (0..3).all(|k| lo[k] <= p[k] && p[k] <= hi[k]);
    let between = windings.iter().filter(|w| (0.25..=0.75).contains(*w)).count();
    println!(
        "  {} points, {:.2}% with a winding number in [0.25, 0.75]",
        asked.len(),
        100.0 * between as f64 / asked.len() as f64
    );
    let mut faults = 0;
    for sign in [SignMethod::Winding, SignMethod::Ray] {
        let begin = Instant::now();
        let g = build(&mesh, sign).expect("a geometry");
        let built = begin.elapsed();
        let (mut clear, mut all) = (0, 0);
        for (p, winding) in asked.iter().zip(&windings) {
            let value = g.value(Vec3::from(*p));
            let differs = (value < 0.0) != (*winding >= 0.5) && value.abs() > 1e-11 * size && is_inside_box(p);
            clear += usize::from(differs && !(0.25..=0.75).contains(winding));
            all += usize::from(differs && (winding - 0.5).abs() > 1e-6);
        }
        let lies = classes(&g, &soup, &mut random);
        let met = compared(&g, &around(&soup, [26, 25, 24], 1.1));
        println!(
            "  {sign:?}: built in {built:.1?}, {clear} signs differ outside [0.25, 0.75], {all} in all; {lies} boxes lie; values, fills and crossings of 15,600 points agree ({met} edges cross)"
        );
        faults += lies + if sign == SignMethod::Winding { all } else { 0 };
    }
    faults
}

/// Random boxes, of which one point or more is on another side than was said.
fn classes(g: &Geometry, soup: &Soup, random: &mut Random) -> usize {
    let (lo, hi) = soup.bounds();
    let size = (Vec3::from(hi) - Vec3::from(lo)).length();
    let mut lies = 0;
    for k in 0..4000 {
        let half = random.point([0.0; 3], [size * 0.5f64.powi(1 + k % 10); 3]);
        let center = random.point(lo, hi);
        let b = Aabb::new(Vec3::from(center) - Vec3::from(half), Vec3::from(center) + Vec3::from(half));
        let class = query::classify_box(g, b);
        if class != 0 {
            let other = |_: usize| {
                let value = g.value(random.point(b.lo.to_array(), b.hi.to_array()).into());
                if class < 0 { value >= 0.0 } else { value <= 0.0 }
            };
            lies += usize::from((0..100).any(other));
        }
    }
    lies
}

/// Nanoseconds: the least of five.
fn cost(count: usize, mut work: impl FnMut()) -> f64 {
    let once = |work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1e9 / count as f64
    };
    (0..5).map(|_| once(&mut work)).fold(f64::INFINITY, f64::min)
}

fn costs() {
    let ball =
        bodies::icosphere(6).map(|p| p.map(|c| c * (1.0 + 0.1 * libm::sin(9.0 * p[0]) * libm::cos(7.0 * p[1] + p[2]))));
    // Five holes of some ten triangles, all on one side, and as many all around.
    let hole = |soup: &Soup, at: [[f64; 3]; 5]| {
        let near = |t: usize| {
            let c = soup.corners(t)[0];
            at.iter().any(|q| (0..3).map(|k| (c[k] / length(c) - q[k] / length(*q)).powi(2)).sum::<f64>() < 9e-4)
        };
        soup.without(near)
    };
    let base =
        hole(&ball, [[0.0, 0.0, -1.0], [0.2, 0.0, -1.0], [-0.2, 0.1, -1.0], [0.0, 0.3, -1.0], [0.1, -0.3, -1.0]]);
    let around = hole(&ball, [[1.0, 0.0, 0.1], [-1.0, 0.3, 0.0], [0.0, 1.0, 0.2], [0.1, -1.0, 0.0], [0.0, 0.2, 1.0]]);
    let mut random = Random(3);
    let uniform = points::uniform(&ball, 1.5, 100_000, &mut random);
    let near = points::near(&ball, 0.01, 100_000, &mut random);
    println!(
        "{} triangles, isa {}, one thread; ns a point: uniform, near the surface, sign of 128^3",
        ball.triangles.len(),
        embound::isa()
    );
    let axis: Vec<f64> = (0..128).map(|k| -1.3 + 2.6 * f64::from(k) / 127.0).collect();
    for (name, soup, sign) in [
        ("closed, PSEUDONORMAL", &ball, SignMethod::Pseudonormal),
        ("closed, WINDING", &ball, SignMethod::Winding),
        ("closed, RAY", &ball, SignMethod::Ray),
        ("closed, NONE", &ball, SignMethod::None),
        ("holes at the base, AUTO", &base, SignMethod::Auto),
        ("holes at the base, RAY", &base, SignMethod::Ray),
        ("holes all around, AUTO", &around, SignMethod::Auto),
        ("holes all around, RAY", &around, SignMethod::Ray),
    ] {
        let mesh = soup.mesh();
        let g = build(&mesh, sign).expect("a geometry");
        let single = [&uniform, &near]
            .map(|points| cost(points.len(), || points.iter().for_each(|p| _ = black_box(g.value(Vec3::from(*p))))));
        let lattice = Lattice::new(&axis, &axis, &axis).expect("a lattice");
        let fill = cost(axis.len().pow(3), || {
            query::fill_signs(&g, &lattice, &Run::SERIAL, &|_, signs| _ = black_box(signs[0])).expect("signs");
        });
        println!(
            "{name:26} {:?}, {} boundary edges: {:.0} {:.0} {fill:.1}",
            g.properties().sign_method,
            mesh.surface().boundary_edges,
            single[0],
            single[1]
        );
    }
}

fn length(p: [f64; 3]) -> f64 {
    p.iter().map(|c| c * c).sum::<f64>().sqrt()
}
