// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constructors: arguments checked, nesting bounded.

mod check;
mod closed_form;
mod combine;
mod sampled;
mod transform;

pub(in crate::geometry) use check::{between, direction, finite_number, half_angle, not_negative, positive};

use super::node::Node;
use super::properties::{Function, FunctionOptions, RefitCheck, SdfOptions};
use super::shape::{Cuboid, Shape, Sphere};
use super::summary::Summary;
use super::surface::Surface;
use super::{Geometry, Inner};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::mesh::Mesh;
use crate::parallel::Run;
use crate::store::Block;
use std::sync::Arc;

/// Deepest nesting: evaluation and destruction recurse.
const MAX_DEPTH: usize = 1000;

impl Geometry {
    pub(in crate::geometry) fn new(node: Node) -> Result<Geometry> {
        Geometry::kept(node, None)
    }

    /// The same, over a block that is to be held as long.
    pub(in crate::geometry) fn kept(node: Node, block: Option<Arc<Block>>) -> Result<Geometry> {
        let summary = Summary::of(&node);
        if summary.depth > MAX_DEPTH {
            return Err(Error::unsupported(format!("nesting: {} levels are more than {MAX_DEPTH}", summary.depth)));
        }
        Ok(Geometry { inner: Arc::new(Inner { node, summary, _block: block }) })
    }

    /// A leaf.
    pub(in crate::geometry) fn leaf(shape: Box<dyn Shape>) -> Result<Geometry> {
        Geometry::new(Node::Shape(shape))
    }

    /// Signed distance to a mesh; the mesh may be dropped afterwards. See [`SdfOptions`]. An open or
    /// inconsistent mesh is [`crate::Status::Topology`] unless the sign is
    /// [`crate::geometry::SignMethod::None`]. O(n log n).
    pub fn from_mesh(mesh: &Mesh, options: &SdfOptions, run: &Run) -> Result<Geometry> {
        Geometry::new(Node::Surface(Box::new(Surface::new(mesh, options, run)?)))
    }

    /// The distance to the same faces over vertices that have moved: `xyz` holds three coordinates for each of
    /// [`Mesh::vertices`], in their order. Values are those of [`Geometry::from_mesh`] of such a mesh, bit for bit. Shares
    /// with this one what does not change. O(n), and about as much again for [`RefitCheck::Check`]; for rigid motions,
    /// [`Geometry::place`] is O(1).
    ///
    /// # Errors
    /// [`crate::Status::Unsupported`] where this is not what [`Geometry::from_mesh`] made, but something made of it;
    /// [`crate::Status::InvalidArgument`]: the count, a coordinate that is not finite or beyond 1e100, a box whose diagonal
    /// is not above 1e-90; [`crate::Status::Topology`]: the surface is turned inside out, or does not keep what the
    /// pseudonormals need where they were asked for.
    pub fn refit(&self, xyz: &[f64], check: RefitCheck, run: &Run) -> Result<Geometry> {
        Geometry::new(Node::Surface(Box::new(self.own_surface()?.refit(xyz, check, run)?)))
    }

    /// How many vertices [`Geometry::refit`] takes.
    ///
    /// # Errors
    /// [`crate::Status::Unsupported`] as there.
    pub fn vertices_to_move(&self) -> Result<usize> {
        Ok(self.own_surface()?.vertex_count())
    }

    fn own_surface(&self) -> Result<&Surface> {
        match self.node() {
            Node::Surface(surface) => Ok(surface),
            other => Err(Error::unsupported(format!(
                "g: it is {}, not what emb_geom_from_mesh made of a mesh; refit that, and make this of it anew",
                other.kind()
            ))),
        }
    }

    /// A ball. The radius is finite and > 0.
    pub fn sphere(center: [f64; 3], radius: f64) -> Result<Geometry> {
        Geometry::new(Node::Sphere(Sphere::new(center, radius)?))
    }

    /// An axis-aligned box; lo < hi on every axis.
    pub fn cuboid(lo: [f64; 3], hi: [f64; 3]) -> Result<Geometry> {
        Geometry::leaf(Box::new(Cuboid::new(lo, hi)?))
    }

    /// Labelled: the innermost label wins.
    pub fn part(&self, part: i32) -> Result<Geometry> {
        Geometry::new(Node::Part(self.clone(), part))
    }

    /// A user's function.
    pub fn function(function: Arc<dyn Function>, options: &FunctionOptions) -> Result<Geometry> {
        let b = options.bounds;
        for k in 0..3 {
            // A struct of zeros would be a body of one point.
            if b.lo[k].is_nan() || b.hi[k].is_nan() || b.lo[k] >= b.hi[k] {
                return Err(Error::invalid(format!(
                    "options.lo[{k}], hi[{k}]: {} to {} is no range",
                    b.lo[k], b.hi[k]
                )));
            }
        }
        for (name, x) in [("lipschitz", options.lipschitz), ("gradient_step", options.gradient_step)] {
            if !(x >= 0.0 && x.is_finite()) {
                return Err(Error::invalid(format!("options.{name}: {x} is not finite and >= 0")));
            }
        }
        Geometry::new(Node::Function { function, options: options.clone() })
    }
}

/// The vector, where all of it is finite.
pub(in crate::geometry) fn finite(name: &str, v: [f64; 3]) -> Result<Vec3> {
    match v.iter().position(|c| !c.is_finite()) {
        Some(k) => Err(Error::invalid(format!("{name}[{k}]: {} is not finite", v[k]))),
        None => Ok(Vec3::from_array(v)),
    }
}
