// SPDX-License-Identifier: MIT OR Apache-2.0
//! `cargo bench --bench tree`: composites of many parts against the plain minimum over all of them in the
//! same run, bits compared: 64,000 balls of radius 0.02, a million unit balls, 10,000 placed parts made anew,
//! a mesh with a thousand drilled holes, a mesh placed 528 times; fills of lattices of trees, exact and of narrow bands.
//!
//!     cargo bench --bench tree -- [small] [large] [moving] [fills] [mesh.stl ...]

use embound::geometry::{Blend, Geometry, SdfOptions};
use embound::io::{self, Format};
use embound::math::Vec3;
use embound::mesh::{Mesh, MeshOptions};
use embound::parallel::Run;
use embound::query::{self, FillMode, Lattice, Strided};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

#[path = "../tests/common/mod.rs"]
mod common;
use common::bodies;
use common::random::Random;

fn seconds<R>(work: impl FnOnce() -> R) -> (f64, R) {
    let start = Instant::now();
    let result = work();
    (start.elapsed().as_secs_f64(), result)
}

/// The median of five.
fn median(mut work: impl FnMut() -> f64) -> f64 {
    let mut all: Vec<f64> = (0..5).map(|_| work()).collect();
    all.sort_by(f64::total_cmp);
    all[2]
}

struct Ball {
    center: Vec3,
    radius: f64,
}

/// The loop a user would write.
fn plain(balls: &[Ball], p: Vec3) -> f64 {
    balls.iter().fold(f64::INFINITY, |least, ball| {
        let d = p - ball.center;
        let value = (d.x * d.x + d.y * d.y + d.z * d.z).sqrt() - ball.radius;
        if value < least { value } else { least }
    })
}

fn points(count: usize, lo: f64, hi: f64, seed: u64) -> Vec<Vec3> {
    let mut random = Random(seed);
    (0..count).map(|_| Vec3::from_array(random.point([lo; 3], [hi; 3]))).collect()
}

fn values(g: &Geometry, p: &[Vec3]) -> (f64, Vec<f64>) {
    let flat: Vec<f64> = p.iter().flat_map(|p| p.to_array()).collect();
    let source = Strided::new(p.len(), [&flat, &flat[1..], &flat[2..]], 3).unwrap();
    let out = std::sync::Mutex::new(vec![0.0; p.len()]);
    let time = median(|| {
        seconds(|| {
            query::values(g, &source, &Run::SERIAL, &|start, v| {
                out.lock().unwrap()[start..start + v.len()].copy_from_slice(v)
            })
            .unwrap()
        })
        .0
    });
    (time, out.into_inner().unwrap())
}

fn axis(n: usize, lo: f64, hi: f64) -> Vec<f64> {
    (0..n).map(|k| lo + (hi - lo) * k as f64 / (n - 1) as f64).collect()
}

fn fill(g: &Geometry, axes: [&[f64]; 3]) -> f64 {
    let lattice = Lattice::new(axes[0], axes[1], axes[2]).unwrap();
    let sum = std::sync::Mutex::new(0.0);
    let time = seconds(|| {
        query::fill(g, &lattice, FillMode::Exact, &Run::SERIAL, &|_, v| *sum.lock().unwrap() += v[0]).unwrap()
    })
    .0;
    black_box(sum.into_inner().unwrap());
    time
}

fn balls(name: &str, side: i32, spacing: f64, radius: f64) {
    let place = |i: i32| (f64::from(i) - 0.5 * f64::from(side - 1)) * spacing;
    let mut all = Vec::new();
    for k in 0..side {
        for j in 0..side {
            all.extend((0..side).map(|i| Ball { center: Vec3::new(place(i), place(j), place(k)), radius }));
        }
    }
    let (make, parts) =
        seconds(|| all.iter().map(|b| Geometry::sphere(b.center.to_array(), b.radius).unwrap()).collect::<Vec<_>>());
    let (build, g) = seconds(|| Geometry::union(&parts).unwrap());
    println!(
        "{name}: {} balls made in {make:.3} s, union built in {build:.3} s, kind {:?}, {} bytes a ball",
        all.len(),
        g.kind(),
        g.properties().bytes / all.len() as u64
    );
    let reach = 0.6 * spacing * f64::from(side);
    let random = points(200_000, -reach, reach, 1);
    let (time, found) = values(&g, &random);
    let few = &random[..200.min(20_000_000 / all.len() * 10)];
    let (slow, expected) = seconds(|| few.iter().map(|p| plain(&all, *p)).collect::<Vec<_>>());
    assert!(expected.iter().zip(&found).all(|(a, b)| a.to_bits() == b.to_bits()), "bits differ");
    let (fast, slow) = (time / random.len() as f64, slow / few.len() as f64);
    println!(
        "  random query {:.3} us, plain loop {:.1} us: {:.0} times, equal bits at {} points",
        fast * 1e6,
        slow * 1e6,
        slow / fast,
        few.len()
    );
    let cold: Vec<f64> = points(31, -reach, reach, 7)
        .iter()
        .map(|p| {
            let wipe: Vec<u8> = vec![1; 256 << 20];
            black_box(&wipe);
            seconds(|| black_box(g.value(*p))).0
        })
        .collect();
    let mut cold = cold;
    cold.sort_by(f64::total_cmp);
    println!("  single cold query {:.2} us (median of 31 after the cache was swept)", cold[15] * 1e6);
    let a = axis(128, -reach, reach);
    let time = fill(&g, [&a, &a, &a]);
    println!("  fill 128^3 {:.3} s, {:.3} us a node", time, time / 128f64.powi(3) * 1e6);
}

