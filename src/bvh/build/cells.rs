// SPDX-License-Identifier: MIT OR Apache-2.0
//! Items sorted into the cells of an octree along the Morton curve (1966), so that the upper levels of a hierarchy are
//! split cell by cell (Garanzha 2011): there an item is one of thousands, and where it lies within its cell makes no
//! difference.

use super::split::Item;
use crate::error::{Error, Result, filled, try_with_capacity};
use crate::math::{MORTON_BITS, morton};
use crate::parallel::Run;
use std::sync::Mutex;

/// Most items of a cell, but where more have one place.
const CELL: usize = 16;

/// Bits of the first sorting, along all three axes.
const FIRST: u32 = 12;

/// Where more than one item in so many has a place that too many others have, cells say too little.
const FEW: usize = 64;

/// Items for a thread to do in one go.
const PIECE: usize = 8192;

/// The items, cell after cell, and a box around each cell.
pub(super) struct Cells {
    pub items: Vec<Item>,
    /// Its index is that of the first item.
    pub cells: Vec<Item>,
}

impl Cells {
    /// None where the items do not spread over cells.
    pub(super) fn of(items: &[Item], run: &Run) -> Result<Option<Cells>> {
        let mut keys = filled("primitives", items.len(), 0u64)?;
        run.for_each_piece(&mut keys, PIECE, &|from, piece| {
            for (k, key) in (from..).zip(piece) {
                *key = u64::from(morton(items[k].place(1 << MORTON_BITS))) << 32 | k as u64;
            }
            Ok(())
        })?;
        let mut start = [0u32; (1 << FIRST) + 1];
        let bucket = |key: u64| (key >> (32 + 3 * MORTON_BITS - FIRST)) as usize;
        keys.iter().for_each(|&key| start[bucket(key) + 1] += 1);
        (0..1 << FIRST).for_each(|k| start[k + 1] += start[k]);
        let mut sorted = filled("primitives", items.len(), 0u64)?;
        let mut next = start;
        for &key in &keys {
            let slot = &mut next[bucket(key)];
            sorted[*slot as usize] = key;
            *slot += 1;
        }
        drop(keys);
        // Buckets one after another, until there are enough for a task.
        let (mut tasks, mut rest, mut done) = (Vec::new(), &mut sorted[..], 0);
        for &end in &start[1..] {
            let size = end as usize - done;
            if size >= PIECE || (end as usize == items.len() && size > 0) {
                let (own, others) = rest.split_at_mut(size);
                tasks.push(Mutex::new((own, Vec::new(), 0)));
                (rest, done) = (others, end as usize);
            }
        }
        run.for_each_chunk(tasks.len(), &|k| {
            let mut task = tasks[k].lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            let (keys, sizes, crowded) = &mut *task;
            keys.chunk_by_mut(|a, b| bucket(*a) == bucket(*b)).for_each(<[u64]>::sort_unstable);
            sizes.try_reserve(keys.len()).map_err(|_| Error::memory("cells", keys.len()))?;
            *crowded = cut(keys, 3 * MORTON_BITS, sizes);
            Ok(())
        })?;
        let (mut sizes, mut crowded) = (try_with_capacity("cells", items.len() / 4)?, 0);
        for task in tasks {
            let (_, mut own, more) = task.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
            sizes.try_reserve(own.len()).map_err(|_| Error::memory("cells", own.len()))?;
            sizes.append(&mut own);
            crowded += more;
        }
        if crowded > items.len() / FEW {
            return Ok(None);
        }
        let mut all = Cells { items: filled("primitives", items.len(), Item::NONE)?, cells: Vec::new() };
        run.for_each_piece(&mut all.items, PIECE, &|from, piece| {
            for (item, key) in piece.iter_mut().zip(&sorted[from..]) {
                *item = items[*key as u32 as usize];
            }
            Ok(())
        })?;
        all.cells = try_with_capacity("cells", sizes.len())?;
        let mut from = 0;
        for size in sizes {
            let members = &all.items[from..from + size as usize];
            all.cells.push(Item::around(members, from));
            from += size as usize;
        }
        Ok(Some(all))
    }
}

/// Adds the sizes of the cells that sorted keys fall into, whose places agree but for the last `bits`; how many items have
/// places that could not be told apart.
fn cut(keys: &[u64], bits: u32, sizes: &mut Vec<u32>) -> usize {
    if keys.len() <= CELL {
        sizes.extend((!keys.is_empty()).then_some(keys.len() as u32));
        return 0;
    }
    if bits == 0 {
        sizes.extend(keys.chunks(CELL).map(|cell| cell.len() as u32));
        return keys.len();
    }
    let octant = |key: u64| key >> (32 + bits - 3) & 7;
    let mut crowded = 0;
    let mut rest = keys;
    for k in 0..8 {
        let (own, others) = rest.split_at(rest.partition_point(|key| octant(*key) <= k));
        crowded += cut(own, bits - 3, sizes);
        rest = others;
    }
    crowded
}
