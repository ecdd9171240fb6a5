// SPDX-License-Identifier: MIT OR Apache-2.0
//! What an expression can be evaluated with: one trait for doubles, intervals and gradients of either.

use crate::math::{Interval, power};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The functions of one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Function {
    Sqrt,
    Abs,
    Exp,
    Ln,
    Log10,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
}

impl Function {
    pub(super) const ALL: [(&'static str, Function); 14] = [
        ("sqrt", Function::Sqrt),
        ("abs", Function::Abs),
        ("exp", Function::Exp),
        ("ln", Function::Ln),
        ("log10", Function::Log10),
        ("sin", Function::Sin),
        ("cos", Function::Cos),
        ("tan", Function::Tan),
        ("asin", Function::Asin),
        ("acos", Function::Acos),
        ("atan", Function::Atan),
        ("sinh", Function::Sinh),
        ("cosh", Function::Cosh),
        ("tanh", Function::Tanh),
    ];
}

/// The arithmetic of an expression. All of it in the same order of operations, so that an interval holds
/// what doubles give.
pub(super) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    fn constant(x: f64) -> Self;
    fn function(self, f: Function) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    /// Any exponent.
    fn pow(self, exponent: Self) -> Self;
    /// The angle of (x, y), y being `self`.
    fn atan2(self, x: Self) -> Self;

    /// A whole exponent, by repeated multiplication.
    fn whole(self, n: i32) -> Self {
        let size = self.magnitude_power(n.unsigned_abs());
        if n < 0 { Self::constant(1.0) / size } else { size }
    }

    fn magnitude_power(self, n: u32) -> Self {
        power(self, Self::constant(1.0), n)
    }

    /// sqrt(a^2 + b^2 + ...), summed in that order; of at least one part.
    fn norm(parts: &[Self]) -> Self {
        let squares = parts.iter().map(|a| a.whole(2));
        squares.reduce(|a, b| a + b).unwrap_or(Self::constant(0.0)).function(Function::Sqrt)
    }
}

impl Number for f64 {
    fn constant(x: f64) -> f64 {
        x
    }

    fn function(self, f: Function) -> f64 {
        match f {
            Function::Sqrt => self.sqrt(),
            Function::Abs => self.abs(),
            Function::Exp => libm::exp(self),
            Function::Ln => libm::log(self),
            Function::Log10 => libm::log10(self),
            Function::Sin => libm::sin(self),
            Function::Cos => libm::cos(self),
            Function::Tan => libm::tan(self),
            Function::Asin => libm::asin(self),
            Function::Acos => libm::acos(self),
            Function::Atan => libm::atan(self),
            Function::Sinh => libm::sinh(self),
            Function::Cosh => libm::cosh(self),
            Function::Tanh => libm::tanh(self),
        }
    }

    // Unlike those of std, these hand NaN on: it says that the expression has no value there.
    fn min(self, other: f64) -> f64 {
        if self < other || self.is_nan() { self } else { other }
    }

    fn max(self, other: f64) -> f64 {
        if self > other || self.is_nan() { self } else { other }
    }

    fn pow(self, exponent: f64) -> f64 {
        libm::pow(self, exponent)
    }

    fn atan2(self, x: f64) -> f64 {
        libm::atan2(self, x)
    }
}

/// An interval, or the knowledge that somewhere in the box the expression may be without a finite value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Enclosure(pub(super) Option<Interval>);

impl Enclosure {
    pub(super) fn of(x: Interval) -> Enclosure {
        Enclosure((x.lo.is_finite() && x.hi.is_finite()).then_some(x))
    }

    fn map(self, f: impl Fn(Interval) -> Option<Interval>) -> Enclosure {
        self.0.and_then(f).map_or(Enclosure(None), Enclosure::of)
    }

    fn with(self, other: Enclosure, f: impl Fn(Interval, Interval) -> Option<Interval>) -> Enclosure {
        self.map(|a| other.0.and_then(|b| f(a, b)))
    }

    /// The greatest magnitude; infinite where unknown.
    pub(super) fn magnitude(self) -> f64 {
        self.0.map_or(f64::INFINITY, Interval::magnitude)
    }
}

impl Add for Enclosure {
    type Output = Enclosure;
    fn add(self, other: Enclosure) -> Enclosure {
        self.with(other, |a, b| Some(a + b))
    }
}

impl Sub for Enclosure {
    type Output = Enclosure;
    fn sub(self, other: Enclosure) -> Enclosure {
        self.with(other, |a, b| Some(a - b))
    }
}

impl Mul for Enclosure {
    type Output = Enclosure;
    fn mul(self, other: Enclosure) -> Enclosure {
        self.with(other, |a, b| Some(a * b))
    }
}

impl Div for Enclosure {
    type Output = Enclosure;
    fn div(self, other: Enclosure) -> Enclosure {
        self.with(other, Interval::quotient)
    }
}

impl Neg for Enclosure {
    type Output = Enclosure;
    fn neg(self) -> Enclosure {
        self.map(|a| Some(-a))
    }
}

impl Number for Enclosure {
    fn constant(x: f64) -> Enclosure {
        Enclosure::of(Interval::point(x))
    }

    fn function(self, f: Function) -> Enclosure {
        self.map(|a| match f {
            Function::Sqrt => a.sqrt(),
            Function::Abs => Some(a.abs()),
            Function::Exp => Some(Interval::exp(a)),
            Function::Ln => Interval::ln(a),
            Function::Log10 => Interval::log10(a),
            Function::Sin => Some(Interval::sin(a)),
            Function::Cos => Some(Interval::cos(a)),
            Function::Tan => Interval::tan(a),
            Function::Asin => Interval::asin(a),
            Function::Acos => Interval::acos(a),
            Function::Atan => Some(Interval::atan(a)),
            Function::Sinh => Some(Interval::sinh(a)),
            Function::Cosh => Some(Interval::cosh(a)),
            Function::Tanh => Some(Interval::tanh(a)),
        })
    }

    fn min(self, other: Enclosure) -> Enclosure {
        self.with(other, |a, b| Some(a.min(b)))
    }

    fn max(self, other: Enclosure) -> Enclosure {
        self.with(other, |a, b| Some(a.max(b)))
    }

    fn pow(self, exponent: Enclosure) -> Enclosure {
        // A constant whole exponent too large to multiply out takes any base.
        self.with(exponent, |a, b| match b.lo {
            n if b.lo == b.hi && n == n.trunc() && a.lo < 0.0 => {
                let size = a.abs().pow(b)?;
                Some(size.hull(-size))
            }
            _ => a.pow(b),
        })
    }

    fn atan2(self, x: Enclosure) -> Enclosure {
        self.with(x, |y, x| Some(Interval::atan2(y, x)))
    }

    fn magnitude_power(self, n: u32) -> Enclosure {
        self.map(|a| Some(a.power(n)))
    }
}
