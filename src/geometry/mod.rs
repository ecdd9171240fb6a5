// SPDX-License-Identifier: MIT OR Apache-2.0
//! The implicit-function tree: shapes, transforms, CSG, mesh distance and user callbacks. Each node
//! knows its bounds, its Lipschitz constant and whether its value is exact.

mod properties;

pub use properties::{Accelerator, Function, FunctionOptions, Kind, Open, Properties, SdfOptions, SignMethod};

use crate::error::Result;
use crate::math::{Aabb, Vec3};
use crate::mesh::Mesh;
use crate::parallel::Run;
use std::sync::Arc;

/// An implicit function: negative inside the body, positive outside, zero on the surface and counted
/// as inside. Immutable; a clone is O(1) and shares everything.
#[derive(Clone)]
pub struct Geometry {
    _todo: Arc<()>,
}

impl Geometry {
    /// Signed distance to a mesh. See [`SdfOptions`].
    pub fn from_mesh(_mesh: &Mesh, _options: &SdfOptions, _run: &Run) -> Result<Geometry> {
        todo!()
    }
    /// A ball.
    pub fn sphere(_center: [f64; 3], _radius: f64) -> Result<Geometry> {
        todo!()
    }
    /// An axis-aligned box.
    pub fn cuboid(_lo: [f64; 3], _hi: [f64; 3]) -> Result<Geometry> {
        todo!()
    }
    /// Points in any part; of none: +inf everywhere.
    pub fn union(_parts: &[Geometry]) -> Result<Geometry> {
        todo!()
    }
    /// Points in every part; of none: -inf everywhere.
    pub fn intersection(_parts: &[Geometry]) -> Result<Geometry> {
        todo!()
    }
    /// Points of `self` that are not in `remove`.
    pub fn difference(&self, _remove: &Geometry) -> Result<Geometry> {
        todo!()
    }
    /// The rest of space: 0.0 - f.
    pub fn complement(&self) -> Result<Geometry> {
        todo!()
    }
    /// Moved by `shift`.
    pub fn translate(&self, _shift: [f64; 3]) -> Result<Geometry> {
        todo!()
    }
    /// Placed rigidly: a point q of the body comes to `rotation * q + shift`. O(1).
    pub fn place(&self, _rotation: [f64; 9], _shift: [f64; 3]) -> Result<Geometry> {
        todo!()
    }
    /// Labelled: the innermost label wins.
    pub fn part(&self, _part: i32) -> Result<Geometry> {
        todo!()
    }
    /// A user's function.
    pub fn function(_function: Arc<dyn Function>, _options: &FunctionOptions) -> Result<Geometry> {
        todo!()
    }
    /// The value at a point; NaN where a coordinate is not finite or a callback failed. Never -0.0.
    pub fn value(&self, _p: Vec3) -> f64 {
        todo!()
    }
    /// A box around the body: infinite where unbounded, [`Aabb::EMPTY`] where there is none.
    pub fn bounds(&self) -> Aabb {
        todo!()
    }
    /// Kind, sign method, Lipschitz constant, primitives, bytes.
    pub fn properties(&self) -> Properties {
        todo!()
    }
    /// Equal on every rank, instruction set and run for equal content; 0 for trees with user functions.
    pub fn fingerprint(&self) -> u64 {
        todo!()
    }
}
