// SPDX-License-Identifier: MIT OR Apache-2.0
//! What whole lattices cost on one thread: signs, the crossings of all edges along the three axes, and values within a
//! band of two cells. A sample of each is compared with single points and edges in the same run:
//!
//!     cargo bench --bench lattice -- [points a side ...] [mesh ...]      (64 128 192 256; a bumpy sphere and a bracket)

use embound::geometry::{Geometry, SdfOptions};
use embound::io::{self, Format};
use embound::math::Vec3;
use embound::mesh::{Mesh, MeshOptions};
use embound::parallel::Run;
use embound::query::{self, Crossing, CrossingForm, FillMode, Lattice};
use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;

#[path = "../tests/common/mod.rs"]
mod common;
use common::{bodies, random::Random};

const TIMES: usize = 3;
const SAMPLE: usize = 20_000;

/// Seconds: the least of three.
fn cost(mut work: impl FnMut()) -> f64 {
    let once = |work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..TIMES).map(|_| once(&mut work)).fold(f64::INFINITY, f64::min)
}

struct Grid {
    axes: [Vec<f64>; 3],
    n: usize,
}

impl Grid {
    fn around(mesh: &Mesh, n: usize) -> Grid {
        let bounds = mesh.bounds();
        let half = 0.55 * (bounds.hi - bounds.lo).max_element();
        let axis = |k: usize| {
            (0..n).map(|i| bounds.center()[k] - half + 2.0 * half * i as f64 / (n - 1) as f64).collect::<Vec<f64>>()
        };
        Grid { axes: [axis(0), axis(1), axis(2)], n }
    }

    fn lattice(&self) -> Lattice<'_> {
        Lattice::new(&self.axes[0], &self.axes[1], &self.axes[2]).expect("axes")
    }

    fn point(&self, at: [usize; 3]) -> Vec3 {
        Vec3::new(self.axes[0][at[0]], self.axes[1][at[1]], self.axes[2][at[2]])
    }

    fn place(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.n * (j + self.n * k)
    }

    /// Points anywhere, and every other one beside a crossing along x.
    fn sample(&self, crossed: &[([usize; 3], Crossing)]) -> Vec<[usize; 3]> {
        let mut random = Random(9);
        let anywhere = |random: &mut Random| [0; 3].map(|_| random.below(self.n - 1));
        let near = |random: &mut Random| crossed[random.below(crossed.len())].0;
        (0..SAMPLE).map(|k| if k % 2 == 0 { anywhere(&mut random) } else { near(&mut random) }).collect()
    }
}

fn signs(g: &Geometry, grid: &Grid, out: &Mutex<Vec<i8>>) -> f64 {
    cost(|| {
        let emit = |at: [usize; 3], signs: &[i8]| {
            let from = grid.place(at);
            out.lock().expect("alone")[from..from + signs.len()].copy_from_slice(signs);
        };
        query::fill_signs(g, &grid.lattice(), &Run::SERIAL, &emit).expect("signs");
    })
}

fn values(g: &Geometry, grid: &Grid, mode: FillMode, out: &Mutex<Vec<f64>>) -> f64 {
    cost(|| {
        let emit = |at: [usize; 3], values: &[f64]| {
            let from = grid.place(at);
            out.lock().expect("alone")[from..from + values.len()].copy_from_slice(values);
        };
        query::fill(g, &grid.lattice(), mode, &Run::SERIAL, &emit).expect("values");
    })
}

fn crossings(g: &Geometry, grid: &Grid, axis: usize, out: &Mutex<Vec<([usize; 3], Crossing)>>) -> f64 {
    cost(|| {
        out.lock().expect("alone").clear();
        let emit = |at: [usize; 3], _: usize, found: &[(usize, Crossing)]| {
            if !found.is_empty() {
                let found = found.iter().map(|(k, crossing)| ([at[0] + k, at[1], at[2]], *crossing));
                out.lock().expect("alone").extend(found);
            }
        };
        query::crossings(g, &grid.lattice(), axis, CrossingForm::Fraction, &Run::SERIAL, &emit).expect("crossings");
    })
}

/// Compares crossings and edges beside them with single segments.
fn compare(g: &Geometry, grid: &Grid, axis: usize, crossed: &[([usize; 3], Crossing)]) {
    for (at, crossing) in crossed.iter().step_by(crossed.len() / SAMPLE + 1) {
        let mut to = *at;
        to[axis] += 1;
        let (a, b) = (grid.point(*at).to_array(), grid.point(to).to_array());
        query::intercepts(g, &a, &b, &Run::SERIAL, &|_, hits| {
            assert_eq!(crossing.at.to_bits(), hits[0].t.to_bits(), "{a:?} {b:?}");
            assert_eq!((crossing.count, crossing.tag), (hits[0].count, hits[0].tag), "{a:?} {b:?}");
        })
        .expect("an intercept");
    }
}

