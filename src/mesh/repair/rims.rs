// SPDX-License-Identifier: MIT OR Apache-2.0
//! The rims of holes: edges of one face, followed from fan to fan.

use super::fans::fans;
use super::push;
use super::work::Work;
use crate::error::{Result, filled, try_with_capacity};
use crate::mesh::edges::{Edges, NONE};

/// A corner of a rim, and whether the edge from it to the next one is walked the way its face runs.
#[derive(Clone, Copy)]
pub(super) struct Step {
    /// The half-edge whose face has the edge.
    pub half_edge: u32,
    pub along: bool,
}

/// The rims of a surface.
pub(super) struct Rims {
    steps: Vec<Step>,
    /// Where each ends.
    end: Vec<usize>,
    /// Walks that come to an end where more than two faces meet.
    pub broken: usize,
}

impl Rims {
    /// Follows the edges of one face. Rims that pass a vertex twice are cut apart there, so each passes a vertex once.
    pub fn of(work: &Work, edges: &Edges, of_half_edge: &[u32]) -> Result<Rims> {
        let mut rims = Rims { steps: Vec::new(), end: Vec::new(), broken: 0 };
        let mut open = Vec::new();
        for edge in edges.iter().filter(|edge| edge.len() == 1) {
            push(&mut open, "edges", edge[0])?;
        }
        if open.is_empty() {
            return Ok(rims);
        }
        open.sort_unstable();
        let partner = partners(work, edges, of_half_edge, &open)?;
        let mut walk = Walk {
            work,
            of_half_edge,
            place: filled("vertices", work.positions.len(), NONE)?,
            steps: try_with_capacity("edges", open.len())?,
        };
        rims.steps = try_with_capacity("edges", open.len())?;
        let mut seen = filled("edges", open.len(), false)?;
        for first in 0..open.len() {
            if seen[first] {
                continue;
            }
            // The end of an edge has twice its number, its other end one more.
            let start = 2 * first as u32;
            let (mut from, mut closed) = (start, true);
            walk.steps.clear();
            loop {
                let k = from as usize / 2;
                seen[k] = true;
                walk.steps.push(Step { half_edge: open[k], along: from.is_multiple_of(2) });
                from = partner[(from ^ 1) as usize];
                if from == start {
                    break;
                }
                if from == NONE {
                    closed = false;
                    break;
                }
            }
            if closed {
                walk.cut_apart(&mut rims)?;
            } else {
                rims.broken += 1;
                // What lies before the first edge of this walk belongs to it.
                let mut back = partner[start as usize];
                while back != NONE {
                    seen[back as usize / 2] = true;
                    back = partner[(back ^ 1) as usize];
                }
            }
        }
        Ok(rims)
    }

    pub fn iter(&self) -> impl Iterator<Item = &[Step]> {
        (0..self.end.len()).map(|k| &self.steps[if k == 0 { 0 } else { self.end[k - 1] }..self.end[k]])
    }
}

/// For each end of the edges, the end of another edge that the same fan leads to.
fn partners(work: &Work, edges: &Edges, of_half_edge: &[u32], open: &[u32]) -> Result<Vec<u32>> {
    let mut fans = fans(work, edges, of_half_edge)?;
    let mut ends = try_with_capacity("edges", 2 * open.len())?;
    for (k, &h) in open.iter().enumerate() {
        let target = work.next(of_half_edge[h as usize] as usize, h);
        ends.extend([(fans.find(h), 2 * k as u32), (fans.find(target), 2 * k as u32 + 1)]);
    }
    ends.sort_unstable();
    let mut partner = filled("edges", ends.len(), NONE)?;
    for of_fan in ends.chunk_by(|a, b| a.0 == b.0) {
        if let &[(_, a), (_, b)] = of_fan {
            (partner[a as usize], partner[b as usize]) = (b, a);
        }
    }
    Ok(partner)
}

/// A closed walk along open edges.
struct Walk<'a> {
    work: &'a Work,
    of_half_edge: &'a [u32],
    /// Where on the path a vertex is.
    place: Vec<u32>,
    steps: Vec<Step>,
}

impl Walk<'_> {
    fn vertex(&self, step: Step) -> u32 {
        let h = step.half_edge;
        let corner = if step.along { h } else { self.work.next(self.of_half_edge[h as usize] as usize, h) };
        self.work.faces.corners[corner as usize]
    }

    /// Hands over each part of the walk that comes back to a vertex without passing another twice.
    fn cut_apart(&mut self, rims: &mut Rims) -> Result<()> {
        let mut path: Vec<Step> = try_with_capacity("edges", self.steps.len())?;
        for k in 0..=self.steps.len() {
            let step = self.steps[if k == self.steps.len() { 0 } else { k }];
            let v = self.vertex(step) as usize;
            if self.place[v] != NONE {
                let from = self.place[v] as usize;
                self.forget(&path[from..]);
                rims.steps.extend(path.drain(from..));
                push(&mut rims.end, "rims", rims.steps.len())?;
            }
            self.place[v] = path.len() as u32;
            path.push(step);
        }
        // The first vertex was passed again at the end.
        self.forget(&path);
        Ok(())
    }

    fn forget(&mut self, path: &[Step]) {
        for step in path {
            let v = self.vertex(*step) as usize;
            self.place[v] = NONE;
        }
    }
}
