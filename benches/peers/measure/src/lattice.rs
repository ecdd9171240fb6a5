// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lattices over the bounding box scaled 1.2: filling them, and boxes of their cells.

use case::{Case, Verdict, bounds, numbers, row, seconds};
use embound::geometry::Geometry;
use embound::math::Vec3;
use embound::parallel::Run;
use embound::query::{self, FillMode, Lattice};
use std::error::Error;
use std::sync::Mutex;

/// Cells along each axis of a box of a grid hierarchy.
const BOX_CELLS: usize = 32;

/// Cells along each axis of the lattice such boxes come from.
const CELLS: usize = 256;

/// Coordinates along the three axes, `n` each.
pub fn axes(case: &Case, n: usize) -> [Vec<f64>; 3] {
    let (lo, hi) = bounds(&case.vertices);
    [0, 1, 2].map(|d| {
        let (size, middle) = (1.2 * (hi[d] - lo[d]), 0.5 * (lo[d] + hi[d]));
        (0..n).map(|k| middle + size * (k as f64 / (n - 1) as f64 - 0.5)).collect()
    })
}

/// The point of a number, x fastest.
pub fn point([x, y, z]: &[Vec<f64>; 3], at: usize) -> [f64; 3] {
    let (row, i) = (at / x.len(), at % x.len());
    [x[i], y[row % y.len()], z[row / y.len()]]
}

/// Fills a lattice into memory that was touched before; seconds.
pub fn fill(
    g: &Geometry,
    axes: &[Vec<f64>; 3],
    mode: FillMode,
    run: &Run,
    out: &mut Vec<f64>,
) -> Result<f64, Box<dyn Error>> {
    let [nx, ny, nz] = [0, 1, 2].map(|d| axes[d].len());
    out.clear();
    out.resize(nx * ny * nz, f64::NAN);
    // A row each, so that threads do not wait for each other.
    let rows: Vec<Mutex<&mut [f64]>> = out.chunks_mut(nx).map(Mutex::new).collect();
    let lattice = Lattice::new(&axes[0], &axes[1], &axes[2])?;
    let emit = |[i, j, k]: [usize; 3], values: &[f64]| {
        rows[j + ny * k].lock().expect("no panic")[i..i + values.len()].copy_from_slice(values);
    };
    let (time, result) = seconds(|| query::fill(g, &lattice, mode, run, &emit));
    result?;
    Ok(time)
}

/// Fills a lattice with signs as bytes, into memory that was touched before; seconds.
pub fn fill_signs(g: &Geometry, axes: &[Vec<f64>; 3], run: &Run, out: &mut Vec<i8>) -> Result<f64, Box<dyn Error>> {
    let [nx, ny, nz] = [0, 1, 2].map(|d| axes[d].len());
    out.clear();
    out.resize(nx * ny * nz, i8::MIN);
    let rows: Vec<Mutex<&mut [i8]>> = out.chunks_mut(nx).map(Mutex::new).collect();
    let lattice = Lattice::new(&axes[0], &axes[1], &axes[2])?;
    let emit = |[i, j, k]: [usize; 3], signs: &[i8]| {
        rows[j + ny * k].lock().expect("no panic")[i..i + signs.len()].copy_from_slice(signs);
    };
    let (time, result) = seconds(|| query::fill_signs(g, &lattice, run, &emit));
    result?;
    Ok(time)
}

