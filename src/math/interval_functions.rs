// SPDX-License-Identifier: MIT OR Apache-2.0
//! Elementary functions of intervals (Moore 1966): each holds what the crate `libm` computes and the exact
//! values alike. `None` where a function is not defined on all of the interval.

use super::Interval;
use std::f64::consts::{FRAC_PI_2, PI};

/// libm is good to two units in the last place; twice that and once more for the end itself.
const ERROR: f64 = 4.0 * f64::EPSILON;

/// Beyond this the quarter of the circle is not told apart any more.
const FAR: f64 = 1e6;

/// More than the rounding of x / pi for |x| <= FAR.
const SLACK: f64 = 1e-8;

impl Interval {
    /// Both ends moved by what libm may be off.
    fn inexact(self) -> Interval {
        let reach = |end: f64| ERROR * end.abs() + f64::MIN_POSITIVE;
        Interval::new(self.lo - reach(self.lo), self.hi + reach(self.hi))
    }

    /// A rising function.
    fn rising(self, f: fn(f64) -> f64) -> Interval {
        Interval::new(f(self.lo), f(self.hi)).inexact()
    }

    /// Cut to [lo, hi], where the values surely lie there.
    fn within(self, lo: f64, hi: f64) -> Interval {
        Interval::new(self.lo.clamp(lo, hi), self.hi.clamp(lo, hi))
    }

