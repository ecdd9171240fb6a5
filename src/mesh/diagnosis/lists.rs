// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lists of numbers, one after another in one array.

use super::push;
use crate::error::{Error, Result};

/// Any number of lists.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lists {
    items: Vec<u32>,
    /// Where each list ends.
    end: Vec<usize>,
}

impl Lists {
    /// How many lists.
    pub fn len(&self) -> usize {
        self.end.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.end.is_empty()
    }

    /// One of them, where there is one of this number.
    pub fn get(&self, k: usize) -> Option<&[u32]> {
        let start = if k == 0 { 0 } else { *self.end.get(k - 1)? };
        self.items.get(start..*self.end.get(k)?)
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.len()).filter_map(|k| self.get(k))
    }

    /// Adds a list.
    pub(crate) fn push(&mut self, list: impl ExactSizeIterator<Item = u32>) -> Result<()> {
        self.items.try_reserve(list.len()).map_err(|_| Error::memory("numbers", self.items.len() + list.len()))?;
        self.items.extend(list);
        push(&mut self.end, "lists", self.items.len())
    }
}
