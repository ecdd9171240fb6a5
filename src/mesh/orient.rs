// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which faces to turn over so that a surface becomes consistent and outward.
//!
//! The rule of [`super::Orient::Auto`], after duplicate faces are gone:
//! 1. Faces that share an edge of exactly two faces get the same orientation: the one that the larger part
//!    of their area had. A patch is what such edges connect. One-sided patches stay as given.
//! 2. Edges of more than two faces carry no orientation. Patches that such edges leave open and that meet
//!    there form one shell; every other patch is a shell of its own. Open and one-sided shells are done.
//! 3. A closed shell that was consistent as given keeps its orientation relative to the outermost closed
//!    shell around it (itself, where there is none): where that one was consistent as given and encloses a
//!    negative volume, both are turned over. So an inside-out part is turned with its cavities, and a
//!    cavity stays one.
//! 4. A closed shell that was inconsistent as given faces outward where an even number of closed shells is
//!    around it, and inward where it is odd.

use super::edges::Edges;
use super::faces::{Faces, Sets, starts_from_counts};
use super::measure::{Sum, area, cone, corners};
use super::{Triangle, nesting};
use crate::error::{Result, filled, try_with_capacity};
use crate::math::{Aabb, Vec3};

/// A surface and its edges, without duplicate faces; `Triangle::face` counts in `faces`.
pub(super) struct Parts<'a> {
    pub vertices: &'a [Vec3],
    pub faces: &'a Faces,
    pub triangles: &'a [Triangle],
    pub edges: &'a Edges,
    pub of_half_edge: &'a [u32],
}

/// The faces to turn over by the rule above; `alternate`: step 4 for every closed shell, and step 3 for none.
pub(super) fn outward(parts: &Parts, alternate: bool) -> Result<Vec<bool>> {
    let mut patches = Patches::flood(parts)?;
    let shell_of_patch = patches.shells(parts)?;
    let mut turned = std::mem::take(&mut patches.turned);
    let shells = Shells::new(parts, &patches, &shell_of_patch, &turned)?;
    let turn_shell = shells.turns(parts.vertices, alternate)?;
    for (f, turn) in turned.iter_mut().enumerate() {
        let shell = shell_of_patch[patches.of_face[f] as usize];
        *turn ^= turn_shell[shells.number[shell as usize] as usize];
    }
    Ok(turned)
}

/// What edges of two faces connect.
struct Patches {
    of_face: Vec<u32>,
    /// Faces that step 1 turns over.
    turned: Vec<bool>,
    /// Of each patch: whether it has boundary edges or only one side.
    open: Vec<bool>,
    /// Of each patch: whether step 1 turned nothing.
    consistent: Vec<bool>,
}

impl Patches {
    fn flood(parts: &Parts) -> Result<Patches> {
        let faces = parts.faces;
        let mates = parts.edges.mates()?;
        let mut areas = filled("faces", faces.len(), 0.0)?;
        for t in parts.triangles {
            areas[t.face as usize] += area(corners(parts.vertices, t));
        }
        let mut patches = Patches {
            of_face: filled("faces", faces.len(), u32::MAX)?,
            turned: filled("faces", faces.len(), false)?,
            open: Vec::new(),
            consistent: Vec::new(),
        };
        let mut members = try_with_capacity("faces", faces.len())?;
        for seed in 0..faces.len() {
            if patches.of_face[seed] == u32::MAX {
                members.clear();
                let one_sided = !patches.spread(parts, &mates, seed as u32, &mut members);
                patches.settle(&members, &areas, one_sided);
            }
        }
        for edge in parts.edges.iter().filter(|edge| edge.len() == 1) {
            let patch = patches.of_face[parts.of_half_edge[edge[0] as usize] as usize];
            patches.open[patch as usize] = true;
        }
        Ok(patches)
    }

    /// Gives the faces around `seed` its orientation; false where there is only one side.
    fn spread(&mut self, parts: &Parts, mates: &[u32], seed: u32, members: &mut Vec<u32>) -> bool {
        let patch = self.open.len() as u32;
        let (mut two_sided, mut next) = (true, 0);
        self.of_face[seed as usize] = patch;
        members.push(seed);
        while let Some(&f) = members.get(next) {
            next += 1;
            let turned = self.turned[f as usize];
            for h in parts.faces.start[f as usize]..parts.faces.start[f as usize + 1] {
                let Some(&g) = parts.of_half_edge.get(mates[h as usize] as usize) else { continue };
                let same_way = parts.faces.corners[h as usize] == parts.faces.corners[mates[h as usize] as usize];
                if self.of_face[g as usize] == u32::MAX {
                    self.of_face[g as usize] = patch;
                    self.turned[g as usize] = turned ^ same_way;
                    members.push(g);
                } else {
                    two_sided &= self.turned[g as usize] == turned ^ same_way;
                }
            }
        }
        two_sided
    }

    /// Keeps what the larger area had, or everything where there is only one side.
    fn settle(&mut self, members: &[u32], areas: &[f64], one_sided: bool) {
        let mut balance = Sum::default();
        for &f in members {
            let area = areas[f as usize];
            balance.add(if self.turned[f as usize] { area } else { -area });
        }
        let other_way = balance.value() > 0.0;
        let mut consistent = true;
        for &f in members {
            let turned = &mut self.turned[f as usize];
            *turned = !one_sided && *turned ^ other_way;
            consistent &= !*turned;
        }
        self.open.push(one_sided);
        self.consistent.push(consistent);
    }

