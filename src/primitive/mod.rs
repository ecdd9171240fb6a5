// SPDX-License-Identifier: MIT OR Apache-2.0
//! Closed-form problems, one a file. Allocate nothing, know nothing of meshes.

pub(crate) mod contact;
pub(crate) mod crossing;
pub(crate) mod cuboid;
pub(crate) mod ellipsoid;
pub(crate) mod estimate;
pub(crate) mod fan;
pub mod inside;
pub(crate) mod least_area;
pub(crate) mod noise;
pub(crate) mod outline;
pub(crate) mod overlap;
mod pass;
pub(crate) mod polygon;
pub(crate) mod profile;
pub(crate) mod ray;
pub(crate) mod solid_angle;
pub(crate) mod sphere;
pub(crate) mod triangle;
