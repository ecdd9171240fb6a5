// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constructors: arguments checked, chains of placements collapsed, nesting bounded.

mod check;
mod closed_form;

pub(in crate::geometry) use check::{between, direction, finite_number, half_angle, not_negative, positive};

use super::node::Node;
use super::placement::Placement;
use super::properties::{Function, FunctionOptions, SdfOptions};
use super::shape::Shape;
use super::summary::Summary;
use super::surface::Surface;
use super::{Geometry, Inner};
use crate::error::{Error, Result, try_with_capacity};
use crate::math::{Aabb, Vec3};
use crate::mesh::Mesh;
use crate::parallel::Run;
use std::sync::Arc;

/// Deepest nesting: evaluation and destruction recurse.
const MAX_DEPTH: usize = 1000;

impl Geometry {
    fn new(node: Node) -> Result<Geometry> {
        let summary = Summary::of(&node);
        if summary.depth > MAX_DEPTH {
            return Err(Error::unsupported(format!("nesting: {} levels are more than {MAX_DEPTH}", summary.depth)));
        }
        Ok(Geometry { inner: Arc::new(Inner { node, summary }) })
    }

    /// A leaf.
    pub(in crate::geometry) fn leaf(_shape: Box<dyn Shape>) -> Result<Geometry> {
        Err(Error::unsupported("shape: not yet"))
    }

    /// Signed distance to a mesh; the mesh may be dropped afterwards. See [`SdfOptions`]. An open or
    /// inconsistent mesh is [`crate::Status::Topology`] unless the sign is
    /// [`crate::geometry::SignMethod::None`]. O(n log n).
    pub fn from_mesh(mesh: &Mesh, options: &SdfOptions, run: &Run) -> Result<Geometry> {
        Geometry::new(Node::Surface(Surface::new(mesh, options, run)?))
    }

    /// A ball. The radius is finite and > 0.
    pub fn sphere(center: [f64; 3], radius: f64) -> Result<Geometry> {
        let center = finite("center", center)?;
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::invalid(format!("radius: {radius} is not finite and > 0")));
        }
        Geometry::new(Node::Sphere { center, radius })
    }

    /// An axis-aligned box; lo < hi on every axis.
    pub fn cuboid(lo: [f64; 3], hi: [f64; 3]) -> Result<Geometry> {
        let b = Aabb::new(finite("lo", lo)?, finite("hi", hi)?);
        match (0..3).find(|&k| b.lo[k] >= b.hi[k]) {
            Some(k) => Err(Error::invalid(format!("hi[{k}]: {} is not above lo[{k}] = {}", b.hi[k], b.lo[k]))),
            None => Geometry::new(Node::Cuboid(b)),
        }
    }

    /// Points in any part; of none: +inf everywhere. The value is the least of the parts', hence a lower
    /// bound of the distance where there are several.
    pub fn union(parts: &[Geometry]) -> Result<Geometry> {
        Geometry::new(Node::Union(copied(parts)?))
    }

    /// Points in every part; of none: -inf everywhere. The value is the greatest of the parts'.
    pub fn intersection(parts: &[Geometry]) -> Result<Geometry> {
        Geometry::new(Node::Intersection(copied(parts)?))
    }

    /// Points of `self` that are not in `remove`.
    pub fn difference(&self, remove: &Geometry) -> Result<Geometry> {
        Geometry::new(Node::Intersection(vec![self.clone(), remove.complement()?]))
    }

    /// The rest of space: 0.0 - f.
    pub fn complement(&self) -> Result<Geometry> {
        Geometry::new(Node::Complement(self.clone()))
    }

    /// Moved by `shift`. Shifts of shifts and of placements collapse into one.
    pub fn translate(&self, shift: [f64; 3]) -> Result<Geometry> {
        let shift = finite("shift", shift)?;
        match self.node() {
            Node::Translate(g, before) => g.translate((*before + shift).to_array()),
            Node::Place(g, before) => Geometry::placed(g, Placement::translation(shift).after(before)),
            _ => Geometry::new(Node::Translate(self.clone(), shift)),
        }
    }

    /// Placed rigidly: a point q of the body comes to `rotation * q + shift`. The matrix is row-major and
    /// a rotation to within 1e-9. O(1): the body is shared; placements of placements collapse into one.
    pub fn place(&self, rotation: [f64; 9], shift: [f64; 3]) -> Result<Geometry> {
        let placement = Placement::new(rotation, finite("shift", shift)?)?;
        let (body, placement) = match self.node() {
            Node::Place(g, before) => (g, placement.after(before)),
            Node::Translate(g, before) => (g, placement.after(&Placement::translation(*before))),
            _ => (self, placement),
        };
        Geometry::placed(body, placement)
    }

    /// The shifts of collapsed placements may add up to more than a number holds.
    fn placed(body: &Geometry, placement: Placement) -> Result<Geometry> {
        finite("shift", placement.shift().to_array())?;
        Geometry::new(Node::Place(body.clone(), placement))
    }

    /// Labelled: the innermost label wins.
    pub fn part(&self, part: i32) -> Result<Geometry> {
        Geometry::new(Node::Part(self.clone(), part))
    }

    /// A user's function.
    pub fn function(function: Arc<dyn Function>, options: &FunctionOptions) -> Result<Geometry> {
        let b = options.bounds;
        for k in 0..3 {
            if b.lo[k].is_nan() || b.hi[k].is_nan() || b.lo[k] > b.hi[k] {
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

fn copied(parts: &[Geometry]) -> Result<Vec<Geometry>> {
    let mut copy = try_with_capacity("parts", parts.len())?;
    copy.extend_from_slice(parts);
    Ok(copy)
}

/// The vector, where all of it is finite.
pub(in crate::geometry) fn finite(name: &str, v: [f64; 3]) -> Result<Vec3> {
    match v.iter().position(|c| !c.is_finite()) {
        Some(k) => Err(Error::invalid(format!("{name}[{k}]: {} is not finite", v[k]))),
        None => Ok(Vec3::from_array(v)),
    }
}
