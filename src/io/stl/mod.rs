// SPDX-License-Identifier: MIT OR Apache-2.0
//! STL (3D Systems 1989), ASCII and binary.

mod ascii;
mod binary;

use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::mesh::{Mesh, MeshOptions};

pub(super) use binary::write;

/// Triangles as a file holds them.
struct Triangles {
    /// Three a triangle.
    corners: Vec<Vec3>,
    /// The solid of each triangle; empty where there is one.
    solids: Vec<i32>,
}

/// Reads either kind. `options` have been checked.
pub(super) fn read(bytes: &[u8], options: &MeshOptions) -> Result<Mesh> {
    if bytes.is_empty() {
        return Err(Error::parse("offset 0: the file is empty"));
    }
    let triangles = if is_binary(bytes) { binary::read(bytes)? } else { ascii::read(bytes)? };
    Mesh::from_soup(triangles.corners, triangles.solids, options)
}

/// A file whose size is what its count asks for is binary, whatever its header says: read as text the
/// count has at least the value of four line feeds, 168 million triangles, so no text has that size by chance.
/// Else it is binary where what would be header and count holds bytes that text does not: a count below
/// 16 million has a zero byte.
fn is_binary(bytes: &[u8]) -> bool {
    let is_control = |b: &u8| (*b < b' ' && !b"\t\n\x0b\x0c\r".contains(b)) || *b == 0x7f;
    binary::claimed_size(bytes) == Some(bytes.len() as u64) || bytes[..bytes.len().min(84)].iter().any(is_control)
}
