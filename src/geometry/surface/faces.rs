// SPDX-License-Identifier: MIT OR Apache-2.0
//! The input faces in a place.

use super::Surface;
use crate::error::{Error, Result};
use crate::math::{Aabb, Vec3, length};
use crate::primitive::triangle::RELATIVE_ERROR;

impl Surface {
    /// The faces at a distance from a point, as the kernel has it, that `holds` is true of, in order. It is
    /// true of none beyond `radius`, but for rounding.
    pub(crate) fn faces_within(&self, p: Vec3, radius: f64, holds: impl Fn(f64) -> bool) -> Result<Vec<i64>> {
        let extent = p.abs().max_element() + self.reach() + self.diagonal() + radius;
        let reach = Vec3::splat(radius + 4.0 * RELATIVE_ERROR * extent);
        self.faces_where(Aabb::new(p - reach, p + reach), |t| {
            let squared = self.foot(t, p).squared;
            // As for the nearest: beyond 1e154 one point stands for all.
            holds(if squared.is_finite() { squared.sqrt() } else { length(p - self.vertices[0]) })
        })
    }

    /// The faces of the triangles with the box about them in a region that `holds` is true of, in order.
    pub(crate) fn faces_where(&self, region: Aabb, holds: impl Fn(u32) -> bool) -> Result<Vec<i64>> {
        let (mut faces, mut is_full) = (Vec::new(), false);
        if region.is_empty() {
            return Ok(faces);
        }
        self.overlapping(region, |triangle| {
            let face = self.face(triangle);
            // What closes an open mesh is no face of it.
            if !is_full && face >= 0 && holds(triangle) {
                is_full = faces.try_reserve(1).is_err();
                if !is_full {
                    faces.push(face);
                }
            }
        });
        if is_full {
            return Err(Error::memory("faces", faces.len() + 1));
        }
        faces.sort_unstable();
        // A face may have several triangles.
        faces.dedup();
        Ok(faces)
    }
}
