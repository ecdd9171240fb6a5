// SPDX-License-Identifier: MIT OR Apache-2.0
//! Wavefront OBJ (Wavefront Technologies, Advanced Visualizer manual, appendix B1): vertices, with or without
//! colours, and polygons. Texture coordinates, normals, lines, points, curves and surfaces are skipped.

mod read;
mod tags;
mod write;

pub(super) use read::read;
pub(super) use write::write;