fn moving() {
    let mut random = Random(3);
    let sphere = Geometry::sphere([0.0; 3], 0.01).unwrap();
    let body = sphere.difference(&Geometry::cuboid([0.0, 0.0, 0.0], [1.0, 1.0, 1.0]).unwrap()).unwrap();
    let bricks = Geometry::cuboid([-0.006, -0.004, -0.01], [0.006, 0.004, 0.01]).unwrap();
    for (name, body) in [("dented balls", &body), ("bricks", &bricks)] {
        let shifts: Vec<[f64; 3]> = (0..10_000).map(|_| random.point([-1.0; 3], [1.0; 3])).collect();
        let turns: Vec<f64> = (0..10_000).map(|_| random.range(0.0, 6.0)).collect();
        let time = median(|| {
            seconds(|| {
                let parts: Vec<Geometry> = shifts
                    .iter()
                    .zip(&turns)
                    .map(|(s, t)| {
                        let (sin, cos) = t.sin_cos();
                        body.place([cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0], *s).unwrap()
                    })
                    .collect();
                black_box(Geometry::union(&parts).unwrap());
            })
            .0
        });
        println!("10,000 {name} placed and united: {:.2} ms", time * 1e3);
    }
}

fn mesh_scenes(path: &str) {
    let mesh: Mesh = io::read(Path::new(path), Format::Detect, &MeshOptions::default()).unwrap();
    let part = Geometry::from_mesh(&mesh, &SdfOptions::default(), &Run::SERIAL).unwrap();
    let b = part.bounds();
    let size = b.hi - b.lo;
    let mut random = Random(5);
    let drills: Vec<Geometry> = (0..1000)
        .map(|_| {
            let at = b.lo + Vec3::from_array(random.point([0.0; 3], [1.0; 3])) * size;
            let along = Vec3::from_array(random.point([-1.0; 3], [1.0; 3])) * 0.05 * b.diagonal();
            Geometry::cylinder((at - along).to_array(), (at + along).to_array(), 0.004 * b.diagonal()).unwrap()
        })
        .collect();
    let (build, drilled) = seconds(|| part.difference_of_many(&drills).unwrap());
    let axes: Vec<Vec<f64>> = (0..3).map(|k| axis(128, b.lo[k] - 0.1 * size[k], b.hi[k] + 0.1 * size[k])).collect();
    let axes = [&axes[0][..], &axes[1][..], &axes[2][..]];
    let (alone, with) = (fill(&part, axes), fill(&drilled, axes));
    println!(
        "{path} less 1,000 cylinders (built in {:.1} ms): fill 128^3 {with:.2} s, the mesh alone {alone:.2} s: {:.2} times",
        build * 1e3,
        with / alone
    );
    let copies: Vec<Geometry> = (0..528)
        .map(|k| {
            part.rotate([1.0, 2.0, 3.0], f64::from(k) * 7.0, [0.0; 3])
                .unwrap()
                .translate([f64::from(k % 8), f64::from(k / 8 % 8), f64::from(k / 64)])
                .unwrap()
        })
        .collect();
    let all = Geometry::union(&copies).unwrap();
    println!(
        "528 copies: {} bytes, the mesh alone {}: {} a placement",
        all.properties().bytes,
        part.properties().bytes,
        (all.properties().bytes - part.properties().bytes) / 528
    );
}

/// A plate with a boss, holes and a fillet: ten leaves.
fn bracket() -> Geometry {
    let plate = Geometry::cuboid([-1.0, -0.6, -0.1], [1.0, 0.6, 0.1]).unwrap();
    let boss = Geometry::cylinder([0.0, 0.0, 0.0], [0.0, 0.0, 0.6], 0.35).unwrap();
    let rib = Geometry::rounded_box([0.5, 0.0, 0.2], [0.3, 0.05, 0.2], 0.02, None).unwrap();
    let body = Geometry::smooth_union(&[plate, boss, rib], &Blend::Smooth(0.05)).unwrap();
    let holes = [[-0.8, -0.4], [-0.8, 0.4], [0.8, -0.4], [0.8, 0.4], [0.0, 0.0]];
    let mut cut: Vec<Geometry> =
        holes.iter().map(|[x, y]| Geometry::infinite_cylinder([*x, *y, 0.0], [0.0, 0.0, 1.0], 0.08).unwrap()).collect();
    cut.push(Geometry::torus([0.0, 0.0, 0.4], [0.0, 0.0, 1.0], 0.35, 0.05).unwrap());
    cut.push(Geometry::sphere([-0.5, 0.0, 0.15], 0.15).unwrap());
    body.difference_of_many(&cut).unwrap().rotate([1.0, 2.0, 3.0], 20.0, [0.0; 3]).unwrap()
}

