// SPDX-License-Identifier: MIT OR Apache-2.0
//! The kinds of node.

use super::Geometry;
use super::placement::Placement;
use super::properties::{Function, FunctionOptions};
use super::surface::Surface;
use crate::math::{Aabb, Vec3};
use std::sync::Arc;

pub(super) enum Node {
    Sphere { center: Vec3, radius: f64 },
    Cuboid(Aabb),
    Surface(Surface),
    Function { function: Arc<dyn Function>, options: FunctionOptions },
    Union(Vec<Geometry>),
    Intersection(Vec<Geometry>),
    Complement(Geometry),
    Translate(Geometry, Vec3),
    Place(Geometry, Placement),
    Part(Geometry, i32),
}
