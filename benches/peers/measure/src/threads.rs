// SPDX-License-Identifier: MIT OR Apache-2.0
//! Two threads beside one, one after the other in the same process.

use crate::ask::{TOLERANCE, values};
use crate::files::{geometry, mesh};
use crate::{Outcome, lattice};
use case::{Case, SETS, row, seconds};
use embound::geometry::Accelerator;
use embound::parallel::{Pool, Run};
use embound::query::FillMode;
use std::path::Path;

/// How many times faster two threads build, answer points in one call, and fill the finest lattice in each mode.
pub fn compare(directory: &Path, lattices: &[usize]) -> Outcome {
    let case = Case::read(directory)?;
    let pool = Pool::new(2, || ())?;
    let two = Run { pool: Some(&pool), progress: None };
    let mesh = mesh(&case)?;
    let (alone, g) = seconds(|| geometry(&mesh, Accelerator::Auto, &Run::SERIAL));
    drop(g?);
    let (together, g) = seconds(|| geometry(&mesh, Accelerator::Auto, &two));
    let g = g?;
    row(&case.name, "two threads, build", "embound", alone / together, "times", None);
    let set = case.set(SETS[0])?;
    let (alone, _) = values(&g, &set.points, &Run::SERIAL)?;
    let (together, answers) = values(&g, &set.points, &two)?;
    let verdict = set.judge(&case, &answers, true, TOLERANCE);
    row(&case.name, "two threads, values in one call", "embound", alone / together, "times", Some(verdict));
    let n = lattices.iter().copied().max().ok_or("--lattice: none")?;
    let axes = lattice::axes(&case, n);
    let mut out = Vec::new();
    for (name, mode) in lattice::modes(&case, n) {
        let alone = lattice::fill(&g, &axes, mode, &Run::SERIAL, &mut out)?;
        let together = lattice::fill(&g, &axes, mode, &two, &mut out)?;
        let verdict = lattice::judge(&case, n, mode, &out)?;
        let question = format!("two threads, fill {name} {n}");
        row(&case.name, &question, "embound", alone / together, "times", Some(verdict));
    }
    let mut signs = Vec::new();
    let alone = lattice::fill_signs(&g, &axes, &Run::SERIAL, &mut signs)?;
    let together = lattice::fill_signs(&g, &axes, &two, &mut signs)?;
    let verdict = lattice::judge(&case, n, FillMode::Sign, &signs)?;
    let question = format!("two threads, {}", lattice::signs_question(n));
    row(&case.name, &question, "embound", alone / together, "times", Some(verdict));
    Ok(())
}
