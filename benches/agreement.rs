// SPDX-License-Identifier: MIT OR Apache-2.0
//! The hierarchy against brute force, bit for bit, and the sign against a dense solid-angle winding
//! number, on meshes given on the command line:
//!
//!     cargo bench --bench agreement -- [--points N] [--signs N] mesh.stl ...
//!
//! Fails where a bit or a sign differs. Times are of this run; both searches use all processors.

#[path = "../tests/common/mod.rs"]
mod common;

use common::random::Random;
use common::winding::winding_number;
use common::{Soup, points};
use embound::geometry::{Accelerator, Closest, Geometry, SdfOptions};
use embound::io::{self, Format};
use embound::math::Vec3;
use embound::mesh::{Mesh, MeshOptions};
use embound::parallel::{Pool, Run};
use embound::query::{self, Strided};
use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|a| a != "--bench");
    let (mut count, mut signs, mut files) = (100_000usize, 20_000usize, Vec::new());
    while let Some(argument) = arguments.next() {
        let mut number = || arguments.next().and_then(|n| n.parse().ok()).expect("a number after the option");
        match argument.as_str() {
            "--points" => count = number(),
            "--signs" => signs = number(),
            _ => files.push(argument),
        }
    }
    if files.is_empty() {
        println!("usage: cargo bench --bench agreement -- [--points N] [--signs N] mesh.stl ...");
        return;
    }
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = Pool::new(threads, || ()).expect("threads");
    println!("isa {}, {threads} threads", embound::isa());
    let faults: usize = files.iter().map(|file| examine(file, count, signs, &pool)).sum();
    println!("{} meshes, {faults} disagreements", files.len());
    std::process::exit(i32::from(faults > 0));
}

fn examine(file: &str, count: usize, signs: usize, pool: &Pool) -> usize {
    let run = Run { pool: Some(pool), progress: None };
    let begin = Instant::now();
    let mesh = io::read(Path::new(file), Format::Detect, &MeshOptions::default()).expect("a readable mesh");
    let read = begin.elapsed();
    let begin = Instant::now();
    let build = |accelerator| {
        let options = SdfOptions { accelerator, ..SdfOptions::default() };
        Geometry::from_mesh(&mesh, &options, &run).expect("a closed mesh")
    };
    let fast = build(Accelerator::Auto);
    let built = begin.elapsed();
    let slow = build(Accelerator::None);
    let properties = fast.properties();
    println!(
        "{file}: {} triangles, read {read:.1?}, build {built:.1?}, sign {:?}, {} bytes a triangle",
        mesh.triangle_count(),
        properties.sign_method,
        properties.bytes / properties.primitives
    );
    let soup = standing(&mesh);
    let mut random = Random(1);
    let asked = points::all_kinds(&soup, count.div_ceil(4), &mut random);
    let (a, fast_time) = closest(&fast, &asked, &run);
    let (b, slow_time) = closest(&slow, &asked, &run);
    let differing = a.iter().zip(&b).filter(|(a, b)| !same(a, b)).count();
    println!(
        "  brute force: {} points, {differing} differ in value, point, primitive or feature; {fast_time:.2?} against {slow_time:.2?}",
        asked.len()
    );
    let (compared, near_half, wrong) = compare_signs(&soup, &fast, &asked, signs, &run);
    println!(
        "  winding number: {compared} signs compared, {near_half} with a number that is not 0 or 1, {wrong} wrong"
    );
    differing + wrong
}

/// The surface as it stands.
fn standing(mesh: &Mesh) -> Soup {
    Soup {
        vertices: mesh.vertices().iter().map(|v| v.to_array()).collect(),
        triangles: mesh.triangles().iter().map(|t| t.vertices).collect(),
    }
}

fn same(a: &Closest, b: &Closest) -> bool {
    let bits = |v: Vec3| v.to_array().map(f64::to_bits);
    a.value.to_bits() == b.value.to_bits()
        && bits(a.point) == bits(b.point)
        && (a.primitive, a.feature) == (b.primitive, b.feature)
}

fn closest(g: &Geometry, asked: &[[f64; 3]], run: &Run) -> (Vec<Closest>, std::time::Duration) {
    let flat = asked.concat();
    let source = Strided::new(asked.len(), [&flat[..], &flat[1..], &flat[2..]], 3).expect("points");
    let out = Mutex::new(vec![None; asked.len()]);
    let begin = Instant::now();
    query::closest(g, &source, f64::INFINITY, run, &|first, found| {
        let mut out = out.lock().expect("no panic");
        out[first..first + found.len()].iter_mut().zip(found).for_each(|(o, c)| *o = Some(*c));
    })
    .expect("answers");
    let elapsed = begin.elapsed();
    (out.into_inner().expect("no panic").into_iter().map(|c| c.expect("every point answered")).collect(), elapsed)
}

/// Signs at `signs` of the points: compared where the winding number is 0 or 1 and rounding is far.
fn compare_signs(soup: &Soup, g: &Geometry, asked: &[[f64; 3]], signs: usize, run: &Run) -> (usize, usize, usize) {
    let (lo, hi) = soup.bounds();
    let size = (0..3).map(|d| (hi[d] - lo[d]).max(lo[d].abs()).max(hi[d].abs())).fold(0.0, f64::max);
    let step = asked.len().div_ceil(signs.max(1)).max(1);
    let chosen: Vec<[f64; 3]> = asked.iter().copied().step_by(step).collect();
    let tally = Mutex::new((0, 0, 0));
    run.for_each_chunk(chosen.len().div_ceil(64), &|k| {
        for p in &chosen[k * 64..chosen.len().min((k + 1) * 64)] {
            let value = g.value(Vec3::from_array(*p));
            if value.abs() <= 1e-12 * size {
                continue;
            }
            let winding = winding_number(soup, *p);
            let clear = (winding - winding.round()).abs() < 1e-3 && (0.0..=1.0).contains(&winding.round());
            let mut tally = tally.lock().expect("no panic");
            if !clear {
                tally.1 += 1;
                continue;
            }
            tally.0 += 1;
            if (value < 0.0) != (winding > 0.5) {
                tally.2 += 1;
                if tally.2 <= 5 {
                    println!("  wrong sign: value {value:e}, winding number {winding} at {p:?}");
                }
            }
        }
        Ok(())
    })
    .expect("signs");
    tally.into_inner().expect("no panic")
}
