// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meetings of a segment with a surface that has no closed form for them: sphere tracing (Hart 1996). From a
//! place of value f the surface is at least |f| / L away, so steps of that length miss nothing; they are not
//! shorter than a fraction of the segment, so the search always ends, and what lies between two such steps
//! and does not change the side is not seen. A change of side is bracketed by a step and bisected.

use super::Geometry;
use super::segment::{Change, Event};
use crate::math::{Vec3, length, unit};

/// Shortest step, in lengths of the segment.
const SHORTEST: f64 = 1.0 / 256.0;

impl Geometry {
    /// The meetings in order; where the Lipschitz constant is unknown, one between ends on different sides.
    pub(super) fn traced_events(&self, a: Vec3, b: Vec3) -> Vec<Event> {
        let slope = self.summary().lipschitz * length(b - a);
        let at = |t: f64| if t < 1.0 { a + (b - a) * t } else { b };
        let mut events = Vec::new();
        let (mut t, mut value) = (0.0, self.raw_value(a));
        while t < 1.0 {
            let step = if slope.is_finite() { (value.abs() / slope).max(SHORTEST) } else { 1.0 };
            // NaN, where a function failed, ends the search as well.
            let next = if step < 1.0 - t { t + step } else { 1.0 };
            let ahead = self.raw_value(at(next));
            let (before, after) = (value <= 0.0, ahead <= 0.0);
            if before != after && !value.is_nan() && !ahead.is_nan() {
                let crossing = self.bisect_between(a, b, (t, next), before);
                let change = if before { Change::Leave } else { Change::Enter };
                let p = at(crossing);
                let near = self.raw_closest(p);
                let event = Event::shape(crossing, change, unit(near.gradient));
                events.push(Event { part: near.part, tag: near.tag, ..event });
            }
            (t, value) = (next, ahead);
        }
        events
    }
}
