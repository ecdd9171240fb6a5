// SPDX-License-Identifier: MIT OR Apache-2.0
//! The same triangles over vertices that have moved.

use crate::Outcome;
use crate::ask::TOLERANCE;
use crate::files::{geometry, mesh};
use case::{Case, SETS, Verdict, row, seconds};
use embound::geometry::{Accelerator, Geometry, RefitCheck};
use embound::math::Vec3;
use embound::parallel::Run;

/// Points whose distance from the moved surface is checked.
const CHECKED: usize = 50;

/// Times `refit` to a body stretched along its axes, with and without the check for faces that meet.
pub fn refit(case: &Case, g: &Geometry) -> Outcome {
    let stretched = case.vertices.iter().map(|v| [0, 1, 2].map(|d| v[d] * (1.0 + 0.01 * d as f64)));
    // A mesh of its own, without the files.
    let moved = Case {
        name: case.name.clone(),
        directory: case.directory.clone(),
        vertices: stretched.collect(),
        triangles: case.triangles.clone(),
        diagonal: case.diagonal,
    };
    let brute = geometry(&mesh(&moved)?, Accelerator::None, &Run::SERIAL)?;
    let set = case.set(SETS[0])?;
    let few = set.points.iter().step_by(set.points.len().div_ceil(CHECKED).max(1));
    let few: Vec<Vec3> = few.map(|p| Vec3::from_array(*p)).collect();
    let exact: Vec<f64> = few.iter().map(|p| brute.value(*p)).collect();
    let xyz = moved.vertices.concat();
    for (question, check) in [("refit checked", RefitCheck::Check), ("refit trusted", RefitCheck::Trust)] {
        let (time, refitted) = seconds(|| g.refit(&xyz, check, &Run::SERIAL));
        let refitted = refitted?;
        let pairs = few.iter().zip(&exact).map(|(p, exact)| (refitted.value(*p), *exact));
        let verdict = Verdict::of(pairs, case.diagonal, true, TOLERANCE);
        row(&case.name, question, "embound", time, "s", Some(verdict));
    }
    Ok(())
}
