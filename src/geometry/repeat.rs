// SPDX-License-Identifier: MIT OR Apache-2.0
//! Finite repetition: the union of copies at i * period, without the copies. Only those are asked that the
//! child's bounds do not rule out, so the answer is that of the union of all of them, to the bit.

use super::Geometry;
use super::classify::POSITIVE;
use super::parts::Found;
use super::properties::Kind;
use super::summary::{ROOT_OF_THREE, Summary, extent, grown};
use crate::error::{Error, Result};
use crate::math::{Aabb, Interval, Vec3, length};
use crate::store::Packer;

/// Copies that may have to be asked one by one for one point.
const MOST_AT_ONCE: f64 = 1_048_576.0;

/// A box that meets more copies than this is taken as mixed.
const MOST_IN_A_BOX: u64 = 256;

pub(super) struct Repeat {
    child: Geometry,
    period: Vec3,
    counts: [u32; 3],
}

impl Repeat {
    pub(super) fn new(child: Geometry, period: Vec3, counts: [u32; 3]) -> Result<Repeat> {
        let repeat = Repeat { child, period, counts };
        let bounds = repeat.child.summary().bounds;
        // Copies that may be at one point: of a body without bounds, all.
        let at_once = |k: usize| match repeat.is_bounded() {
            true => ((bounds.hi[k] - bounds.lo[k]) / period[k].abs() + 2.0).min(f64::from(counts[k])),
            false => f64::from(counts[k]),
        };
        let copies = at_once(0) * at_once(1) * at_once(2);
        if copies > MOST_AT_ONCE {
            return Err(Error::unsupported(format!(
                "counts: {copies:.0} copies may be at one point, more than {MOST_AT_ONCE}: the period is that much smaller than the body, or the body has no bounds"
            )));
        }
        Ok(repeat)
    }

    pub(super) fn pack(&self, out: &mut Packer) {
        out.vector(self.period);
        self.counts.iter().for_each(|&count| out.word(u64::from(count)));
    }

    pub(super) fn child(&self) -> &Geometry {
        &self.child
    }

    /// Whether the child's bounds say where its value is not small.
    fn is_bounded(&self) -> bool {
        let s = self.child.summary();
        s.bounds.is_finite() && !s.bounds.is_empty() && s.spread.is_finite()
    }

    pub(super) fn shift(&self, at: [u32; 3]) -> Vec3 {
        self.period * Vec3::from_array(at.map(f64::from))
    }

    /// Copies in the order of the union: x fastest.
    fn number(&self, at: [u32; 3]) -> usize {
        let [nx, ny, _] = self.counts.map(|c| c as usize);
        at[0] as usize + nx * (at[1] as usize + ny * at[2] as usize)
    }

    fn place(&self, number: usize) -> [u32; 3] {
        let [nx, ny, _] = self.counts.map(|c| c as usize);
        [(number % nx) as u32, (number / nx % ny) as u32, (number / nx / ny) as u32]
    }

    /// The copies along an axis whose interval [lo, hi] may come within [from, to]; first > last: none.
    fn along(&self, axis: usize, (lo, hi): (f64, f64), (from, to): (f64, f64)) -> (u32, u32) {
        let (period, last) = (self.period[axis], self.counts[axis] - 1);
        if period == 0.0 || last == 0 {
            return (0, last);
        }
        let (a, b) = ((from - hi) / period, (to - lo) / period);
        // One more on both sides for rounding.
        let (a, b) = (a.min(b).floor() - 1.0, a.max(b).ceil() + 1.0);
        if a > f64::from(last) || b < 0.0 {
            return (1, 0);
        }
        (a.max(0.0) as u32, b.min(f64::from(last)) as u32)
    }

    /// The least value and the number of the copy it belongs to.
    #[inline(never)]
    pub(super) fn least(&self, p: Vec3) -> Found {
        let s = self.child.summary();
        let mut best = Found { value: f64::INFINITY, part: usize::MAX };
        let offer = |at: [u32; 3], best: &mut Found| {
            let (value, part) = (self.child.raw_value(p - self.shift(at)), self.number(at));
            if value < best.value || (value == best.value && part < best.part) || value.is_nan() {
                *best = Found { value, part };
            }
        };
        let is_bounded = self.is_bounded() && p.is_finite();
        let nearest: Option<[u32; 3]> = is_bounded.then(|| {
            let offset = p - s.bounds.center();
            std::array::from_fn(|k| match self.period[k] {
                0.0 => 0,
                period => libm::rint(offset[k] / period).clamp(0.0, f64::from(self.counts[k] - 1)) as u32,
            })
        });
        if let Some(at) = nearest {
            offer(at, &mut best);
        }
        let extent = ROOT_OF_THREE * (p.abs().max_element() + self.farthest());
        let reach = |value: f64| {
            let margin = (s.rounding.0 + 16.0 * f64::EPSILON) * extent + s.rounding.1;
            let reach = value + margin;
            // Inside, a value is no lower than the depth in the bounds times the Lipschitz constant.
            let reach = if reach > 0.0 { reach * s.spread } else { reach / s.lipschitz.max(1.0) };
            reach * (1.0 + 1e-14 * reach.signum()) + margin
        };
        let near = |axis: usize, reach: f64| match is_bounded {
            true => {
                let reach = reach.max(0.0);
                self.along(axis, (s.bounds.lo[axis], s.bounds.hi[axis]), (p[axis] - reach, p[axis] + reach))
            }
            false => (0, self.counts[axis] - 1),
        };
        let mut limit = reach(best.value);
        let (z0, z1) = near(2, limit);
        for z in z0..=z1 {
            let (y0, y1) = near(1, limit);
            for y in y0..=y1 {
                let (x0, x1) = near(0, limit);
                for x in x0..=x1 {
                    let at = [x, y, z];
                    // Once only: asked twice, lattices within lattices would take twice as long with each level.
                    let is_asked = nearest == Some(at);
                    if is_asked || (is_bounded && box_key(s.bounds, p - self.shift(at)) > key(limit)) {
                        continue;
                    }
                    offer(at, &mut best);
                    if best.value.is_nan() {
                        return best;
                    }
                    limit = reach(best.value);
                }
            }
        }
        best
    }

