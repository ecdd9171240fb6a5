// SPDX-License-Identifier: MIT OR Apache-2.0
//! Derivatives in forward mode (Griewank and Walther 2008), of doubles and of intervals: a value with its
//! partial derivatives. Over intervals, all of Clarke's gradients at kinks are held.

use super::number::{Enclosure, Function, Number};
use crate::math::Interval;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its partial derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gradient<N> {
    pub(super) value: N,
    pub(super) partials: [N; 3],
}

/// What derivatives need of numbers besides arithmetic.
pub(super) trait Differentiable: Number {
    /// Whether it is zero and nothing else: then it stays so times anything, infinity included.
    fn is_zero(self) -> bool;
    /// The slope of the magnitude.
    fn direction(self) -> Self;
    /// The slopes of the lesser of two: those of either, or both where it may be either.
    fn of_lesser(values: [Self; 2], slopes: [Self; 2]) -> Self;
    /// `self` over the norm of which it is a part: within [-1, 1].
    fn share(self, norm: Self) -> Self;
    /// Whether the angle of (x, y) may jump, y being `self`.
    fn jumps(self, x: Self) -> bool;
    /// No finite derivative.
    fn unknown() -> Self;
}

impl Differentiable for f64 {
    fn is_zero(self) -> bool {
        self == 0.0
    }
    fn direction(self) -> f64 {
        1.0f64.copysign(self)
    }
    fn of_lesser(values: [f64; 2], slopes: [f64; 2]) -> f64 {
        if values[0] < values[1] { slopes[0] } else { slopes[1] }
    }
    fn share(self, norm: f64) -> f64 {
        self / norm
    }
    fn jumps(self, _x: f64) -> bool {
        false
    }
    fn unknown() -> f64 {
        f64::NAN
    }
}

impl Differentiable for Enclosure {
    fn is_zero(self) -> bool {
        self.0 == Some(Interval::point(0.0))
    }
    fn direction(self) -> Enclosure {
        let sign = self.0.map(|x| f64::from(x.sign())).unwrap_or(0.0);
        Enclosure(Some(if sign == 0.0 { Interval::new(-1.0, 1.0) } else { Interval::point(sign) }))
    }
    fn of_lesser(values: [Enclosure; 2], slopes: [Enclosure; 2]) -> Enclosure {
        match (values[0].0, values[1].0) {
            (Some(a), Some(b)) if a.hi < b.lo => slopes[0],
            (Some(a), Some(b)) if b.hi < a.lo => slopes[1],
            _ => Enclosure(slopes[0].0.and_then(|a| slopes[1].0.map(|b| a.hull(b)))),
        }
    }
    fn share(self, norm: Enclosure) -> Enclosure {
        let unit = Interval::new(-1.0, 1.0);
        Enclosure(Some((self / norm).0.map_or(unit, |x| x.intersection(unit)).intersection(unit)))
    }
    fn jumps(self, x: Enclosure) -> bool {
        !self.0.zip(x.0).is_some_and(|(y, x)| y.turns_smoothly(x))
    }
    fn unknown() -> Enclosure {
        Enclosure(None)
    }
}

/// The derivative at `x` of a function whose value there is `y`.
pub(super) fn derivative<N: Differentiable>(f: Function, x: N, y: N) -> N {
    let number = N::constant;
    match f {
        Function::Sqrt => number(0.5) / y,
        Function::Abs => x.direction(),
        Function::Exp => y,
        Function::Ln => number(1.0) / x,
        Function::Log10 => number(std::f64::consts::LOG10_E) / x,
        Function::Sin => x.function(Function::Cos),
        Function::Cos => -x.function(Function::Sin),
        Function::Tan => number(1.0) + y.whole(2),
        Function::Asin => number(1.0) / (number(1.0) - x.whole(2)).function(Function::Sqrt),
        Function::Acos => -(number(1.0) / (number(1.0) - x.whole(2)).function(Function::Sqrt)),
        Function::Atan => number(1.0) / (number(1.0) + x.whole(2)),
        Function::Sinh => x.function(Function::Cosh),
        Function::Cosh => x.function(Function::Sinh),
        Function::Tanh => number(1.0) - y.whole(2),
    }
}

/// A product that is zero where either factor is, even if the other is not finite.
pub(super) fn times<N: Differentiable>(slope: N, partial: N) -> N {
    if partial.is_zero() || slope.is_zero() { N::constant(0.0) } else { slope * partial }
}

impl<N: Differentiable> Gradient<N> {
    /// The coordinate along axis `k`, or a constant.
    pub(super) fn along(value: N, k: Option<usize>) -> Gradient<N> {
        let partials = std::array::from_fn(|m| N::constant(if k == Some(m) { 1.0 } else { 0.0 }));
        Gradient { value, partials }
    }

