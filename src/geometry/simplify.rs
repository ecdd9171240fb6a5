// SPDX-License-Identifier: MIT OR Apache-2.0
//! A tree cut down to what matters within a box (Duff 1992): parts that lose against another everywhere in
//! it are left out. Values within the box keep their bits.

use super::Geometry;
use super::blend::Blend;
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

    /// Recurses: each level keeps little on the stack, and nodes are made after it has returned.
    fn within(&self, b: Aabb) -> Result<Geometry> {
        match self.node() {
            Node::Union(parts) | Node::Intersection(parts) => united(winners(parts, b, 0.0)?, parts.is_turned()),
            Node::Smooth(smooth) => {
                let support = smooth.blend().support();
                blended(winners(smooth.parts(), b, support)?, smooth.blend())
            }
            Node::Complement(g) => wrapped(g.within(b)?, Node::Complement),
            Node::Translate(g, shift) => {
                let g = g.within(Aabb::new(b.lo - *shift, b.hi - *shift))?;
                wrapped(g, |g| Node::Translate(g, *shift))
            }
            Node::Place(g, placement) => {
                let g = g.within(placement.box_to_body(b))?;
                wrapped(g, |g| Node::Place(g, *placement))
            }
            Node::Map(g, map) => wrapped(g.within(map.box_of(b))?, |g| Node::Map(g, *map)),
            Node::Level(g, level) => wrapped(g.within(b)?, |g| Node::Level(g, *level)),
            Node::Part(g, label) => wrapped(g.within(b)?, |g| Node::Part(g, *label)),
            _ => Ok(self.clone()),
        }
    }
}

#[inline(never)]
fn wrapped(g: Geometry, node: impl FnOnce(Geometry) -> Node) -> Result<Geometry> {
    Geometry::new(node(g))
}

#[inline(never)]
fn united(parts: Vec<Geometry>, turned: bool) -> Result<Geometry> {
    let parts = Parts::new(parts, turned)?;
    Geometry::new(if turned { Node::Intersection(parts) } else { Node::Union(parts) })
}

#[inline(never)]
fn blended(parts: Vec<Geometry>, blend: &Blend) -> Result<Geometry> {
    Geometry::new(Node::Smooth(Smooth::new(Parts::new(parts, false)?, blend.clone())))
}

/// The parts whose least value (signs turned where all are) may come within `support` of the least of all.
#[inline(never)]
fn winners(parts: &Parts, b: Aabb, support: f64) -> Result<Vec<Geometry>> {
    let mut kept = contenders(parts, b, support)?;
    for part in &mut kept {
        *part = part.within(b)?;
    }
    Ok(kept)
}

#[inline(never)]
fn contenders(parts: &Parts, b: Aabb, support: f64) -> Result<Vec<Geometry>> {
    let mut ranges = try_with_capacity("parts", parts.list().len())?;
    for part in parts.list() {
        let range: Interval = part.range(b).intersection(part.range_from_middle(b));
        ranges.push(if parts.is_turned() { -range } else { range });
    }
    let highest = ranges.iter().fold(f64::INFINITY, |least, r| least.min(r.hi));
    let mut kept = try_with_capacity("parts", parts.list().len())?;
    let near = parts.list().iter().zip(&ranges).filter(|(_, range)| range.lo <= highest + support);
    kept.extend(near.map(|(part, _)| part.clone()));
    Ok(kept)
}
