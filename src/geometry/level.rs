// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bodies between level sets of another: the value is a function of its value alone.

use super::properties::Kind;
use super::summary::{Summary, grown};
use crate::math::{Aabb, Interval, Vec3};

#[derive(Clone, Copy, Debug)]
pub(super) enum Level {
    /// f - d: grown by d, or shrunk.
    Offset(f64),
    /// |f| - d: a shell, 2 d thick, around the surface.
    Annular(f64),
    /// f / c: a lower bound of the distance where c is the Lipschitz constant.
    Divided(f64),
}

impl Level {
    /// The value, from the child's.
    #[inline]
    pub(super) fn value(self, f: f64) -> f64 {
        match self {
            Level::Offset(d) => f - d,
            Level::Annular(d) => f.abs() - d,
            Level::Divided(c) => f / c,
        }
    }

    /// What the child's gradient is multiplied by where its value is `f`.
    pub(super) fn slope(self, f: f64) -> f64 {
        match self {
            Level::Offset(_) => 1.0,
            Level::Annular(_) if f < 0.0 => -1.0,
            Level::Annular(_) => 1.0,
            Level::Divided(c) => 1.0 / c,
        }
    }

    /// The values of a box, from the child's.
    pub(super) fn range(self, f: Interval) -> Interval {
        match self {
            // Each is monotone, as computed, in the child's value or its magnitude.
            Level::Offset(d) => Interval::new(f.lo - d, f.hi - d),
            Level::Annular(d) => {
                let size = f.abs();
                Interval::new(size.lo - d, size.hi - d)
            }
            Level::Divided(c) => Interval::new(f.lo / c, f.hi / c),
        }
    }

    /// Of the node over a child of which `s` is known.
    pub(super) fn summary(self, s: Summary) -> Summary {
        let kind = |is_exact: bool| match s.kind {
            Kind::Exact if is_exact => Kind::Exact,
            _ if s.lipschitz <= 1.0 => Kind::LowerBound,
            _ => Kind::SignOnly,
        };
        let wider = |b: Aabb, d: f64| if d > 0.0 { grown(b, Vec3::splat(d * s.spread_axis)) } else { b };
        let rounding = |d: f64| (s.rounding.0, s.rounding.1 + 4.0 * f64::EPSILON * d.abs());
        match self {
            Level::Offset(d) => Summary {
                bounds: wider(s.bounds, d),
                rest: wider(s.rest, -d),
                kind: kind(-s.reach_inward < d && d < s.reach_outward),
                reach_outward: (s.reach_outward - d).max(0.0),
                reach_inward: (s.reach_inward + d).max(0.0),
                // Values add their rounding to that of the difference.
                rounding: (rounding(d).0 + 4.0 * f64::EPSILON, rounding(d).1),
                ..s
            },
            Level::Annular(d) => Summary {
                bounds: wider(s.bounds, d),
                rest: Aabb::ALL,
                kind: kind(d < s.reach_inward.min(s.reach_outward)),
                reach_outward: 0.0,
                reach_inward: 0.0,
                rounding: (rounding(d).0 + 4.0 * f64::EPSILON, rounding(d).1),
                ..s
            },
            Level::Divided(c) => Summary {
                kind: if s.lipschitz <= c { Kind::LowerBound } else { Kind::SignOnly },
                // Exactly 1 where it is divided by itself: what is made of it stays a lower bound.
                lipschitz: if s.lipschitz <= c { 1.0 } else { (s.lipschitz / c).next_up() },
                spread: s.spread * c,
                spread_rest: s.spread_rest * c,
                spread_axis: s.spread_axis * c,
                reach_outward: 0.0,
                reach_inward: 0.0,
                rounding: (s.rounding.0 / c + 4.0 * f64::EPSILON, s.rounding.1 / c),
                ..s
            },
        }
    }
}