    /// A function of this, by its slope.
    fn chain(self, value: N, slope: N) -> Gradient<N> {
        Gradient { value, partials: self.partials.map(|p| times(slope, p)) }
    }

    /// A function of two, by its slopes.
    fn chain2(self, other: Gradient<N>, value: N, slopes: [N; 2]) -> Gradient<N> {
        let partial = |k: usize| times(slopes[0], self.partials[k]) + times(slopes[1], other.partials[k]);
        Gradient { value, partials: std::array::from_fn(partial) }
    }

    fn is_constant(self) -> bool {
        self.partials.iter().all(|p| p.is_zero())
    }
}

impl<N: Differentiable> Add for Gradient<N> {
    type Output = Gradient<N>;
    fn add(self, other: Gradient<N>) -> Gradient<N> {
        let partials = std::array::from_fn(|k| self.partials[k] + other.partials[k]);
        Gradient { value: self.value + other.value, partials }
    }
}

impl<N: Differentiable> Sub for Gradient<N> {
    type Output = Gradient<N>;
    fn sub(self, other: Gradient<N>) -> Gradient<N> {
        let partials = std::array::from_fn(|k| self.partials[k] - other.partials[k]);
        Gradient { value: self.value - other.value, partials }
    }
}

impl<N: Differentiable> Mul for Gradient<N> {
    type Output = Gradient<N>;
    fn mul(self, other: Gradient<N>) -> Gradient<N> {
        self.chain2(other, self.value * other.value, [other.value, self.value])
    }
}

impl<N: Differentiable> Div for Gradient<N> {
    type Output = Gradient<N>;
    fn div(self, other: Gradient<N>) -> Gradient<N> {
        let value = self.value / other.value;
        let inverse = N::constant(1.0) / other.value;
        self.chain2(other, value, [inverse, -(value / other.value)])
    }
}

impl<N: Differentiable> Neg for Gradient<N> {
    type Output = Gradient<N>;
    fn neg(self) -> Gradient<N> {
        Gradient { value: -self.value, partials: self.partials.map(|p| -p) }
    }
}

impl<N: Differentiable> Number for Gradient<N> {
    fn constant(x: f64) -> Gradient<N> {
        Gradient::along(N::constant(x), None)
    }

    fn function(self, f: Function) -> Gradient<N> {
        let value = self.value.function(f);
        self.chain(value, derivative(f, self.value, value))
    }

    fn min(self, other: Gradient<N>) -> Gradient<N> {
        let values = [self.value, other.value];
        let partial = |k: usize| N::of_lesser(values, [self.partials[k], other.partials[k]]);
        Gradient { value: self.value.min(other.value), partials: std::array::from_fn(partial) }
    }

    fn max(self, other: Gradient<N>) -> Gradient<N> {
        // The greater of two is the lesser of their negatives.
        let values = [-self.value, -other.value];
        let partial = |k: usize| N::of_lesser(values, [self.partials[k], other.partials[k]]);
        Gradient { value: self.value.max(other.value), partials: std::array::from_fn(partial) }
    }

    fn pow(self, exponent: Gradient<N>) -> Gradient<N> {
        let value = self.value.pow(exponent.value);
        let slope = exponent.value * self.value.pow(exponent.value - N::constant(1.0));
        if exponent.is_constant() {
            return self.chain(value, slope);
        }
        self.chain2(exponent, value, [slope, value * self.value.function(Function::Ln)])
    }

    fn atan2(self, x: Gradient<N>) -> Gradient<N> {
        let value = N::atan2(self.value, x.value);
        // Also where neither moves: the sign of a zero may.
        if self.value.jumps(x.value) {
            return Gradient { value, partials: [N::unknown(); 3] };
        }
        let square = self.value.whole(2) + x.value.whole(2);
        self.chain2(x, value, [x.value / square, -(self.value / square)])
    }

    fn whole(self, n: i32) -> Gradient<N> {
        let slope = if n == 0 { N::constant(0.0) } else { N::constant(f64::from(n)) * self.value.whole(n - 1) };
        self.chain(self.value.whole(n), slope)
    }

    fn norm(parts: &[Gradient<N>]) -> Gradient<N> {
        let mut values = [N::constant(0.0); 3];
        values.iter_mut().zip(parts).for_each(|(value, part)| *value = part.value);
        let value = N::norm(&values[..parts.len().min(3)]);
        let mut partials = [N::constant(0.0); 3];
        for part in parts {
            let share = part.value.share(value);
            partials = std::array::from_fn(|k| partials[k] + times(share, part.partials[k]));
        }
        Gradient { value, partials }
    }
}
