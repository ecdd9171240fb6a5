// SPDX-License-Identifier: MIT OR Apache-2.0
//! The value at a point, or at many. It depends on the point and the geometry alone.

use super::node::Node;
use super::shape::Shape;
use super::surface::Block;
use super::{Cut, Geometry};
use crate::error::Result;
use crate::math::{Vec3, positive_zero};

/// Deeper than this, many points are asked for one after another: blocks need stack.
pub(super) const DEEPEST_BLOCK: usize = 32;

/// Unions of more parts than this are asked for point by point.
const MOST_BLOCK_PARTS: usize = 16;

/// Trees of more shapes than this are asked point by point: their hierarchies leave most of them out.
const MOST_AT_ONCE: u64 = 32;

impl Geometry {
    /// The value at a point; NaN where a coordinate is not finite or a user's function failed. Never
    /// -0.0.
    pub fn value(&self, p: Vec3) -> f64 {
        if p.is_finite() { positive_zero(self.raw_value(p)) } else { f64::NAN }
    }

    /// The values at many points: the bits of [`Geometry::value`]. A user's function that takes many points
    /// at once is handed them together.
    pub(crate) fn values(&self, points: &[Vec3], out: &mut [f64]) {
        let s = self.summary();
        let is_small = !s.batched && (2..=MOST_AT_ONCE).contains(&s.primitives) && Cut::suits(self);
        if (s.batched || is_small) && points.len() > 1 && points.iter().all(|p| p.is_finite()) {
            if !is_small || Cut::whole(self).scattered_values(points, out).is_err() {
                self.raw_values(points, out);
            }
            out.iter_mut().for_each(|value| *value = positive_zero(*value));
        } else {
            points.iter().zip(out).for_each(|(p, value)| *value = self.value(*p));
        }
    }

    /// The value; the sign of zero is not settled yet.
    pub(super) fn raw_value(&self, p: Vec3) -> f64 {
        match self.node() {
            Node::Sphere(sphere) => sphere.value(p),
            Node::Shape(shape) if p.is_finite() => shape.value(p),
            Node::Surface(surface) if p.is_finite() => surface.value(p),
            Node::Shape(_) | Node::Surface(_) => f64::NAN,
            Node::Function { function, .. } => function.value(p),
            Node::Union(parts) => parts.least(p).value,
            Node::Intersection(parts) => -parts.least(p).value,
            Node::Smooth(smooth) => smooth.value(p),
            Node::Repeat(repeat) => repeat.least(p).value,
            Node::Complement(g) => 0.0 - g.raw_value(p),
            Node::Translate(g, shift) => g.raw_value(p - *shift),
            Node::Place(g, placement) => placement.scale() * g.raw_value(placement.to_body(p)),
            Node::Map(g, map) => map.value(p, g.raw_value(map.point(p))),
            Node::Level(g, level) => level.value(g.raw_value(p)),
            Node::Stencil(g, stencil) => stencil.value(g, p),
            Node::Part(g, _) => g.raw_value(p),
        }
    }

    /// The same at many points.
    fn raw_values(&self, points: &[Vec3], out: &mut [f64]) {
        let one_by_one = |out: &mut [f64]| points.iter().zip(out).for_each(|(p, v)| *v = self.raw_value(*p));
        let s = self.summary();
        if !s.batched || s.depth > DEEPEST_BLOCK {
            return one_by_one(out);
        }
        let mapped = |map: &dyn Fn(Vec3) -> Vec3| points.iter().map(|p| map(*p)).collect::<Vec<_>>();
        match self.node() {
            Node::Function { function, .. } => function.values(points, out),
            Node::Surface(surface) if points.iter().all(|p| p.is_finite()) => surface.values(points, out),
            Node::Union(parts) if parts.is_batched() && points.iter().all(|p| p.is_finite()) => {
                parts.least_values(points, out);
            }
            Node::Union(parts) | Node::Intersection(parts) if parts.list().len() <= MOST_BLOCK_PARTS => {
                let sign = if parts.is_turned() { -1.0 } else { 1.0 };
                out.fill(f64::INFINITY);
                let mut values = vec![0.0; points.len()];
                for part in parts.list() {
                    part.raw_values(points, &mut values);
                    for (least, value) in out.iter_mut().zip(&values) {
                        let value = value * sign;
                        // The first NaN stays.
                        if !least.is_nan() && (value < *least || value.is_nan()) {
                            *least = value;
                        }
                    }
                }
                out.iter_mut().for_each(|value| *value *= sign);
            }
            Node::Complement(g) => {
                g.raw_values(points, out);
                out.iter_mut().for_each(|value| *value = 0.0 - *value);
            }
            Node::Translate(g, shift) => g.raw_values(&mapped(&|p| p - *shift), out),
            Node::Place(g, placement) => {
                g.raw_values(&mapped(&|p| placement.to_body(p)), out);
                out.iter_mut().for_each(|value| *value *= placement.scale());
            }
            Node::Map(g, map) => {
                g.raw_values(&mapped(&|p| map.point(p)), out);
                points.iter().zip(out).for_each(|(p, value)| *value = map.value(*p, *value));
            }
            Node::Level(g, level) => {
                g.raw_values(points, out);
                out.iter_mut().for_each(|value| *value = level.value(*value));
            }
            Node::Part(g, _) => g.raw_values(points, out),
            _ => one_by_one(out),
        }
    }

    /// Whether blocks of a lattice cost less than its points one after another.
    pub(crate) fn has_blocks(&self) -> bool {
        match self.node() {
            Node::Surface(_) => true,
            Node::Complement(g) | Node::Translate(g, _) | Node::Part(g, _) => g.has_blocks(),
            _ => false,
        }
    }

    /// The values over a block of a lattice, x fastest, where [`Geometry::has_blocks`]: the bits of [`Geometry::value`] up
    /// to a magnitude of `far`, beyond it any such magnitude with the right sign.
    pub(crate) fn block_values(&self, axes: [&[f64]; 3], far: f64, out: &mut [f64]) -> Result<()> {
        match self.node() {
            Node::Surface(surface) => surface.block_values(&Block { axes, far }, out)?,
            Node::Complement(g) => {
                g.block_values(axes, far, out)?;
                out.iter_mut().for_each(|value| *value = 0.0 - *value);
            }
            Node::Translate(g, shift) => {
                let shifted = |axis: usize| axes[axis].iter().map(|c| c - shift[axis]).collect::<Vec<f64>>();
                let [x, y, z] = [shifted(0), shifted(1), shifted(2)];
                g.block_values([&x, &y, &z], far, out)?;
            }
            Node::Part(g, _) => g.block_values(axes, far, out)?,
            _ => {}
        }
        out.iter_mut().for_each(|value| *value = positive_zero(*value));
        Ok(())
    }
}
