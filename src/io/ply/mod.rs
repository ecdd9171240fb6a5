// SPDX-License-Identifier: MIT OR Apache-2.0
//! PLY (Turk 1994), ASCII and binary of either byte order. Scalar properties of vertices and faces beyond x, y
//! and z become named data; an integer face property `tag` becomes the tags.

mod header;
mod numbers;
mod read;
mod write;

pub(super) use read::read;
pub(super) use write::write;
