// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces of exactly zero area leave without a crack.
//!
//! Flat faces that share edges lie on one line. Every edge of theirs is cut at those of their corners that lie on
//! it, whichever face it belongs to: the neighbour over the longest edge of a flat triangle gets the corner
//! between. Each piece of the line then has an even number of flat faces, so that edges without these are
//! closed or open as they were with them.

use super::Repairs;
use super::work::Work;
use crate::error::{Error, Result, filled, try_with_capacity};
use crate::math::Aabb;
use crate::mesh::clean::Corner;
use crate::mesh::edges::Edges;
use crate::mesh::faces::{Sets, starts_from_counts};
use crate::primitive::polygon::are_collinear;
use std::ops::Range;

/// Taking out flat faces may leave others flat. Beyond these rounds they stay.
const ROUNDS: usize = 16;

/// Flat faces whose edges pass each other's corners more often than this for each corner stay: cutting them would
/// take quadratic space.
const CUTS_FOR_A_CORNER: usize = 64;

/// Takes out flat faces.
pub(super) fn take_out(work: &mut Work, repairs: &mut Repairs) -> Result<()> {
    for _ in 0..ROUNDS {
        let Some(lines) = Lines::find(work)? else { break };
        if !lines.leave(work, repairs)? {
            break;
        }
    }
    Ok(())
}

/// Whether all corners of a face lie on one line.
fn is_flat(work: &Work, f: usize) -> bool {
    let corners = work.faces.face(f);
    let at = |v: u32| work.positions[v as usize];
    let first = at(corners[0]);
    let Some(second) = corners.iter().map(|&v| at(v)).find(|p| *p != first) else { return true };
    corners.iter().all(|&v| are_collinear(first, second, at(v)))
}

/// Flat faces by the line on which they lie.
struct Lines {
    flat: Vec<bool>,
    edges: Edges,
    of_half_edge: Vec<u32>,
    /// The lowest flat face of the line, for each flat face.
    line: Vec<u32>,
    /// The half-edges of flat faces which have no partner among them, by line, as half-edges of edges.
    start: Vec<u32>,
    outer: Vec<u32>,
}

impl Lines {
    /// None where no face is flat.
    fn find(work: &Work) -> Result<Option<Lines>> {
        let count = work.faces.len();
        let mut flat = try_with_capacity("faces", count)?;
        flat.extend((0..count).map(|f| is_flat(work, f)));
        if !flat.contains(&true) {
            return Ok(None);
        }
        let edges = Edges::of(work.positions.len(), work.faces.half_edges())?;
        let of_half_edge = work.faces.of_half_edges()?;
        let face = |h: u32| of_half_edge[h as usize] as usize;
        let mut sets = Sets::new(count)?;
        for edge in edges.iter() {
            let h = edge[0];
            let ends = [h, work.next(face(h), h)].map(|c| work.positions[work.faces.corners[c as usize] as usize]);
            let mut degenerate_faces = edge.iter().map(|&h| face(h)).filter(|f| flat[*f]);
            // An edge of no length lies on many lines.
            if let (Some(first), true) = (degenerate_faces.next(), ends[0] != ends[1]) {
                degenerate_faces.for_each(|f| sets.join(first as u32, f as u32));
            }
        }
        let mut line = try_with_capacity("faces", count)?;
        line.extend((0..count as u32).map(|f| sets.find(f)));
        let mut lines =
            Lines { flat, edges, of_half_edge, line, start: filled("lines", count + 1, 0)?, outer: Vec::new() };
        lines.gather_outer_edges()?;
        Ok(Some(lines))
    }

    fn face(&self, h: u32) -> usize {
        self.of_half_edge[h as usize] as usize
    }

    /// The numbers of edges, by line, that are not what just two flat faces of the line have in common.
    fn gather_outer_edges(&mut self) -> Result<()> {
        let mut found = Vec::new();
        for edge in self.edges.iter() {
            let flat = edge.iter().map(|&h| self.face(h)).filter(|f| self.flat[*f]);
            let mut lines = flat.map(|f| self.line[f]);
            let Some(first) = lines.next() else { continue };
            let inner = edge.len() == 2 && lines.next() == Some(first);
            if !inner {
                found.try_reserve(edge.len()).map_err(|_| Error::memory("edges", found.len() + edge.len()))?;
                found.extend(edge.iter().map(|&h| (first, h)));
            }
        }
        for &(line, _) in &found {
            self.start[line as usize] += 1;
        }
        starts_from_counts(&mut self.start);
        self.outer = filled("half-edges", found.len(), 0)?;
        let mut next = try_with_capacity("lines", self.start.len())?;
        next.extend_from_slice(&self.start);
        for (line, h) in found {
            let slot: &mut u32 = &mut next[line as usize];
            self.outer[*slot as usize] = h;
            *slot += 1;
        }
        Ok(())
    }

