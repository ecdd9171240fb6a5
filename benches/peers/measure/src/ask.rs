// SPDX-License-Identifier: MIT OR Apache-2.0
//! embound on one case and one thread, every answer held against brute force.

use crate::files::{geometry, mesh};
use crate::{Outcome, centre, edges, lattice, moved};
use case::{Case, PointSet, SETS, Verdict, peer, row, seconds, version};
use embound::geometry::{Accelerator, Closest, Geometry};
use embound::io::{self, Format};
use embound::math::Vec3;
use embound::mesh::MeshOptions;
use embound::parallel::Run;
use embound::query::{self, Strided};
use std::error::Error;
use std::path::Path;
use std::sync::Mutex;

/// What the worst error may be, in diagonals.
pub const TOLERANCE: f64 = 1e-9;

/// Times everything once.
pub fn ask(directory: &Path, lattices: &[usize], edges: &[usize]) -> Outcome {
    let case = Case::read(directory)?;
    peer("embound", version(crate::LOCK, "embound"), "f64, signed");
    println!("fact\tinstruction set\t{}", embound::isa());
    load(&case)?;
    let mesh = mesh(&case)?;
    let (build, g) = seconds(|| geometry(&mesh, Accelerator::Auto, &Run::SERIAL));
    let g = g?;
    row(&case.name, "build", "embound", build, "s", None);
    let (build, compact) = seconds(|| geometry(&mesh, Accelerator::Compact, &Run::SERIAL));
    let compact = compact?;
    row(&case.name, "build, compact", "embound", build, "s", None);
    for (question, g) in [("memory", &g), ("memory, compact", &compact)] {
        let each = g.properties().bytes as f64 / case.triangles.len() as f64;
        row(&case.name, question, "embound", each, "B a triangle", None);
    }
    for name in SETS {
        let set = case.set(name)?;
        one_by_one(&case, &g, name, &set);
        in_one_call(&case, &g, name, "embound-batch", &set)?;
        // The compact layout gains nothing by the order of a grid.
        if name != "grid" {
            in_one_call(&case, &compact, name, "embound-compact", &set)?;
        }
        closest(&case, &g, name, &set)?;
    }
    moved::refit(&case, &g)?;
    for n in lattices {
        lattice::fill_all(&case, &g, *n)?;
    }
    lattice::classify(&case, &g)?;
    let brute = geometry(&mesh, Accelerator::None, &Run::SERIAL)?;
    for n in edges {
        edges::crossings(&case, &g, &brute, *n)?;
    }
    if case.name.starts_with("icosphere") {
        centre::ask(&case, &g, &brute);
    }
    Ok(())
}

/// From the file to an answer, the file being in the system's cache.
fn load(case: &Case) -> Outcome {
    let path = case.directory.join("mesh.stl");
    let (read, mesh) = seconds(|| io::read(&path, Format::Detect, &MeshOptions::default()));
    let mesh = mesh?;
    let (build, g) = seconds(|| geometry(&mesh, Accelerator::Auto, &Run::SERIAL));
    std::hint::black_box(g?.value(Vec3::ZERO));
    row(&case.name, "read STL", "embound", read, "s", None);
    row(&case.name, "read STL and build", "embound", read + build, "s", None);
    Ok(())
}

fn one_by_one(case: &Case, g: &Geometry, name: &str, set: &PointSet) {
    std::hint::black_box(set.warm_up().map(|p| g.value(Vec3::from_array(*p))).sum::<f64>());
    let mut answers = vec![f64::NAN; set.points.len()];
    let (time, ()) = seconds(|| {
        answers.iter_mut().zip(&set.points).for_each(|(a, p)| *a = g.value(Vec3::from_array(*p)));
    });
    let verdict = set.judge(case, &answers, true, TOLERANCE);
    row(&case.name, name, "embound", time * 1e9 / answers.len() as f64, "ns", Some(verdict));
}

/// Values of all points in one call; seconds and the answers.
pub fn values(g: &Geometry, points: &[[f64; 3]], run: &Run) -> Result<(f64, Vec<f64>), Box<dyn Error>> {
    let flat = points.as_flattened();
    let source = Strided::new(points.len(), [flat, &flat[1..], &flat[2..]], 3)?;
    let answers = Mutex::new(vec![f64::NAN; points.len()]);
    let emit = |first: usize, values: &[f64]| {
        answers.lock().expect("no panic")[first..first + values.len()].copy_from_slice(values);
    };
    let (time, result) = seconds(|| query::values(g, &source, run, &emit));
    result?;
    Ok((time, answers.into_inner()?))
}

fn in_one_call(case: &Case, g: &Geometry, name: &str, how: &str, set: &PointSet) -> Outcome {
    let (time, answers) = values(g, &set.points, &Run::SERIAL)?;
    let verdict = set.judge(case, &answers, true, TOLERANCE);
    row(&case.name, name, how, time * 1e9 / answers.len() as f64, "ns", Some(verdict));
    Ok(())
}

/// Closest points of all points in one call.
fn closest(case: &Case, g: &Geometry, name: &str, set: &PointSet) -> Outcome {
    let count = set.points.len();
    let flat = set.points.as_flattened();
    let source = Strided::new(count, [flat, &flat[1..], &flat[2..]], 3)?;
    let found = Mutex::new(vec![Closest::default(); count]);
    let emit = |first: usize, closest: &[Closest]| {
        found.lock().expect("no panic")[first..first + closest.len()].copy_from_slice(closest);
    };
    let (time, result) = seconds(|| query::closest(g, &source, f64::INFINITY, &Run::SERIAL, &emit));
    result?;
    let found = found.into_inner()?;
    // The point must be as far away as the value says, and the value right.
    let values: Vec<f64> = found.iter().map(|c| c.value).collect();
    let apart = found.iter().zip(&set.points).map(|(c, p)| ((c.point - Vec3::from_array(*p)).length(), c.value));
    let places = Verdict::of(apart, case.diagonal, false, TOLERANCE);
    let verdict = set.judge(case, &values, true, TOLERANCE);
    let verdict = Verdict { worst: verdict.worst.max(places.worst), ..verdict };
    row(&case.name, name, "embound-closest", time * 1e9 / count as f64, "ns", Some(verdict));
    Ok(())
}
