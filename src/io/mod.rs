// SPDX-License-Identifier: MIT OR Apache-2.0
//! Readers and writers. Formats are found by content, not by name.

use crate::error::Result;
use crate::mesh::{Mesh, MeshOptions};
use std::path::Path;

/// A file format of meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Found by content.
    #[default]
    Detect,
    /// STL, ASCII or binary.
    Stl,
}

/// Reads a mesh from a file.
pub fn read(_path: &Path, _format: Format, _options: &MeshOptions) -> Result<Mesh> {
    todo!()
}

/// Reads a mesh from the bytes of a file.
pub fn read_memory(_bytes: &[u8], _format: Format, _options: &MeshOptions) -> Result<Mesh> {
    todo!()
}

/// Writes the mesh as it stands (binary STL for `.stl`); the format is chosen by the extension.
pub fn write(_mesh: &Mesh, _path: &Path) -> Result<()> {
    todo!()
}
