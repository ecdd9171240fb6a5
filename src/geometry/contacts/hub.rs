// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices of many triangles. Near the vertex a triangle is the set of directions between its two edges, an arc
//! on the unit sphere, and two triangles meet beyond the vertex just where their arcs meet: a hierarchy over the
//! arcs finds the pairs. Triangles at one edge of the vertex are half-planes around that edge, and fold onto each
//! other just where their directions around it agree: a hierarchy over these finds the pairs.

use super::Contacts;
use super::collect::Chunk;
use super::groups::GROUP;
use crate::bvh::{ALONE, LEAF_SIZE, Pairs, Scratch, Tree};
use crate::error::{Error, Result, try_with_capacity};
use crate::math::{Aabb, length, unit};
use crate::parallel::Run;

/// Room for the rounding of a unit vector.
const ROUNDING: f64 = 1e-14;

/// A triangle at a vertex.
#[derive(Clone, Copy)]
struct Spread {
    triangle: u32,
    ends: [u32; 2],
}

impl Contacts<'_> {
    /// Pairs of triangles at `hub`.
    pub(super) fn in_hub(&self, hub: u32, found: &mut Chunk) -> Result<()> {
        let leaving = self.topology.outgoing(hub);
        let mut spreads = try_with_capacity("triangles", leaving.len())?;
        spreads.extend(leaving.iter().map(|h| h / 3).filter(|t| !self.flat[*t as usize]).map(|triangle| {
            let [a, b, c] = self.triangles[triangle as usize].vertices;
            let ends = if a == hub { [b, c] } else { [a, if b == hub { c } else { b }] };
            Spread { triangle, ends }
        }));
        let shared = crowded(&spreads)?;
        let mut groups = Vec::new();
        if !shared.is_empty() {
            groups = try_with_capacity("groups", spreads.len())?;
            let is_shared = |v: &&u32| shared.binary_search(v).is_ok();
            groups.extend(spreads.iter().map(|s| s.ends.iter().filter(is_shared).min().copied().unwrap_or(ALONE)));
        }
        self.test_pairs(hub, &spreads, |s| self.arc(hub, s), &groups, found)?;
        let mut pages = try_with_capacity("triangles", groups.len())?;
        pages.extend(spreads.iter().zip(&groups).filter(|(_, group)| **group != ALONE).map(|(s, group)| (*group, *s)));
        pages.sort_by_key(|(group, _)| *group);
        // Of an edge to a lower vertex that vertex takes care.
        for book in pages.chunk_by(|a, b| a.0 == b.0).filter(|book| book[0].0 > hub) {
            let mut leaves = try_with_capacity("triangles", book.len())?;
            leaves.extend(book.iter().map(|(_, s)| *s));
            self.test_pairs(hub, &leaves, |s| self.page(hub, book[0].0, s), &[], found)?;
        }
        Ok(())
    }

    /// Tests the pairs whose boxes meet.
    fn test_pairs(
        &self,
        hub: u32,
        spreads: &[Spread],
        bounds: impl Fn(&Spread) -> Aabb,
        groups: &[u32],
        found: &mut Chunk,
    ) -> Result<()> {
        if spreads.is_empty() {
            return Ok(());
        }
        let mut boxes = try_with_capacity("boxes", spreads.len())?;
        boxes.extend(spreads.iter().map(bounds));
        let serial = Run::SERIAL;
        let (tree, leaves) = Tree::build(boxes.len(), &|k| boxes[k], LEAF_SIZE, &serial)?;
        let pairs = Pairs::new(&tree, &leaves.order, &leaves.start, |k| boxes[k as usize], groups, &serial)?;
        let (mut scratch, mut near) = (Scratch::default(), Vec::new());
        for leaf in 0..pairs.leaf_count() {
            near.clear();
            pairs.of_leaves(leaf..leaf + 1, &|_, _| false, &mut scratch, &mut near)?;
            for pair in &near {
                let [s, t] = pair.map(|k| spreads[k as usize].triangle);
                if self.touch_at(hub, s, t) {
                    found.add([s, t])?;
                }
            }
            if found.is_enough() {
                break;
            }
        }
        Ok(())
    }

    /// The box around the directions of a triangle, seen from a corner.
    fn arc(&self, hub: u32, spread: &Spread) -> Aabb {
        let to = spread.ends.map(|v| self.vertices[v as usize] - self.vertices[hub as usize]);
        let chord = Aabb::of(to.map(unit));
        let half = 0.5 * length(unit(to[1]) - unit(to[0]));
        let sagitta = 1.0 - (1.0 - half * half).max(0.0).sqrt();
        // A point this near to the triangle is seen in about this angle beside it.
        let nearest = length(to[0]).min(length(to[1]));
        let beside = if 4.0 * self.slack < nearest { 2.0 * self.slack / nearest } else { 2.0 };
        let room = sagitta + ROUNDING + if self.slack > 0.0 { beside } else { 0.0 };
        Aabb::new(chord.lo - room, chord.hi + room)
    }

    /// The box around the direction of a triangle, seen along its edge from `hub` to `other`.
    fn page(&self, hub: u32, other: u32, spread: &Spread) -> Aabb {
        let apex = if spread.ends[0] == other { spread.ends[1] } else { spread.ends[0] };
        let from = self.vertices[hub as usize];
        let along = unit(self.vertices[other as usize] - from);
        let spoke = self.vertices[apex as usize] - from;
        let across = spoke - along * spoke.dot(along);
        let rounding = 16.0 * f64::EPSILON * length(spoke) / length(across);
        // What is no number, 0 / 0, is all directions.
        let room = rounding.min(2.0) + ROUNDING;
        let direction = unit(across);
        Aabb::new(direction - room, direction + room)
    }
}

/// The vertices that many of the triangles at a vertex share with it, ascending.
fn crowded(spreads: &[Spread]) -> Result<Vec<u32>> {
    let mut ends = try_with_capacity("vertices", 2 * spreads.len())?;
    ends.extend(spreads.iter().flat_map(|s| s.ends));
    ends.sort_unstable();
    let mut shared = Vec::new();
    for run in ends.chunk_by(|a, b| a == b).filter(|run| run.len() >= GROUP) {
        shared.try_reserve(1).map_err(|_| Error::memory("vertices", shared.len()))?;
        shared.push(run[0]);
    }
    Ok(shared)
}
