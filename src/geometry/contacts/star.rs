// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles that share a vertex.

use super::Contacts;
use super::collect::Chunk;
use crate::error::Result;
use crate::primitive::fan;
use std::ops::Range;

/// Stars of more triangles than this are no longer looked at pair by pair.
const FEW: usize = 32;

impl Contacts<'_> {
    pub(super) fn in_stars(&self, vertices: Range<usize>, found: &mut Chunk) -> Result<()> {
        let mut ring = Vec::new();
        for v in vertices {
            let v = v as u32;
            if self.is_clear(v, &mut ring) {
                continue;
            }
            let leaving = self.topology.outgoing(v);
            if leaving.len() > FEW {
                self.in_hub(v, found)?;
            } else {
                for (k, h) in leaving.iter().enumerate() {
                    for g in &leaving[..k] {
                        let (s, t) = (g / 3, h / 3);
                        if self.touch_at(v, s, t) {
                            found.add([s, t])?;
                        }
                    }
                }
            }
            if found.is_enough() {
                break;
            }
        }
        Ok(())
    }

    /// Whether the triangles at a vertex are one fan or disc that is proved to keep clear of itself. `ring` is
    /// scratch.
    fn is_clear(&self, v: u32, ring: &mut Vec<u32>) -> bool {
        let topology = self.topology;
        let leaving = topology.outgoing(v);
        let Some(&lowest) = leaving.first() else { return true };
        let first = leaving.iter().copied().find(|h| topology.twin(*h).is_none()).unwrap_or(lowest);
        // Each half-edge of the fan leads to a point of the ring, and the last one's triangle has one more.
        ring.clear();
        let (mut at, mut closed) = (first, false);
        for _ in 0..leaving.len() {
            ring.push(topology.target(at));
            let before = topology.previous(at);
            match topology.twin(before) {
                Some(next) if next == first => {
                    closed = true;
                    break;
                }
                Some(next) => at = next,
                None => {
                    ring.push(topology.origin(before));
                    break;
                }
            }
        }
        let triangles = if closed { ring.len() } else { ring.len() - 1 };
        let place = |v: u32| self.vertices[v as usize];
        triangles == leaving.len() && fan::is_clear(place(v), |k| place(ring[k]), ring.len(), closed, self.slack)
    }
}
