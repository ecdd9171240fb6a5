// SPDX-License-Identifier: MIT OR Apache-2.0
//! Hierarchies in relocatable blocks.

use super::nearest::LEVELS;
use super::oriented::Oriented;
use super::{EMPTY_NODE, LEAF, Leaves, Node, Tree};
use crate::error::{Result, filled};
use crate::simd::lanes::WIDTH;
use crate::store::{Packer, Unpacker, wrong};

/// Coordinates of boxes are of about one, or, where doubles end, up to a few millions: their squares are numbers.
const LARGEST: f32 = 1e9;

impl Tree {
    pub(crate) fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.array(&self.nodes);
        out.array(&self.oriented);
        out.vector(self.center);
        out.number(self.scale);
        out.word(self.depth as u64);
    }

    /// A hierarchy over so many leaves.
    pub(crate) fn unpack(from: &mut Unpacker, leaves: usize) -> Result<Tree> {
        let nodes = from.array::<Node>("nodes")?;
        let oriented = from.array::<Oriented>("oriented boxes")?;
        let (center, scale) = (from.vector()?, from.finite()?);
        let tree = Tree { nodes, oriented, center, scale, depth: from.index(LEVELS + 1, "level")? };
        if !(tree.scale.is_normal() && tree.scale > 0.0) || tree.nodes.is_empty() || tree.depth == 0 {
            return Err(wrong("a hierarchy has no nodes, or no scale"));
        }
        if !tree.oriented.is_empty() && tree.oriented.len() != tree.nodes.len() {
            return Err(wrong("a hierarchy has not as many oriented boxes as nodes"));
        }
        if from.checks() {
            tree.check(leaves)?;
        }
        Ok(tree)
    }

    /// Whether it has oriented boxes.
    pub(crate) fn is_fit(&self) -> bool {
        !self.oriented.is_empty()
    }

    /// Makes sure that every search ends, within the levels there is room for, and finds leaves that there are.
    fn check(&self, leaves: usize) -> Result<()> {
        let mut level = filled("nodes", self.nodes.len(), 0u8)?;
        let mut is_reached = filled("leaves", leaves, false)?;
        level[0] = 1;
        let mut deepest = 0;
        for (k, node) in self.nodes.iter().enumerate() {
            let own = level[k];
            if own == 0 || usize::from(own) > LEVELS || !has_sound_boxes(node) {
                return Err(wrong(&format!("node {k} of a hierarchy is damaged")));
            }
            deepest = deepest.max(own);
            for child in node.child.into_iter().filter(|child| *child != u32::MAX) {
                let at = (child & !LEAF) as usize;
                let is_sound = if child & LEAF != 0 {
                    is_reached.get_mut(at).is_some_and(|is_reached| !std::mem::replace(is_reached, true))
                } else {
                    // After its parent, and of one parent alone.
                    at > k && level.get_mut(at).is_some_and(|level| std::mem::replace(level, own + 1) == 0)
                };
                if !is_sound {
                    return Err(wrong(&format!("node {k} of a hierarchy leads to {at}, which is not below it alone")));
                }
            }
        }
        if usize::from(deepest) != self.depth || !is_reached.iter().all(|is_reached| *is_reached) {
            return Err(wrong("a hierarchy does not lead to all of its leaves"));
        }
        let mismatch =
            |(node, oriented): (&Node, &Oriented)| node.child != oriented.child || !oriented.is_sound(LARGEST);
        match self.nodes.iter().zip(&self.oriented).position(mismatch) {
            Some(k) => Err(wrong(&format!("the oriented boxes of node {k} of a hierarchy are damaged"))),
            None => Ok(()),
        }
    }
}

/// Whether a node has a child, every child a box, and what is no child none.
fn has_sound_boxes(node: &Node) -> bool {
    let is_sound = |lane: usize, axis: usize| {
        let (lo, hi) = (node.lo[axis][lane], node.hi[axis][lane]);
        match node.child[lane] {
            u32::MAX => lo == EMPTY_NODE.lo[0][0] && hi == EMPTY_NODE.hi[0][0],
            _ => -LARGEST <= lo && lo <= hi && hi <= LARGEST,
        }
    };
    node.child.iter().any(|child| *child != u32::MAX) && (0..WIDTH).all(|lane| (0..3).all(|axis| is_sound(lane, axis)))
}

impl Leaves {
    pub(crate) fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.array(&self.order);
        out.array(&self.start);
    }

    /// Of so many primitives.
    pub(crate) fn unpack(from: &mut Unpacker, primitives: usize) -> Result<Leaves> {
        let leaves = Leaves { order: from.array_of("order", primitives)?, start: from.array("starts of leaves")? };
        if leaves.start.len() < 2 {
            return Err(wrong("there is no leaf"));
        }
        if from.checks() {
            let start = &leaves.start;
            let rises = start.windows(2).all(|pair| pair[0] < pair[1]);
            if !rises || start[0] != 0 || start[start.len() - 1] as usize != primitives {
                return Err(wrong("leaves do not begin where others end"));
            }
            each_once(leaves.order.iter().copied(), primitives)?;
        }
        Ok(leaves)
    }
}

/// Makes sure that every number below `count` is among these once.
pub(crate) fn each_once(numbers: impl IntoIterator<Item = u32>, count: usize) -> Result<()> {
    let mut seen = filled("primitives", count, false)?;
    let mut left = count;
    for k in numbers {
        let is_new = seen.get_mut(k as usize).is_some_and(|seen| !std::mem::replace(seen, true));
        if !is_new {
            return Err(wrong(&format!("leaves hold {k} of {count} where it should not be")));
        }
        left -= 1;
    }
    if left == 0 { Ok(()) } else { Err(wrong(&format!("leaves do not hold {left} of {count}"))) }
}
