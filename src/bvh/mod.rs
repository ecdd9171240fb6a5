// SPDX-License-Identifier: MIT OR Apache-2.0
//! A bounding volume hierarchy of degree 8 over anything with boxes; it does not know what a primitive
//! means. Boxes are f32, rounded outward, relative to the middle and size of all of them; leaves are runs of up to
//! eight primitives, or of one, for the caller to lay out side by side.

mod build;
mod far;
mod nearest;
mod oriented;
mod overlap;
mod pack;
mod pairs;
mod ray;
mod witness;

pub(crate) use nearest::{Along, Around, GROUP, LeafDistance, nearest, nearest_for_group};
pub(crate) use pack::each_once;
pub(crate) use pairs::{ALONE, Pairs, Scratch};
pub(crate) use ray::{Ahead, LeafOnLine, Line, Seen};
pub(crate) use witness::{Corners, LeafList};

use crate::math::{Aabb, Vec3, f32_above, f32_below};
use crate::simd::lanes::WIDTH;
use crate::store::{Array, plain};
use oriented::Oriented;

/// Most primitives of a leaf.
pub(crate) const LEAF_SIZE: usize = 8;

/// Set in a child reference that names a leaf.
const LEAF: u32 = 1 << 31;

/// Eight boxes side by side. An unused child has an empty box and is never reached.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Node {
    lo: [[f32; WIDTH]; 3],
    hi: [[f32; WIDTH]; 3],
    child: [u32; WIDTH],
}

plain! {
    Node { lo: [[f32; WIDTH]; 3], hi: [[f32; WIDTH]; 3], child: [u32; WIDTH] }
}

const EMPTY_NODE: Node =
    Node { lo: [[f32::INFINITY; WIDTH]; 3], hi: [[f32::NEG_INFINITY; WIDTH]; 3], child: [u32::MAX; WIDTH] };

/// The hierarchy: index-based arrays, no pointers.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// Node 0 is the root; children come after their parent.
    nodes: Array<Node>,
    /// For each, the same turned to fit, where they were asked for.
    oriented: Array<Oriented>,
    /// Middle of all boxes; everything in `nodes` is relative to it.
    center: Vec3,
    /// A power of two that brings everything in `nodes` to a size of about one, so that f32 neither overflows
    /// nor underflows.
    scale: f64,
    /// Levels of nodes.
    depth: usize,
}

/// Which primitives are in which leaf.
pub(crate) struct Leaves {
    /// Primitives, leaf after leaf.
    pub(crate) order: Array<u32>,
    /// Leaf k holds `order[start[k]..start[k + 1]]`.
    pub(crate) start: Array<u32>,
}

impl Tree {
    /// A box relative to the centre and scaled, rounded outward. Subtraction and rounding are monotone, so
    /// a point inside the box stays inside when the same is done to it.
    fn relative(&self, b: Aabb) -> ([f32; 3], [f32; 3]) {
        let (lo, hi) = ((b.lo - self.center) * self.scale, (b.hi - self.center) * self.scale);
        (lo.to_array().map(f32_below), hi.to_array().map(f32_above))
    }

    /// A point relative to the centre and scaled: those in the boxes come to lie within one of the origin.
    #[inline(always)]
    pub(crate) fn place(&self, p: Vec3) -> Vec3 {
        (p - self.center) * self.scale
    }

    /// A distance as [`Tree::place`] scales it, to the nearest f32.
    #[inline(always)]
    pub(crate) fn scaled(&self, distance: f64) -> f32 {
        (distance * self.scale) as f32
    }

    /// What [`Tree::place`] scales by.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// Memory of the arrays.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.oriented[..])
    }
}

/// The power of two that scales a length to between 1/2 and 1, as far as doubles allow.
fn scale_of(length: f64) -> f64 {
    let exponent = (length.to_bits() >> 52 & 0x7FF) as i64 - 1023;
    let exponent = (-exponent - 1).clamp(-1000, 1000);
    f64::from_bits(((exponent + 1023) as u64) << 52)
}