fn measure(name: &str, mesh: &Mesh, sides: &[usize]) {
    let g = Geometry::from_mesh(mesh, &SdfOptions::default(), &Run::SERIAL).expect("a closed mesh");
    println!("{name}: {} triangles", mesh.triangle_count());
    for &n in sides {
        let grid = Grid::around(mesh, n);
        let points = (n * n * n) as f64;
        let (sign, crossed) = (Mutex::new(vec![0; n * n * n]), Mutex::new(Vec::new()));
        let sign_time = signs(&g, &grid, &sign);
        let sign = sign.into_inner().expect("alone");
        let (mut crossing_time, mut count, mut sample) = ([0.0; 3], 0, Vec::new());
        for axis in [2, 1, 0] {
            crossing_time[axis] = crossings(&g, &grid, axis, &crossed);
            let crossed = crossed.lock().expect("alone");
            compare(&g, &grid, axis, &crossed);
            count += crossed.len();
            sample = grid.sample(&crossed);
        }
        let value = |at: &[usize; 3]| g.value(grid.point(*at));
        for at in &sample {
            let value = value(at);
            assert_eq!(f64::from(sign[grid.place(*at)]), if value == 0.0 { 0.0 } else { value.signum() }, "{at:?}");
        }
        let banded = Mutex::new(vec![0.0; n * n * n]);
        let band = 2.0 * (grid.axes[0][1] - grid.axes[0][0]);
        let band_time = values(&g, &grid, FillMode::Band(band), &banded);
        let banded = banded.into_inner().expect("alone");
        for at in &sample {
            let value = value(at);
            let wanted = if value.abs() < band { value } else { band.copysign(value) };
            assert_eq!(banded[grid.place(*at)].to_bits(), wanted.to_bits(), "{at:?}");
        }
        println!(
            "{n:5}^3: signs {:7.2} ms ({:6.2} ns a point), crossings {:6.2} + {:6.2} + {:6.2} ms ({:6.1} ns each of {count}), band of 2 cells {:8.1} ms ({:6.1} ns a point)",
            sign_time * 1e3,
            sign_time * 1e9 / points,
            crossing_time[0] * 1e3,
            crossing_time[1] * 1e3,
            crossing_time[2] * 1e3,
            crossing_time.iter().sum::<f64>() * 1e9 / count.max(1) as f64,
            band_time * 1e3,
            band_time * 1e9 / points,
        );
    }
}

/// Trees, whose lattices are classified cube by cube, beside their points one after another.
fn measure_tree(name: &str, g: &Geometry, box_of: &Mesh, n: usize) {
    let grid = Grid::around(box_of, n);
    let points = (n * n * n) as f64;
    let (sign, crossed) = (Mutex::new(vec![0; n * n * n]), Mutex::new(Vec::new()));
    let sign_time = signs(g, &grid, &sign);
    let sign = sign.into_inner().expect("alone");
    let crossing_time = crossings(g, &grid, 0, &crossed);
    let crossed = crossed.into_inner().expect("alone");
    compare(g, &grid, 0, &crossed);
    let sample = grid.sample(&crossed);
    let start = Instant::now();
    for at in &sample {
        let value = g.value(grid.point(*at));
        assert_eq!(f64::from(sign[grid.place(*at)]), if value == 0.0 { 0.0 } else { value.signum() }, "{at:?}");
    }
    println!(
        "{name}: {n}^3: signs {:.2} ns a point (one by one {:.0}), crossings along x {:.2} ns an edge",
        sign_time * 1e9 / points,
        start.elapsed().as_secs_f64() * 1e9 / SAMPLE as f64,
        crossing_time * 1e9 / points,
    );
}

fn main() {
    let given: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let mut sides: Vec<usize> = given.iter().filter_map(|a| a.parse().ok()).collect();
    if sides.is_empty() {
        sides = vec![64, 128, 192, 256];
    }
    let files: Vec<&String> = given.iter().filter(|a| a.parse::<usize>().is_err()).collect();
    for file in &files {
        measure(file, &io::read(Path::new(file), Format::Detect, &MeshOptions::default()).expect(file), &sides);
    }
    if files.is_empty() {
        let bumpy = |p: [f64; 3]| p.map(|c| c * (1.0 + 0.05 * libm::sin(9.0 * p[0]) * libm::sin(7.0 * p[1])));
        measure("bumpy sphere", &bodies::icosphere(6).map(bumpy).mesh(), &sides);
        measure("bracket", &bodies::bracket().mesh(), &sides);
        let around = bodies::cuboid([-1.0; 3], [1.0; 3]).mesh();
        let mut random = Random(4);
        let balls: Vec<Geometry> = (0..1000)
            .map(|_| Geometry::sphere(random.point([-1.0; 3], [1.0; 3]), random.range(0.02, 0.1)).expect("a ball"))
            .collect();
        let balls = Geometry::union(&balls).expect("a union");
        let ball = bodies::icosphere(5).map(bumpy).scaled(0.8).mesh();
        let ball = Geometry::from_mesh(&ball, &SdfOptions::default(), &Run::SERIAL).expect("a closed mesh");
        let turn = [0.36, 0.48, -0.8, -0.8, 0.60, 0.0, 0.48, 0.64, 0.60];
        let turned = ball.place(turn, [0.1, 0.0, 0.0]).expect("a rotation");
        for (name, g) in [("1,000 balls", &balls), ("a turned mesh", &turned)] {
            measure_tree(name, g, &around, 96);
        }
        measure_tree("a mesh less 1,000 balls", &ball.difference(&balls).expect("a difference"), &around, 96);
    }
}
