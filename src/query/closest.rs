// SPDX-License-Identifier: MIT OR Apache-2.0
//! Closest points, with gradient, primitive, part and tag.

use super::{CHUNK, PointSource, at_points, check, suited};
use crate::error::{Error, Result};
use crate::geometry::{Closest, Geometry};
use crate::parallel::Run;

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
    at_points(&suited(g, run), points, &|first, points| {
        let mut answers = [Closest::only(0.0); CHUNK];
        let answers = &mut answers[..points.len()];
        g.closest_many(points, answers);
        for (answer, p) in answers.iter_mut().zip(points) {
            check(g, answer.value, *p)?;
            if answer.value.abs() > max_distance {
                *answer = Closest::only(max_distance.copysign(answer.value));
            }
        }
        emit(first, answers);
        Ok(())
    })
}
