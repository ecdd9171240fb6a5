// SPDX-License-Identifier: MIT OR Apache-2.0
//! The triangles round a vertex of many as a group. Their boxes meet one another, and where they are long, hardly tell
//! where they are; but they often lie in a plane, and what is off that plane keeps clear of all of them.

use super::Contacts;
use crate::bvh::ALONE;
use crate::error::{Error, Result, try_with_capacity};
use crate::math::Vec3;

/// Triangles at a vertex that make a group.
pub(super) const GROUP: usize = 64;

/// Room for the rounding of a height, relative to lengths.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Groups of triangles.
#[derive(Default)]
pub(super) struct Groups {
    /// The group of each triangle, or [`ALONE`]; nothing at all where there are no groups.
    pub of_triangle: Vec<u32>,
    pub fans: Vec<Fan>,
}

/// Where the triangles of a group are: between two planes.
#[derive(Clone, Copy)]
pub(super) struct Fan {
    hub: Vec3,
    normal: Vec3,
    low: f64,
    high: f64,
    reach: f64,
}

impl Contacts<'_> {
    /// Each triangle in the group of that of its vertices which has most.
    pub(super) fn groups(&self) -> Result<Groups> {
        let degree = |v: u32| self.topology.outgoing(v).len();
        let mut groups = Groups::default();
        let mut number = Vec::new();
        for v in (0..self.vertices.len() as u32).filter(|v| degree(*v) >= GROUP) {
            let room = |_| Error::memory("groups", groups.fans.len() + 1);
            number.try_reserve(1).map_err(room)?;
            groups.fans.try_reserve(1).map_err(|_| Error::memory("groups", number.len() + 1))?;
            number.push(v);
            groups.fans.push(self.fan(v));
        }
        if number.is_empty() {
            return Ok(groups);
        }
        groups.of_triangle = try_with_capacity("groups", self.triangles.len())?;
        groups.of_triangle.extend(self.triangles.iter().map(|t| {
            let most = t.vertices.into_iter().max_by_key(|v| (degree(*v), u32::MAX - *v));
            most.and_then(|v| number.binary_search(&v).ok()).map_or(ALONE, |k| k as u32)
        }));
        Ok(groups)
    }

    /// Where the triangles at a vertex are.
    fn fan(&self, v: u32) -> Fan {
        let hub = self.vertices[v as usize];
        let triangles = || self.topology.outgoing(v).iter().map(|h| self.corners(h / 3).map(|c| c - hub));
        // Either way round: neighbours may disagree.
        let mut normal = Vec3::ZERO;
        for [a, b, c] in triangles() {
            let up = (b - a).cross(c - a);
            normal += if up.dot(normal) < 0.0 { -up } else { up };
        }
        let normal = crate::math::unit(normal);
        let (mut low, mut high, mut reach) = (0.0f64, 0.0f64, 0.0f64);
        for corner in triangles().flatten() {
            let height = corner.dot(normal);
            (low, high, reach) = (low.min(height), high.max(height), reach.max(corner.abs().max_element()));
        }
        Fan { hub, normal, low, high, reach }
    }

    /// Whether triangles all lie on one side of the planes that a group is between, by more than the slack.
    pub(super) fn is_apart(&self, triangles: &[u32], fan: Fan) -> bool {
        let (mut low, mut high, mut reach) = (f64::INFINITY, f64::NEG_INFINITY, fan.reach);
        for corner in triangles.iter().flat_map(|t| self.corners(*t)) {
            let offset = corner - fan.hub;
            let height = offset.dot(fan.normal);
            (low, high, reach) = (low.min(height), high.max(height), reach.max(offset.abs().max_element()));
        }
        // Heights are off by less than this, and the normal's components add up to less than 2.
        let room = 2.0 * (ROUNDING * reach + self.slack);
        low - fan.high > room || fan.low - high > room
    }
}
