// SPDX-License-Identifier: MIT OR Apache-2.0
//! Closest points, with gradient, primitive, part and tag.

use super::order::at_sorted_points;
use super::{CHUNK, PointSource, at_points, check, suited};
use crate::error::{Error, Result};
use crate::geometry::{Closest, Geometry};
use crate::parallel::Run;

/// Points that are sorted as one; their answers are large.
const RUN: usize = 4096;

/// The closest point of each of `points`. Beyond `max_distance` (infinite: none) the value is plus or
/// minus `max_distance` and nothing else is known.
pub fn closest(
    g: &Geometry,
    points: &dyn PointSource,
    max_distance: f64,
    run: &Run,
    emit: &(dyn Fn(usize, &[Closest]) + Sync),
) -> Result<()> {
    if max_distance.is_nan() || max_distance <= 0.0 {
        return Err(Error::invalid(format!("max_distance: {max_distance} is not > 0")));
    }
    let cut = |answers: &mut [Closest]| {
        for answer in answers.iter_mut().filter(|answer| answer.value.abs() > max_distance) {
            *answer = Closest::only(max_distance.copysign(answer.value));
        }
    };
    let run = suited(g, run);
    if g.gains_by_order() && points.count() > CHUNK {
        let answer = |points: &[_], answers: &mut [Closest]| g.closest_many(points, answers);
        return at_sorted_points::<Closest>(&run, g, points, RUN, &answer, &|first, answers| {
            cut(answers);
            emit(first, answers);
        });
    }
    at_points(&run, points, &|first, points| {
        let mut answers = [Closest::only(0.0); CHUNK];
        let answers = &mut answers[..points.len()];
        g.closest_many(points, answers);
        for (answer, p) in answers.iter().zip(points) {
            check(g, answer.value, *p)?;
        }
        cut(answers);
        emit(first, answers);
        Ok(())
    })
}
