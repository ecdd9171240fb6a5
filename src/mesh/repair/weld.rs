// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices with equal positions, or nearer than a tolerance, become one; faces that lose their area by it leave.

use super::Repairs;
use super::work::Work;
use crate::error::{Result, filled};
use crate::math::Aabb;
use crate::mesh::weld::{weld_equal, weld_near};

/// `tolerance` is a part of the diagonal; 0: equal positions.
pub(super) fn weld(work: &mut Work, tolerance: f64, repairs: &mut Repairs) -> Result<()> {
    let used = filled("vertices", work.positions.len(), true)?;
    let mut welded = weld_equal(&work.positions, &used)?;
    if tolerance > 0.0 {
        let bounds = Aabb::of(welded.vertices.iter().copied());
        weld_near(&mut welded, bounds, tolerance * bounds.diagonal())?;
    }
    let fewer = work.positions.len() - welded.vertices.len();
    if fewer == 0 {
        return Ok(());
    }
    repairs.vertices_welded = fewer;
    let mut rings = work.rings(0)?;
    for (f, &number) in work.faces.input.iter().enumerate() {
        for h in work.faces.start[f]..work.faces.start[f + 1] {
            let (v, row) = work.corner(h);
            rings.add((welded.of[v as usize], row));
        }
        repairs.faces_collapsed += usize::from(!rings.end(number));
    }
    work.positions = welded.vertices;
    work.replace(rings)
}
