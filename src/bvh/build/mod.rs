// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binned surface area heuristic (Wald 2007), binary splits gathered eight to a node. What is below the root's children
//! and theirs is built on all threads; the tree is the same for any number of them.

mod split;

use super::{EMPTY_NODE, LEAF, Leaves, Node, Tree, scale_of};
use crate::error::{Error, Result, try_with_capacity};
use crate::math::Aabb;
use crate::parallel;
use crate::simd::lanes::WIDTH;
use split::{Item, Splitter};
use std::sync::Mutex;

/// Shorter runs are not worth a task of their own.
const SHORT: usize = 4096;

/// Levels of nodes whose children are tasks.
const SHARED: usize = 2;

/// Nodes and ends of leaves in depth-first order, numbered from 0.
#[derive(Default)]
struct Part {
    nodes: Vec<Node>,
    ends: Vec<u32>,
    depth: usize,
}

impl Tree {
    /// Builds over `count` boxes, none of them empty, at least one. `leaf_size` is at most [`super::LEAF_SIZE`].
    pub(crate) fn build(
        count: usize,
        bounds: &(dyn Fn(usize) -> Aabb + Sync),
        leaf_size: usize,
        run: &parallel::Run,
    ) -> Result<(Tree, Leaves)> {
        if count >= LEAF as usize {
            return Err(Error::unsupported(format!("{count} primitives are too many for one hierarchy")));
        }
        // What the hierarchy is built for tells the progress.
        let run = parallel::Run { progress: None, ..*run };
        let whole = (0..count).fold(Aabb::EMPTY, |all, k| all.hull(bounds(k)));
        let mut tree = Tree {
            nodes: Vec::new(),
            oriented: Vec::new(),
            center: whole.center(),
            scale: scale_of(whole.diagonal()),
            depth: 0,
        };
        let mut items: Vec<Item> = try_with_capacity("primitives", count)?;
        items.resize(count, Item::NONE);
        run.for_each_piece(&mut items, SHORT, &|from, piece| {
            for (k, item) in piece.iter_mut().enumerate() {
                *item = Item::new(tree.relative(bounds(from + k)), from + k);
            }
            Ok(())
        })?;
        let part = part(&mut items, 0, leaf_size, 0, &run)?;
        (tree.nodes, tree.depth) = (part.nodes, part.depth);
        let mut order = try_with_capacity("primitives", count)?;
        order.extend(items.iter().map(Item::index));
        let mut start = try_with_capacity("leaves", part.ends.len() + 1)?;
        start.push(0);
        start.extend(part.ends);
        Ok((tree, Leaves { order, start }))
    }
}

/// The hierarchy over items from the one of number `first` on; one of few items is a leaf, but for the root.
fn part(items: &mut [Item], first: usize, leaf_size: usize, depth: usize, run: &parallel::Run) -> Result<Part> {
    if depth == SHARED || items.len() < 2 * SHORT {
        let mut part = Part::default();
        if depth > 0 && items.len() <= leaf_size {
            part.ends.try_reserve(1).map_err(|_| Error::memory("leaves", 1))?;
            part.ends.push((first + items.len()) as u32);
        } else {
            below(items, first, leaf_size, depth, &mut part)?;
        }
        return Ok(part);
    }
    let runs = Splitter { items, leaf_size }.in_eight(depth);
    let mut tasks = Vec::with_capacity(WIDTH);
    let (mut rest, mut at) = (items, first);
    for (count, _) in runs.iter() {
        let (own, others) = rest.split_at_mut(count);
        tasks.push(Mutex::new((own, at, Part::default())));
        (rest, at) = (others, at + count);
    }
    run.for_each_chunk(tasks.len(), &|k| {
        let mut task = tasks[k].lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        let (items, first, done) = &mut *task;
        *done = part(items, *first, leaf_size, depth + 1, run)?;
        Ok(())
    })?;
    let mut whole = Part { nodes: Vec::new(), ends: Vec::new(), depth: depth + 1 };
    let children = tasks.into_iter().map(|task| task.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner()));
    let mut node = EMPTY_NODE;
    whole.nodes.try_reserve(1).map_err(|_| Error::memory("nodes", 1))?;
    whole.nodes.push(node);
    for (k, ((_, _, part), (_, bounds))) in children.zip(runs.iter()).enumerate() {
        let is_leaf = part.nodes.is_empty();
        let child = if is_leaf { whole.ends.len() as u32 | LEAF } else { whole.nodes.len() as u32 };
        bounds.put(&mut node, k, child);
        append(&mut whole, part)?;
    }
    whole.nodes[0] = node;
    Ok(whole)
}

/// Appends the node of items and everything below it; its index.
fn below(items: &mut [Item], first: usize, leaf_size: usize, depth: usize, part: &mut Part) -> Result<u32> {
    let at = part.nodes.len();
    part.depth = part.depth.max(depth + 1);
    part.nodes.try_reserve(1).map_err(|_| Error::memory("nodes", at + 1))?;
    part.nodes.push(EMPTY_NODE);
    let mut node = EMPTY_NODE;
    let runs = Splitter { items, leaf_size }.in_eight(depth);
    let (mut rest, mut from) = (items, first);
    for (k, (count, bounds)) in runs.iter().enumerate() {
        let (own, others) = rest.split_at_mut(count);
        let child = if count <= leaf_size {
            part.ends.try_reserve(1).map_err(|_| Error::memory("leaves", part.ends.len() + 1))?;
            part.ends.push((from + count) as u32);
            (part.ends.len() - 1) as u32 | LEAF
        } else {
            below(own, from, leaf_size, depth + 1, part)?
        };
        bounds.put(&mut node, k, child);
        (rest, from) = (others, from + count);
    }
    part.nodes[at] = node;
    Ok(at as u32)
}

/// Puts a part behind another.
fn append(whole: &mut Part, part: Part) -> Result<()> {
    let (nodes, leaves) = (whole.nodes.len() as u32, whole.ends.len() as u32);
    whole.nodes.try_reserve(part.nodes.len()).map_err(|_| Error::memory("nodes", part.nodes.len()))?;
    whole.ends.try_reserve(part.ends.len()).map_err(|_| Error::memory("leaves", part.ends.len()))?;
    whole.depth = whole.depth.max(part.depth);
    whole.ends.extend(part.ends);
    for mut node in part.nodes {
        for child in node.child.iter_mut().filter(|child| **child != u32::MAX) {
            *child += if *child & LEAF != 0 { leaves } else { nodes };
        }
        whole.nodes.push(node);
    }
    Ok(())
}
