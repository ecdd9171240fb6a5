// SPDX-License-Identifier: MIT OR Apache-2.0
//! Smooth union. The values of all parts are blended in rising order, blend(blend(a, b), c) and so on with
//! a <= b <= c, until the next one is further behind the result than the blend's support: the order in which
//! the parts are given makes no difference to the bit, the value goes on continuously where two parts change
//! places, and every part within the support takes part.

use super::blend::Blend;
use super::closest::Closest;
use super::parts::{Found, Parts};
use super::properties::Kind;
use super::summary::{Summary, grown};
use crate::math::{Aabb, Interval, Vec3};

pub(super) struct Smooth {
    parts: Parts,
    blend: Blend,
    /// The most by which blending all parts goes below the least of them.
    depth: f64,
}

impl Smooth {
    /// `parts` are not turned.
    pub(super) fn new(parts: Parts, blend: Blend) -> Smooth {
        let depth = blend.depth(parts.list().len());
        Smooth { parts, blend, depth }
    }

    pub(super) fn parts(&self) -> &Parts {
        &self.parts
    }

    pub(super) fn blend(&self) -> &Blend {
        &self.blend
    }

    /// The parts that count, in rising order; one that is NaN alone.
    fn blended(&self, p: Vec3) -> Vec<Found> {
        let mut found = self.parts.near(p, self.blend.support());
        found.sort_unstable_by(|a, b| a.value.total_cmp(&b.value).then(a.part.cmp(&b.part)));
        found
    }

    /// Blends until the rest is too far behind, or the blend failed: `blend` gets the number of the next part,
    /// the lesser value and the greater, and whether the greater is the next part's.
    fn fold(&self, found: &[Found], mut blend: impl FnMut(usize, f64, f64, bool) -> f64) -> f64 {
        let mut value = found[0].value;
        for (k, next) in found.iter().enumerate().skip(1) {
            if value.is_nan() || next.value - value >= self.blend.support() {
                break;
            }
            // Rounding may bring a user's blend above its lesser value.
            value = blend(k, value.min(next.value), value.max(next.value), value <= next.value);
        }
        value
    }

    #[inline(never)]
    pub(super) fn value(&self, p: Vec3) -> f64 {
        self.fold(&self.blended(p), |_, a, b, _| self.blend.value(a, b))
    }

    /// The value where these are the values of all parts that may count, in their order.
    pub(super) fn of(&self, found: &mut Vec<Found>) -> f64 {
        let mut least = f64::INFINITY;
        for next in found.iter() {
            if next.value.is_nan() {
                return next.value;
            }
            least = if next.value < least { next.value } else { least };
        }
        let end = least + self.blend.support();
        found.retain(|f| f.value < end);
        // What is too large for the support to count stands alone.
        if found.len() < 2 || !least.is_finite() {
            return least;
        }
        self.in_order(found)
    }

    /// The blend of all that count.
    fn in_order(&self, found: &mut [Found]) -> f64 {
        found.sort_unstable_by(|a, b| a.value.total_cmp(&b.value).then(a.part.cmp(&b.part)));
        self.fold(found, |_, a, b, _| self.blend.value(a, b))
    }

    /// The values, where the least of all parts has these.
    pub(super) fn below(&self, least: Interval) -> Interval {
        Interval::new((least.lo - self.depth).next_down(), least.hi)
    }

    /// With the labels of the part of least value.
    #[inline(never)]
    pub(super) fn closest(&self, p: Vec3) -> Closest {
        let found = self.blended(p);
        if found[0].part == usize::MAX {
            return Closest::only(found[0].value);
        }
        let part = |k: usize| &self.parts.list()[found[k].part];
        let winner = part(0).raw_closest(p);
        let mut gradient = winner.gradient;
        let value = self.fold(&found, |k, a, b, is_in_order| {
            let (blended, by_a, by_b) = self.blend.of(a, b);
            let (by_value, by_next) = if is_in_order { (by_a, by_b) } else { (by_b, by_a) };
            gradient = gradient * by_value + part(k).gradient(p) * by_next;
            blended
        });
        let alone = value == winner.value;
        let nowhere = Closest { value, gradient, part: winner.part, tag: winner.tag, ..Closest::only(value) };
        if alone { winner } else { nowhere }
    }

    pub(super) fn range(&self, b: Aabb) -> Interval {
        self.below(self.parts.range(b, self.depth * (1.0 + 1e-9)))
    }

    /// Of the node over parts of whose union `s` is known.
    pub(super) fn summary(&self, s: Summary) -> Summary {
        let n = self.parts.list().len();
        if n < 2 {
            return s;
        }
        let lipschitz = s.lipschitz * self.blend.lipschitz();
        let unit = 16.0 * f64::EPSILON * n.min(1000) as f64;
        Summary {
            bounds: grown(s.bounds, Vec3::splat(self.depth * s.spread_axis)),
            kind: if lipschitz <= 1.0 { Kind::LowerBound } else { Kind::SignOnly },
            lipschitz,
            reach_outward: 0.0,
            reach_inward: 0.0,
            // Blends round values and what they take off.
            rounding: (
                s.rounding.0 + 4.0 * unit * s.steepness(),
                s.rounding.1 + unit * (self.depth + s.extent() + s.magnitude),
            ),
            magnitude: s.magnitude + self.depth,
            ..s
        }
    }
}
