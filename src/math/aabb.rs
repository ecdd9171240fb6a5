// SPDX-License-Identifier: MIT OR Apache-2.0
//! Axis-aligned boxes, closed, possibly infinite, possibly empty.

use super::Vec3;

/// The closed box `[lo, hi]`. Empty when `lo > hi` on some axis; [`Aabb::EMPTY`] is the canonical one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Lower corner.
    pub lo: Vec3,
    /// Upper corner.
    pub hi: Vec3,
}

impl Aabb {
    /// No point at all: `lo = +inf`, `hi = -inf`.
    pub const EMPTY: Aabb = Aabb { lo: Vec3::INFINITY, hi: Vec3::NEG_INFINITY };
    /// All of space.
    pub const ALL: Aabb = Aabb { lo: Vec3::NEG_INFINITY, hi: Vec3::INFINITY };

    /// The box `[lo, hi]`.
    pub fn new(lo: Vec3, hi: Vec3) -> Aabb {
        Aabb { lo, hi }
    }

    /// The smallest box around `points`.
    pub fn of(points: impl IntoIterator<Item = Vec3>) -> Aabb {
        points.into_iter().fold(Aabb::EMPTY, |b, p| Aabb::new(b.lo.min(p), b.hi.max(p)))
    }

    /// The smallest box around both.
    #[inline]
    pub fn hull(self, other: Aabb) -> Aabb {
        // One instruction each, where `f64::min` spends three on NaN.
        let min = |a: f64, b: f64| if a < b { a } else { b };
        let max = |a: f64, b: f64| if a > b { a } else { b };
        let ((a, b), (c, d)) = ((self.lo, other.lo), (self.hi, other.hi));
        Aabb {
            lo: Vec3::new(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)),
            hi: Vec3::new(max(c.x, d.x), max(c.y, d.y), max(c.z, d.z)),
        }
    }

    /// The points in both; [`Aabb::EMPTY`] when there are none.
    pub fn intersection(self, other: Aabb) -> Aabb {
        let b = Aabb::new(self.lo.max(other.lo), self.hi.min(other.hi));
        if b.is_empty() { Aabb::EMPTY } else { b }
    }

    /// Whether no point is inside.
    pub fn is_empty(self) -> bool {
        !(self.lo.x <= self.hi.x && self.lo.y <= self.hi.y && self.lo.z <= self.hi.z)
    }

    /// Whether all corners are finite.
    pub fn is_finite(self) -> bool {
        self.lo.is_finite() && self.hi.is_finite()
    }

    /// Whether `p` is inside or on the boundary.
    pub fn contains(self, p: Vec3) -> bool {
        self.lo.cmple(p).all() && p.cmple(self.hi).all()
    }

    /// The middle, computed without overflow.
    pub fn center(self) -> Vec3 {
        self.lo * 0.5 + self.hi * 0.5
    }

    /// Length of the diagonal.
    pub fn diagonal(self) -> f64 {
        super::length(self.hi - self.lo)
    }
}
