// SPDX-License-Identifier: MIT OR Apache-2.0
//! A set of edges in a hash table with a fixed hash.

use crate::error::{Result, filled};

const FREE: u64 = u64::MAX;

/// Pairs of vertices, in either order.
pub(in crate::mesh) struct EdgeSet {
    /// A power of two, at least twice as many as edges.
    slots: Vec<u64>,
    count: usize,
}

impl EdgeSet {
    pub fn new() -> Result<EdgeSet> {
        Ok(EdgeSet { slots: filled("hash slots", 1 << 6, FREE)?, count: 0 })
    }

    pub fn contains(&self, a: u32, b: u32) -> bool {
        let key = key(a, b);
        self.slots[self.slot(key)] == key
    }

    pub fn insert(&mut self, a: u32, b: u32) -> Result<()> {
        let key = key(a, b);
        let slot = self.slot(key);
        if self.slots[slot] == FREE {
            self.slots[slot] = key;
            self.count += 1;
            if 2 * self.count > self.slots.len() {
                self.grow()?;
            }
        }
        Ok(())
    }

    fn grow(&mut self) -> Result<()> {
        let larger = filled("hash slots", 4 * self.slots.len(), FREE)?;
        for key in std::mem::replace(&mut self.slots, larger).into_iter().filter(|key| *key != FREE) {
            let slot = self.slot(key);
            self.slots[slot] = key;
        }
        Ok(())
    }

    /// Where an edge is, or the free slot where it belongs. The mixing is that of MurmurHash3.
    fn slot(&self, key: u64) -> usize {
        let h = (key ^ (key >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        let h = (h ^ (h >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
        let mask = self.slots.len() - 1;
        let mut slot = (h ^ (h >> 33)) as usize & mask;
        while self.slots[slot] != FREE && self.slots[slot] != key {
            slot = (slot + 1) & mask;
        }
        slot
    }
}

fn key(a: u32, b: u32) -> u64 {
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}
