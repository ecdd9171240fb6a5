// SPDX-License-Identifier: MIT OR Apache-2.0
//! Distance to a triangle surface: triangles laid out eight side by side, leaf after leaf of the
//! hierarchy, and what the sign needs. Index-based arrays only.

mod band;
mod build;
mod check;
mod choose;
mod closing;
mod columns;
mod crossings;
mod cube;
mod ends;
mod faces;
mod few;
mod nearest;
mod normals;
mod open;
mod pack;
mod rays;
mod refit;
mod scanned;
mod sides;
mod sign;
mod tile;
mod visits;
mod waiting;
mod why;

pub(crate) use band::{BandSlab, BandWork};
use closing::Closing;
pub(crate) use crossings::Hit;
use ends::Ends;
pub(crate) use nearest::Nearest;
pub(crate) use rays::Met;
use sides::Sides;
pub(crate) use tile::Block;
use why::Why;

use crate::bvh::{Leaves, Tree};
use crate::error::{Result, filled};
use crate::geometry::SignMethod;
use crate::math::{Aabb, Vec3};
use crate::mesh::NO_FACE;
use crate::primitive::estimate::Estimates;
use crate::primitive::overlap::are_apart;
use crate::primitive::triangle::RELATIVE_ERROR;
use crate::simd::lanes::WIDTH;
use crate::store::{Array, plain};
use std::sync::Arc;

/// Marks the unused lanes of a block.
const NO_TRIANGLE: u32 = u32::MAX;

/// In the place of a neighbour: the edge has none, and the triangle's own normal.
const ALONE: u32 = u32::MAX;

/// In the place of a neighbour: the edge's pseudonormal decides nothing.
const UNCLEAR: u32 = u32::MAX - 1;

/// A volume of less than this share of the diagonal's cube has no side.
const NO_VOLUME: f64 = 1e-12;

/// Triangles or vertices that a thread does in one go.
const PIECE: usize = 4096;

/// The triangles of one leaf.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
struct Leaf {
    estimates: Estimates,
    /// Triangle of each lane.
    triangle: [u32; WIDTH],
}

plain! {
    Leaf { estimates: Estimates, triangle: [u32; WIDTH] }
    Origin { face: u32, tag: i32, piece: u32 }
}

/// The corners of the triangles, and where they come from.
struct Triangles {
    vertex: Array<[u32; 3]>,
    /// Nothing where each triangle is the face of its number, as read and without a tag.
    origin: Array<Origin>,
}

/// The input face that a triangle belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
struct Origin {
    face: u32,
    tag: i32,
    /// Which of the triangles that the face was cut into it is, twice; plus 1 where orientation turned the
    /// face over, so that corners 1 and 2 stand exchanged.
    piece: u32,
}

impl Triangles {
    fn len(&self) -> usize {
        self.vertex.len()
    }

    fn origin(&self, triangle: u32) -> Origin {
        self.origin.get(triangle as usize).copied().unwrap_or(Origin { face: triangle, tag: 0, piece: 0 })
    }

    fn is_turned(&self, triangle: u32) -> bool {
        self.origin(triangle).piece & 1 == 1
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.vertex[..]) + size_of_val(&self.origin[..])
    }
}

/// Signed or unsigned distance to a triangle surface. Immutable.
pub(crate) struct Surface {
    leaves: Array<Leaf>,
    /// In the compact layout, where there are no `leaves`: the triangles of each.
    compact: Option<Leaves>,
    /// None: every triangle is looked at.
    tree: Option<Tree>,
    vertices: Array<Vec3>,
    triangles: Arc<Triangles>,
    /// Unit normals of the triangles; zero where the area is.
    normals: Array<Vec3>,
    /// The triangles across the edges 0-1, 1-2, 2-0 of each, [`ALONE`] or [`UNCLEAR`].
    neighbours: Array<[u32; 3]>,
    /// The same without [`UNCLEAR`].
    topology: Array<[u32; 3]>,
    /// Pseudonormal of each vertex; zero where it decides nothing.
    vertex_normals: Array<Vec3>,
    bounds: Aabb,
    diagonal: f64,
    sign: Sign,
    /// What was asked for, and the sign that the topology allows.
    asked: (SignMethod, Sign),
    /// Triangles that pseudonormals do not decide the sign at.
    doubts: Doubts,
    /// Where the surface is not.
    sides: Sides,
    /// What it lacks, where it is open and has a sign.
    closing: Option<Closing>,
    why: Why,
    /// What was made to close it.
    ends: Ends,
    /// Winding number far away: 1 where an inside-out mesh was kept, else 0.
    far_winding: i32,
}

/// What stays when the vertices move.
struct Kept {
    triangles: Arc<Triangles>,
    topology: Array<[u32; 3]>,
    asked: (SignMethod, Sign),
    ends: Ends,
}

/// A set of triangles; no memory where it is empty.
#[derive(Clone, Debug, Default)]
struct Doubts {
    bits: Array<u64>,
}

impl Doubts {
    fn add(&mut self, t: u32, of: usize) -> Result<()> {
        if self.bits.is_empty() {
            self.bits = filled("triangles", of.div_ceil(64), 0)?.into();
        }
        self.bits.edit("triangles")?[t as usize / 64] |= 1 << (t % 64);
        Ok(())
    }

    #[inline(always)]
    fn has(&self, t: u32) -> bool {
        self.bits.get(t as usize / 64).is_some_and(|bits| bits >> (t % 64) & 1 == 1)
    }
}