/// Nanoseconds that this thread had a processor; of the clock where the system does not say.
fn spent(start: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|n| n.parse().ok()).unwrap_or(start.elapsed().as_nanos() as f64)
}

/// Lattices of 64 points a side: exact, and in a band of three steps.
fn fills() {
    let mut random = Random(11);
    let mut balls = |count: usize, least: f64, most: f64| -> Vec<Geometry> {
        (0..count)
            .map(|_| Geometry::sphere(random.point([-1.0; 3], [1.0; 3]), random.range(least, most)).unwrap())
            .collect()
    };
    let mesh = |soup: common::Soup| Geometry::from_mesh(&soup.mesh(), &SdfOptions::default(), &Run::SERIAL).unwrap();
    let (ring, ball) = (mesh(bodies::torus(0.7, 0.3, 160, 64)), mesh(bodies::icosphere(5)));
    let less = |mesh: &Geometry, balls: &[Geometry]| mesh.difference_of_many(balls).unwrap();
    let scenes = [
        ("ten leaves", bracket()),
        ("1,000 balls", Geometry::union(&balls(1000, 0.02, 0.1)).unwrap()),
        ("64,000 balls", Geometry::union(&balls(64_000, 0.01, 0.02)).unwrap()),
        ("a torus of 20,480 triangles less 1,000 balls", less(&ring, &balls(1000, 0.02, 0.1))),
        ("a ball of 20,480 triangles less 1,000 balls", less(&ball, &balls(1000, 0.02, 0.1))),
        ("200 balls, smooth", Geometry::smooth_union(&balls(200, 0.05, 0.2), &Blend::Smooth(0.05)).unwrap()),
    ];
    let axis = axis(64, -1.2, 1.2);
    let lattice = Lattice::new(&axis, &axis, &axis).unwrap();
    let count = 64usize.pow(3);
    let points: Vec<f64> = (0..count).flat_map(|k| [axis[k % 64], axis[k / 64 % 64], axis[k / 4096]]).collect();
    let start = Instant::now();
    for (name, g) in &scenes {
        let band = 3.0 * (axis[1] - axis[0]);
        let mut best = [f64::INFINITY; 3];
        let mut answers = [(); 3].map(|_| vec![0.0; count]);
        // Turn by turn: what else the machine does falls on all.
        for _ in 0..5 {
            for (kind, (best, answers)) in best.iter_mut().zip(&mut answers).enumerate() {
                let out = std::sync::Mutex::new(answers);
                let from = spent(start);
                let write = |at: usize, v: &[f64]| out.lock().unwrap()[at..at + v.len()].copy_from_slice(v);
                match kind {
                    0 => (0..64 * 64).try_for_each(|row| {
                        let at = 64 * row;
                        let row = &points[3 * at..3 * (at + 64)];
                        let source = Strided::new(64, [row, &row[1..], &row[2..]], 3)?;
                        query::values(g, &source, &Run::SERIAL, &|start, v| write(at + start, v))
                    }),
                    _ => {
                        let mode = if kind == 1 { FillMode::Exact } else { FillMode::Band(band) };
                        let place = |[i, j, k]: [usize; 3], v: &[f64]| write(i + 64 * (j + 64 * k), v);
                        query::fill(g, &lattice, mode, &Run::SERIAL, &place)
                    }
                }
                .unwrap();
                *best = best.min(spent(start) - from);
            }
        }
        let [single, exact, banded] = answers;
        assert!(exact.iter().zip(&single).all(|(a, b)| a.to_bits() == b.to_bits()), "bits differ");
        let wanted = single.iter().map(|v| if v.abs() < band { *v } else { band.copysign(*v) });
        assert!(banded.iter().zip(wanted).all(|(a, b)| a.to_bits() == b.to_bits()), "bits differ");
        let [points, exact, banded] = best.map(|time| time / count as f64);
        println!("{name}, 64^3, ns a node: row by row {points:.1}, exact {exact:.1}, band {banded:.1}");
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = |name: &str| arguments.is_empty() || arguments.iter().any(|a| a == name);
    if wanted("small") {
        balls("64,000 balls of radius 0.02", 40, 0.04 + 0.4 / 41.0, 0.02);
    }
    if wanted("large") {
        balls("a million unit balls", 100, 3.0, 1.0);
    }
    if wanted("moving") {
        moving();
    }
    if wanted("fills") {
        fills();
    }
    arguments.iter().filter(|a| a.ends_with(".stl")).for_each(|path| mesh_scenes(path));
}
