// SPDX-License-Identifier: MIT OR Apache-2.0
//! The closest point, the gradient and what they belong to. In a composite these are the ones of the
//! part that wins.

use super::Geometry;
use super::node::Node;
use super::placement::Placement;
use super::properties::{FunctionOptions, Kind};
use super::segment::{NO_PART, NO_TAG};
use super::shape::Shape;
use super::surface::{Nearest, Surface};
use super::value::DEEPEST_BLOCK;
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
    /// Of the triangle's corners, in the order of the input face; NaN off meshes, and on triangles that close one.
    pub barycentric: Vec3,
    /// Index of the input face; -1 off meshes, and on triangles that close one, as are those below.
    pub primitive: i64,
    /// Which of the triangles that the face was cut into, from 0 in the order of [`crate::mesh::Mesh::triangles`];
    /// -1 off meshes.
    pub piece: i32,
    /// The innermost label; -1 where there is none.
    pub part: i32,
    /// Tag of the input face; -1 off meshes.
    pub tag: i32,
    /// 0 face, 1 to 3 edge 0-1, 1-2, 2-0, 4 to 6 vertex; -1 off meshes.
    pub feature: i32,
}

impl Default for Closest {
    fn default() -> Closest {
        Closest::only(f64::NAN)
    }
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
            piece: -1,
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

    fn placed(self, placement: &Placement) -> Closest {
        Closest {
            value: placement.scale() * self.value,
            gradient: placement.direction(self.gradient),
            ..self.moved(|q| placement.to_space(q))
        }
    }

    fn complemented(self) -> Closest {
        Closest { value: 0.0 - self.value, gradient: -self.gradient, ..self }
    }

    fn labelled(self, label: i32) -> Closest {
        Closest { part: if self.part == NO_PART { label } else { self.part }, ..self }
    }

    /// Without negative zeros, and nothing known where the value is not.
    fn finished(mut self) -> Closest {
        self.value = positive_zero(self.value);
        // Adding zero turns -0.0 into +0.0.
        self.point += Vec3::ZERO;
        self.gradient += Vec3::ZERO;
        if self.value.is_nan() { Closest::only(f64::NAN) } else { self }
    }
}

fn on_surface(surface: &Surface, p: Vec3, nearest: &Nearest) -> Closest {
    let primitive = surface.face(nearest.triangle);
    let (feature, barycentric) = match surface.as_input(nearest) {
        // What closes a mesh has no corners of a face.
        _ if primitive < 0 => (-1, Vec3::NAN),
        (feature, barycentric) => (feature as i32, barycentric),
    };
    let value = surface.signed(p, nearest);
    Closest {
        value,
        point: nearest.point,
        gradient: surface.gradient(p, nearest, value),
        barycentric,
        primitive,
        piece: surface.piece(nearest.triangle),
        part: NO_PART,
        tag: surface.tag(nearest.triangle),
        feature,
    }
}

impl Geometry {
    /// The closest point and all that goes with it. NaN throughout where a coordinate is not finite or a
    /// user's function failed.
    pub fn closest(&self, p: Vec3) -> Closest {
        if !p.is_finite() {
            return Closest::only(f64::NAN);
        }
        self.raw_closest(p).finished()
    }

    /// The closest points of many: the bits of [`Geometry::closest`].
    pub(crate) fn closest_many(&self, points: &[Vec3], out: &mut [Closest]) {
        if self.summary().depth <= DEEPEST_BLOCK && points.iter().all(|p| p.is_finite()) {
            self.raw_closest_many(points, out);
            out.iter_mut().for_each(|answer| *answer = answer.finished());
        } else {
            points.iter().zip(out).for_each(|(p, answer)| *answer = self.closest(*p));
        }
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
            Node::Surface(surface) => on_surface(surface, p, &surface.nearest(p)),
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
            Node::Complement(g) => g.raw_closest(p).complemented(),
            Node::Translate(g, shift) => g.raw_closest(p - *shift).moved(|q| q + *shift),
            Node::Place(g, placement) => g.raw_closest(placement.to_body(p)).placed(placement),
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
            Node::Part(g, label) => g.raw_closest(p).labelled(*label),
        }
    }

    /// The same at many finite points. What leads to one mesh asks it for a few points side by side.
    fn raw_closest_many(&self, points: &[Vec3], out: &mut [Closest]) {
        let mut inner = |g: &Geometry, to_body: &dyn Fn(Vec3) -> Vec3, back: &dyn Fn(Closest) -> Closest| {
            let inside: Vec<Vec3> = points.iter().map(|p| to_body(*p)).collect();
            g.raw_closest_many(&inside, out);
            out.iter_mut().for_each(|answer| *answer = back(*answer));
        };
        match self.node() {
            Node::Surface(surface) if points.iter().all(|p| p.is_finite()) => {
                surface.for_each_nearest(points, |k, nearest| out[k] = on_surface(surface, points[k], nearest));
            }
            Node::Complement(g) => inner(g, &|p| p, &Closest::complemented),
            Node::Translate(g, shift) => inner(g, &|p| p - *shift, &|c| c.moved(|q| q + *shift)),
            Node::Place(g, placement) => inner(g, &|p| placement.to_body(p), &|c| c.placed(placement)),
            Node::Part(g, label) => inner(g, &|p| p, &|c| c.labelled(*label)),
            _ => points.iter().zip(out).for_each(|(p, answer)| *answer = self.raw_closest(*p)),
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
