// SPDX-License-Identifier: MIT OR Apache-2.0
//! A tree cut down to what matters within a box (Duff 1992): parts that lose against another everywhere in
//! it are left out. Values within the box keep their bits.

use super::Geometry;
use super::node::Node;
use super::parts::Parts;
use super::smooth::Smooth;
use crate::error::{Error, Result, try_with_capacity};
use crate::math::{Aabb, Interval};

impl Geometry {
    /// A geometry with the same values, to the bit, at every double of the finite box `b`, and with no more
    /// parts than may matter there; outside of the box its values mean nothing. Linear in the parts.
    pub fn simplified(&self, b: Aabb) -> Result<Geometry> {
        if b.is_empty() || !b.is_finite() {
            return Err(Error::invalid(format!("lo, hi: {} to {} is no finite box", b.lo, b.hi)));
        }
        self.within(b)
    }

    fn within(&self, b: Aabb) -> Result<Geometry> {
        let node = match self.node() {
            Node::Union(parts) => Node::Union(winners(parts, b, 0.0)?),
            Node::Intersection(parts) => Node::Intersection(winners(parts, b, 0.0)?),
            Node::Smooth(smooth) => {
                let support = smooth.blend().support();
                Node::Smooth(Smooth::new(winners(smooth.parts(), b, support)?, smooth.blend().clone()))
            }
            Node::Complement(g) => Node::Complement(g.within(b)?),
            Node::Translate(g, shift) => Node::Translate(g.within(Aabb::new(b.lo - *shift, b.hi - *shift))?, *shift),
            Node::Place(g, placement) => Node::Place(g.within(placement.box_to_body(b))?, *placement),
            Node::Map(g, map) => Node::Map(g.within(map.box_of(b))?, *map),
            Node::Level(g, level) => Node::Level(g.within(b)?, *level),
            Node::Part(g, label) => Node::Part(g.within(b)?, *label),
            _ => return Ok(self.clone()),
        };
        Geometry::new(node)
    }
}

/// The parts whose least value (signs turned where all are) may come within `support` of the least of all.
fn winners(parts: &Parts, b: Aabb, support: f64) -> Result<Parts> {
    let mut ranges = try_with_capacity("parts", parts.list().len())?;
    for part in parts.list() {
        let range: Interval = part.range(b).intersection(part.range_from_middle(b));
        ranges.push(if parts.is_turned() { -range } else { range });
    }
    let highest = ranges.iter().fold(f64::INFINITY, |least, r| least.min(r.hi));
    let mut kept = try_with_capacity("parts", parts.list().len())?;
    for (part, range) in parts.list().iter().zip(&ranges) {
        if range.lo <= highest + support {
            kept.push(part.within(b)?);
        }
    }
    Parts::new(kept, parts.is_turned())
}
