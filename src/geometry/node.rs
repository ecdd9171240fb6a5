// SPDX-License-Identifier: MIT OR Apache-2.0
//! The kinds of node.

use super::Geometry;
use super::level::Level;
use super::map::Map;
use super::parts::Parts;
use super::placement::Placement;
use super::properties::{Function, FunctionOptions};
use super::repeat::Repeat;
use super::shape::{Shape, Sphere};
use super::smooth::Smooth;
use super::stencil::Stencil;
use super::surface::Surface;
use crate::math::Vec3;
use std::sync::Arc;

pub(super) enum Node {
    /// The commonest leaf, by the million: without an allocation of its own.
    Sphere(Sphere),
    Shape(Box<dyn Shape>),
    Surface(Box<Surface>),
    Function {
        function: Arc<dyn Function>,
        options: FunctionOptions,
    },
    /// The least value wins.
    Union(Parts),
    /// The greatest value wins.
    Intersection(Parts),
    Smooth(Smooth),
    Repeat(Repeat),
    Complement(Geometry),
    Translate(Geometry, Vec3),
    Place(Geometry, Placement),
    Map(Geometry, Map),
    Level(Geometry, Level),
    Stencil(Geometry, Stencil),
    Part(Geometry, i32),
}

impl Node {
    /// The leaf in closed form that it is.
    pub(super) fn shape(&self) -> Option<&dyn Shape> {
        match self {
            Node::Sphere(sphere) => Some(sphere),
            Node::Shape(shape) => Some(&**shape),
            _ => None,
        }
    }

    /// What it is, in words.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Node::Sphere(_) | Node::Shape(_) => "a shape",
            Node::Surface(_) => "a mesh",
            Node::Function { .. } => "a function",
            Node::Union(_) => "a union",
            Node::Intersection(_) => "an intersection or a difference",
            Node::Smooth(_) => "a blend",
            Node::Repeat(_) => "a pattern",
            Node::Complement(_) => "a complement",
            Node::Translate(..) | Node::Place(..) | Node::Map(..) => "moved, turned or bent",
            Node::Level(..) | Node::Stencil(..) => "offset or smoothed",
            Node::Part(..) => "labelled",
        }
    }

    /// Its children.
    pub(super) fn children(&self) -> &[Geometry] {
        match self {
            Node::Sphere(_) | Node::Shape(_) | Node::Surface(_) | Node::Function { .. } => &[],
            Node::Union(parts) | Node::Intersection(parts) => parts.list(),
            Node::Smooth(smooth) => smooth.parts().list(),
            Node::Repeat(repeat) => std::slice::from_ref(repeat.child()),
            Node::Complement(g)
            | Node::Translate(g, _)
            | Node::Place(g, _)
            | Node::Map(g, _)
            | Node::Level(g, _)
            | Node::Stencil(g, _)
            | Node::Part(g, _) => std::slice::from_ref(g),
        }
    }
}
