// SPDX-License-Identifier: MIT OR Apache-2.0
//! A body given by an expression of x, y and z.
//!
//! Within the bounds the value is the expression's. With q the point of the bounds nearest to p, d(p) the signed
//! distance to the bounds' box and L a Lipschitz constant of the expression within them, the value is
//! max(f(q), L d(p)): the body cut off at its bounds. Both parts have the constant L in all of space (a projection
//! onto a box does not stretch), hence so has the value. Where the expression is not negative on the border of the
//! bounds, as it must be if the body lies within them, f(p) >= L d(p) inside: the value there is f itself.
//! Where L is not known, the value is f inside and max(f(q), d(p)) outside.

mod gradient;
mod number;
mod parse;
mod program;
mod slope;

use super::pack::{EXPRESSION, aabb, pack_box};
use super::{Facts, Shape};
use crate::error::{Error, Result, try_with_capacity};
use crate::math::{Aabb, Interval, Vec3, unit};
use crate::store::{Array, Packer, Unpacker, wrong};
use gradient::Gradient;
use number::{Enclosure, Number};
use program::Program;

/// What the caller knows of an expression.
#[derive(Clone, Debug)]
pub struct ExpressionOptions {
    /// A box around the body, which is cut off there; all of space by default.
    pub bounds: Aabb,
    /// Lipschitz constant within the bounds, vouched for by the caller; 0: to be found, where the bounds are finite.
    pub lipschitz: f64,
}

impl Default for ExpressionOptions {
    fn default() -> ExpressionOptions {
        ExpressionOptions { bounds: Aabb::ALL, lipschitz: 0.0 }
    }
}

/// An expression, compiled.
pub(crate) struct Expression {
    text: Array<u8>,
    program: Program,
    bounds: Aabb,
    /// Within the bounds; infinite where unknown.
    lipschitz: f64,
}

impl Expression {
    pub(crate) fn new(text: &str, options: &ExpressionOptions) -> Result<Expression> {
        let bounds = options.bounds;
        for k in 0..3 {
            let (lo, hi) = (bounds.lo[k], bounds.hi[k]);
            let range = lo <= hi && lo < f64::INFINITY && hi > f64::NEG_INFINITY;
            if !range {
                return Err(Error::invalid(format!("options.lo[{k}], hi[{k}]: {lo} to {hi} is no range")));
            }
        }
        let given = options.lipschitz;
        if !(given >= 0.0 && given.is_finite()) {
            return Err(Error::invalid(format!("options.lipschitz: {given} is not finite and >= 0")));
        }
        let program = parse::parse(text)?;
        let lipschitz = if given > 0.0 { given } else { slope::lipschitz(&program, bounds) };
        let mut copy = try_with_capacity("bytes", text.len())?;
        copy.extend_from_slice(text.as_bytes());
        Ok(Expression { text: copy.into(), program, bounds, lipschitz })
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Expression> {
        let (text, bounds, lipschitz) = (from.array::<u8>("text")?, aabb(from)?, from.number()?);
        if bounds.is_empty() || lipschitz < 0.0 {
            return Err(wrong("an expression has no bounds"));
        }
        let words = str::from_utf8(&text).map_err(|_| wrong("an expression is no text"))?;
        Ok(Expression { program: parse::parse(words)?, text, bounds, lipschitz })
    }

    /// The factor of the distance to the bounds: > 0, 1 where no constant is known.
    fn steep(&self) -> f64 {
        let known = self.lipschitz > f64::MIN_POSITIVE && self.lipschitz.is_finite();
        if known { self.lipschitz } else { 1.0 }
    }

    /// The signed distance to the bounds' box; not asked where all sides are infinite.
    fn outside<N: Number>(&self, p: [N; 3]) -> N {
        let zero = N::constant(0.0);
        let (mut deepest, mut beyond) = (None, [zero; 3]);
        for k in 0..3 {
            let below = self.bounds.lo[k].is_finite().then(|| N::constant(self.bounds.lo[k]) - p[k]);
            let above = self.bounds.hi[k].is_finite().then(|| p[k] - N::constant(self.bounds.hi[k]));
            for side in [below, above].into_iter().flatten() {
                deepest = Some(deepest.map_or(side, |deepest: N| deepest.max(side)));
                beyond[k] = beyond[k].max(side);
            }
        }
        let deepest = deepest.unwrap_or(zero);
        // Squares may underflow; a side does not.
        N::norm(&beyond).max(deepest) + deepest.min(zero)
    }

    fn coordinates(&self, p: Vec3) -> ([f64; 3], [f64; 3]) {
        (p.to_array(), p.clamp(self.bounds.lo, self.bounds.hi).to_array())
    }

    /// Whether the distance to the bounds has a say at such points.
    fn is_cut(&self, inside: bool) -> bool {
        self.bounds != Aabb::ALL && (!inside || self.lipschitz.is_finite())
    }
}

impl Shape for Expression {
    fn may_fail(&self) -> bool {
        true
    }

