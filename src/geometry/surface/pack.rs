// SPDX-License-Identifier: MIT OR Apache-2.0
//! Surfaces in relocatable blocks: all of their arrays as they are, so that nothing is made anew.

use super::closing::Closing;
use super::sides::Sides;
use super::{ALONE, Doubts, Ends, Leaf, NO_TRIANGLE, Origin, Sign, Surface, Triangles, UNCLEAR, Why};
use crate::bvh::{Leaves, Tree, each_once};
use crate::error::Result;
use crate::geometry::SignMethod;
use crate::math::{Aabb, Vec3};
use crate::mesh::LARGEST_COORDINATE;
use crate::simd::lanes::WIDTH;
use crate::store::{Packer, Unpacker, wrong};
use std::sync::Arc;

/// In the order of their numbers in a block.
const METHODS: [SignMethod; 6] = [
    SignMethod::Auto,
    SignMethod::Pseudonormal,
    SignMethod::Winding,
    SignMethod::Ray,
    SignMethod::Axis,
    SignMethod::None,
];
pub(super) const SIGNS: [Sign; 7] =
    [Sign::Pseudonormal, Sign::Crossings, Sign::Unsigned, Sign::Votes, Sign::Axis(0), Sign::Axis(1), Sign::Axis(2)];

/// The layouts: no hierarchy, leaves side by side, compact.
const PLAIN: usize = 0;
const FULL: usize = 1;
const COMPACT: usize = 2;

pub(super) fn number_of<T: PartialEq>(all: &[T], one: &T) -> u64 {
    all.iter().position(|other| other == one).unwrap_or(all.len()) as u64
}