/// What a fill of each mode is called, over a lattice of `n` points an axis; the band is two cells wide.
pub fn modes(case: &Case, n: usize) -> [(&'static str, FillMode); 3] {
    let (lo, hi) = bounds(&case.vertices);
    let cell = (0..3).map(|d| 1.2 * (hi[d] - lo[d]) / (n - 1) as f64).fold(0.0, f64::max);
    [("exact", FillMode::Exact), ("band", FillMode::Band(2.0 * cell)), ("sign", FillMode::Sign)]
}

/// What is to be written at the points of the sample, held against what was.
pub fn judge<T: Copy + Into<f64>>(
    case: &Case,
    n: usize,
    mode: FillMode,
    values: &[T],
) -> Result<Verdict, Box<dyn Error>> {
    let path = |end: &str| case.directory.join(format!("lattice-{n}.{end}"));
    let at = numbers(&path("at.u32"), u32::from_le_bytes)?;
    let exact = numbers(&path("exact.f64"), f64::from_le_bytes)?;
    let wanted = |d: f64| match mode {
        FillMode::Band(band) if d.abs() >= band => band.copysign(d),
        FillMode::Sign => d.signum(),
        _ => d,
    };
    let pairs = at.iter().zip(exact).map(|(at, d)| (values[*at as usize].into(), wanted(d)));
    // The magnitude of a sign says nothing about distances.
    let diagonal = if mode == FillMode::Sign { 1.0 } else { case.diagonal };
    Ok(Verdict::of(pairs, diagonal, true, crate::ask::TOLERANCE))
}

/// Fills in every mode, and with signs as bytes, on one thread.
pub fn fill_all(case: &Case, g: &Geometry, n: usize) -> Result<(), Box<dyn Error>> {
    let axes = axes(case, n);
    let mut out = Vec::new();
    for (name, mode) in modes(case, n) {
        let time = fill(g, &axes, mode, &Run::SERIAL, &mut out)?;
        let verdict = judge(case, n, mode, &out)?;
        let each = time * 1e9 / out.len() as f64;
        row(&case.name, &format!("fill {name} {n}"), "embound", each, "ns", Some(verdict));
    }
    let mut signs = Vec::new();
    let time = fill_signs(g, &axes, &Run::SERIAL, &mut signs)?;
    let verdict = judge(case, n, FillMode::Sign, &signs)?;
    row(&case.name, &signs_question(n), "embound", time * 1e9 / signs.len() as f64, "ns", Some(verdict));
    Ok(())
}

/// What a fill with signs as bytes is called.
pub fn signs_question(n: usize) -> String {
    format!("fill sign, i8 {n}")
}

/// Classifies the boxes of 32^3 cells of a lattice of 256^3 cells: those that the surface may meet, and those
/// whose centre is farther from it than their corners.
pub fn classify(case: &Case, g: &Geometry) -> Result<(), Box<dyn Error>> {
    let edges = axes(case, CELLS / BOX_CELLS + 1);
    let corner = |at: [usize; 3]| Vec3::from_array([0, 1, 2].map(|d| edges[d][at[d]]));
    let n = CELLS / BOX_CELLS;
    let all = (0..n * n * n).map(|k| [k % n, k / n % n, k / n / n]);
    let boxes: Vec<[Vec3; 2]> = all.map(|at| [corner(at), corner(at.map(|c| c + 1))]).collect();
    let is_far = |b: &&[Vec3; 2]| g.value((b[0] + b[1]) * 0.5).abs() > (b[1] - b[0]).length() * 0.5;
    let (far, near): (Vec<&[Vec3; 2]>, Vec<_>) = boxes.iter().partition(is_far);
    for (name, chosen) in [("far", far), ("near", near)] {
        let (lo, hi): (Vec<[f64; 3]>, Vec<_>) = chosen.iter().map(|b| (b[0].to_array(), b[1].to_array())).unzip();
        let found = Mutex::new(vec![i32::MIN; chosen.len()]);
        let emit = |first: usize, classes: &[i32]| {
            found.lock().expect("no panic")[first..first + classes.len()].copy_from_slice(classes);
        };
        let (lo, hi) = (lo.concat(), hi.concat());
        let rounds = 10;
        let (time, result) =
            seconds(|| (0..rounds).try_for_each(|_| query::classify_boxes(g, &lo, &hi, &Run::SERIAL, &emit)));
        result?;
        let found = found.into_inner()?;
        let wrong = chosen.iter().zip(&found).filter(|(b, class)| contradicts(g, b, **class)).count();
        let verdict = Verdict { worst: 0.0, wrong_signs: Some(wrong), tolerance: 0.0 };
        let each = time * 1e9 / (rounds * chosen.len()) as f64;
        row(&case.name, &format!("classify {name}"), "embound", each, "ns", Some(verdict));
        let open = found.iter().filter(|class| **class == 0).count() as f64 / chosen.len() as f64;
        row(&case.name, &format!("classify {name}, undecided"), "embound", 100.0 * open, "%", None);
    }
    Ok(())
}

/// Whether the sign at a corner or in the middle is not what the class says.
fn contradicts(g: &Geometry, [lo, hi]: &[Vec3; 2], class: i32) -> bool {
    let corners = (0..8).map(|k| {
        let pick = |d: usize| if k >> d & 1 == 0 { lo[d] } else { hi[d] };
        Vec3::new(pick(0), pick(1), pick(2))
    });
    let mut values = corners.chain([(*lo + *hi) * 0.5]).map(|p| g.value(p));
    match class {
        0 => false,
        1 => values.any(|v| v <= 0.0),
        -1 => values.any(|v| v >= 0.0),
        _ => true,
    }
}
