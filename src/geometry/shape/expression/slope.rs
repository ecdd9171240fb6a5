// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lipschitz constants from interval arithmetic on the gradient (Hansen and Walster 2004), refined by
//! bisection where the bound is greatest.

use super::gradient::{Gradient, derivative, times};
use super::number::{Enclosure, Function, Number};
use super::program::Program;
use crate::math::{Aabb, Interval, Vec3};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Boxes looked at, at most; fewer for long expressions.
const BOXES: usize = 4000;
const WORK: usize = 1_000_000;

/// A gradient over a box with a bound on its length that is often tighter than that of its components:
/// that of sqrt(x^2 + y^2 + z^2) is 1 around zero too.
#[derive(Clone, Copy)]
struct Slope {
    of: Gradient<Enclosure>,
    length: f64,
}

impl Slope {
    fn new(of: Gradient<Enclosure>, length: f64) -> Slope {
        let components = norm(of.partials.map(Enclosure::magnitude));
        let length = if length.is_nan() { f64::INFINITY } else { length };
        Slope { of, length: length.min(components) }
    }

    fn size(self) -> f64 {
        self.of.value.magnitude()
    }

    /// The greatest magnitude of the scalar product of two gradients.
    fn dot(self, other: Slope) -> f64 {
        let product = |k: usize| times(self.of.partials[k], other.of.partials[k]);
        (product(0) + product(1) + product(2)).magnitude()
    }

    /// A bound on the length of the gradient of a sum or difference: gradients at right angles add up less.
    fn sum(self, other: Slope) -> f64 {
        let (a, b) = (self.length, other.length);
        let square = sum_above(sum_above(above(a, a), above(b, b)), 2.0 * self.dot(other));
        sum_above(a, b).min(root_above(square))
    }
}

fn norm(parts: [f64; 3]) -> f64 {
    let finite = parts.iter().all(|p| p.is_finite());
    // A single component is its own length: constants of 1 stay so.
    match parts.iter().filter(|p| **p != 0.0).count() {
        0 | 1 => parts.into_iter().fold(0.0, f64::max),
        _ if finite => crate::geometry::shape::height_field::length_above(parts[0], parts[1], parts[2]),
        _ => f64::INFINITY,
    }
}

/// a * b rounded up; zero times anything is zero, one times anything is that.
fn above(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 {
        0.0
    } else if a == 1.0 || b == 1.0 {
        a * b
    } else {
        (a * b).next_up()
    }
}

/// The square root rounded up; that of 1 is 1.
fn root_above(x: f64) -> f64 {
    if x == 0.0 || x == 1.0 { x } else { x.sqrt().next_up() }
}

fn sum_above(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { a + b } else { (a + b).next_up() }
}

impl Add for Slope {
    type Output = Slope;
    fn add(self, other: Slope) -> Slope {
        Slope::new(self.of + other.of, self.sum(other))
    }
}

impl Sub for Slope {
    type Output = Slope;
    fn sub(self, other: Slope) -> Slope {
        Slope::new(self.of - other.of, self.sum(other))
    }
}

impl Mul for Slope {
    type Output = Slope;
    fn mul(self, other: Slope) -> Slope {
        let length = sum_above(above(self.size(), other.length), above(other.size(), self.length));
        Slope::new(self.of * other.of, length)
    }
}

impl Div for Slope {
    type Output = Slope;
    fn div(self, other: Slope) -> Slope {
        let quotient = self.of / other.of;
        let inverse = Enclosure::constant(1.0) / other.of.value;
        let by_other = (quotient.value * inverse).magnitude();
        Slope::new(quotient, sum_above(above(inverse.magnitude(), self.length), above(by_other, other.length)))
    }
}

impl Neg for Slope {
    type Output = Slope;
    fn neg(self) -> Slope {
        Slope { of: -self.of, length: self.length }
    }
}

