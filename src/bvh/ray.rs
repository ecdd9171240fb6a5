// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaves along a ray, the nearest first. In f64, since rays begin anywhere, with room for rounding.

use super::{LEAF, Node, Tree};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::simd::lanes::WIDTH;

/// What boxes are widened by, relative to the distance from the middle: far above the roundings here and those of where
/// a ray meets what is in them.
const ROOM: f64 = 1e-13;

/// A ray as the tree places it.
struct Placed {
    origin: Vec3,
    inverse: Vec3,
    room: f64,
    from: f64,
}

impl Tree {
    /// Visits the leaves that may hold something where a ray, whose direction's largest coordinate is at least 1 and
    /// below 2, meets it at `from` or later and no later than the limit: `to`, then what `visit` says.
    pub(crate) fn along_ray(
        &self,
        origin: Vec3,
        direction: Vec3,
        [from, to]: [f64; 2],
        waiting: &mut Vec<(f64, u32)>,
        mut visit: impl FnMut(usize) -> f64,
    ) -> Result<()> {
        let at = self.place(origin);
        let room = ROOM * (1.0 + at.abs().max_element());
        // Of a coordinate that stays, so large that it is either always or never between two others.
        let inverse = direction.to_array().map(|d| (1.0 / d).clamp(-f64::MAX, f64::MAX));
        let ray = Placed { origin: at, inverse: Vec3::from_array(inverse), room, from: from * self.scale };
        let mut limit = to * self.scale;
        waiting.clear();
        waiting.try_reserve(WIDTH).map_err(|_| Error::memory("nodes", WIDTH))?;
        waiting.push((f64::NEG_INFINITY, 0));
        while let Some((near, child)) = waiting.pop() {
            if near > limit {
                continue;
            }
            if child & LEAF != 0 {
                limit = visit((child & !LEAF) as usize) * self.scale;
                continue;
            }
            let node = &self.nodes[child as usize];
            let [near, far] = ray.within(node);
            let first = waiting.len();
            waiting.try_reserve(WIDTH).map_err(|_| Error::memory("nodes", first + WIDTH))?;
            for k in 0..WIDTH {
                let is_met = near[k] <= far[k] && near[k] <= limit && far[k] >= ray.from;
                if is_met && node.child[k] != u32::MAX {
                    waiting.push((near[k], node.child[k]));
                }
            }
            // The nearest on top.
            waiting[first..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        }
        Ok(())
    }
}

impl Placed {
    /// Where the line comes into each box and leaves it.
    fn within(&self, node: &Node) -> [[f64; WIDTH]; 2] {
        let (mut near, mut far) = ([f64::NEG_INFINITY; WIDTH], [f64::INFINITY; WIDTH]);
        for axis in 0..3 {
            let (o, inverse) = (self.origin[axis], self.inverse[axis]);
            let (lo, hi) = (&node.lo[axis], &node.hi[axis]);
            let (first, last, room) = if inverse < 0.0 { (hi, lo, -self.room) } else { (lo, hi, self.room) };
            for k in 0..WIDTH {
                let enter = (f64::from(first[k]) - room - o) * inverse;
                let leave = (f64::from(last[k]) + room - o) * inverse;
                near[k] = if enter > near[k] { enter } else { near[k] };
                far[k] = if leave < far[k] { leave } else { far[k] };
            }
        }
        [near, far]
    }
}
