// SPDX-License-Identifier: MIT OR Apache-2.0
//! The faces of one mesh, that may be moved, in a place.

use super::Geometry;
use super::rays::Targets;
use crate::error::{Error, Result};
use crate::math::{Aabb, Vec3};
use crate::primitive::overlap::meets;
use crate::primitive::triangle::RELATIVE_ERROR;

impl Geometry {
    /// The input faces of a mesh, each corner where the motions above bring it, that have a point in common
    /// with a closed box, exactly; in order.
    pub(crate) fn faces_overlapping(&self, b: Aabb) -> Result<Vec<i64>> {
        let targets = self.ray_targets()?;
        let target = targets.only()?;
        let surface = target.surface;
        if target.steps.is_empty() {
            return surface.faces_where(b, |t| meets(surface.corners(t), b));
        }
        // Made finite where it is infinite: a box to be turned must be.
        let all = target.steps.iter().rev().fold(surface.bounds(), |b, step| step.box_to_space(b));
        let region = target.steps.iter().fold(b.intersection(all), |b, step| {
            let b = step.box_to_body(b);
            // What a corner is off by when it comes back.
            let room = Vec3::splat(RELATIVE_ERROR * (b.lo.abs().max(b.hi.abs()).max_element() + step.offset()));
            if b.is_empty() { b } else { Aabb::new(b.lo - room, b.hi + room) }
        });
        surface.faces_where(region, |t| {
            let moved = |corner: Vec3| target.steps.iter().rev().fold(corner, |c, step| step.to_space(c));
            meets(surface.corners(t).map(moved), b)
        })
    }

    /// The input faces of a mesh at most that far from a point, in order. Distances are those of the mesh to
    /// the point as the motions above bring it to the mesh, scaled as values are.
    pub(crate) fn faces_within(&self, p: Vec3, radius: f64) -> Result<Vec<i64>> {
        let targets = self.ray_targets()?;
        let target = targets.only()?;
        let (mut at, mut reach) = (p, radius);
        for step in &target.steps {
            at = step.to_body(at);
            reach = (reach / step.scale()).next_up();
        }
        let all = |d: f64| target.steps.iter().rev().fold(d, |d, step| step.scale() * d);
        target.surface.faces_within(at, reach, |distance| all(distance) <= radius)
    }
}

impl<'a> Targets<'a> {
    /// The mesh, where there is one.
    fn only(&self) -> Result<&super::rays::Target<'a>> {
        match self.list() {
            [target] => Ok(target),
            all => Err(Error::unsupported(format!("g: {} meshes, whose faces have the same numbers", all.len()))),
        }
    }
}
