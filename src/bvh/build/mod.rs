// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binned surface area heuristic (Wald 2007), binary splits gathered eight to a node. What is below the root's children
//! and theirs is built on all threads; the tree is the same for any number of them.

mod cells;
mod refit;
mod split;

use super::{EMPTY_NODE, LEAF, Leaves, Node, Tree, scale_of};
use crate::error::{Error, Result, filled, try_with_capacity};
use crate::math::Aabb;
use crate::parallel;
use crate::simd::lanes::WIDTH;
use crate::store::Array;
use cells::Cells;
use split::{Item, Runs, Splitter};
use std::sync::Mutex;

/// Shorter runs are not worth a task of their own.
const SHORT: usize = 4096;

/// Shorter runs are split item by item, longer ones cell by cell.
const MANY: usize = 2048;

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
        let run = run.silent();
        let whole = hull_of_all(count, bounds, &run)?;
        let mut tree = Tree {
            nodes: Array::default(),
            oriented: Array::default(),
            center: whole.center(),
            scale: scale_of(whole.diagonal()),
            depth: 0,
        };
        let mut items = filled("primitives", count, Item::NONE)?;
        run.for_each_piece(&mut items, SHORT, &|from, piece| {
            for (k, item) in piece.iter_mut().enumerate() {
                *item = Item::new(tree.relative(bounds(from + k)), from + k);
            }
            Ok(())
        })?;
        let cells = if count >= MANY { Cells::of(&items, &run)? } else { None };
        let part = match cells {
            Some(Cells { items: sorted, mut cells }) => {
                Source::Cells { cells: &mut cells, sorted: &sorted }.part(&mut items, 0, leaf_size, 0, &run)?
            }
            None => Source::Items.part(&mut items, 0, leaf_size, 0, &run)?,
        };
        (tree.nodes, tree.depth) = (part.nodes.into(), part.depth);
        let mut order = try_with_capacity("primitives", count)?;
        order.extend(items.iter().map(Item::index));
        let mut start = try_with_capacity("leaves", part.ends.len() + 1)?;
        start.push(0);
        start.extend(part.ends);
        Ok((tree, Leaves { order: order.into(), start: start.into() }))
    }
}

/// The box around all.
fn hull_of_all(count: usize, bounds: &(dyn Fn(usize) -> Aabb + Sync), run: &parallel::Run) -> Result<Aabb> {
    let mut pieces = filled("boxes", count.div_ceil(SHORT), Aabb::EMPTY)?;
    run.for_each_piece(&mut pieces, 1, &|piece, hull| {
        let members = piece * SHORT..count.min((piece + 1) * SHORT);
        hull[0] = members.fold(Aabb::EMPTY, |all, k| all.hull(bounds(k)));
        Ok(())
    })?;
    Ok(pieces.into_iter().fold(Aabb::EMPTY, Aabb::hull))
}

/// What items are split by.
enum Source<'a> {
    /// They are there.
    Items,
    /// The cells that they are in, each of which stands for a stretch of `sorted`; they are still to be put in their place.
    Cells { cells: &'a mut [Item], sorted: &'a [Item] },
}

/// What a task builds.
struct Task<'a> {
    source: Source<'a>,
    items: &'a mut [Item],
    first: usize,
    part: Part,
}

impl<'a> Source<'a> {
    /// The hierarchy over items from the one of number `first` on; one of few items is a leaf, but for the root.
    fn part(
        self,
        items: &'a mut [Item],
        first: usize,
        leaf_size: usize,
        depth: usize,
        run: &parallel::Run,
    ) -> Result<Part> {
        let source = match self {
            Source::Cells { cells, sorted } if items.len() < MANY => {
                let mut rest = &mut items[..];
                for cell in cells {
                    let (own, others) = rest.split_at_mut(cell.weight() as usize);
                    own.copy_from_slice(&sorted[cell.index() as usize..][..own.len()]);
                    rest = others;
                }
                Source::Items
            }
            source => source,
        };
        if matches!(source, Source::Items) && (depth >= SHARED || items.len() < 2 * SHORT) {
            let mut part = Part::default();
            if depth > 0 && items.len() <= leaf_size {
                part.ends.try_reserve(1).map_err(|_| Error::memory("leaves", 1))?;
                part.ends.push((first + items.len()) as u32);
            } else {
                below(items, first, leaf_size, depth, &mut part)?;
            }
            return Ok(part);
        }
        let alone = run.on_this_thread();
        let run = if depth < SHARED { run } else { &alone };
        let mut tasks = Vec::with_capacity(WIDTH);
        let runs = source.split(items, first, leaf_size, depth, &mut tasks);
        run.for_each_chunk(tasks.len(), &|k| {
            let mut task = tasks[k].lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            let Task { source, items, first, part } = &mut *task;
            let source = std::mem::replace(source, Source::Items);
            *part = source.part(std::mem::take(items), *first, leaf_size, depth + 1, run)?;
            Ok(())
        })?;
        let mut whole = Part { nodes: Vec::new(), ends: Vec::new(), depth: depth + 1 };
        let children = tasks.into_iter().map(|task| task.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner()));
        let mut node = EMPTY_NODE;
        whole.nodes.try_reserve(1).map_err(|_| Error::memory("nodes", 1))?;
        whole.nodes.push(node);
        for (k, (task, (_, _, bounds))) in children.zip(runs.iter()).enumerate() {
            let is_leaf = task.part.nodes.is_empty();
            let child = if is_leaf { whole.ends.len() as u32 | LEAF } else { whole.nodes.len() as u32 };
            bounds.put(&mut node, k, child);
            append(&mut whole, task.part)?;
        }
        whole.nodes[0] = node;
        Ok(whole)
    }

    /// Splits in eight, with a task for each run.
    fn split(
        self,
        items: &'a mut [Item],
        first: usize,
        leaf_size: usize,
        depth: usize,
        tasks: &mut Vec<Mutex<Task<'a>>>,
    ) -> Runs {
        match self {
            Source::Items => {
                let runs = Splitter { items: &mut *items, leaf_size }.in_eight(depth);
                let (mut rest, mut at) = (items, first);
                for (count, ..) in runs.iter() {
                    let (own, others) = rest.split_at_mut(count);
                    tasks.push(Mutex::new(Task {
                        source: Source::Items,
                        items: own,
                        first: at,
                        part: Part::default(),
                    }));
                    (rest, at) = (others, at + count);
                }
                runs
            }
            Source::Cells { cells, sorted } => {
                let runs = Splitter { items: &mut *cells, leaf_size }.in_eight(depth);
                let (mut rest, mut cells, mut at) = (items, cells, first);
                for (count, weight, _) in runs.iter() {
                    let (own, others) = rest.split_at_mut(weight);
                    let (own_cells, other_cells) = cells.split_at_mut(count);
                    let source = Source::Cells { cells: own_cells, sorted };
                    tasks.push(Mutex::new(Task { source, items: own, first: at, part: Part::default() }));
                    (rest, cells, at) = (others, other_cells, at + weight);
                }
                runs
            }
        }
    }
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
    for (k, (count, _, bounds)) in runs.iter().enumerate() {
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