    /// Step 2: the shell of each patch, as the number of one of its patches; marks the open ones.
    fn shells(&mut self, parts: &Parts) -> Result<Vec<u32>> {
        let mut ends = Vec::new();
        let mut alone = filled("patches", self.open.len(), false)?;
        let crowded = || parts.edges.iter().filter(|edge| edge.len() > 2);
        for edge in crowded() {
            self.unbalanced(parts, edge, |patch| patch, &mut ends);
            for &(patch, _) in &ends {
                alone[patch as usize] = true;
            }
        }
        let mut sets = Sets::new(self.open.len())?;
        for edge in crowded() {
            let patches = edge.iter().map(|&h| self.of_face[parts.of_half_edge[h as usize] as usize]);
            let mut first = None;
            for patch in patches.filter(|&p| alone[p as usize]) {
                sets.join(*first.get_or_insert(patch), patch);
            }
        }
        let mut shell = try_with_capacity("patches", self.open.len())?;
        shell.extend((0..self.open.len() as u32).map(|patch| sets.find(patch)));
        for (patch, &shell) in shell.iter().enumerate() {
            let (open, consistent) = (self.open[patch], self.consistent[patch]);
            self.open[shell as usize] |= open;
            self.consistent[shell as usize] &= consistent;
        }
        for edge in crowded() {
            self.unbalanced(parts, edge, |patch| shell[patch as usize], &mut ends);
            for &(shell, _) in &ends {
                self.open[shell as usize] = true;
            }
        }
        Ok(shell)
    }

    /// Of the groups that meet in an edge: those that do not cross it as often one way as the other.
    fn unbalanced(&self, parts: &Parts, edge: &[u32], group: impl Fn(u32) -> u32, out: &mut Vec<(u32, i64)>) {
        let corner = |h: u32| parts.faces.corners[h as usize];
        out.clear();
        out.extend(edge.iter().map(|&h| {
            let f = parts.of_half_edge[h as usize] as usize;
            let along = (corner(h) == corner(edge[0])) ^ self.turned[f];
            (group(self.of_face[f]), if along { 1 } else { -1 })
        }));
        out.sort_unstable();
        out.dedup_by(|next, sum| {
            let same = next.0 == sum.0;
            sum.1 += if same { next.1 } else { 0 };
            same
        });
        out.retain(|&(_, excess)| excess != 0);
    }
}

/// The shells, numbered from 0, with their triangles.
struct Shells {
    /// From the patch that stands for a shell to its number.
    number: Vec<u32>,
    closed: Vec<bool>,
    consistent: Vec<bool>,
    bounds: Vec<Aabb>,
    volume: Vec<f64>,
    grouped: nesting::Grouped,
}

impl Shells {
    fn new(parts: &Parts, patches: &Patches, shell_of_patch: &[u32], turned: &[bool]) -> Result<Shells> {
        let mut number = filled("shells", shell_of_patch.len(), u32::MAX)?;
        let (mut closed, mut consistent) = (Vec::new(), Vec::new());
        for (patch, _) in shell_of_patch.iter().enumerate().filter(|(p, s)| **s as usize == *p) {
            number[patch] = closed.len() as u32;
            closed.push(!patches.open[patch]);
            consistent.push(patches.consistent[patch]);
        }
        let shell = |t: &Triangle| {
            let patch = patches.of_face[t.face as usize];
            number[shell_of_patch[patch as usize] as usize] as usize
        };
        let count = closed.len();
        let mut start = filled("shells", count + 1, 0u32)?;
        let mut bounds = filled("shells", count, Aabb::EMPTY)?;
        for t in parts.triangles {
            start[shell(t)] += 1;
            bounds[shell(t)] = bounds[shell(t)].hull(Aabb::of(corners(parts.vertices, t)));
        }
        starts_from_counts(&mut start);
        let mut next = start.clone();
        let mut triangles = filled("triangles", parts.triangles.len(), [0; 3])?;
        let mut sums = filled("shells", count, Sum::default())?;
        for t in parts.triangles {
            let s = shell(t);
            triangles[next[s] as usize] = t.vertices;
            next[s] += 1;
            let cone = cone(corners(parts.vertices, t), bounds[s].center());
            sums[s].add(if turned[t.face as usize] { -cone } else { cone });
        }
        let volume = sums.into_iter().map(Sum::value).collect();
        Ok(Shells { number, closed, consistent, bounds, volume, grouped: nesting::Grouped { start, triangles } })
    }

    /// Steps 3 and 4: the shells to turn over.
    fn turns(&self, vertices: &[Vec3], alternate: bool) -> Result<Vec<bool>> {
        let mut turn = filled("shells", self.closed.len(), false)?;
        let closed: Vec<u32> = (0..turn.len() as u32).filter(|&s| self.closed[s as usize]).collect();
        let doubtful = |s: &u32| self.volume[*s as usize] < 0.0 || !self.consistent[*s as usize];
        if !alternate && !closed.iter().any(doubtful) {
            return Ok(turn);
        }
        let around = nesting::shells_around(vertices, &self.grouped, &self.bounds, &closed)?;
        for &s in &closed {
            let own = s as usize;
            let outermost = around[own].iter().map(|&c| c as usize).find(|&c| around[c].is_empty()).unwrap_or(own);
            turn[own] = if self.consistent[own] && !alternate {
                self.consistent[outermost] && self.volume[outermost] < 0.0
            } else if around[own].len() % 2 == 0 {
                self.volume[own] < 0.0
            } else {
                self.volume[own] > 0.0
            };
        }
        Ok(turn)
    }
}
