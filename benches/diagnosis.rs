// SPDX-License-Identifier: MIT OR Apache-2.0
//! Diagnosis of a mesh: the seconds of each stage, the text, and the distance built from the same mesh, whose
//! check that it does not pass through itself shares the search.
//!
//!     cargo bench --bench diagnosis -- [million | fan | leaves | copies | pieces | loop | mesh file] ...
//!
//! `fine=FILE` cuts each triangle of a file in four until there are half a million.
//! `million` is a torus of a million triangles; the others are 100,000 faces round one vertex, 100,000 at one
//! edge, 100,000 copies of one face, 100,000 components, and one boundary loop of a million edges.

use embound::geometry::{Geometry, SdfOptions};
use embound::io::{self, Format};
use embound::mesh::{DiagnosisOptions, Mesh, MeshOptions};
use embound::parallel::{Pool, Run};
use embound::query;
use std::path::Path;
use std::time::Instant;

#[path = "../tests/common/mod.rs"]
mod common;
use common::random::Random;
use common::{Soup, bodies};

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = if wanted.is_empty() { vec!["million".to_owned()] } else { wanted };
    let pool = Pool::new(2, || ()).expect("threads");
    for name in &wanted {
        let start = Instant::now();
        let mesh = generated(name).map_or_else(|| read(name), |soup| soup.mesh());
        println!("{name}: {} triangles", mesh.triangle_count());
        println!("{:8.3} s  generated or read, and welded", start.elapsed().as_secs_f64());
        examine(&mesh, &pool);
    }
}

fn read(path: &str) -> Mesh {
    io::read(Path::new(path), Format::Detect, &MeshOptions::default()).expect("a readable mesh")
}

fn examine(mesh: &Mesh, pool: &Pool) {
    let topology = DiagnosisOptions { intersection_limit: 0, ..DiagnosisOptions::default() };
    let all = DiagnosisOptions::default();
    let pooled = Run { pool: Some(pool), progress: None };
    let time = |options: &DiagnosisOptions, run: &Run| {
        let start = Instant::now();
        let found = query::diagnose(mesh, options, run).expect("a diagnosis");
        (start.elapsed().as_secs_f64(), found)
    };
    println!("{:8.3} s  diagnosed without intersections", time(&topology, &Run::SERIAL).0);
    let (alone, found) = time(&all, &Run::SERIAL);
    println!("{alone:8.3} s  diagnosed with intersections, one thread");
    let (both, again) = time(&all, &pooled);
    println!("{both:8.3} s  diagnosed with intersections, two threads");
    assert_eq!(found, again, "the diagnosis depends on the threads");
    for (run, threads) in [(Run::SERIAL, "one thread"), (pooled, "two threads")] {
        let start = Instant::now();
        match Geometry::from_mesh(mesh, &SdfOptions::default(), &run) {
            Ok(g) => {
                let sign = g.properties().sign_method;
                println!("{:8.3} s  distance built, {threads}, sign {sign:?}", start.elapsed().as_secs_f64());
            }
            Err(why) => println!("          no distance: {why}"),
        }
    }
    print!("{}", found.text());
}

fn generated(name: &str) -> Option<Soup> {
    Some(match name {
        "million" => bodies::torus(1.0, 0.3, 1000, 500),
        "fan" => fan(100_000),
        "coin" => coin(10_000),
        "coins" => coin(100_000),
        "leaves" => bodies::book(100_000),
        "copies" => Soup { triangles: vec![bodies::tetrahedron().triangles; 25_000].concat(), ..bodies::tetrahedron() },
        "pieces" => pieces(50),
        "loop" => strip(500_000),
        _ => fine(name.strip_prefix("fine=")?),
    })
}

/// The surface of a file in small triangles.
fn fine(path: &str) -> Soup {
    let mesh = read(path);
    let mut soup = Soup {
        vertices: mesh.vertices().iter().map(|p| p.to_array()).collect(),
        triangles: mesh.triangles().iter().map(|t| t.vertices).collect(),
    };
    while soup.triangles.len() < 500_000 {
        soup = bodies::quartered(&soup);
    }
    soup
}

/// A disc of narrow triangles with a ragged rim, tilted, and one triangle through it.
fn fan(count: usize) -> Soup {
    let mut random = Random(5);
    let mut out = Soup { vertices: vec![[0.0; 3]], triangles: Vec::new() };
    for k in 0..count {
        let a = std::f64::consts::TAU * k as f64 / count as f64;
        let r = random.range(0.2, 1.0);
        let (x, y) = (r * libm::cos(a), r * libm::sin(a));
        out.vertices.push([x, 0.6 * y, 0.8 * y + 0.2 * x]);
        out.triangles.push([0, k as u32 + 1, ((k + 1) % count) as u32 + 1]);
    }
    let n = out.vertices.len() as u32;
    out.vertices.extend([[0.05, 0.0, -0.5], [0.05, 0.001, 0.5], [0.06, 0.0, 0.5]]);
    out.triangles.push([n, n + 1, n + 2]);
    out
}

/// A thin tilted cylinder, whose caps are fans close to each other.
fn coin(sides: usize) -> Soup {
    let mut out = Soup { vertices: vec![[0.0, 0.0, 0.0], [0.0, 0.0, 0.01]], triangles: Vec::new() };
    for k in 0..sides {
        let a = std::f64::consts::TAU * k as f64 / sides as f64;
        let (x, y) = (libm::cos(a), libm::sin(a));
        out.vertices.extend([[x, y, 0.0], [x, y, 0.01]]);
        let (low, next) = (2 + 2 * k as u32, 2 + 2 * ((k + 1) % sides) as u32);
        out.triangles.extend([[0, next, low], [1, low + 1, next + 1], [low, next, next + 1], [low, next + 1, low + 1]]);
    }
    let turned = |x: f64, y: f64| [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y];
    out.map(|[x, y, z]| {
        let [x, z] = turned(x, z);
        let [y, z] = turned(y, z);
        [x, y, z]
    })
}

/// Tetrahedra apart from each other, `n` by `n` by 40.
fn pieces(n: usize) -> Soup {
    let one = bodies::tetrahedron();
    let mut out = Soup::default();
    for (k, j, i) in (0..40).flat_map(|k| (0..n).flat_map(move |j| (0..n).map(move |i| (k, j, i)))) {
        let base = out.vertices.len() as u32;
        out.vertices
            .extend(one.vertices.iter().map(|p| [p[0] + 2.0 * i as f64, p[1] + 2.0 * j as f64, p[2] + 2.0 * k as f64]));
        out.triangles.extend(one.triangles.iter().map(|t| t.map(|v| v + base)));
    }
    out
}

/// A long flat strip.
fn strip(length: usize) -> Soup {
    let vertices = (0..=length).flat_map(|k| [[k as f64, 0.0, 0.0], [k as f64, 1.0, 0.0]]).collect();
    let quads = (0..length as u32).map(|k| 2 * k);
    let triangles = quads.flat_map(|a| [[a, a + 2, a + 3], [a, a + 3, a + 1]]).collect();
    Soup { vertices, triangles }
}