    /// Whether `x` is in it.
    pub fn contains(self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// The greatest magnitude.
    pub fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// Quotients by numbers that are not zero.
    pub fn quotient(self, by: Interval) -> Option<Interval> {
        if by.contains(0.0) {
            return None;
        }
        let all = [self.lo / by.lo, self.lo / by.hi, self.hi / by.lo, self.hi / by.hi];
        let lo = all.into_iter().fold(f64::INFINITY, f64::min);
        let hi = all.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Some(Interval::new(lo, hi).outward())
    }

    /// Square roots.
    pub fn sqrt(self) -> Option<Interval> {
        (self.lo >= 0.0).then(|| Interval::new(self.lo.sqrt(), self.hi.sqrt()).outward().within(0.0, f64::INFINITY))
    }

    /// The product of `n` factors, multiplied as [`power`] does.
    pub fn power(self, n: u32) -> Interval {
        let of = |x: f64| power(Interval::point(x.abs()), Interval::point(1.0), n);
        if n.is_multiple_of(2) {
            let size = self.abs();
            return of(size.lo).hull(of(size.hi));
        }
        let end = |x: f64| if x < 0.0 { -of(x) } else { of(x) };
        end(self.lo).hull(end(self.hi))
    }

    /// a^b for a > 0, or a = 0 and b > 0: monotone in either, so the extremes are at corners.
    pub fn pow(self, b: Interval) -> Option<Interval> {
        if self.lo < 0.0 || (self.lo == 0.0 && b.lo <= 0.0) {
            return None;
        }
        let corner = |x: f64, y: f64| Interval::point(libm::pow(x, y));
        let hull = corner(self.lo, b.lo).hull(corner(self.lo, b.hi));
        let hull = hull.hull(corner(self.hi, b.lo)).hull(corner(self.hi, b.hi));
        Some(hull.inexact().within(0.0, f64::INFINITY))
    }

    /// e^x.
    pub fn exp(self) -> Interval {
        self.rising(libm::exp).within(0.0, f64::INFINITY)
    }

    /// Natural logarithms of positive numbers.
    pub fn ln(self) -> Option<Interval> {
        (self.lo > 0.0).then(|| self.rising(libm::log))
    }

    /// Decimal logarithms of positive numbers.
    pub fn log10(self) -> Option<Interval> {
        (self.lo > 0.0).then(|| self.rising(libm::log10))
    }

    /// The whole numbers k for which (k + shift) pi may be in it: the first and the last; None where it is far
    /// from zero.
    fn half_turns(self, shift: f64) -> Option<(f64, f64)> {
        let first = (self.lo / PI - shift - SLACK).ceil();
        let last = (self.hi / PI - shift + SLACK).floor();
        (self.magnitude() <= FAR).then_some((first, last))
    }

    /// A function with value 1 at even half turns and -1 at odd ones, monotone between.
    fn wave(self, f: fn(f64) -> f64, shift: f64) -> Interval {
        let Some((first, last)) = self.half_turns(shift) else {
            return Interval::new(-1.0, 1.0);
        };
        if last > first {
            return Interval::new(-1.0, 1.0);
        }
        let ends = Interval::point(f(self.lo)).hull(Interval::point(f(self.hi))).inexact();
        let crest = if first % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let all = if last == first { ends.hull(Interval::point(crest)) } else { ends };
        all.within(-1.0, 1.0)
    }

    /// Sines.
    pub fn sin(self) -> Interval {
        self.wave(libm::sin, 0.5)
    }

    /// Cosines.
    pub fn cos(self) -> Interval {
        self.wave(libm::cos, 0.0)
    }

    /// Tangents, with no pole between.
    pub fn tan(self) -> Option<Interval> {
        let (first, last) = self.half_turns(0.5)?;
        (last < first).then(|| self.rising(libm::tan))
    }

    /// Arc sines.
    pub fn asin(self) -> Option<Interval> {
        (self.lo >= -1.0 && self.hi <= 1.0).then(|| self.rising(libm::asin))
    }

    /// Arc cosines.
    pub fn acos(self) -> Option<Interval> {
        let falling = || Interval::new(libm::acos(self.hi), libm::acos(self.lo)).inexact();
        (self.lo >= -1.0 && self.hi <= 1.0).then(falling)
    }

    /// Arc tangents.
    pub fn atan(self) -> Interval {
        self.rising(libm::atan).within(-FRAC_PI_2.next_up(), FRAC_PI_2.next_up())
    }

    /// Hyperbolic sines.
    pub fn sinh(self) -> Interval {
        self.rising(libm::sinh)
    }

    /// Hyperbolic cosines.
    pub fn cosh(self) -> Interval {
        self.abs().rising(libm::cosh).within(1.0, f64::INFINITY)
    }

    /// Hyperbolic tangents.
    pub fn tanh(self) -> Interval {
        self.rising(libm::tanh).within(-1.0, 1.0)
    }

    /// Whether the angle of (x, y), y being `self`, makes no jump: no point is on the negative x axis or at zero.
    pub fn turns_smoothly(self, x: Interval) -> bool {
        !self.contains(0.0) || x.lo > 0.0
    }

    /// The angles of the points (x, y), y being `self`; extreme at corners where the angle makes no jump.
    pub fn atan2(self, x: Interval) -> Interval {
        if !self.turns_smoothly(x) {
            return Interval::new(-PI, PI).inexact();
        }
        let corner = |y: f64, x: f64| Interval::point(libm::atan2(y, x));
        let hull = corner(self.lo, x.lo).hull(corner(self.lo, x.hi));
        hull.hull(corner(self.hi, x.lo)).hull(corner(self.hi, x.hi)).inexact()
    }
}

/// `x` to a whole power by repeated squaring: the one order of multiplications, for numbers of any kind.
pub fn power<T: Copy + std::ops::Mul<Output = T>>(x: T, one: T, n: u32) -> T {
    let (mut result, mut factor, mut n) = (None, x, n);
    while n > 0 {
        if n % 2 == 1 {
            result = Some(result.map_or(factor, |r: T| r * factor));
        }
        n /= 2;
        if n > 0 {
            factor = factor * factor;
        }
    }
    result.unwrap_or(one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Every computed value of `f` over a fine sampling, ends included, is in `range`.
    fn holds(x: Interval, range: Option<Interval>, f: impl Fn(f64) -> f64) {
        let Some(range) = range else { return };
        for i in 0..=200 {
            let at = (x.lo + (x.hi - x.lo) * (f64::from(i) / 200.0)).clamp(x.lo, x.hi);
            assert!(range.contains(f(at)), "{x:?} {range:?} at {at}: {}", f(at));
        }
    }

    fn interval() -> impl Strategy<Value = Interval> {
        let middle = prop_oneof![-1.0..1.0f64, -20.0..20.0f64, -1e5..1e5f64];
        let size = prop_oneof![0.0..1e-9f64, 0.0..1.0f64, 0.0..8.0f64];
        (middle, size).prop_map(|(x, size)| Interval::new(x, x + size))
    }

    proptest! {
        #[test]
        fn functions_of_one_number(x in interval()) {
            holds(x, x.sqrt(), f64::sqrt);
            holds(x, Some(Interval::exp(x)), libm::exp);
            holds(x, Interval::ln(x), libm::log);
            holds(x, Interval::log10(x), libm::log10);
            holds(x, Some(Interval::sin(x)), libm::sin);
            holds(x, Some(Interval::cos(x)), libm::cos);
            holds(x, Interval::tan(x), libm::tan);
            holds(x, Interval::asin(x), libm::asin);
            holds(x, Interval::acos(x), libm::acos);
            holds(x, Some(Interval::atan(x)), libm::atan);
            if x.magnitude() < 700.0 {
                holds(x, Some(Interval::sinh(x)), libm::sinh);
                holds(x, Some(Interval::cosh(x)), libm::cosh);
            }
            holds(x, Some(Interval::tanh(x)), libm::tanh);
            holds(x, Some(x.abs()), f64::abs);
            for n in 0..12 {
                holds(x, Some(x.power(n)), |x| power(x, 1.0, n));
            }
        }

        #[test]
        fn functions_of_two_numbers(x in interval(), y in interval()) {
            for i in 0..=20 {
                let other = (y.lo + (y.hi - y.lo) * (f64::from(i) / 20.0)).clamp(y.lo, y.hi);
                holds(x, Some(x + y), |x| x + other);
                holds(x, Some(x - y), |x| x - other);
                holds(x, Some(x * y), |x| x * other);
                holds(x, x.quotient(y), |x| x / other);
                holds(x, Some(Interval::atan2(x, y)), |x| libm::atan2(x, other));
                holds(x, x.pow(y).filter(|p| p.hi < f64::INFINITY), |x| libm::pow(x, other));
                holds(x, Some(x.min(y)), |x| x.min(other));
                holds(x, Some(x.max(y)), |x| x.max(other));
            }
        }
    }

    #[test]
    fn waves_turn_where_they_should() {
        assert_eq!(Interval::sin(Interval::new(1.0, 2.0)).hi, 1.0);
        assert!(Interval::sin(Interval::new(1.0, 1.5)).hi < 1.0);
        assert_eq!(Interval::cos(Interval::new(3.0, 4.0)).lo, -1.0);
        assert_eq!(Interval::cos(Interval::new(-0.5, 0.5)).hi, 1.0);
        assert_eq!(Interval::sin(Interval::new(-2.0, -1.0)).lo, -1.0);
        assert!(Interval::tan(Interval::new(1.0, 2.0)).is_none());
        let unit = Interval::new(-1.0, 1.0);
        assert!((unit * unit).lo < 0.0 && unit.power(2).lo == 0.0);
    }
}
