// SPDX-License-Identifier: MIT OR Apache-2.0
//! The triangulation of least area over a closed loop of points in space, with what it needs to work in.

use super::faces::filled;
use crate::error::Result;
use crate::math::Vec3;
use crate::primitive::least_area;

/// `points.len() - 2` triangles over a loop, as indices into it and running as it does; none where there are fewer than
/// three points, and where every triangulation needs a side that `forbidden` names (by its two points, the first lower).
/// Cubic time, quadratic memory.
pub(super) fn least_area(points: &[Vec3], forbidden: &dyn Fn(usize, usize) -> bool) -> Result<Option<Vec<[u32; 3]>>> {
    let n = points.len();
    if n < 3 {
        return Ok(None);
    }
    let mut table = filled("sides of a loop", n * n, least_area::Stretch::default())?;
    let mut triangles = filled("triangles", n - 2, [0; 3])?;
    let found = least_area::least_area(points, forbidden, &mut table, &mut triangles);
    Ok(found.then_some(triangles))
}
