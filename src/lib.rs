// SPDX-License-Identifier: MIT OR Apache-2.0
//! embound answers what embedded-boundary and immersed-boundary solvers ask of geometry: at
//! millions of points, boxes and edges, where is the surface?
//!
//! A [`mesh::Mesh`] is read from a file or from arrays, becomes a [`geometry::Geometry`] (an
//! implicit function: negative inside the body, positive outside, zero on the surface and counted
//! as inside), and [`query`] asks it questions: value, closest point, fill, crossings, intercepts,
//! classification. The C ABI in [`ffi`] is a thin layer over exactly this.

pub mod error;
#[allow(rustdoc::broken_intra_doc_links)] // cbindgen reads array lengths from what looks like links.
pub mod ffi;
pub mod geometry;
pub mod io;
pub mod math;
pub mod mesh;
pub mod parallel;
pub mod query;

mod bvh;
pub mod primitive;
mod scan;
mod simd;
mod store;

pub use error::{Error, Result, Status};
pub use simd::isa;
