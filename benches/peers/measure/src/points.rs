// SPDX-License-Identifier: MIT OR Apache-2.0
//! The cases: each mesh, its three point sets, and exact distances at a sample of them. The same bits
//! every time.

use crate::files::{geometry, mesh, write_points};
use crate::icosphere::icosphere;
use crate::lattice;
use crate::random::Random;
use crate::{Arguments, Outcome};
use case::{Case, bounds, write_numbers};
use embound::geometry::{Accelerator, Geometry};
use embound::io::{self, Format};
use embound::math::Vec3;
use embound::mesh::MeshOptions;
use embound::parallel::{Pool, Run};
use embound::query::{self, Strided};
use std::error::Error;
use std::path::Path;
use std::sync::Mutex;

/// Points of a set that are checked, on meshes on which that takes seconds.
const CHECKED: usize = 2_000;

/// Writes a case for each mesh below `out`.
pub fn write(out: &Path, meshes: &[&str], given: &Arguments) -> Outcome {
    for mesh in meshes {
        let (name, vertices, triangles) = surface(mesh)?;
        let directory = out.join(&name);
        std::fs::create_dir_all(&directory)?;
        write_points(&directory.join("vertices.f64"), &vertices)?;
        write_numbers(&directory.join("triangles.u32"), triangles.iter().flatten().map(|v| v.to_le_bytes()))?;
        let case = Case::read(&directory)?;
        write_sets(&case, given)?;
        println!("case\t{name}\t{}\t{:e}", case.triangles.len(), case.diagonal);
    }
    Ok(())
}

type Surface = (String, Vec<[f64; 3]>, Vec<[u32; 3]>);

/// A file's surface, welded and oriented, or a sphere's.
fn surface(mesh: &str) -> Result<Surface, Box<dyn Error>> {
    if let Some(count) = mesh.strip_prefix("icosphere:") {
        let sphere = icosphere(count.parse()?);
        return Ok((format!("icosphere-{count}"), sphere.vertices, sphere.triangles));
    }
    let read = io::read(Path::new(mesh), Format::Detect, &MeshOptions::default())?;
    let name = Path::new(mesh).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let vertices = read.vertices().iter().map(|v| v.to_array()).collect();
    Ok((name, vertices, read.triangles().iter().map(|t| t.vertices).collect()))
}

fn write_sets(case: &Case, given: &Arguments) -> Outcome {
    let mesh = mesh(case)?;
    io::write(&mesh, &case.directory.join("mesh.stl"))?;
    let pool = Pool::new(std::thread::available_parallelism().map_or(1, usize::from), || ())?;
    let run = Run { pool: Some(&pool), progress: None };
    let exact = geometry(&mesh, Accelerator::None, &run)?;
    let axes = lattice::axes(case, given.grid);
    let grid = (0..given.grid.pow(3)).map(|at| lattice::point(&axes, at)).collect();
    let sets = [("uniform", uniform(case, given.count)), ("near", near(case, given.count)), ("grid", grid)];
    for (name, points) in sets {
        write_points(&case.directory.join(format!("{name}.f64")), &points)?;
        write_sample(case, name, points.len(), &|at| points[at], &exact, &run)?;
    }
    // Lattices are made anew where they are filled.
    for n in &given.lattices {
        let axes = lattice::axes(case, *n);
        let name = format!("lattice-{n}");
        write_sample(case, &name, n.pow(3), &|at| lattice::point(&axes, at), &exact, &run)?;
    }
    Ok(())
}

/// Numbers of evenly spread points and their distances; fewer where there are many triangles.
fn write_sample(
    case: &Case,
    name: &str,
    points: usize,
    point: &dyn Fn(usize) -> [f64; 3],
    exact: &Geometry,
    run: &Run,
) -> Outcome {
    let count = CHECKED.min(400_000_000 / case.triangles.len()).min(points);
    let at: Vec<usize> = (0..count).map(|k| (k * points + points / 2) / count).collect();
    let asked: Vec<[f64; 3]> = at.iter().map(|&i| point(i)).collect();
    let flat = asked.concat();
    let source = Strided::new(count, [&flat, &flat[1..], &flat[2..]], 3)?;
    let found = Mutex::new(vec![f64::NAN; count]);
    query::values(exact, &source, run, &|first, values| {
        found.lock().expect("no panic")[first..first + values.len()].copy_from_slice(values);
    })?;
    let path = |end: &str| case.directory.join(format!("{name}.{end}"));
    write_numbers(&path("at.u32"), at.iter().map(|&i| (i as u32).to_le_bytes()))?;
    write_numbers(&path("exact.f64"), found.into_inner()?.iter().map(|d| d.to_le_bytes()))?;
    Ok(())
}

/// In the bounding box scaled 1.5 about its middle.
fn uniform(case: &Case, count: usize) -> Vec<[f64; 3]> {
    let (lo, hi) = bounds(&case.vertices);
    let room = [0, 1, 2].map(|d| 0.25 * (hi[d] - lo[d]));
    let (lo, hi) = ([0, 1, 2].map(|d| lo[d] - room[d]), [0, 1, 2].map(|d| hi[d] + room[d]));
    let mut random = Random(1);
    (0..count).map(|_| random.point(lo, hi)).collect()
}

/// On the surface, evenly by area, moved along the triangle's normal by up to 1% of the diagonal either way.
fn near(case: &Case, count: usize) -> Vec<[f64; 3]> {
    let corners = |t: usize| case.triangles[t].map(|v| Vec3::from_array(case.vertices[v as usize]));
    let normal = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a);
    let mut total = 0.0;
    let areas: Vec<f64> = (0..case.triangles.len())
        .map(|t| {
            total += normal(corners(t)).length();
            total
        })
        .collect();
    let mut random = Random(2);
    (0..count)
        .map(|_| {
            let wanted = random.range(0.0, total);
            let [a, b, c] = corners(areas.partition_point(|area| *area <= wanted).min(areas.len() - 1));
            let (u, v) = (random.unit(), random.unit());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let up = normal([a, b, c]).normalize_or_zero();
            (a + (b - a) * u + (c - a) * v + up * (0.01 * case.diagonal * random.range(-1.0, 1.0))).to_array()
        })
        .collect()
}
