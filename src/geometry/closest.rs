// SPDX-License-Identifier: MIT OR Apache-2.0
//! The closest point, the gradient and what they belong to. In a composite these are the ones of the
//! part that wins.

use super::Geometry;
use super::node::Node;
use super::properties::{FunctionOptions, Kind};
use super::segment::{NO_PART, NO_TAG};
use super::shape::Shape;
use crate::math::{Aabb, Vec3, positive_zero};

/// What is known of the nearest piece of surface.
#[derive(Clone, Copy, Debug)]
pub struct Closest {
    /// The value, as everywhere.
    pub value: f64,
    /// The closest point of the part that wins; NaN where the part's value is no distance.
    pub point: Vec3,
    /// Gradient of the value; of length 1 where the part is exact.
    pub gradient: Vec3,
    /// Of the triangle's corners, in the order of the input face; NaN off meshes.
    pub barycentric: Vec3,
    /// Index of the input face; -1 off meshes.
    pub primitive: i64,
    /// The innermost label; -1 where there is none.
    pub part: i32,
    /// Tag of the input face; -1 off meshes.
    pub tag: i32,
    /// 0 face, 1 to 3 edge 0-1, 1-2, 2-0, 4 to 6 vertex; -1 off meshes.
    pub feature: i32,
}

impl Closest {
    /// Nothing known but the value.
    pub(crate) fn only(value: f64) -> Closest {
        Closest {
            value,
            point: Vec3::NAN,
            gradient: Vec3::NAN,
            barycentric: Vec3::NAN,
            primitive: -1,
            part: NO_PART,
            tag: NO_TAG,
            feature: -1,
        }
    }
}

impl Closest {
    fn moved(self, by: impl Fn(Vec3) -> Vec3) -> Closest {
        Closest { point: by(self.point), ..self }
    }
}

impl Geometry {
    /// The closest point and all that goes with it. NaN throughout where a coordinate is not finite or a
    /// user's function failed.
    pub fn closest(&self, p: Vec3) -> Closest {
        if !p.is_finite() {
            return Closest::only(f64::NAN);
        }
        let mut answer = self.raw_closest(p);
        answer.value = positive_zero(answer.value);
        // Adding zero turns -0.0 into +0.0.
        answer.point += Vec3::ZERO;
        answer.gradient += Vec3::ZERO;
        if answer.value.is_nan() { Closest::only(f64::NAN) } else { answer }
    }

    /// Gradient of the value.
    pub(super) fn gradient(&self, p: Vec3) -> Vec3 {
        match self.node() {
            Node::Sphere(sphere) => sphere.gradient(p),
            Node::Shape(shape) if p.is_finite() => shape.gradient(p),
            _ => self.raw_closest(p).gradient,
        }
    }

    pub(super) fn raw_closest(&self, p: Vec3) -> Closest {
        match self.node() {
            Node::Shape(_) | Node::Surface(_) if !p.is_finite() => Closest::only(f64::NAN),
            Node::Sphere(_) | Node::Shape(_) => self.stepped(p, self.raw_value(p), self.gradient(p)),
            Node::Surface(surface) => {
                let nearest = surface.nearest(p);
                let (feature, barycentric) = surface.as_input(&nearest);
                let value = surface.signed(p, &nearest);
                Closest {
                    value,
                    point: nearest.point,
                    gradient: surface.gradient(p, &nearest, value),
                    barycentric,
                    primitive: i64::from(surface.face(nearest.triangle)),
                    part: NO_PART,
                    tag: surface.tag(nearest.triangle),
                    feature: feature as i32,
                }
            }
            Node::Function { function, options } => {
                let known = function.gradient(p);
                let gradient = known.unwrap_or_else(|| self.difference_quotient(p, options));
                self.stepped(p, self.raw_value(p), gradient)
            }
            Node::Union(parts) | Node::Intersection(parts) => {
                let least = parts.least(p);
                match parts.list().get(least.part) {
                    Some(part) => part.raw_closest(p),
                    None if parts.is_turned() => Closest::only(f64::NEG_INFINITY),
                    None => Closest::only(f64::INFINITY),
                }
            }
            Node::Smooth(smooth) => smooth.closest(p),
            Node::Repeat(repeat) => {
                let shift = repeat.copy(repeat.least(p).part);
                repeat.child().raw_closest(p - shift).moved(|q| q + shift)
            }
            Node::Complement(g) => {
                let answer = g.raw_closest(p);
                Closest { value: 0.0 - answer.value, gradient: -answer.gradient, ..answer }
            }
            Node::Translate(g, shift) => g.raw_closest(p - *shift).moved(|q| q + *shift),
            Node::Place(g, placement) => {
                let answer = g.raw_closest(placement.to_body(p));
                Closest {
                    value: placement.scale() * answer.value,
                    gradient: placement.direction(answer.gradient),
                    ..answer.moved(|q| placement.to_space(q))
                }
            }
            Node::Map(g, map) => {
                let answer = g.raw_closest(map.point(p));
                self.derived(p, map.value(p, answer.value), map.gradient(p, answer.value, answer.gradient), answer)
            }
            Node::Level(g, level) => {
                let answer = g.raw_closest(p);
                let gradient = answer.gradient * level.slope(answer.value);
                self.derived(p, level.value(answer.value), gradient, answer)
            }
            Node::Stencil(g, stencil) => {
                let (value, gradient, middle) = stencil.closest(g, p);
                self.derived(p, value, gradient, middle)
            }
            Node::Part(g, label) => {
                let answer = g.raw_closest(p);
                Closest { part: if answer.part == NO_PART { *label } else { answer.part }, ..answer }
            }
        }
    }

    /// Where the value is a distance, one step along the gradient reaches the surface.
    fn stepped(&self, p: Vec3, value: f64, gradient: Vec3) -> Closest {
        let point = if self.kind() == Kind::Exact { p - gradient * value } else { Vec3::NAN };
        Closest { point, gradient, ..Closest::only(value) }
    }

    /// Of a node whose surface is not its child's: the labels are the child's, face and feature are none.
    fn derived(&self, p: Vec3, value: f64, gradient: Vec3, child: Closest) -> Closest {
        Closest { part: child.part, tag: child.tag, ..self.stepped(p, value, gradient) }
    }

    /// Centred differences.
    fn difference_quotient(&self, p: Vec3, options: &FunctionOptions) -> Vec3 {
        let step = gradient_step(options);
        let along = |axis: Vec3| {
            let (above, below) = (p + axis * step, p - axis * step);
            (self.raw_value(above) - self.raw_value(below)) / (above - below).dot(axis)
        };
        Vec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z))
    }
}

/// The step the user asks for, or a millionth of the body's diagonal.
fn gradient_step(options: &FunctionOptions) -> f64 {
    let Aabb { lo, hi } = options.bounds;
    if options.gradient_step > 0.0 {
        options.gradient_step
    } else if lo.is_finite() && hi.is_finite() && lo != hi {
        1e-6 * options.bounds.diagonal()
    } else {
        1e-6
    }
}
