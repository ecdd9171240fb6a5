// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where the edges of a lattice cross the surface: all of them, and those that do, one by one.

use crate::ask::TOLERANCE;
use crate::{Outcome, lattice};
use case::{Case, Verdict, row, seconds};
use embound::geometry::Geometry;
use embound::math::Vec3;
use embound::parallel::Run;
use embound::query::{self, CrossingForm, FillMode, Intercept, Lattice};
use std::sync::Mutex;

/// Points along an axis up to which the signs of edges' ends come from values; beyond, that takes too long.
const FEW: usize = 96;

/// Crossings whose distance from the surface is checked.
const CHECKED: usize = 200;

/// A crossed edge and where.
type Crossed = ([usize; 3], usize, f64);

/// Times `crossings` over all edges and `intercepts` over the crossed ones.
pub fn crossings(case: &Case, g: &Geometry, brute: &Geometry, n: usize) -> Outcome {
    let axes = lattice::axes(case, n);
    let (time, found) = all(g, &axes)?;
    let each = time * 1e9 / (3 * n * n * (n - 1)) as f64;
    // As many edges are crossed as have ends on two sides, and every crossing lies on the surface.
    let mut values = Vec::new();
    let mode = if n <= FEW { FillMode::Exact } else { FillMode::Sign };
    lattice::fill(g, &axes, mode, &Run::SERIAL, &mut values)?;
    let wrong = found.len().abs_diff(changes(&values, n));
    let point = |at: [usize; 3]| Vec3::from_array([0, 1, 2].map(|d| axes[d][at[d]]));
    let sample = found.iter().step_by(found.len().div_ceil(CHECKED).max(1));
    let off = sample.map(|(at, axis, coordinate)| {
        let mut p = point(*at);
        p[*axis] = *coordinate;
        (brute.value(p), 0.0)
    });
    let verdict = Verdict { wrong_signs: Some(wrong), ..Verdict::of(off, case.diagonal, false, TOLERANCE) };
    row(&case.name, &format!("crossings {n}"), "embound", each, "ns", Some(verdict));

    let ends = |(at, axis, _): &Crossed| {
        let mut next = *at;
        next[*axis] += 1;
        (point(*at).to_array(), point(next).to_array())
    };
    let (a, b): (Vec<_>, Vec<_>) = found.iter().map(ends).unzip();
    let (a, b) = (a.concat(), b.concat());
    let places = Mutex::new(vec![f64::NAN; found.len()]);
    let emit = |first: usize, answers: &[Intercept]| {
        let mut places = places.lock().expect("no panic");
        places[first..first + answers.len()].iter_mut().zip(answers).for_each(|(p, a)| *p = a.t);
    };
    let (time, result) = seconds(|| query::intercepts(g, &a, &b, &Run::SERIAL, &emit));
    result?;
    // The same edge has the same crossing, whichever way it is asked for.
    let pairs = places.into_inner()?.into_iter().enumerate().map(|(k, t)| {
        let axis = found[k].1;
        (a[3 * k + axis] + (b[3 * k + axis] - a[3 * k + axis]) * t - found[k].2, 0.0)
    });
    let verdict = Verdict::of(pairs, case.diagonal, false, TOLERANCE);
    row(
        &case.name,
        &format!("intercept of a crossed edge {n}"),
        "embound",
        time * 1e9 / found.len() as f64,
        "ns",
        Some(verdict),
    );
    Ok(())
}

/// Every crossed edge of a lattice along all three axes, in order.
fn all(g: &Geometry, axes: &[Vec<f64>; 3]) -> Result<(f64, Vec<Crossed>), Box<dyn std::error::Error>> {
    let lattice = Lattice::new(&axes[0], &axes[1], &axes[2])?;
    let (mut time, mut found) = (0.0, Vec::new());
    for axis in 0..3 {
        let here = Mutex::new(Vec::new());
        let emit = |[i, j, k]: [usize; 3], _: usize, crossings: &[(usize, query::Crossing)]| {
            let crossed = crossings.iter().filter(|(_, c)| !c.at.is_nan());
            here.lock().expect("no panic").extend(crossed.map(|(d, c)| ([i + d, j, k], axis, c.at)));
        };
        let form = CrossingForm::Coordinate;
        let (passed, result) = seconds(|| query::crossings(g, &lattice, axis, form, &Run::SERIAL, &emit));
        result?;
        time += passed;
        found.append(&mut here.into_inner()?);
    }
    Ok((time, found))
}

/// Edges whose ends lie on two sides; zero counts as inside.
fn changes(values: &[f64], n: usize) -> usize {
    let steps = [1, n, n * n];
    let ends = |axis: usize| {
        let inner = (0..values.len()).filter(move |at| at / steps[axis] % n + 1 < n);
        inner.filter(move |&at| (values[at] <= 0.0) != (values[at + steps[axis]] <= 0.0)).count()
    };
    (0..3).map(ends).sum()
}
