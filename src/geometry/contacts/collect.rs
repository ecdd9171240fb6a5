// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pairs gathered chunk by chunk from any number of threads: in the order of the chunks, and no more than a
//! limit, so that what is kept does not depend on which thread was first.

use super::{Found, reserve};
use crate::error::{Result, try_with_capacity};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard};

/// What was handed in.
struct State {
    /// By chunk, until all before it are there.
    waiting: Vec<Option<Vec<[u32; 2]>>>,
    /// The first chunk that is not there.
    next: usize,
    pairs: Vec<[u32; 2]>,
}

/// All chunks of a search.
pub(super) struct Collector {
    limit: usize,
    /// The chunks up to one that is there have as many pairs as are wanted.
    full: AtomicBool,
    state: Mutex<State>,
}

/// The pairs of one chunk.
pub(super) struct Chunk<'a> {
    number: usize,
    pairs: Vec<[u32; 2]>,
    collector: &'a Collector,
}

impl Collector {
    pub fn new(chunks: usize, limit: usize) -> Result<Collector> {
        let mut waiting = try_with_capacity("chunks", chunks)?;
        waiting.resize_with(chunks, || None);
        let state = State { waiting, next: 0, pairs: Vec::new() };
        Ok(Collector { limit, full: AtomicBool::new(limit == 0), state: Mutex::new(state) })
    }

    /// An empty chunk.
    pub fn chunk(&self, number: usize) -> Chunk<'_> {
        Chunk { number, pairs: Vec::new(), collector: self }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    /// Takes what was found of a chunk.
    pub fn hand_in(&self, chunk: Chunk) -> Result<()> {
        let mut state = self.state();
        let State { waiting, next, pairs } = &mut *state;
        waiting[chunk.number] = Some(chunk.pairs);
        while let Some(found) = waiting.get_mut(*next).and_then(Option::take) {
            *next += 1;
            if !self.full.load(Ordering::Relaxed) {
                reserve(pairs, found.len())?;
                pairs.extend_from_slice(&found);
                if pairs.len() >= self.limit {
                    self.full.store(true, Ordering::Relaxed);
                }
            }
        }
        Ok(())
    }

    /// The pairs, in the order of the chunks.
    pub fn finish(self) -> Found {
        let State { mut pairs, .. } = self.state.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        pairs.truncate(self.limit);
        Found { complete: !self.full.into_inner(), pairs }
    }
}

impl Chunk<'_> {
    /// Adds a pair of triangles that meet.
    pub fn add(&mut self, [a, b]: [u32; 2]) -> Result<()> {
        reserve(&mut self.pairs, 1)?;
        self.pairs.push([a.min(b), a.max(b)]);
        Ok(())
    }

    /// Whether more would be thrown away.
    pub fn is_enough(&self) -> bool {
        self.pairs.len() >= self.collector.limit || self.collector.full.load(Ordering::Relaxed)
    }
}
