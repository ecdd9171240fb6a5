// SPDX-License-Identifier: MIT OR Apache-2.0
//! A hierarchy around boxes that have moved: what is below a node stays there, and its box is made anew from the bottom.

use super::hull_of_all;
use crate::bvh::{EMPTY_NODE, LEAF, Node, Tree, scale_of};
use crate::error::{Result, try_copy, try_with_capacity};
use crate::math::Aabb;
use crate::parallel::Run;
use crate::simd::lanes::WIDTH;
use crate::store::Array;

/// Leaves for a thread to do in one go.
const PIECE: usize = 2048;

type Box32 = ([f32; 3], [f32; 3]);

impl Tree {
    /// The hierarchy around `leaves` leaves with these boxes. O(n).
    pub(crate) fn refit(&self, leaves: usize, bounds: &(dyn Fn(usize) -> Aabb + Sync), run: &Run) -> Result<Tree> {
        let whole = hull_of_all(leaves, bounds, run)?;
        let (center, scale) = (whole.center(), scale_of(whole.diagonal()));
        let mut nodes = try_copy("nodes", &self.nodes)?;
        let mut tree = Tree { nodes: Array::default(), oriented: Array::default(), center, scale, depth: self.depth };
        let mut boxes: Vec<Box32> = try_with_capacity("boxes", leaves)?;
        boxes.resize(leaves, ([0.0; 3], [0.0; 3]));
        run.for_each_piece(&mut boxes, PIECE, &|from, piece| {
            piece.iter_mut().zip(from..).for_each(|(b, leaf)| *b = tree.relative(bounds(leaf)));
            Ok(())
        })?;
        // Children come after their parent.
        for at in (0..nodes.len()).rev() {
            let child = nodes[at].child;
            let mut node = Node { child, ..EMPTY_NODE };
            for lane in (0..WIDTH).filter(|lane| child[*lane] != u32::MAX) {
                let (lo, hi) = match child[lane] & LEAF {
                    0 => hull(&nodes[child[lane] as usize]),
                    _ => boxes[(child[lane] & !LEAF) as usize],
                };
                for axis in 0..3 {
                    (node.lo[axis][lane], node.hi[axis][lane]) = (lo[axis], hi[axis]);
                }
            }
            nodes[at] = node;
        }
        tree.nodes = nodes.into();
        Ok(tree)
    }
}

/// The box around a node's children.
fn hull(node: &Node) -> Box32 {
    let least = |lanes: [f32; WIDTH]| lanes.into_iter().fold(f32::INFINITY, |a, b| if b < a { b } else { a });
    let greatest = |lanes: [f32; WIDTH]| lanes.into_iter().fold(f32::NEG_INFINITY, |a, b| if b > a { b } else { a });
    (node.lo.map(least), node.hi.map(greatest))
}