/// How the sign is decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    Pseudonormal,
    /// The winding number: of an open surface the generalised one, which pseudonormals may stand in for as well.
    Crossings,
    Unsigned,
    /// What most rays along the axes say, of an open surface.
    Votes,
    /// Whether anything is met along this axis.
    Axis(u8),
}

impl Surface {
    pub(crate) fn bounds(&self) -> Aabb {
        self.bounds
    }

    pub(crate) fn diagonal(&self) -> f64 {
        self.diagonal
    }

    /// The largest coordinate.
    pub(crate) fn reach(&self) -> f64 {
        self.bounds.lo.abs().max(self.bounds.hi.abs()).max_element()
    }

    pub(crate) fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    pub(crate) fn is_signed(&self) -> bool {
        self.sign != Sign::Unsigned
    }

    /// Whether the body is everything but what the surface encloses.
    pub(crate) fn is_inverted(&self) -> bool {
        self.far_winding == 1
    }

    pub(crate) fn sign_method(&self) -> SignMethod {
        match (self.asked.0, self.sign) {
            (_, Sign::Unsigned) => SignMethod::None,
            (_, Sign::Axis(_)) => SignMethod::Axis,
            (_, Sign::Votes) => SignMethod::Ray,
            (SignMethod::Winding, _) => SignMethod::Winding,
            _ if self.closing.is_some() => SignMethod::Winding,
            (_, Sign::Pseudonormal) if self.doubts.bits.is_empty() => SignMethod::Pseudonormal,
            // Of both, what counts is the one that is right everywhere.
            _ => SignMethod::Ray,
        }
    }

    /// The input face of a triangle; -1 where it has none.
    pub(crate) fn face(&self, triangle: u32) -> i64 {
        match self.triangles.origin(triangle).face {
            NO_FACE => -1,
            face => i64::from(face),
        }
    }

    /// Which of the triangles that its face was cut into a triangle is; -1 where it has none.
    pub(crate) fn piece(&self, triangle: u32) -> i32 {
        let origin = self.triangles.origin(triangle);
        if origin.face == NO_FACE { -1 } else { (origin.piece >> 1) as i32 }
    }

    pub(crate) fn tag(&self, triangle: u32) -> i32 {
        self.triangles.origin(triangle).tag
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self)
            + size_of_val(&self.leaves[..])
            + self.compact.as_ref().map_or(0, |all| size_of_val(&all.order[..]) + size_of_val(&all.start[..]))
            + self.tree.as_ref().map_or(0, Tree::bytes)
            + size_of_val(&self.vertices[..])
            + self.triangles.bytes()
            + size_of_val(&self.normals[..])
            + size_of_val(&self.neighbours[..])
            + if self.neighbours.is(&self.topology) { 0 } else { size_of_val(&self.topology[..]) }
            + size_of_val(&self.vertex_normals[..])
            + size_of_val(&self.doubts.bits[..])
            + self.sides.bytes()
            + self.closing.as_ref().map_or(0, Closing::bytes)
            + self.ends.bytes()
    }

    /// Feeds the bits that define every answer to `add`.
    pub(crate) fn fingerprint(&self, add: &mut impl FnMut(u64)) {
        add(pack::number_of(&pack::SIGNS, &self.sign));
        add(self.far_winding as u64);
        self.doubts.bits.iter().for_each(|bits| add(*bits));
        for v in &self.vertices {
            v.to_array().iter().for_each(|c| add((c + 0.0).to_bits()));
        }
        for (vertex, t) in self.triangles.vertex.iter().zip(0..) {
            vertex.iter().for_each(|&v| add(u64::from(v)));
            let origin = self.triangles.origin(t);
            add(u64::from(origin.face));
            add(origin.tag as u64);
            add(u64::from(origin.piece));
        }
    }

    #[inline(always)]
    pub(crate) fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles.vertex[triangle as usize].map(|v| self.vertices[v as usize])
    }

    fn normal(&self, triangle: u32) -> Vec3 {
        self.normals[triangle as usize]
    }

    fn leaf_count(&self) -> usize {
        self.compact.as_ref().map_or(self.leaves.len(), |all| all.start.len() - 1)
    }

    /// The triangles of a leaf.
    #[inline(always)]
    fn members(&self, leaf: usize) -> &[u32] {
        match &self.compact {
            Some(all) => &all.order[all.start[leaf] as usize..all.start[leaf + 1] as usize],
            None => {
                let triangle = &self.leaves[leaf].triangle;
                &triangle[..triangle.iter().position(|t| *t == NO_TRIANGLE).unwrap_or(WIDTH)]
            }
        }
    }

    /// Calls `visit` for every triangle whose box may meet `region`.
    fn overlapping(&self, region: Aabb, mut visit: impl FnMut(u32)) {
        match &self.tree {
            Some(tree) => tree.overlapping(region, |leaf| self.members(leaf).iter().for_each(|&t| visit(t))),
            None => (0..self.triangles.len() as u32).for_each(visit),
        }
    }
}

impl Surface {
    /// Whether no triangle comes as near to a finite box as rounding.
    pub(crate) fn misses(&self, b: Aabb) -> bool {
        let extent = b.lo.abs().max(b.hi.abs()).max_element() + self.reach() + self.diagonal();
        let room = Vec3::splat(4.0 * RELATIVE_ERROR * extent);
        let near = Aabb::new(b.lo - room, b.hi + room);
        let meets = |t: u32| !are_apart(self.corners(t), near);
        match &self.tree {
            Some(tree) => !tree.any_overlapping(near, |leaf| self.members(leaf).iter().any(|&t| meets(t))),
            None => !(0..self.triangles.len() as u32).any(meets),
        }
    }
}
