// SPDX-License-Identifier: MIT OR Apache-2.0
//! Many parts of which the least value wins (a union), or, turned, the greatest (an intersection: the least
//! of the values with their signs turned). Over more than a few parts with finite bounds it has hierarchies
//! of its own; parts without stand beside them. The answers are those of asking every part, to the bit.

mod disjoint;
mod hierarchy;
mod pack;
mod search;
mod spheres;

pub(super) use search::Found;

use super::Geometry;
use super::classify::LEAST;
use super::summary::{ROOT_OF_THREE, extent, grown};
use crate::error::Result;
use crate::math::{Aabb, Interval, Vec3};
use hierarchy::Hierarchy;
use std::sync::OnceLock;

/// Fewer parts than this are asked one after another.
const MANY: usize = 4;

/// Below this many levels of nodes there is no hierarchy: its search needs stack.
const DEEP: usize = 64;

/// A box that meets more parts than this is taken as mixed.
const MOST_IN_A_BOX: usize = 256;

/// The parts near a box.
pub(super) enum Near {
    /// In order.
    All(Vec<usize>),
    /// More than were wanted.
    Crowd,
    Unknown,
}

/// Parts that are looked at for each that a search near a box may find.
const LOOKED_AT: usize = 3;

pub(super) struct Parts {
    list: Vec<Geometry>,
    /// Whether the signs of all values are turned.
    turned: bool,
    hierarchy: Option<Box<Hierarchy>>,
    /// Whether no two have a point in common, where that was asked.
    apart: OnceLock<bool>,
}

impl Parts {
    pub(super) fn new(list: Vec<Geometry>, turned: bool) -> Result<Parts> {
        let depth = list.iter().map(|g| g.summary().depth).max().unwrap_or(0);
        let hierarchy = match list.len() >= MANY && depth < DEEP {
            true => Hierarchy::new(&list, turned)?.map(Box::new),
            false => None,
        };
        Ok(Parts { list, turned, hierarchy, apart: OnceLock::new() })
    }

    pub(super) fn list(&self) -> &[Geometry] {
        &self.list
    }

    pub(super) fn is_turned(&self) -> bool {
        self.turned
    }

    /// Memory beside the parts' own.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.list[..]) + self.hierarchy.as_ref().map_or(0, |h| h.bytes())
    }

    /// The value of a part, turned where all are.
    fn signed(&self, part: usize, p: Vec3) -> f64 {
        let value = self.list[part].raw_value(p);
        if self.turned { -value } else { value }
    }

    /// Around a part, or, turned, around the rest of space.
    fn bounds(&self, part: usize) -> Aabb {
        around(&self.list[part], self.turned)
    }

    /// The parts, in order, whose bounds may meet a box.
    pub(super) fn meeting(&self, b: Aabb) -> Vec<usize> {
        self.meeting_of(b).0
    }

    /// The same, and how many were looked at.
    fn meeting_of(&self, b: Aabb) -> (Vec<usize>, usize) {
        let (mut found, mut looked_at) = (Vec::new(), self.list.len());
        match &self.hierarchy {
            Some(hierarchy) => {
                hierarchy.meeting(b, |part| found.push(part));
                looked_at = found.len();
                found.retain(|&part| hierarchy.is_beside(part) || !self.bounds(part).intersection(b).is_empty());
            }
            None => found.extend((0..self.list.len()).filter(|&k| !self.bounds(k).intersection(b).is_empty())),
        }
        found.sort_unstable();
        (found, looked_at)
    }

    /// Whether there is a hierarchy.
    pub(super) fn is_ordered(&self) -> bool {
        self.hierarchy.is_some()
    }

    /// The parts, in order, whose value (signs turned where all are) may come within `support` of the least of all
    /// somewhere in a finite box and be below `far`.
    pub(super) fn near_box(&self, b: Aabb, support: f64, far: f64, most: usize) -> Near {
        let middle = self.least(b.center());
        let (Some(hierarchy), Some(winner)) = (&self.hierarchy, self.list.get(middle.part)) else {
            return Near::Unknown;
        };
        let range = winner.range_from_middle(b);
        let highest = if self.turned { -range.lo } else { range.hi };
        let reach = hierarchy.bound((highest + support).min(far), ROOT_OF_THREE * extent(b));
        if !reach.is_finite() {
            return Near::Unknown;
        }
        let near = grown(b, Vec3::splat(reach.max(0.0)));
        let (mut found, mut looked_at) = (Vec::new(), 0);
        let is_full = hierarchy.any_meeting(near, |part| {
            looked_at += 1;
            // What a crowd costs is fetching each one from memory.
            if looked_at > LOOKED_AT * most {
                return true;
            }
            if hierarchy.is_beside(part) || !self.bounds(part).intersection(near).is_empty() {
                found.push(part);
            }
            found.len() > most
        });
        if is_full {
            return Near::Crowd;
        }
        if found.is_empty() {
            // All are beyond `far`: one of them says so.
            found.push(middle.part);
        }
        found.sort_unstable();
        Near::All(found)
    }

    /// The least value (signs turned where all are) over a finite box. What is `beyond` or more need not be
    /// told apart.
    pub(super) fn range(&self, b: Aabb, beyond: f64) -> Interval {
        let spread = self.list.iter().map(|g| g.summary().spread_axis).fold(1.0, f64::max);
        let spread = self.hierarchy.as_ref().map_or(spread, |h| h.spread());
        // Parts farther off are positive, and by more than `beyond`.
        let near = grown(b, Vec3::splat(if beyond > 0.0 { beyond * spread } else { 0.0 }));
        let found =
            if beyond > 0.0 && !spread.is_finite() { (0..self.list.len()).collect() } else { self.meeting(near) };
        if found.len() > MOST_IN_A_BOX {
            return Interval::ALL;
        }
        let mut least = Interval { lo: beyond.max(LEAST), hi: f64::INFINITY };
        for &part in &found {
            let range = self.list[part].range(b);
            least = least.min(if self.turned { -range } else { range });
        }
        least
    }
}

/// Around a body, or, turned, around the rest of space. Bounds that miss each other by rounding stand in
/// wrong order.
fn around(g: &Geometry, turned: bool) -> Aabb {
    let b = if turned { g.summary().rest } else { g.summary().bounds };
    if b == Aabb::EMPTY { b } else { Aabb::new(b.lo.min(b.hi), b.lo.max(b.hi)) }
}
