// SPDX-License-Identifier: MIT OR Apache-2.0
//! Smooth minima of two values (Quilez 2013; the exponential one of Ricci 1973 in logarithmic form), and the
//! user's.

use crate::error::{Error, Result};
use std::fmt;
use std::sync::Arc;

/// Two values and how they are blended into one where they are close.
#[derive(Clone)]
pub enum Blend {
    /// `min(a, b) - h^2 s / 4`, `h = max(s - |a - b|, 0) / s`, for this width s: a quadratic piece that leaves
    /// values further apart than s alone.
    Smooth(f64),
    /// `-s log(e^(-a/s) + e^(-b/s))` for this width s, computed without overflow. What is 37 s behind is below
    /// the last digit and counts as nothing.
    Exponential(f64),
    /// The caller's.
    Custom(CustomBlend),
}

/// A user's blend of two values.
pub trait BlendFunction: Send + Sync {
    /// The blend of `a <= b`, and its derivatives by both where they are known (NaN: centred differences are
    /// taken). NaN says that the function failed.
    fn blend(&self, a: f64, b: f64) -> (f64, f64, f64);
}

/// A user's blend with what the caller knows, and vouches for, of it: it rises with either value and is never
/// above the lesser.
#[derive(Clone)]
pub struct CustomBlend {
    /// The function.
    pub function: Arc<dyn BlendFunction>,
    /// Values further apart than this leave the lesser alone; infinite where there is no such distance.
    pub support: f64,
    /// The most by which blending any number of values goes below the least of them.
    pub depth: f64,
    /// |blend(a, b) - blend(c, d)| <= lipschitz * max(|a - c|, |b - d|); infinite where unknown.
    pub lipschitz: f64,
    /// Whether several threads may call the function at once.
    pub thread_safe: bool,
}

impl fmt::Debug for Blend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Blend::Smooth(s) => write!(f, "Smooth({s})"),
            Blend::Exponential(s) => write!(f, "Exponential({s})"),
            Blend::Custom(_) => write!(f, "Custom"),
        }
    }
}

/// Beyond this many widths the exponential blend leaves the lesser value alone: e^-37 is below half a unit
/// of rounding of one.
const EXPONENTIAL_SUPPORT: f64 = 37.0;

impl Blend {
    pub(super) fn check(&self) -> Result<()> {
        match self {
            Blend::Smooth(s) | Blend::Exponential(s) if !(*s > 0.0 && s.is_finite()) => {
                Err(Error::invalid(format!("blend.width: {s} is not finite and > 0")))
            }
            Blend::Custom(c) => {
                for (name, x) in [("support", c.support), ("depth", c.depth), ("lipschitz", c.lipschitz)] {
                    if x.is_nan() || x < 0.0 {
                        return Err(Error::invalid(format!("blend.{name}: {x} is not >= 0")));
                    }
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Values further behind than this count as nothing.
    pub(super) fn support(&self) -> f64 {
        match self {
            Blend::Smooth(s) => *s,
            Blend::Exponential(s) => EXPONENTIAL_SUPPORT * s,
            Blend::Custom(c) => c.support,
        }
    }

    /// The most by which blending `n` values goes below the least of them.
    pub(super) fn depth(&self, n: usize) -> f64 {
        match self {
            Blend::Custom(c) => c.depth,
            // It is deepest where all are equal.
            _ => {
                let below = (1..n.min(4096)).fold(0.0, |sum, _| self.of(sum, 0.0).0);
                let rest = if n > 4096 { self.deepest() } else { -below };
                rest * (1.0 + 1e-9)
            }
        }
    }

    /// A bound for any number of values that fits in memory.
    fn deepest(&self) -> f64 {
        match self {
            Blend::Smooth(s) => *s,
            Blend::Exponential(s) => 45.0 * s,
            Blend::Custom(c) => c.depth,
        }
    }

    /// Bound on how much faster than its arguments the blend changes.
    pub(super) fn lipschitz(&self) -> f64 {
        match self {
            Blend::Smooth(_) | Blend::Exponential(_) => 1.0,
            Blend::Custom(c) => c.lipschitz,
        }
    }

    /// The blend of `a <= b`.
    pub(super) fn value(&self, a: f64, b: f64) -> f64 {
        match self {
            // Without the differences that may have to stand for derivatives.
            Blend::Custom(c) if a.is_finite() && b != f64::INFINITY => c.function.blend(a, b).0,
            _ => self.of(a, b).0,
        }
    }

    /// The blend of `a <= b`, and its derivatives by both.
    pub(super) fn of(&self, a: f64, b: f64) -> (f64, f64, f64) {
        if !a.is_finite() || b == f64::INFINITY {
            return (a, 1.0, 0.0);
        }
        match self {
            Blend::Smooth(s) => {
                let behind = s - (b - a);
                let h = if behind > 0.0 { behind / s } else { 0.0 };
                (a - h * h * s * 0.25, 1.0 - 0.5 * h, 0.5 * h)
            }
            Blend::Exponential(s) => {
                let e = libm::exp((a - b) / s);
                (a - s * libm::log1p(e), 1.0 / (1.0 + e), e / (1.0 + e))
            }
            Blend::Custom(c) => {
                let (value, by_a, by_b) = c.function.blend(a, b);
                if by_a.is_finite() && by_b.is_finite() {
                    return (value, by_a, by_b);
                }
                let step = 1e-6 * if c.support.is_finite() && c.support > 0.0 { c.support } else { 1.0 };
                let at = |a: f64, b: f64| c.function.blend(a.min(b), a.max(b)).0;
                let by_a = (at(a + step, b) - at(a - step, b)) / (2.0 * step);
                let by_b = (at(a, b + step) - at(a, b - step)) / (2.0 * step);
                (value, by_a, by_b)
            }
        }
    }

    /// The numbers that define it.
    pub(super) fn words(&self, add: &mut dyn FnMut(u64)) {
        match self {
            Blend::Smooth(s) => [1, s.to_bits()].into_iter().for_each(add),
            Blend::Exponential(s) => [2, s.to_bits()].into_iter().for_each(add),
            Blend::Custom(_) => add(3),
        }
    }
}
