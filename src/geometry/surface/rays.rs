// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where a ray meets the surface.

use super::Surface;
use crate::error::Result;
use crate::math::Vec3;
use crate::primitive::ray::Ray;

/// One meeting of a ray with a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Met {
    /// As the ray scales it.
    pub(crate) t: f64,
    pub(crate) triangle: u32,
    /// Whether the ray passes towards the outer side of the triangle.
    pub(crate) leaves: bool,
}

impl Surface {
    /// Hands `offer` the meetings within the range of a ray, in no given order; those beyond a limit, at first `to` and
    /// then what `offer` says, may be left out.
    pub(crate) fn along_ray(
        &self,
        ray: &Ray,
        to: f64,
        waiting: &mut Vec<(f64, u32)>,
        mut offer: impl FnMut(Met) -> f64,
    ) -> Result<()> {
        let mut limit = to;
        let mut look = |triangle: u32, limit: &mut f64| {
            let corners = self.corners(triangle);
            let turn = ray.meets(corners);
            if turn != 0 {
                *limit = offer(Met { t: ray.place(corners), triangle, leaves: turn > 0 });
            }
        };
        match &self.tree {
            Some(tree) => tree.along_ray(ray.origin, ray.direction, [ray.from, to], waiting, |leaf| {
                self.members(leaf).iter().for_each(|&t| look(t, &mut limit));
                limit
            }),
            None => {
                (0..self.triangles.len() as u32).for_each(|t| look(t, &mut limit));
                Ok(())
            }
        }
    }

    /// Outward unit normal of a triangle; zero where its area is.
    pub(crate) fn outward(&self, triangle: u32) -> Vec3 {
        self.normal(triangle)
    }
}