    /// NaN where the expression has no value.
    fn value(&self, p: Vec3) -> f64 {
        let (here, near) = self.coordinates(p);
        let value = self.program.evaluate(near);
        if !self.is_cut(self.bounds.contains(p)) {
            return value;
        }
        Number::max(value, self.outside(here) * self.steep())
    }

    fn gradient(&self, p: Vec3) -> Vec3 {
        let (here, near) = self.coordinates(p);
        let variables = |at: [f64; 3]| std::array::from_fn(|k| Gradient::along(at[k], Some(k)));
        let own = self.program.evaluate(variables(near));
        // Across the bounds the nearest point does not move along.
        let partial = |k: usize| if near[k] == here[k] && own.partials[k].is_finite() { own.partials[k] } else { 0.0 };
        let mut gradient = Vec3::new(partial(0), partial(1), partial(2));
        if self.is_cut(self.bounds.contains(p)) {
            let outside: Gradient<f64> = self.outside(variables(here));
            let flat = gradient == Vec3::ZERO && !self.bounds.contains(p);
            // Where the expression has no value its bounds have.
            if flat || own.value.is_nan() || own.value < outside.value * self.steep() {
                gradient = unit(p - Vec3::from_array(near)) * self.steep();
                if gradient == Vec3::ZERO {
                    gradient =
                        Vec3::from_array(outside.partials.map(|d| if d.is_finite() { d } else { 0.0 })) * self.steep();
                }
            }
        }
        // Flat: no direction is better than another.
        if gradient == Vec3::ZERO { Vec3::Z } else { gradient }
    }

    fn facts(&self) -> Facts {
        // What is added for the bounds is as steep as the expression, or 1.
        let everywhere = self.lipschitz.max(if self.bounds == Aabb::ALL { 0.0 } else { self.steep() });
        let rounding = 1000.0 * f64::EPSILON * if everywhere.is_finite() { everywhere.max(1.0) } else { 1.0 };
        Facts {
            bounds: self.bounds,
            rest: Aabb::ALL,
            exact: false,
            lipschitz: everywhere,
            // Outside the value is at least the distance to the bounds times `steep`.
            spread: (1.0 / self.steep()) * (1.0 + 16.0 * f64::EPSILON),
            reach_outward: 0.0,
            reach_inward: 0.0,
            rounding: (rounding, rounding),
        }
    }

    fn range(&self, b: Aabb) -> Interval {
        let (lo, hi) = (b.lo.clamp(self.bounds.lo, self.bounds.hi), b.hi.clamp(self.bounds.lo, self.bounds.hi));
        let sides = |lo: Vec3, hi: Vec3| std::array::from_fn(|k| Enclosure::of(Interval::new(lo[k], hi[k])));
        let own: Enclosure = self.program.evaluate(sides(lo, hi));
        let inside = self.bounds.contains(b.lo) && self.bounds.contains(b.hi);
        let Enclosure(range) = if self.is_cut(inside) {
            let outside = self.outside(sides(b.lo, b.hi)) * Enclosure::constant(self.steep());
            let cut = own.max(outside);
            // Without a constant the part inside is not cut.
            if self.lipschitz.is_finite() { cut } else { Enclosure(own.0.zip(cut.0).map(|(a, b)| a.hull(b))) }
        } else {
            own
        };
        range.unwrap_or(Interval::ALL)
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(EXPRESSION);
        add(self.text.len() as u64);
        self.text.iter().for_each(|byte| add(u64::from(*byte)));
        for corner in [self.bounds.lo, self.bounds.hi] {
            corner.to_array().iter().for_each(|c| add(c.to_bits()));
        }
        add(self.lipschitz.to_bits());
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(EXPRESSION);
        out.array(&self.text);
        pack_box(self.bounds, out);
        out.number(self.lipschitz);
    }

    fn bytes(&self) -> usize {
        size_of::<Expression>() + self.text.len() + self.program.bytes()
    }
}

#[cfg(test)]
mod tests;
