// SPDX-License-Identifier: MIT OR Apache-2.0
//! What an open surface lacks, by its boundary: caps over its loops for the winding number, or the edges of its rim
//! where rays alone decide. Nothing of it is surface: no distance is to it, and nothing meets it.
//!
//! With caps C the surface S is closed, and the winding number W of both is a count of exact crossings. That of S alone
//! is w = W - w(C) (Martens & Bessmeltsev 2025 sweep the boundary to infinity instead). Where the caps are seen under less
//! than half of all directions, |w(C)| < 1/2, the side is W's, and it takes no sum to know it. Elsewhere w(C) comes
//! from clusters of caps, expanded about their middles (Barill et al. 2018) with a bound on what is left out, and where
//! that leaves w on both sides of 1/2, cap by cap.

mod clusters;
mod expansion;
mod pack;

use crate::error::{Error, Result};
use crate::math::{Aabb, Vec3};
use crate::mesh::{HalfEdges, boundary_loops};
use crate::primitive::crossing::AxisLine;
use crate::store::{Array, plain};
use expansion::Expansion;

/// Caps, or edges as triangles with two equal corners, and a hierarchy over them. The first side of each is at the
/// boundary.
pub(super) struct Closing {
    corners: Array<[Vec3; 3]>,
    /// Depth first: the first half of a cluster follows it.
    clusters: Array<Cluster>,
    loops: usize,
}

/// Some caps.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
struct Cluster {
    lo: Vec3,
    hi: Vec3,
    expansion: Expansion,
    /// Length of the boundary that they are at.
    rim: f64,
    /// Caps: `first..first + count`.
    first: u32,
    count: u32,
    /// Where the second half is; 0 of a leaf.
    second: u32,
    unused: u32,
}

plain! {
    Cluster { lo: Vec3, hi: Vec3, expansion: Expansion, rim: f64, first: u32, count: u32, second: u32, unused: u32 }
}

/// Clusters that are waiting to be looked at: one a level.
const DEEPEST: usize = 64;

/// More clusters than this are not looked at to find that a box is far from all caps.
const MOST_VISITS: usize = 256;

impl Closing {
    /// Caps over the loops of the boundary, fans around their middles; none where there is no boundary.
    pub(super) fn caps(topology: &HalfEdges, vertices: &[Vec3]) -> Result<Option<Closing>> {
        let at = |v: u32| vertices[v as usize];
        Closing::of_loops(topology, |path, add| {
            let middle = path.iter().fold(Vec3::ZERO, |sum, &v| sum + at(v) / path.len() as f64);
            let next = path.iter().skip(1).chain(&path[..1]);
            path.iter().zip(next).try_for_each(|(&a, &b)| add([at(a), at(b), middle]))
        })
    }

    /// The edges of the boundary.
    pub(super) fn rim(topology: &HalfEdges, vertices: &[Vec3]) -> Result<Option<Closing>> {
        let at = |v: u32| vertices[v as usize];
        Closing::of_loops(topology, |path, add| {
            let next = path.iter().skip(1).chain(&path[..1]);
            path.iter().zip(next).try_for_each(|(&a, &b)| add([at(a), at(b), at(b)]))
        })
    }

    fn of_loops(
        topology: &HalfEdges,
        close: impl Fn(&[u32], &mut dyn FnMut([Vec3; 3]) -> Result<()>) -> Result<()>,
    ) -> Result<Option<Closing>> {
        let mut corners: Vec<[Vec3; 3]> = Vec::new();
        let loops = boundary_loops(topology)?;
        for path in loops.iter() {
            close(path, &mut |cap| {
                corners.try_reserve(1).map_err(|_| Error::memory("caps", corners.len() + 1))?;
                corners.push(cap);
                Ok(())
            })?;
        }
        if corners.is_empty() { Ok(None) } else { Closing::over(corners, loops.len()).map(Some) }
    }

    /// Loops of the boundary.
    pub(super) fn loops(&self) -> usize {
        self.loops
    }

    /// Caps: one for each edge of the boundary.
    pub(super) fn len(&self) -> usize {
        self.corners.len()
    }

    pub(super) fn corners(&self, cap: u32) -> [Vec3; 3] {
        self.corners[cap as usize]
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.corners[..]) + size_of_val(&self.clusters[..])
    }

    /// What the cones over the caps enclose.
    pub(super) fn volume(&self, apex: Vec3) -> f64 {
        self.corners.iter().map(|[a, b, c]| (*a - apex).dot((*b - apex).cross(*c - apex)) / 6.0).sum()
    }

    /// Calls `visit` for every cap whose cluster meets a region, until it has seen enough.
    fn any_in(&self, region: Aabb, mut visit: impl FnMut(u32, [Vec3; 3]) -> bool) -> bool {
        let mut waiting = Waiting::new();
        while let Some(at) = waiting.pop() {
            let cluster = &self.clusters[at as usize];
            if cluster.lo.cmpgt(region.hi).any() || cluster.hi.cmplt(region.lo).any() {
                continue;
            }
            if cluster.second != 0 {
                waiting.push(at + 1, cluster.second);
                continue;
            }
            let members = cluster.first..cluster.first + cluster.count;
            if members.into_iter().any(|cap| visit(cap, self.corners[cap as usize])) {
                return true;
            }
        }
        false
    }

    pub(super) fn each_in(&self, region: Aabb, mut visit: impl FnMut(u32)) {
        self.any_in(region, |cap, _| {
            visit(cap);
            false
        });
    }

    /// Whether the box around a cap, or an edge, meets a region.
    pub(super) fn meets(&self, region: Aabb) -> bool {
        self.any_in(region, |_, corners| {
            let b = Aabb::of(corners);
            !(b.lo.cmpgt(region.hi).any() || b.hi.cmplt(region.lo).any())
        })
    }

    /// What the crossings of a vertical line above a point add to the winding number.
    pub(super) fn winding(&self, p: Vec3) -> i32 {
        let line = AxisLine::new(2, p);
        let mut winding = 0;
        self.any_in(Aabb::new(p, Vec3::new(p.x, p.y, f64::INFINITY)), |_, corners| {
            let turn = line.meets(corners);
            if turn != 0 && line.below(p.z, corners, turn) {
                winding += turn;
            }
            false
        });
        winding
    }
}

/// A stack that needs no memory.
struct Waiting {
    all: [u32; DEEPEST],
    count: usize,
}

impl Waiting {
    fn new() -> Waiting {
        Waiting { all: [0; DEEPEST], count: 1 }
    }

    fn pop(&mut self) -> Option<u32> {
        self.count = self.count.checked_sub(1)?;
        Some(self.all[self.count])
    }

    /// The first on top.
    fn push(&mut self, first: u32, second: u32) {
        self.all[self.count] = second;
        self.all[self.count + 1] = first;
        self.count += 2;
    }
}
