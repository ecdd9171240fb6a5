// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values at many points.

use super::{CHUNK, PointSource, at_points, check, suited};
use crate::error::Result;
use crate::geometry::Geometry;
use crate::parallel::Run;

/// The values at `points`: the bits of [`Geometry::value`].
pub fn values(g: &Geometry, points: &dyn PointSource, run: &Run, emit: &(dyn Fn(usize, &[f64]) + Sync)) -> Result<()> {
    at_points(&suited(g, run), points, &|first, points| {
        let mut values = [0.0; CHUNK];
        g.values(points, &mut values[..points.len()]);
        for (value, p) in values.iter().zip(points) {
            check(g, *value, *p)?;
        }
        emit(first, &values[..points.len()]);
        Ok(())
    })
}
