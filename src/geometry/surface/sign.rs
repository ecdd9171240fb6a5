// SPDX-License-Identifier: MIT OR Apache-2.0
//! The sign: angle-weighted pseudonormals (Baerentzen & Aanaes 2005) where they decide clearly, exact
//! crossings of a vertical line elsewhere. Both are right off the surface of a closed mesh where it passes the
//! check of `check.rs`, so it does not matter which one answered; where it does not, crossings answer alone.

use super::{ALONE, Nearest, Sign, Surface, UNCLEAR};
use crate::math::{Aabb, Vec3, length, unit};
use crate::primitive::crossing::AxisLine;

/// Below this cosine between the offset and the pseudonormal, crossings decide.
const CLEAR_COSINE: f64 = 1e-3;

/// Nearer than this times the largest coordinate or the diagonal, the direction of the offset is rounding:
/// crossings decide.
pub(super) const CLEAR_DISTANCE: f64 = 1e-11;

impl Surface {
    /// Signed distance: negative inside. Zero is +0.0.
    pub(crate) fn value(&self, p: Vec3) -> f64 {
        self.signed(p, &self.nearest(p))
    }

    /// The signed distance of a point whose nearest triangle is known.
    pub(crate) fn signed(&self, p: Vec3, nearest: &Nearest) -> f64 {
        let d = nearest.distance;
        if self.sign_by_normal(p, nearest).unwrap_or_else(|| self.is_inside(p)) { -d } else { d }
    }

    /// Gradient of the signed distance, which is `value` at `p`; on the surface, the pseudonormal.
    pub(crate) fn gradient(&self, p: Vec3, nearest: &Nearest, value: f64) -> Vec3 {
        let away = unit(p - nearest.point);
        let near = !self.is_clear(nearest);
        if near || away == Vec3::ZERO {
            let normal = unit(self.pseudonormal(nearest));
            let face = self.normal(nearest.triangle);
            return [normal, face, away].into_iter().find(|n| *n != Vec3::ZERO).unwrap_or(Vec3::X);
        }
        if value < 0.0 { -away } else { away }
    }

    /// Whether the offset from the nearest point has a direction. The nearest point is rounded to its
    /// coordinates, which are large where the surface is far from the origin.
    fn is_clear(&self, nearest: &Nearest) -> bool {
        nearest.distance > CLEAR_DISTANCE * self.diagonal.max(self.reach())
    }

    /// Whether a point is inside where that takes no crossings to know; on the surface the sign is positive.
    pub(super) fn sign_by_normal(&self, p: Vec3, nearest: &Nearest) -> Option<bool> {
        if nearest.distance == 0.0 || self.sign == Sign::Unsigned {
            return Some(false);
        }
        if !self.is_near_bounds(p) {
            // Far away, rounding may choose any triangle as the nearest one.
            return Some(self.far_winding >= 1);
        }
        if self.sign == Sign::Pseudonormal && self.is_clear(nearest) && !self.doubts.has(nearest.triangle) {
            let (offset, normal) = (p - nearest.point, self.pseudonormal(nearest));
            let along = offset.dot(normal);
            if along.abs() > CLEAR_COSINE * length(offset) * length(normal) && self.settles_within(p, nearest.distance)
            {
                return Some(along < 0.0);
            }
        }
        None
    }

    /// The pseudonormal of the nearest feature; zero where it decides nothing.
    fn pseudonormal(&self, nearest: &Nearest) -> Vec3 {
        let t = nearest.triangle as usize;
        match nearest.feature {
            0 => self.normals[t],
            k @ 1..=3 => match self.neighbours[t][k - 1] {
                UNCLEAR => Vec3::ZERO,
                ALONE => self.normals[t],
                other => self.normals[t] + self.normals[other as usize],
            },
            k => self.vertex_normals[self.triangles.vertex[t][k - 4] as usize],
        }
    }

    /// The winding number around `p`, exact: of a surface with holes, that of it and its caps. Of a closed one, at least 1
    /// is inside.
    pub(crate) fn winding(&self, p: Vec3) -> i32 {
        if !self.bounds.contains(p) {
            return self.far_winding;
        }
        let line = AxisLine::new(2, p);
        let column = Aabb::new(p, Vec3::new(p.x, p.y, f64::INFINITY));
        let mut winding = self.far_winding;
        self.overlapping(column, |t| {
            let corners = self.corners(t);
            let turn = line.meets(corners);
            if turn != 0 && line.below(p.z, corners, turn) {
                winding += turn;
            }
        });
        winding + self.closing.as_ref().map_or(0, |caps| caps.winding(p))
    }
}
