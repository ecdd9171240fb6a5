// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meetings of a segment with a surface that has no closed form for them: sphere tracing (Hart 1996). From a
//! place of value f the surface is at least |f| / L away, so steps of that length miss nothing; they are not
//! shorter than a fraction of the segment, so the search always ends, and what lies between two such steps
//! and does not change the side is not seen. A change of side is bracketed by a step, and the bracket closed by
//! interpolation, truncation and projection (Oliveira & Takahashi 2020): never more than one evaluation above
//! bisection, whatever the function, and a handful where it is smooth.

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
                let crossing = self.close(a, b, (t, next), (value, ahead));
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

    /// A crossing between ends on opposite sides: the last double before the side changes, seen from the
    /// outside end.
    pub(crate) fn bisect(&self, a: Vec3, b: Vec3) -> f64 {
        self.close(a, b, (0.0, 1.0), (self.raw_value(a), self.raw_value(b)))
    }

    /// The same between two places of the segment with these values.
    fn close(&self, a: Vec3, b: Vec3, (mut lo, mut hi): (f64, f64), (mut below, mut above): (f64, f64)) -> f64 {
        let inside_first = below <= 0.0;
        let least = 0.5 * f64::EPSILON;
        let steepness = 0.2 / (hi - lo);
        // What bisection would still leave, and one step more.
        let mut slack = hi - lo;
        loop {
            let (width, middle) = (hi - lo, 0.5 * (lo + hi));
            if middle <= lo || middle >= hi || width <= 2.0 * least {
                return if inside_first { lo } else { hi };
            }
            let crossing = (above * lo - below * hi) / (above - below);
            let crossing = if crossing.is_finite() { crossing.clamp(lo, hi) } else { middle };
            // Towards the middle: first by a bit, so that both ends come in, then as far as the slack asks.
            let inward = if crossing <= middle { 1.0 } else { -1.0 };
            let nudge = steepness * width * width;
            let truncated = if nudge <= (middle - crossing).abs() { crossing + inward * nudge } else { middle };
            let room = (slack - 0.5 * width).max(0.0);
            let next = if (truncated - middle).abs() <= room { truncated } else { middle - inward * room };
            let next = if next > lo && next < hi { next } else { middle };
            slack *= 0.5;
            let value = self.raw_value(a + (b - a) * next);
            if (value <= 0.0) == inside_first {
                (lo, below) = (next, value);
            } else {
                (hi, above) = (next, value);
            }
        }
    }
}
