// SPDX-License-Identifier: MIT OR Apache-2.0
//! Readers and writers. Formats are found by content, not by name.

mod file;
mod stl;

use crate::error::{Error, Result};
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

/// Reads a mesh from a file. STL: a triangle's tag is the number of its solid, from 0; binary files are
/// one solid.
///
/// # Errors
/// [`Status::Io`](crate::Status) with the path and the system's reason; [`Status::Parse`](crate::Status)
/// with the path and what [`read_memory`] says.
pub fn read(path: &Path, format: Format, options: &MeshOptions) -> Result<Mesh> {
    options.check()?;
    let bytes = file::read(path)?;
    read_memory(&bytes, format, options)
        .map_err(|e| Error::new(e.status(), format!("{}: {}", path.display(), e.message())))
}

/// Reads a mesh from the bytes of a file. 100,000 triangles of binary STL take tens of milliseconds.
///
/// # Errors
/// [`Status::Parse`](crate::Status) naming the line (ASCII) or the offset (binary) and the value: an empty
/// file, no triangle, an end within a triangle, a coordinate that is not a finite number, anything else that
/// the format does not have. [`Status::InvalidArgument`](crate::Status) naming an option out of its range.
pub fn read_memory(bytes: &[u8], format: Format, options: &MeshOptions) -> Result<Mesh> {
    options.check()?;
    match format {
        Format::Detect | Format::Stl => stl::read(bytes, options),
    }
}

/// Writes the triangles of the surface as it stands: binary STL for `.stl`, in any case. The file
/// appears under its name when it is complete.
///
/// # Errors
/// [`Status::Unsupported`](crate::Status) for another extension, and for a coordinate beyond the range of
/// the f32 of STL; [`Status::Io`](crate::Status) with the path and the system's reason.
pub fn write(mesh: &Mesh, path: &Path) -> Result<()> {
    let extension = path.extension().unwrap_or_default();
    if !extension.eq_ignore_ascii_case("stl") {
        return Err(Error::unsupported(format!(
            "{}: the extension \"{}\" is of no format that can be written",
            path.display(),
            extension.display()
        )));
    }
    file::write(path, &stl::write(mesh)?)
}
