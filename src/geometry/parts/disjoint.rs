// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether no two parts have a point in common: then the least of their exact distances is exact, inside
//! one of them as well as outside of all.

use super::Parts;
use super::hierarchy::as_sphere;
use crate::math::{Aabb, Interval, length};

/// Parts that come up beside another, for each part and in all, before it is left open.
const NEAR_A_PART: usize = 64;
const NEAR: usize = 1024;

impl Parts {
    /// Whether it is proved that no two parts (turned: no two complements) have a point in common.
    pub(in crate::geometry) fn are_disjoint(&self) -> bool {
        *self.apart.get_or_init(|| self.are_found_disjoint())
    }

    fn are_found_disjoint(&self) -> bool {
        let mut left = NEAR + NEAR_A_PART * self.list.len();
        (0..self.list.len()).all(|a| {
            // Where parts are of very different sizes the hierarchy brings up many.
            let (near, looked_at) = self.meeting_of(self.bounds(a));
            left = left.saturating_sub(looked_at);
            left > 0
                && near
                    .into_iter()
                    .filter(|&b| b > a)
                    .all(|b| self.misses(a, b) || self.misses(b, a) || self.balls_miss(a, b))
        })
    }

    /// Whether part `a` is wholly outside of the box around part `b`.
    fn misses(&self, a: usize, b: usize) -> bool {
        let around: Aabb = self.bounds(b);
        if around.is_empty() || !around.is_finite() {
            return false;
        }
        let range: Interval = self.list[a].range(around);
        range.sign() == if self.turned { -1 } else { 1 }
    }

    fn balls_miss(&self, a: usize, b: usize) -> bool {
        match (as_sphere(&self.list[a]), as_sphere(&self.list[b])) {
            (Some(a), Some(b)) if !self.turned => {
                let size = a.center.abs().max(b.center.abs()).max_element() + a.radius + b.radius;
                length(a.center - b.center) > a.radius + b.radius + 16.0 * f64::EPSILON * size
            }
            _ => false,
        }
    }
}