    fn farthest(&self) -> f64 {
        let last = self.counts.map(|c| c - 1);
        self.shift(last).abs().max_element()
    }

    /// The child's copy of this number, as a shift.
    pub(super) fn copy(&self, number: usize) -> Vec3 {
        self.shift(self.place(number))
    }

    /// Shifts of the copies whose bounds may meet a box; none where they are too many to look at.
    pub(super) fn meeting(&self, b: Aabb, most: u64) -> Option<Vec<Vec3>> {
        let own = self.child.summary().bounds;
        let own = Aabb::new(own.lo.min(own.hi), own.lo.max(own.hi));
        let room = Vec3::splat(64.0 * f64::EPSILON * (self.farthest() + own.hi.abs().max(own.lo.abs()).max_element()));
        let own = if own.is_finite() { Aabb::new(own.lo - room, own.hi + room) } else { Aabb::ALL };
        let range: [(u32, u32); 3] = std::array::from_fn(|k| match own.is_finite() && b.is_finite() {
            true => self.along(k, (own.lo[k], own.hi[k]), (b.lo[k], b.hi[k])),
            false => (0, self.counts[k] - 1),
        });
        if range.iter().any(|(first, last)| first > last) {
            return Some(Vec::new());
        }
        let copies = range.iter().fold(1u64, |n, (first, last)| n.saturating_mul(u64::from(last - first) + 1));
        if copies > most {
            return None;
        }
        let mut shifts = Vec::new();
        for z in range[2].0..=range[2].1 {
            for y in range[1].0..=range[1].1 {
                shifts.extend((range[0].0..=range[0].1).map(|x| self.shift([x, y, z])));
            }
        }
        Some(shifts)
    }

    /// Shifts of the copies, in order, whose value may be `highest` or less somewhere in a finite box; none where they
    /// are more than `most`, or where there is no telling.
    pub(super) fn near_box(&self, b: Aabb, highest: f64, most: u64) -> Option<Vec<Vec3>> {
        if !self.is_bounded() || !highest.is_finite() {
            return None;
        }
        let s = self.child.summary();
        let margin = s.error(extent(b) + self.farthest()) + 64.0 * f64::EPSILON * (extent(b) + self.farthest());
        let reach = (highest.max(0.0) + margin) * s.spread * (1.0 + 1e-9) + margin;
        self.meeting(grown(b, Vec3::splat(reach)), most)
    }

    pub(super) fn range(&self, b: Aabb) -> Interval {
        let Some(shifts) = self.meeting(b, MOST_IN_A_BOX) else { return Interval::ALL };
        // Subtraction is monotone: the shifted box holds every shifted point, rounding included.
        let ranges = shifts.into_iter().map(|d| self.child.range(Aabb::new(b.lo - d, b.hi - d)));
        ranges.fold(POSITIVE, Interval::min)
    }

    pub(super) fn summary(&self) -> Summary {
        let s = *self.child.summary();
        let last = self.shift(self.counts.map(|c| c - 1));
        let size = |b: Aabb| if b.is_finite() { b.lo.abs().max(b.hi.abs()).max_element() } else { 0.0 };
        let room = 8.0 * f64::EPSILON * (size(s.bounds) + last.abs().max_element());
        let moved = Aabb::new(s.bounds.lo + last.min(Vec3::ZERO), s.bounds.hi + last.max(Vec3::ZERO));
        let apart =
            (0..3).all(|k| self.counts[k] == 1 || self.period[k].abs() > s.bounds.hi[k] - s.bounds.lo[k] + 4.0 * room);
        let single = self.counts == [1; 3];
        let steep = s.steepness();
        Summary {
            bounds: grown(moved, Vec3::splat(room)),
            // Of what is outside of every copy, that of the first.
            rest: s.rest,
            kind: if single || (s.kind == Kind::Exact && apart) { s.kind } else { s.kind.max(Kind::LowerBound) },
            spread_rest: s.spread_rest,
            reach_outward: if single { s.reach_outward } else { 0.0 },
            reach_inward: if single { s.reach_inward } else { 0.0 },
            rounding: (
                s.rounding.0 + 4.0 * f64::EPSILON * steep,
                s.rounding.1 + (s.rounding.0 + 4.0 * f64::EPSILON * steep) * length(last),
            ),
            magnitude: s.magnitude + steep * length(last),
            ..s
        }
    }

    pub(super) fn words(&self, add: &mut dyn FnMut(u64)) {
        self.period.to_array().iter().for_each(|x| add((x + 0.0).to_bits()));
        self.counts.iter().for_each(|c| add(u64::from(*c)));
    }
}

/// Signed distances by their signed squares, which order alike and need no root.
fn key(distance: f64) -> f64 {
    distance * distance.abs()
}

/// Key of the distance to a box; inside, of minus the distance to its nearest face.
fn box_key(b: Aabb, p: Vec3) -> f64 {
    let outside = (b.lo - p).max(p - b.hi);
    let deepest = outside.max_element();
    if deepest < 0.0 { key(deepest) } else { outside.max(Vec3::ZERO).length_squared() }
}
