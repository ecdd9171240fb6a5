// SPDX-License-Identifier: MIT OR Apache-2.0
//! One of each set of copies, for what would otherwise be asked of all of them.

use super::{Intersections, Mesh, push};
use crate::error::{Result, filled, try_with_capacity};
use crate::mesh::Triangle;
use crate::mesh::duplicates::{self, Repeats};
use crate::mesh::faces::starts_from_counts;

/// Faces that others repeat, and the triangles without the repetitions.
pub(crate) struct Copies {
    /// Of the earliest of each set of copies, in order.
    pub triangles: Vec<Triangle>,
    /// By input face, ascending, those that are the earliest: each with its copies, itself included.
    start: Vec<u32>,
    copies: Vec<u32>,
}

impl Mesh {
    /// None where no face repeats another.
    pub(crate) fn copies(&self) -> Result<Option<Copies>> {
        if self.report.duplicate_faces == 0 {
            return Ok(None);
        }
        let faces = self.half_edges.faces();
        let Repeats { either_way, .. } = duplicates::find(faces, self.vertices.len())?;
        let mut triangles = Vec::new();
        for f in (0..faces.len()).filter(|f| either_way[*f] as usize == *f) {
            for t in &self.triangles[faces.triangles_of(f)] {
                push(&mut triangles, "triangles", *t)?;
            }
        }
        let mut start = filled("faces", self.face_count + 1, 0u32)?;
        for first in &either_way {
            start[faces.input[*first as usize] as usize] += 1;
        }
        starts_from_counts(&mut start);
        let mut next = try_with_capacity("faces", start.len())?;
        next.extend_from_slice(&start);
        let mut copies = filled("faces", faces.len(), 0u32)?;
        for (f, first) in either_way.iter().enumerate() {
            let slot = &mut next[faces.input[*first as usize] as usize];
            copies[*slot as usize] = faces.input[f];
            *slot += 1;
        }
        Ok(Some(Copies { triangles, start, copies }))
    }
}

impl Copies {
    /// The copies of an input face that is the earliest of them.
    fn of(&self, face: u32) -> &[u32] {
        &self.copies[self.start[face as usize] as usize..self.start[face as usize + 1] as usize]
    }

    /// Each copy of a face meets what the face meets: all pairs are counted, no more than `limit` are listed.
    pub(crate) fn intersections(&self, pairs: &[[u32; 2]], complete: bool, limit: usize) -> Result<Intersections> {
        let mut all = Intersections { complete, ..Intersections::default() };
        for &[f, g] in pairs {
            let (ours, theirs) = (self.of(f), self.of(g));
            all.count = all.count.saturating_add(ours.len() as u64 * theirs.len() as u64);
            let room = limit - all.pairs.len();
            for (a, b) in ours.iter().flat_map(|a| theirs.iter().map(move |b| (*a, *b))).take(room) {
                push(&mut all.pairs, "pairs", [a.min(b), a.max(b)])?;
            }
        }
        all.pairs.sort_unstable();
        Ok(all)
    }
}
