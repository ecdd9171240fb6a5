// SPDX-License-Identifier: MIT OR Apache-2.0
//! From triangles to a geometry: nanoseconds a triangle of each step, the least of some tries.
//!
//!     cargo bench --bench build -- [once] [threads] [file ...]      (1; icospheres of 20,480, 81,920 and 1,310,720 triangles)
//!
//! `stl` reads a binary STL from memory, `mesh` welds arrays, `NONE` is the hierarchy and what stands in its leaves,
//! `RAY` the same with a sign by crossings, `AUTO` with pseudonormals and the check that lets them decide; `refit` takes
//! other vertices. With `once` each step runs once, for a profiler.

use embound::geometry::{Geometry, RefitCheck, SdfOptions, SignMethod};
use embound::io::{self, Format};
use embound::mesh::{Mesh, MeshOptions};
use embound::parallel::{Pool, Run};
use embound::query::{self, Strided};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

#[path = "../tests/common/mod.rs"]
mod common;
use common::{Soup, bodies, random::Random, stl_bytes};

/// Seconds: the least of some tries.
fn least<R>(tries: usize, mut work: impl FnMut() -> R) -> f64 {
    let mut once = || {
        let start = Instant::now();
        black_box(work());
        start.elapsed().as_secs_f64()
    };
    (0..tries).map(|_| once()).fold(f64::INFINITY, f64::min)
}

fn measure(name: &str, mesh: &Mesh, run: &Run, once: bool) {
    let count = mesh.triangle_count();
    let tries = if once { 1 } else { (3_000_000 / count).clamp(3, 15) };
    let vertices = mesh.vertices().iter().map(|p| p.to_array()).collect();
    let soup = Soup { vertices, triangles: mesh.triangles().iter().map(|t| t.vertices).collect() };
    let (stl, xyz, indices) = (stl_bytes::binary(&soup), soup.xyz(), soup.indices());
    let options = MeshOptions::default();
    let build = |sign: SignMethod| {
        let options = SdfOptions { sign, ..SdfOptions::default() };
        Geometry::from_mesh(mesh, &options, run)
    };
    let mut line = format!("{name}, {count} triangles, ns each:");
    let mut tell = |what: &str, seconds: f64| line += &format!(" {what} {:.0}", seconds * 1e9 / count as f64);
    tell("stl", least(tries, || io::read_memory(&stl, Format::Detect, &options)));
    tell("mesh", least(tries, || Mesh::from_triangles(&xyz, &indices, None, &options)));
    tell("NONE", least(tries, || build(SignMethod::None)));
    tell("RAY", least(tries, || build(SignMethod::Ray)));
    tell("AUTO", least(tries, || build(SignMethod::Auto)));
    let moved: Vec<f64> = soup.vertices.iter().flat_map(|p| p.map(|c| 1.01 * c)).collect();
    if let Ok(g) = build(SignMethod::Auto) {
        let step = |check| g.refit(&moved, check, run);
        tell("refit checked", least(tries, || step(RefitCheck::Check)));
        tell("trusted", least(tries, || step(RefitCheck::Trust)));
    }
    let g = build(SignMethod::None).expect("any mesh");
    let (lo, hi) = (mesh.bounds().lo.to_array(), mesh.bounds().hi.to_array());
    let mut random = Random(1);
    let points: Vec<f64> = (0..100_000).flat_map(|_| random.point(lo, hi)).collect();
    let source = Strided::new(100_000, [&points, &points[1..], &points[2..]], 3).expect("points");
    let time = least(tries.min(5), || query::values(&g, &source, &Run::SERIAL, &|_, v| _ = black_box(v[0])));
    println!("{line}; a value at random {:.0} ns; {} bytes each", time * 1e4, g.properties().bytes / count as u64);
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let threads = arguments.iter().find_map(|a| a.parse().ok()).unwrap_or(1);
    let pool = Pool::new(threads, || {}).expect("a pool");
    let run = Run { pool: Some(&pool), progress: None };
    let once = arguments.iter().any(|a| a == "once");
    let is_file = |a: &&String| *a != "once" && a.parse::<usize>().is_err();
    let files: Vec<&String> = arguments.iter().filter(is_file).collect();
    for file in &files {
        measure(file, &io::read(Path::new(file), Format::Detect, &MeshOptions::default()).expect(file), &run, once);
    }
    if files.is_empty() {
        [5, 6, 8].into_iter().for_each(|level| measure("icosphere", &bodies::icosphere(level).mesh(), &run, once));
    }
}
