// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where a surface meets itself beyond the edges and vertices that its triangles share.
//!
//! Triangles that share a vertex are looked at vertex by vertex (`star.rs`): most stars are proved clear at
//! once. All others are pairs whose boxes meet, which the hierarchy finds; most of these are proved clear by an
//! axis. What is left is decided by exact predicates. Nothing is quadratic in the faces at a vertex (`hub.rs`).

mod collect;
mod groups;
mod hub;
mod star;

use crate::bvh::{Leaves, Pairs, Scratch, Tree};
use crate::error::{Error, Result, filled};
use crate::math::{Aabb, Vec3};
use crate::mesh::{HalfEdges, Triangle};
use crate::parallel::Run;
use crate::primitive::contact::{are_clear, folded, meet_beyond_corner, triangles_touch};
use crate::primitive::polygon::are_collinear;
use crate::primitive::triangle::{Prepared, V3, nearest};
use collect::{Chunk, Collector};
use groups::Groups;
use std::ops::Range;

/// Vertices and leaves of a chunk of work.
const VERTICES: usize = 4096;
const LEAVES: usize = 256;

/// Triangles for a thread to do in one go.
const PIECE: usize = 4096;

/// Leaves whose pairs wait for being looked at.
const FEW: usize = 32;

/// The surface to look at. No two triangles have the same three vertices unless their faces overlap.
pub(crate) struct Contacts<'a> {
    vertices: &'a [Vec3],
    triangles: &'a [Triangle],
    /// The topology of the triangles: its face k is triangle k.
    topology: &'a HalfEdges,
    /// Triangles without area, which are left out: the edges that they consist of are their neighbours'.
    flat: Vec<bool>,
    /// Triangles that share no vertex or one alone also count as meeting where a corner of one, other than that
    /// vertex, is not farther than this from the other.
    slack: f64,
    /// Whether the triangles that one face was cut into may meet each other.
    faces_alone: bool,
}

/// What was found: pairs of triangles that meet, and whether these are all.
pub(crate) struct Found {
    pub pairs: Vec<[u32; 2]>,
    pub complete: bool,
}

impl<'a> Contacts<'a> {
    /// `faces_alone`: the triangles that one face was cut into do not count against each other.
    pub fn new(
        vertices: &'a [Vec3],
        triangles: &'a [Triangle],
        topology: &'a HalfEdges,
        slack: f64,
        faces_alone: bool,
        run: &Run,
    ) -> Result<Self> {
        let mut flat = filled("triangles", triangles.len(), false)?;
        run.silent().for_each_piece(&mut flat, PIECE, &|from, piece| {
            for (flat, t) in piece.iter_mut().zip(&triangles[from..]) {
                let [a, b, c] = t.corners(vertices);
                *flat = are_collinear(a, b, c);
            }
            Ok(())
        })?;
        Ok(Contacts { vertices, triangles, topology, flat, slack, faces_alone })
    }

    /// The box of a triangle, with room for the slack.
    fn bounds(&self, t: u32) -> Aabb {
        let b = Aabb::of(self.corners(t));
        Aabb::new(b.lo - self.slack, b.hi + self.slack)
    }

    /// Pairs of triangles that meet: all of them, or the first `limit` that are found. `tree` is over their boxes. The
    /// order of the search, and so what is found, does not depend on the run.
    pub fn find(&self, tree: &Tree, leaves: &Leaves, limit: usize, run: &Run) -> Result<Found> {
        let groups = self.groups()?;
        let pairs = Pairs::new(tree, &leaves.order, &leaves.start, |t| self.bounds(t), &groups.of_triangle, run)?;
        let stars = self.vertices.len().div_ceil(VERTICES);
        let chunks = stars + pairs.leaf_count().div_ceil(LEAVES);
        let collector = Collector::new(chunks, limit)?;
        run.for_each_chunk(chunks, &|chunk| {
            let mut found = collector.chunk(chunk);
            match chunk.checked_sub(stars) {
                None => {
                    let to = self.vertices.len().min((chunk + 1) * VERTICES);
                    self.in_stars(chunk * VERTICES..to, &mut found)?;
                }
                Some(leaves) => {
                    let to = pairs.leaf_count().min((leaves + 1) * LEAVES);
                    self.among_leaves(&pairs, &groups, leaves * LEAVES..to, &mut found)?;
                }
            }
            collector.hand_in(found)
        })?;
        Ok(collector.finish())
    }