    /// Cuts the edges of each line and takes its faces out; false where nothing could be done.
    fn leave(&self, work: &mut Work, repairs: &mut Repairs) -> Result<bool> {
        let mut corners_of_line = filled("lines", self.flat.len(), 0usize)?;
        for f in (0..self.flat.len()).filter(|&f| self.flat[f]) {
            corners_of_line[self.line[f] as usize] += work.faces.face(f).len();
        }
        let mut cuts = Cuts::default();
        let mut stays = filled("lines", self.flat.len(), false)?;
        for line in (0..self.flat.len()).filter(|&k| corners_of_line[k] > 0) {
            stays[line] = !self.cut(work, line, CUTS_FOR_A_CORNER * corners_of_line[line], &mut cuts)?;
        }
        let leaves = |f: usize| self.flat[f] && !stays[self.line[f] as usize];
        let gone = (0..self.flat.len()).filter(|&f| leaves(f)).count();
        if gone == 0 {
            return Ok(false);
        }
        cuts.of.sort_unstable_by_key(|cut| cut.half_edge);
        let mut rings = work.rings(cuts.corners.len())?;
        let mut next = cuts.of.iter().peekable();
        let mut emptied = 0;
        for f in (0..self.flat.len()).filter(|&f| !leaves(f)) {
            for h in work.faces.start[f]..work.faces.start[f + 1] {
                rings.add(work.corner(h));
                // Cuts of half-edges before this one are those of faces that leave.
                while let Some(cut) = next.next_if(|cut| cut.half_edge <= h) {
                    if cut.half_edge == h {
                        cuts.corners[cut.range.clone()].iter().for_each(|corner| rings.add(*corner));
                        repairs.corners_added += cut.range.len();
                    }
                }
            }
            emptied += usize::from(!rings.end(work.faces.input[f]));
        }
        repairs.degenerate_faces += gone + emptied;
        work.replace(rings)?;
        Ok(true)
    }

    /// Cuts the edges of a line at the corners that lie on it; false, and nothing done, where that is too much.
    fn cut(&self, work: &Work, line: usize, most: usize, cuts: &mut Cuts) -> Result<bool> {
        let outer = &self.outer[self.start[line] as usize..self.start[line + 1] as usize];
        let is_own = |h: u32| self.flat[self.face(h)] && self.line[self.face(h)] as usize == line;
        let mut corners: Vec<Corner> = try_with_capacity("corners", 2 * outer.len())?;
        for &h in outer.iter().filter(|h| is_own(**h)) {
            corners.extend([work.corner(h), work.corner(work.next(self.face(h), h))]);
        }
        let at = |v: u32| work.positions[v as usize];
        let bounds = Aabb::of(corners.iter().map(|c| at(c.0)));
        let size = bounds.hi - bounds.lo;
        let axis = (0..3).fold(0, |best, k| if size[k] > size[best] { k } else { best });
        // Corners of equal positions follow one another by their numbers, the same way for every edge.
        let order = |v: u32, w: u32| at(v)[axis].total_cmp(&at(w)[axis]).then(v.cmp(&w));
        corners.sort_unstable_by(|a, b| order(a.0, b.0).then(a.1.cmp(&b.1)));
        corners.dedup_by_key(|corner| corner.0);
        let before = (cuts.corners.len(), cuts.of.len());
        for &h in outer.iter().filter(|h| !is_own(**h)) {
            let [from, to] = [h, work.next(self.face(h), h)].map(|h| work.corner(h).0);
            let forward = order(from, to).is_lt();
            let (low, high) = if forward { (from, to) } else { (to, from) };
            let first = corners.partition_point(|c| order(c.0, low).is_le());
            let between = &corners[first..corners.partition_point(|c| order(c.0, high).is_lt()).max(first)];
            if cuts.corners.len() - before.0 + between.len() > most {
                cuts.corners.truncate(before.0);
                cuts.of.truncate(before.1);
                return Ok(false);
            }
            cuts.add(h, between, forward)?;
        }
        Ok(true)
    }
}

/// Half-edges with the corners to put between their ends.
#[derive(Default)]
struct Cuts {
    corners: Vec<Corner>,
    of: Vec<Cut>,
}

struct Cut {
    half_edge: u32,
    range: Range<usize>,
}

impl Cuts {
    fn add(&mut self, half_edge: u32, between: &[Corner], forward: bool) -> Result<()> {
        if between.is_empty() {
            return Ok(());
        }
        let start = self.corners.len();
        self.corners.try_reserve(between.len()).map_err(|_| Error::memory("corners", start + between.len()))?;
        self.of.try_reserve(1).map_err(|_| Error::memory("edges", self.of.len() + 1))?;
        self.corners.extend_from_slice(between);
        if !forward {
            self.corners[start..].reverse();
        }
        self.of.push(Cut { half_edge, range: start..self.corners.len() });
        Ok(())
    }
}
