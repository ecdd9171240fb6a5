// SPDX-License-Identifier: MIT OR Apache-2.0
//! The closest point, the gradient and what they belong to. In a composite these are the ones of the
//! part that wins.

use super::Geometry;
use super::node::Node;
use super::properties::{FunctionOptions, Kind};
use super::segment::{NO_PART, NO_TAG};
use crate::math::{Aabb, Vec3, positive_zero};
use crate::primitive::{cuboid, sphere};

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
        self.raw_closest(p).gradient
    }

    fn raw_closest(&self, p: Vec3) -> Closest {
        match self.node() {
            Node::Sphere { center, .. } => self.shape(p, sphere::gradient(*center, p)),
            Node::Cuboid(b) => self.shape(p, cuboid::gradient(*b, p)),
            Node::Surface(_) if !p.is_finite() => Closest::only(f64::NAN),
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
            Node::Function { options, .. } => {
                let gradient = self.difference_quotient(p, options);
                let mut answer = self.shape(p, gradient);
                if options.kind != Kind::Exact {
                    answer.point = Vec3::NAN;
                }
                answer
            }
            Node::Union(parts) => match Geometry::winner(parts, p, |a, b| a < b) {
                Some(part) => part.raw_closest(p),
                None => Closest::only(f64::INFINITY),
            },
            Node::Intersection(parts) => match Geometry::winner(parts, p, |a, b| a > b) {
                Some(part) => part.raw_closest(p),
                None => Closest::only(f64::NEG_INFINITY),
            },
            Node::Complement(g) => {
                let answer = g.raw_closest(p);
                Closest { value: 0.0 - answer.value, gradient: -answer.gradient, ..answer }
            }
            Node::Translate(g, shift) => {
                let answer = g.raw_closest(p - *shift);
                Closest { point: answer.point + *shift, ..answer }
            }
            Node::Place(g, placement) => {
                let answer = g.raw_closest(placement.to_body(p));
                Closest {
                    point: placement.to_space(answer.point),
                    gradient: placement.direction(answer.gradient),
                    ..answer
                }
            }
            Node::Part(g, label) => {
                let answer = g.raw_closest(p);
                Closest { part: if answer.part == NO_PART { *label } else { answer.part }, ..answer }
            }
        }
    }

    /// Of a node whose value is a distance: one step along the gradient reaches the surface.
    fn shape(&self, p: Vec3, gradient: Vec3) -> Closest {
        let value = self.raw_value(p);
        Closest { point: p - gradient * value, gradient, ..Closest::only(value) }
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