    /// Pairs that share no vertex.
    fn among_leaves(&self, pairs: &Pairs, groups: &Groups, leaves: Range<usize>, found: &mut Chunk) -> Result<()> {
        let apart = |members: &[u32], group: u32| self.is_apart(members, groups.fans[group as usize]);
        let (mut scratch, mut near) = (Scratch::default(), Vec::new());
        for from in leaves.clone().step_by(FEW) {
            near.clear();
            pairs.of_leaves(from..leaves.end.min(from + FEW), &apart, &mut scratch, &mut near)?;
            for &[s, t] in &near {
                if self.touch_apart(s, t) {
                    found.add([s, t])?;
                }
            }
            if found.is_enough() {
                break;
            }
        }
        Ok(())
    }

    fn corners(&self, t: u32) -> [Vec3; 3] {
        self.triangles[t as usize].corners(self.vertices)
    }

    /// Whether two triangles are of any interest to each other.
    fn may_meet(&self, s: u32, t: u32) -> bool {
        let same_face = self.triangles[s as usize].face == self.triangles[t as usize].face;
        let is_flat = self.flat[s as usize] || self.flat[t as usize];
        !(is_flat || self.faces_alone && same_face)
    }

    /// Whether two triangles that share no vertex meet; false where they share one.
    fn touch_apart(&self, s: u32, t: u32) -> bool {
        let (u, v) = (self.triangles[s as usize].vertices, self.triangles[t as usize].vertices);
        if u.iter().any(|a| v.contains(a)) || !self.may_meet(s, t) {
            return false;
        }
        let (c, d) = (self.corners(s), self.corners(t));
        if are_clear(&c, &d, self.slack) {
            return false;
        }
        triangles_touch(c, d) || self.is_near(&c, d) || self.is_near(&d, c)
    }

    /// Whether two triangles that share vertices meet beyond them, where `corner` is the lowest that they share.
    fn touch_at(&self, corner: u32, s: u32, t: u32) -> bool {
        if !self.may_meet(s, t) {
            return false;
        }
        let (u, v) = (self.triangles[s as usize].vertices, self.triangles[t as usize].vertices);
        let is_shared = |a: &u32| v.contains(a);
        if u.iter().any(|a| *a < corner && is_shared(a)) {
            return false;
        }
        let from = |v: [u32; 3], first: u32| {
            let k = v.iter().position(|a| *a == first).unwrap_or(0);
            [v[k], v[(k + 1) % 3], v[(k + 2) % 3]].map(|a| self.vertices[a as usize])
        };
        let (c, d) = (from(u, corner), from(v, corner));
        match u.iter().filter(|a| is_shared(a)).count() {
            1 => meet_beyond_corner(c, d) || self.is_near(&c[1..], d) || self.is_near(&d[1..], c),
            2 => {
                let apart = v.iter().find(|a| !u.contains(a)).unwrap_or(&v[0]);
                let own = u.iter().find(|a| !is_shared(a)).unwrap_or(&u[0]);
                // Its edge opposite to the third corner comes first.
                let [third, a, b] = from(u, *own);
                folded(self.vertices[*apart as usize], [a, b, third])
            }
            _ => true,
        }
    }

    /// Whether one of the points is not farther than the slack from a triangle.
    fn is_near(&self, points: &[Vec3], triangle: [Vec3; 3]) -> bool {
        if self.slack == 0.0 {
            return false;
        }
        let prepared = Prepared::new(triangle);
        points.iter().any(|p| nearest(&prepared, V3::from_vec(*p)).squared <= self.slack * self.slack)
    }
}

/// Room for some more pairs.
fn reserve(pairs: &mut Vec<[u32; 2]>, more: usize) -> Result<()> {
    pairs.try_reserve(more).map_err(|_| Error::memory("pairs", pairs.len() + more))
}
