// SPDX-License-Identifier: MIT OR Apache-2.0
//! The triangulation of least area over a closed loop of points in space, plane or not (Barequet & Sharir
//! 1995, "Filling gaps in the boundary of a polyhedron"), by dynamic programming.

use super::faces::filled;
use super::measure::area;
use crate::error::Result;
use crate::math::Vec3;

/// `points.len() - 2` triangles over a loop of at least three points, as indices into it and running as it
/// does; none where every triangulation needs a side that `forbidden` names (by its two points, the first
/// lower). Of several as small the one whose middle corners come first. Cubic time, quadratic memory.
pub(super) fn least_area(points: &[Vec3], forbidden: &dyn Fn(usize, usize) -> bool) -> Result<Option<Vec<[u32; 3]>>> {
    let n = points.len();
    // Of the part of the loop from i to k: the least area, and the corner over the side i-k.
    let mut least = filled("sides of a loop", n * n, 0.0)?;
    let mut over = filled("sides of a loop", n * n, 0u32)?;
    for reach in 2..n {
        for i in 0..n - reach {
            let k = i + reach;
            let mut best = (f64::INFINITY, i as u32 + 1);
            if reach + 1 == n || !forbidden(i, k) {
                for m in i + 1..k {
                    let total = least[i * n + m] + least[m * n + k] + area([points[i], points[m], points[k]]);
                    if total < best.0 {
                        best = (total, m as u32);
                    }
                }
            }
            (least[i * n + k], over[i * n + k]) = best;
        }
    }
    if n < 3 || least[n - 1] == f64::INFINITY {
        return Ok(None);
    }
    let mut triangles = crate::error::try_with_capacity("triangles", n - 2)?;
    let mut open = vec![(0, n - 1)];
    while let Some((i, k)) = open.pop() {
        if k - i > 1 {
            let m = over[i * n + k] as usize;
            triangles.push([i as u32, m as u32, k as u32]);
            open.extend([(i, m), (m, k)]);
        }
    }
    Ok(Some(triangles))
}
