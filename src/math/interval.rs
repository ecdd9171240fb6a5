// SPDX-License-Identifier: MIT OR Apache-2.0
//! Intervals rounded outward: each operation holds every result that its operands can give, as computed in
//! doubles and in exact arithmetic alike (Moore 1966).

/// The closed interval `[lo, hi]`, `lo <= hi`, possibly infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

impl Interval {
    /// Every number.
    pub const ALL: Interval = Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// `[lo, hi]`; every number where that is none (NaN, or `lo > hi`).
    pub fn new(lo: f64, hi: f64) -> Interval {
        if lo <= hi { Interval { lo, hi } } else { Interval::ALL }
    }

    /// One number.
    pub fn point(x: f64) -> Interval {
        Interval::new(x, x)
    }

    /// `middle` plus or minus `reach`, not below zero.
    pub fn around(middle: f64, reach: f64) -> Interval {
        Interval::new((middle - reach).next_down(), (middle + reach).next_up())
    }

    /// -1 where all of it is negative, +1 where all of it is positive, else 0.
    pub fn sign(self) -> i32 {
        i32::from(self.lo > 0.0) - i32::from(self.hi < 0.0)
    }

    /// What is in both, where both hold the same value.
    pub fn intersection(self, other: Interval) -> Interval {
        Interval::new(self.lo.max(other.lo), self.hi.min(other.hi))
    }

    /// Around both.
    pub fn hull(self, other: Interval) -> Interval {
        Interval { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The lesser of two values.
    pub fn min(self, other: Interval) -> Interval {
        Interval { lo: self.lo.min(other.lo), hi: self.hi.min(other.hi) }
    }

    /// The greater of two values.
    pub fn max(self, other: Interval) -> Interval {
        Interval { lo: self.lo.max(other.lo), hi: self.hi.max(other.hi) }
    }

    /// The magnitude.
    pub fn abs(self) -> Interval {
        if self.lo >= 0.0 {
            self
        } else if self.hi <= 0.0 {
            -self
        } else {
            Interval { lo: 0.0, hi: self.hi.max(-self.lo) }
        }
    }

    /// Both ends moved by one unit of rounding.
    pub(crate) fn outward(self) -> Interval {
        Interval::new(self.lo.next_down(), self.hi.next_up())
    }
}

impl std::ops::Neg for Interval {
    type Output = Interval;

    fn neg(self) -> Interval {
        Interval { lo: -self.hi, hi: -self.lo }
    }
}

impl std::ops::Add for Interval {
    type Output = Interval;

    fn add(self, other: Interval) -> Interval {
        let sum = Interval { lo: self.lo + other.lo, hi: self.hi + other.hi };
        // A sum that comes out as zero is exact: magnitudes keep their sign.
        let lo = if sum.lo == 0.0 { 0.0 } else { sum.lo.next_down() };
        let hi = if sum.hi == 0.0 { 0.0 } else { sum.hi.next_up() };
        Interval::new(lo, hi)
    }
}

impl std::ops::Sub for Interval {
    type Output = Interval;

    fn sub(self, other: Interval) -> Interval {
        self + -other
    }
}

impl std::ops::Mul for Interval {
    type Output = Interval;

    fn mul(self, other: Interval) -> Interval {
        // Zero times infinity is zero here: infinity stands for numbers without limit.
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let all = [
            product(self.lo, other.lo),
            product(self.lo, other.hi),
            product(self.hi, other.lo),
            product(self.hi, other.hi),
        ];
        let lo = all.into_iter().fold(f64::INFINITY, f64::min);
        let hi = all.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let product = Interval { lo, hi }.outward();
        // Products of magnitudes are none below zero, even where they underflow.
        let magnitudes = (self.lo >= 0.0 && other.lo >= 0.0) || (self.hi <= 0.0 && other.hi <= 0.0);
        if magnitudes { Interval { lo: product.lo.max(0.0), hi: product.hi } } else { product }
    }
}
