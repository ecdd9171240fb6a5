// SPDX-License-Identifier: MIT OR Apache-2.0
//! Legacy VTK PolyData (Kitware, "VTK File Formats"), as text or big-endian bytes, in the forms of versions up to 5.
//! Polygons and triangle strips are faces; vertices and lines are stepped over. Cell data `tag` of one integer are the
//! tags.

mod cursor;
mod data;
mod read;
mod write;

pub(super) use read::read;
pub(super) use write::write;
