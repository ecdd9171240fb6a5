// SPDX-License-Identifier: MIT OR Apache-2.0
//! STL (3D Systems 1989), ASCII and binary.

mod ascii;
mod binary;

use crate::error::{Result, Status};
use crate::math::Vec3;
use crate::mesh::Input;

pub(super) use binary::write;

/// Triangles as a file holds them.
#[derive(Default)]
struct Triangles {
    /// Three a triangle.
    corners: Vec<Vec3>,
    /// The solid of each triangle; empty where there is one.
    solids: Vec<i32>,
    /// Of each solid; empty where it has none.
    names: Vec<String>,
}

/// Reads either kind. A triangle's tag is the number of its solid, from 0.
pub(super) fn read(bytes: &[u8]) -> Result<Input> {
    let triangles = if is_binary(bytes) { binary::read(bytes)? } else { ascii::read(bytes)? };
    let mut input = Input::triangle_soup(triangles.corners, Status::Parse)?;
    input.tags = triangles.solids;
    let named = (0..).zip(triangles.names).filter(|(_, name)| !name.is_empty());
    input.tag_names.extend(named);
    Ok(input)
}

/// A file whose size is what its count asks for is binary, whatever its header says: read as text the
/// count has at least the value of four line feeds, 168 million triangles, so no text has that size by chance.
/// Else it is binary where what would be header and count holds bytes that text does not: a count below
/// 16 million has a zero byte.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    let is_control = |b: &u8| (*b < b' ' && !b"\t\n\x0b\x0c\r".contains(b)) || *b == 0x7f;
    binary::claimed_size(bytes) == Some(bytes.len() as u64) || bytes[..bytes.len().min(84)].iter().any(is_control)
}
