// SPDX-License-Identifier: MIT OR Apache-2.0
//! Two threads beside one, one after the other in the same process.

use crate::files::{geometry, mesh};
use crate::{Outcome, lattice};
use case::{Case, row};
use embound::geometry::Accelerator;
use embound::parallel::{Pool, Run};
use std::path::Path;

/// How many times faster two threads fill the finest lattice, in each mode.
pub fn compare(directory: &Path, lattices: &[usize]) -> Outcome {
    let case = Case::read(directory)?;
    let pool = Pool::new(2, || ())?;
    let two = Run { pool: Some(&pool), progress: None };
    let g = geometry(&mesh(&case)?, Accelerator::Auto, &two)?;
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
    Ok(())
}
