// SPDX-License-Identifier: MIT OR Apache-2.0
//! VTK's XML PolyData (VTK User's Guide, "VTK File Formats"): data as text, base64 or appended, compressed by
//! zlib or not, in either byte order.

mod array;
mod base64;
mod blocks;
pub(super) mod cells;
mod document;
mod fields;
pub(super) mod read;
mod write;
mod xml;

pub(super) use read::read;
pub(super) use write::write;
