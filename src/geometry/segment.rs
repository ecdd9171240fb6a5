// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where a segment enters and leaves a body (Roth 1982): the shapes' own crossings, combined by the
//! logic of the tree.

use super::Geometry;
use super::node::Node;
use super::shape::Crossings;
use super::surface::{Hit, Surface};
use crate::math::{Aabb, Vec3, positive_zero};

/// No label.
pub(crate) const NO_PART: i32 = -1;
/// No tag.
pub(crate) const NO_TAG: i32 = -1;

/// Copies of a repeated body that are looked at one by one along a segment.
const MOST_COPIES: u64 = 4096;

/// What happens at a meeting with the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Change {
    /// From outside to inside.
    Enter,
    /// From inside to outside.
    Leave,
    /// An unsigned sheet: no side changes.
    Touch,
}

/// One meeting of a segment with the surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Event {
    /// 0 at the start, 1 at the end.
    pub(crate) t: f64,
    pub(crate) change: Change,
    /// Outward unit normal of the body.
    pub(crate) normal: Vec3,
    pub(crate) primitive: i64,
    pub(crate) part: i32,
    pub(crate) tag: i32,
}

impl Event {
    pub(super) fn shape(t: f64, change: Change, normal: Vec3) -> Event {
        Event { t: positive_zero(t), change, normal, primitive: -1, part: NO_PART, tag: NO_TAG }
    }

    /// Seen from the other side of the surface.
    pub(super) fn turned(self) -> Event {
        let change = match self.change {
            Change::Enter => Change::Leave,
            Change::Leave => Change::Enter,
            Change::Touch => Change::Touch,
        };
        Event { change, normal: -self.normal, ..self }
    }
}

impl Geometry {
    /// The meetings of the segment from `a` to `b` (finite, different) with the surface, in order. In closed
    /// form where there is one; elsewhere by steps that the Lipschitz constant allows (see `trace.rs`), or,
    /// where that is unknown, from the sides of the ends alone.
    pub(crate) fn events(&self, a: Vec3, b: Vec3) -> Vec<Event> {
        match self.node() {
            Node::Sphere(_) | Node::Shape(_) => match self.node().shape().map(|shape| shape.crossings(a, b)) {
                Some(Crossings::Between(enter, leave)) => within(Some((enter, leave))),
                Some(Crossings::Misses) => Vec::new(),
                _ => self.traced_events(a, b),
            },
            Node::Surface(surface) => surface_events(surface, a, b),
            Node::Function { .. } | Node::Smooth(_) | Node::Level(..) | Node::Stencil(..) => self.traced_events(a, b),
            Node::Union(parts) | Node::Intersection(parts) => {
                let near = parts.meeting(Aabb::of([a, b]));
                combined(near.into_iter().map(|k| Placed(&parts.list()[k], Vec3::ZERO)), a, b, parts.is_turned())
            }
            Node::Repeat(repeat) => match repeat.meeting(Aabb::of([a, b]), MOST_COPIES) {
                Some(shifts) => combined(shifts.into_iter().map(|shift| Placed(repeat.child(), shift)), a, b, false),
                None => self.traced_events(a, b),
            },
            Node::Complement(g) => g.events(a, b).into_iter().map(Event::turned).collect(),
            Node::Translate(g, shift) => g.events(a - *shift, b - *shift),
            Node::Place(g, placement) => {
                let mut events = g.events(placement.to_body(a), placement.to_body(b));
                events.iter_mut().for_each(|e| e.normal = placement.direction(e.normal));
                events
            }
            Node::Map(g, map) if map.is_linear() => {
                let (from, to) = (map.point(a), map.point(b));
                let mut events = if from == to { Vec::new() } else { g.events(from, to) };
                events.iter_mut().for_each(|e| e.normal = crate::math::unit(map.gradient(a, 0.0, e.normal)));
                events
            }
            Node::Map(..) => self.traced_events(a, b),
            Node::Part(g, label) => {
                let mut events = g.events(a, b);
                events.iter_mut().filter(|e| e.part == NO_PART).for_each(|e| e.part = *label);
                events
            }
        }
    }

    /// Whether the value there is not positive.
    pub(crate) fn is_inside(&self, p: Vec3) -> bool {
        self.raw_value(p) <= 0.0
    }

