// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values at many points.

use super::order::at_sorted_points;
use super::{CHUNK, PointSource, at_points, check, suited};
use crate::error::Result;
use crate::geometry::Geometry;
use crate::parallel::Run;

/// Points that are sorted as one: as many as find themselves a place in a processor's second cache.
const RUN: usize = 16384;

/// The values at `points`: the bits of [`Geometry::value`].
pub fn values(g: &Geometry, points: &dyn PointSource, run: &Run, emit: &(dyn Fn(usize, &[f64]) + Sync)) -> Result<()> {
    let run = suited(g, run);
    if g.gains_by_order() && points.count() > CHUNK {
        let answer = |points: &[_], values: &mut [f64]| g.values(points, values);
        return at_sorted_points::<f64>(&run, g, points, RUN, &answer, &|first, values| emit(first, values));
    }
    at_points(&run, points, &|first, points| {
        let mut values = [0.0; CHUNK];
        g.values(points, &mut values[..points.len()]);
        for (value, p) in values.iter().zip(points) {
            check(g, *value, *p)?;
        }
        emit(first, &values[..points.len()]);
        Ok(())
    })
}
