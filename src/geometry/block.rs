// SPDX-License-Identifier: MIT OR Apache-2.0
//! The values of a cut tree at many points, a node at a time: the bits of single points.

use super::Geometry;
use super::cut::{Below, Cut};
use super::node::Node;
use super::parts::{Found, Parts};
use super::points::Place;
use super::shape::Shape;
use super::smooth::Smooth;
use super::surface::Block;
use crate::error::Result;

/// What is left whole and has more parts than this is asked point by point: its hierarchy knows better.
const MOST_WHOLE: usize = 16;

/// With more parts than this left of a union, its hierarchy is asked after all.
const MOST_LEFT: usize = 96;

impl Cut<'_> {
    /// Up to a magnitude of `far` the bits of the tree, beyond it any such magnitude with the right sign; the sign of
    /// zero is not settled yet.
    pub(super) fn values(&self, at: &Place, far: f64, out: &mut [f64]) -> Result<()> {
        match self.g.node() {
            Node::Sphere(sphere) => sphere.values(at.points(), out),
            Node::Shape(shape) => shape.values(at.points(), out),
            Node::Surface(surface) => match at.axes() {
                Some(axes) => surface.block_values(&Block { axes, far }, out)?,
                None => surface.values(&at.points().iter().collect::<Vec<_>>(), out),
            },
            Node::Function { .. } => one_by_one(self.g, at, out),
            Node::Union(parts) | Node::Intersection(parts) => return self.union_values(parts, at, far, out),
            Node::Smooth(smooth) => return self.smooth_values(smooth, at, out),
            Node::Repeat(_) => return self.repeat_values(at, out),
            Node::Complement(_) => {
                self.child(at, far, out)?;
                out.iter_mut().for_each(|value| *value = 0.0 - *value);
            }
            Node::Translate(_, shift) => return self.child(&at.less(*shift), far, out),
            Node::Place(_, placement) => {
                self.child(&at.mapped(|p| placement.to_body(p)), f64::INFINITY, out)?;
                out.iter_mut().for_each(|value| *value *= placement.scale());
            }
            Node::Map(_, map) => {
                self.child(&at.mapped(|p| map.point(p)), f64::INFINITY, out)?;
                at.points().iter().zip(out).for_each(|(p, value)| *value = map.value(p, *value));
            }
            Node::Level(_, level) => {
                self.child(at, f64::INFINITY, out)?;
                out.iter_mut().for_each(|value| *value = level.value(*value));
            }
            Node::Stencil(_, stencil) => {
                let mut sampled = vec![0.0; out.len()];
                return stencil.values(out, |d, weight, sum| {
                    self.child(&at.less(-d), f64::INFINITY, &mut sampled)?;
                    sum.iter_mut().zip(&sampled).for_each(|(sum, value)| *sum += weight * value);
                    Ok(())
                });
            }
            Node::Part(..) => return self.child(at, far, out),
        }
        Ok(())
    }

    /// Of the one child.
    #[inline(never)]
    fn child(&self, at: &Place, far: f64, out: &mut [f64]) -> Result<()> {
        match (&self.below, self.g.node().children()) {
            (Below::Children(children), _) => children[0].values(at, far, out),
            (_, children) => Cut::whole(&children[0]).values(at, far, out),
        }
    }

    /// The parts to ask; none where the points had better be asked one by one.
    fn parts<'b>(&'b self, parts: &'b Parts, whole: &'b mut Vec<Cut<'b>>) -> Option<&'b [Cut<'b>]> {
        match &self.below {
            Below::Children(children) if children.len() <= MOST_LEFT || !parts.is_ordered() => Some(children),
            Below::Whole if parts.list().len() <= MOST_WHOLE => {
                whole.extend(parts.list().iter().map(Cut::whole));
                Some(whole)
            }
            _ => None,
        }
    }

    #[inline(never)]
    fn union_values(&self, parts: &Parts, at: &Place, far: f64, out: &mut [f64]) -> Result<()> {
        let mut whole = Vec::new();
        let Some(children) = self.parts(parts, &mut whole) else {
            if parts.is_batched() {
                parts.least_values(&at.points().iter().collect::<Vec<_>>(), out);
            } else {
                one_by_one(self.g, at, out);
            }
            return Ok(());
        };
        let sign = if parts.is_turned() { -1.0 } else { 1.0 };
        out.fill(f64::INFINITY);
        let mut values = vec![0.0; out.len()];
        for child in children {
            child.values(at, far, &mut values)?;
            for (least, value) in out.iter_mut().zip(&values) {
                let value = value * sign;
                // The first NaN stays.
                let is_less = (value < *least) | (value.is_nan() & !least.is_nan());
                *least = if is_less { value } else { *least };
            }
        }
        out.iter_mut().for_each(|value| *value *= sign);
        Ok(())
    }

    #[inline(never)]
    fn smooth_values(&self, smooth: &Smooth, at: &Place, out: &mut [f64]) -> Result<()> {
        let mut whole = Vec::new();
        let Some(children) = self.parts(smooth.parts(), &mut whole) else {
            one_by_one(self.g, at, out);
            return Ok(());
        };
        let n = out.len();
        let mut values = vec![0.0; n * children.len()];
        for (child, values) in children.iter().zip(values.chunks_mut(n)) {
            child.values(at, f64::INFINITY, values)?;
        }
        let mut found = Vec::with_capacity(children.len());
        for (k, value) in out.iter_mut().enumerate() {
            found.clear();
            found.extend((0..children.len()).map(|part| Found { value: values[part * n + k], part }));
            *value = smooth.of(&mut found);
        }
        Ok(())
    }

    #[inline(never)]
    fn repeat_values(&self, at: &Place, out: &mut [f64]) -> Result<()> {
        let Below::Copies(copies) = &self.below else {
            one_by_one(self.g, at, out);
            return Ok(());
        };
        out.fill(f64::INFINITY);
        let mut values = vec![0.0; out.len()];
        for (shift, copy) in copies {
            copy.values(&at.less(*shift), f64::INFINITY, &mut values)?;
            for (least, value) in out.iter_mut().zip(&values) {
                let is_less = (*value < *least) | (value.is_nan() & !least.is_nan());
                *least = if is_less { *value } else { *least };
            }
        }
        Ok(())
    }
}

fn one_by_one(g: &Geometry, at: &Place, out: &mut [f64]) {
    at.points().iter().zip(out).for_each(|(p, value)| *value = g.raw_value(p));
}