    /// Whether steps along a segment cannot miss much: without a Lipschitz constant a body between its ends goes
    /// unseen, and a crossing of another body within it is none.
    pub(crate) fn has_slope(&self) -> bool {
        let s = self.summary();
        // A surface alone knows all of its crossings.
        s.lipschitz.is_finite() && (!s.jumps || self.has_blocks())
    }

    /// Whether the sides are different a millionth of the segment before and after a place.
    pub(crate) fn changes_side(&self, a: Vec3, b: Vec3, t: f64) -> bool {
        let at = |t: f64| if t < 1.0 { a + (b - a) * t.max(0.0) } else { b };
        self.is_inside(at(t - 1e-6)) != self.is_inside(at(t + 1e-6))
    }

    /// The normal and labels at a crossing that was bisected.
    pub(crate) fn bisected_event(&self, p: Vec3, t: f64, change: Change) -> Event {
        let near = self.closest(p);
        let normal = crate::math::unit(near.gradient);
        Event { t, change, normal, primitive: near.primitive, part: near.part, tag: near.tag }
    }
}

/// The part of an interval of the line that lies on the segment.
fn within(interval: Option<((f64, Vec3), (f64, Vec3))>) -> Vec<Event> {
    let mut events = Vec::new();
    if let Some((enter, leave)) = interval {
        if (0.0..=1.0).contains(&enter.0) {
            events.push(Event::shape(enter.0, Change::Enter, enter.1));
        }
        if (0.0..=1.0).contains(&leave.0) {
            events.push(Event::shape(leave.0, Change::Leave, leave.1));
        }
    }
    events
}

/// Of all triangles met, those where the winding number passes between 0 and 1.
fn surface_events(surface: &Surface, a: Vec3, b: Vec3) -> Vec<Event> {
    if surface.bounds().intersection(Aabb::of([a, b])).is_empty() {
        return Vec::new();
    }
    let hits = surface.hits(a, b);
    let winding = if surface.is_signed() && !hits.is_empty() { surface.winding_before(a) } else { 0 };
    let mut events = Vec::new();
    side_changes(surface, &hits, winding, &mut events);
    events
}

/// Of the triangles met from a point of this winding number on, those where the side changes.
pub(super) fn side_changes(surface: &Surface, hits: &[Hit], mut winding: i32, events: &mut Vec<Event>) {
    for hit in hits {
        let before = winding >= 1;
        winding += hit.change;
        if surface.is_cap(hit.triangle) {
            continue;
        }
        let change = match (surface.is_signed(), before, winding >= 1) {
            (false, ..) => Change::Touch,
            (_, false, true) => Change::Enter,
            (_, true, false) => Change::Leave,
            _ => continue,
        };
        events.push(Event {
            t: positive_zero(hit.t),
            change,
            normal: hit.normal,
            primitive: surface.face(hit.triangle),
            part: NO_PART,
            tag: surface.tag(hit.triangle),
        });
    }
}

/// A part, moved by a shift.
struct Placed<'a>(&'a Geometry, Vec3);

/// Union, or intersection as the complement of the union of complements: a sweep that counts the parts
/// the segment is inside of. At one place entering comes before leaving, so parts in contact are one. Parts
/// left out are those that the segment is outside of (of whose complements, where complemented).
fn combined<'a>(parts: impl Iterator<Item = Placed<'a>>, a: Vec3, b: Vec3, complemented: bool) -> Vec<Event> {
    let mut all = Vec::new();
    let mut depth = 0;
    for Placed(part, shift) in parts {
        let (a, b) = (a - shift, b - shift);
        let events = part.events(a, b);
        let first = events.iter().map(|e| e.change).find(|c| *c != Change::Touch);
        let inside = match first {
            Some(change) => change == Change::Leave,
            None => part.is_inside(a),
        };
        depth += i32::from(inside != complemented);
        all.extend(events.into_iter().map(|e| if complemented { e.turned() } else { e }));
    }
    all.sort_by(|u, v| u.t.total_cmp(&v.t).then((u.change == Change::Leave).cmp(&(v.change == Change::Leave))));
    all.retain(|e| match e.change {
        Change::Touch => depth == 0,
        Change::Enter => {
            depth += 1;
            depth == 1
        }
        Change::Leave => {
            depth -= 1;
            depth == 0
        }
    });
    if complemented { all.into_iter().map(Event::turned).collect() } else { all }
}