impl Number for Slope {
    fn constant(x: f64) -> Slope {
        Slope { of: Gradient::constant(x), length: 0.0 }
    }

    fn function(self, f: Function) -> Slope {
        let of = self.of.function(f);
        let steep = derivative(f, self.of.value, of.value).magnitude();
        Slope::new(of, above(steep, self.length))
    }

    fn min(self, other: Slope) -> Slope {
        Slope::new(self.of.min(other.of), self.length.max(other.length))
    }

    fn max(self, other: Slope) -> Slope {
        Slope::new(self.of.max(other.of), self.length.max(other.length))
    }

    fn pow(self, exponent: Slope) -> Slope {
        Slope::new(self.of.pow(exponent.of), f64::INFINITY)
    }

    fn atan2(self, x: Slope) -> Slope {
        Slope::new(Gradient::atan2(self.of, x.of), f64::INFINITY)
    }

    fn whole(self, n: i32) -> Slope {
        Slope::new(self.of.whole(n), f64::INFINITY)
    }

    /// The gradient is J^T u with |u| <= 1, u the parts over their norm: no longer than the root of the
    /// greatest row sum of |J J^T| (Gershgorin).
    fn norm(parts: &[Slope]) -> Slope {
        let mut all = [Gradient::constant(0.0); 3];
        all.iter_mut().zip(parts).for_each(|(of, part)| *of = part.of);
        let n = parts.len().min(3);
        // Of one with itself, the square of its length.
        let dot = |a: usize, b: usize| {
            if a == b { above(parts[a].length, parts[a].length) } else { parts[a].dot(parts[b]) }
        };
        let row = |a: usize| (0..n).map(|b| dot(a, b)).fold(0.0, sum_above);
        let length = root_above((0..n).map(row).fold(0.0, f64::max));
        Slope::new(Gradient::norm(&all[..n]), length)
    }
}

/// A box with the bound over it, greatest first.
struct Part(f64, Aabb);

impl PartialEq for Part {
    fn eq(&self, other: &Part) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Part {}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Part) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Part {
    fn cmp(&self, other: &Part) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// A bound over one box.
fn bound(program: &Program, b: Aabb) -> f64 {
    let variable = |k: usize| {
        let of = Gradient::along(Enclosure::of(Interval::new(b.lo[k], b.hi[k])), Some(k));
        Slope { of, length: 1.0 }
    };
    let slope = program.evaluate([variable(0), variable(1), variable(2)]);
    if slope.of.value.0.is_some() { slope.length } else { f64::INFINITY }
}

/// A Lipschitz constant over a finite box; infinite where none was found.
pub(super) fn lipschitz(program: &Program, b: Aabb) -> f64 {
    if !b.is_finite() {
        return f64::INFINITY;
    }
    let budget = BOXES.min(WORK / program.len().max(1));
    let mut open = BinaryHeap::from([Part(bound(program, b), b)]);
    // The greatest slope that was met: the bound cannot come below it.
    let mut met = 0.0f64;
    for _ in 0..budget {
        let Some(Part(worst, b)) = open.pop() else { break };
        let middle = b.center();
        let here = bound(program, Aabb::new(middle, middle));
        met = if here.is_finite() { met.max(here) } else { met };
        let size = b.hi - b.lo;
        let axis = if size.x >= size.y && size.x >= size.z {
            Vec3::X
        } else if size.y >= size.z {
            Vec3::Y
        } else {
            Vec3::Z
        };
        let cut = |corner: Vec3| corner + (middle - corner) * axis;
        if worst <= met * (1.0 + 1e-3) || (size * axis).max_element() <= 0.0 {
            open.push(Part(worst, b));
            break;
        }
        for half in [Aabb::new(b.lo, cut(b.hi)), Aabb::new(cut(b.lo), b.hi)] {
            open.push(Part(bound(program, half).min(worst), half));
        }
    }
    open.peek().map_or(f64::INFINITY, |part| part.0)
}
