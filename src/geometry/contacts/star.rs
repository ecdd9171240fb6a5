// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles that share a vertex.

use super::Contacts;
use super::collect::Chunk;
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::primitive::fan;
use std::ops::Range;

/// Stars of more triangles than this are no longer looked at pair by pair.
const FEW: usize = 32;

impl Contacts<'_> {
    pub(super) fn in_stars(&self, vertices: Range<usize>, found: &mut Chunk) -> Result<()> {
        let mut spokes = Vec::new();
        for v in vertices {
            let v = v as u32;
            if self.is_clear(v, &mut spokes)? {
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

    /// Whether the triangles at a vertex are one fan or disc that is proved to keep clear of itself. `spokes` is
    /// scratch.
    fn is_clear(&self, v: u32, spokes: &mut Vec<Vec3>) -> Result<bool> {
        let topology = self.topology;
        let leaving = topology.outgoing(v);
        let Some(&lowest) = leaving.first() else { return Ok(true) };
        let first = leaving.iter().copied().find(|h| topology.twin(*h).is_none()).unwrap_or(lowest);
        // Each half-edge of the fan leads to a point of the ring, and the last one's triangle has one more.
        spokes.clear();
        spokes.try_reserve(leaving.len() + 1).map_err(|_| Error::memory("vertices", leaving.len() + 1))?;
        let center = self.vertices[v as usize];
        let spoke = |v: u32| self.vertices[v as usize] - center;
        let (mut at, mut closed) = (first, false);
        for _ in 0..leaving.len() {
            // (Faces are triangles.)
            let (t, k) = (at / 3, at % 3);
            let [a, b, c] = self.triangles[t as usize].vertices;
            let (to, back, before) = match k {
                0 => (b, c, at + 2),
                1 => (c, a, at - 1),
                _ => (a, b, at - 1),
            };
            spokes.push(spoke(to));
            match topology.twin(before) {
                Some(next) if next == first => {
                    closed = true;
                    break;
                }
                Some(next) => at = next,
                None => {
                    spokes.push(spoke(back));
                    break;
                }
            }
        }
        let triangles = if closed { spokes.len() } else { spokes.len() - 1 };
        Ok(triangles == leaving.len() && fan::is_clear(spokes, closed, self.slack))
    }
}
