// SPDX-License-Identifier: MIT OR Apache-2.0
//! A number of questions and nothing else, for a counter of instructions: the difference between two runs
//! of different numbers has neither the start nor the build in it.

use crate::files::{geometry, mesh};
use crate::{Outcome, lattice};
use case::{Case, SETS};
use embound::geometry::Accelerator;
use embound::math::Vec3;
use embound::parallel::Run;
use embound::query::FillMode;
use std::path::Path;

/// Asks for the first `n` points of a set, or fills a lattice of 32 by 32 by `n` points.
pub fn only(directory: &Path, question: &str, n: usize) -> Outcome {
    let case = Case::read(directory)?;
    let g = geometry(&mesh(&case)?, Accelerator::Auto, &Run::SERIAL)?;
    if SETS.contains(&question) {
        let points = case.set(question)?.points;
        std::hint::black_box(points.iter().take(n).map(|p| g.value(Vec3::from_array(*p))).sum::<f64>());
        return Ok(());
    }
    if question != "fill" {
        return Err(format!("{question}: not uniform, near, grid or fill").into());
    }
    let mut axes = lattice::axes(&case, 32);
    axes[2].truncate(n);
    lattice::fill(&g, &axes, FillMode::Exact, &Run::SERIAL, &mut Vec::new())?;
    Ok(())
}