impl Surface {
    pub(crate) fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.array(&self.vertices);
        out.array(&self.triangles.vertex);
        out.array(&self.triangles.origin);
        out.array(&self.normals);
        out.array(&self.neighbours);
        out.array(&self.topology);
        out.array(&self.vertex_normals);
        out.array(&self.doubts.bits);
        out.vector(self.bounds.lo);
        out.vector(self.bounds.hi);
        out.word(number_of(&SIGNS, &self.sign));
        out.word(number_of(&METHODS, &self.asked.0));
        out.word(number_of(&SIGNS, &self.asked.1));
        out.word(u64::from(self.far_winding == 1));
        self.sides.pack(out);
        out.word(u64::from(self.closing.is_some()));
        if let Some(closing) = &self.closing {
            closing.pack(out);
        }
        self.why.pack(out);
        self.ends.pack(out);
        match (&self.tree, &self.compact) {
            (None, _) => out.word(PLAIN as u64),
            (Some(tree), None) => {
                out.word(FULL as u64);
                out.array(&self.leaves);
                tree.pack(out);
            }
            (Some(tree), Some(leaves)) => {
                out.word(COMPACT as u64);
                leaves.pack(out);
                tree.pack(out);
            }
        }
    }

    pub(crate) fn unpack(from: &mut Unpacker) -> Result<Surface> {
        let vertices = from.array::<Vec3>("vertices")?;
        let vertex = from.array::<[u32; 3]>("triangles")?;
        let origin = from.array::<Origin>("origins")?;
        let count = vertex.len();
        if count == 0 || count >= UNCLEAR as usize || !(origin.is_empty() || origin.len() == count) {
            return Err(wrong("a surface has no triangles, or not as many origins"));
        }
        let normals = from.array_of("normals", count)?;
        let neighbours = from.array_of("neighbours", count)?;
        let topology = from.array_of("topology", count)?;
        let vertex_normals = from.array_of("vertex normals", vertices.len())?;
        let doubts = Doubts { bits: from.array("doubts")? };
        if !(doubts.bits.is_empty() || doubts.bits.len() == count.div_ceil(64)) {
            return Err(wrong("a surface has doubts of other triangles"));
        }
        let bounds = Aabb::new(from.vector()?, from.vector()?);
        if bounds.is_empty() {
            return Err(wrong("a surface has no bounds"));
        }
        let sign = SIGNS[from.index(SIGNS.len(), "sign")?];
        let asked = (METHODS[from.index(METHODS.len(), "sign")?], SIGNS[from.index(SIGNS.len(), "sign")?]);
        let far_winding = i32::from(from.flag()?);
        let sides = Sides::unpack(from)?;
        let closing = if from.flag()? { Some(Closing::unpack(from)?) } else { None };
        let why = Why::unpack(from)?;
        let ends = Ends::unpack(from, vertices.len())?;
        let mut surface = Surface {
            leaves: Default::default(),
            compact: None,
            tree: None,
            vertices,
            triangles: Arc::new(Triangles { vertex, origin }),
            normals,
            neighbours,
            topology,
            vertex_normals,
            bounds,
            diagonal: bounds.diagonal(),
            sign,
            asked,
            doubts,
            sides,
            closing,
            why,
            ends,
            far_winding,
        };
        match from.index(3, "layout")? {
            PLAIN => {}
            FULL => {
                surface.leaves = from.array("leaves")?;
                surface.tree = Some(Tree::unpack(from, surface.leaves.len())?);
            }
            _ => {
                let leaves = Leaves::unpack(from, count)?;
                surface.tree = Some(Tree::unpack(from, leaves.start.len() - 1)?);
                surface.compact = Some(leaves);
            }
        }
        let is_full = surface.tree.is_some() && surface.compact.is_none();
        if surface.tree.as_ref().is_some_and(|tree| tree.is_fit() != is_full) {
            return Err(wrong("a hierarchy has boxes that are not those of its layout"));
        }
        if from.checks() {
            surface.check()?;
        }
        Ok(surface)
    }

    /// Makes sure that every index leads to something, and that numbers are some.
    fn check(&self) -> Result<()> {
        let is_fit = |p: &Vec3| p.is_finite() && p.abs().max_element() <= LARGEST_COORDINATE;
        if let Some(v) = self.vertices.iter().position(|p| !is_fit(p)) {
            return Err(wrong(&format!("vertex {v} of a surface is not finite or too far away")));
        }
        // Of weighted normals; their lengths are of no account.
        let is_number = |n: &Vec3| n.abs().max_element() <= 1e12;
        if !self.normals.iter().all(|n| n.abs().max_element() <= 2.0) || !self.vertex_normals.iter().all(is_number) {
            return Err(wrong("a normal of a surface is none"));
        }
        let (vertices, triangles) = (self.vertices.len() as u32, self.triangles.len() as u32);
        let mut hull = Aabb::EMPTY;
        for (t, corners) in self.triangles.vertex.iter().enumerate() {
            let are_near = self.neighbours[t].iter().all(|&n| n < triangles || n >= UNCLEAR);
            let is_sound = corners.iter().all(|&v| v < vertices) && are_near && self.hangs_together(t as u32);
            if !is_sound {
                return Err(wrong(&format!("triangle {t} of a surface leads to what is not there")));
            }
            hull = hull.hull(Aabb::of(corners.map(|v| self.vertices[v as usize])));
        }
        if hull != self.bounds {
            return Err(wrong("the bounds of a surface are those of another"));
        }
        let mut of_leaves = 0;
        for leaf in &self.leaves {
            let used = leaf.triangle.iter().position(|t| *t == NO_TRIANGLE).unwrap_or(WIDTH);
            let rest = leaf.triangle[used..].iter().all(|t| *t == NO_TRIANGLE);
            if used == 0 || !rest || !leaf.estimates.are_sound(used) {
                return Err(wrong(&format!("leaf {of_leaves} of a surface is damaged")));
            }
            of_leaves += 1;
        }
        if of_leaves > 0 {
            each_once(self.leaves.iter().flat_map(Leaf::triangles), self.triangles.len())?;
        }
        Ok(())
    }

    /// Whether each neighbour of a triangle has it as its neighbour, along the same edge: else fans of triangles
    /// would not come round.
    fn hangs_together(&self, t: u32) -> bool {
        let own = self.triangles.vertex[t as usize];
        (0..3).all(|k| {
            let other = self.topology[t as usize][k];
            let (from, to) = (own[k], own[(k + 1) % 3]);
            let Some(across) = self.triangles.vertex.get(other as usize) else { return other == ALONE };
            let back = (0..3).find(|&j| across[j] == to && across[(j + 1) % 3] == from);
            back.is_some_and(|j| self.topology[other as usize][j] == t)
        })
    }
}

impl Leaf {
    fn triangles(&self) -> impl Iterator<Item = u32> + use<> {
        self.triangle.into_iter().filter(|t| *t != NO_TRIANGLE)
    }
}
