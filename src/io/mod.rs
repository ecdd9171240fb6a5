// SPDX-License-Identifier: MIT OR Apache-2.0
//! Readers and writers. Formats are found by content, not by name.

mod detect;
mod file;
mod grid;
mod number;
mod obj;
mod ply;
mod proportion;
mod stl;
mod text;
mod vtk;
mod vtp;
mod words;

pub(crate) use file::write_with;
pub use grid::{GridField, write_grid};

use crate::error::{Error, Result};
use crate::mesh::{Input, JoinTags, Mesh, MeshOptions, build, join};
use proportion::Demand;
use std::path::Path;

/// A file format of meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Found by content.
    #[default]
    Detect,
    /// STL, ASCII or binary.
    Stl,
    /// PLY, ASCII or binary of either byte order.
    Ply,
    /// Wavefront OBJ.
    Obj,
    /// Legacy VTK PolyData, ASCII or binary.
    Vtk,
    /// XML VTK PolyData (.vtp), ASCII, binary or appended.
    Vtp,
}

/// Reads a mesh from a file; see [`read_memory`].
///
/// # Errors
/// [`Status::Io`](crate::Status) with the path and the system's reason; [`Status::Parse`](crate::Status)
/// with the path and what [`read_memory`] says.
pub fn read(path: &Path, format: Format, options: &MeshOptions) -> Result<Mesh> {
    options.check()?;
    read_input(path, format).and_then(|input| build(input, options).map_err(|e| named(path, &e)))
}

/// Reads several files into one mesh. With [`JoinTags::Renumber`] every tag of every file has a number of its
/// own; a file without names of tags lends its own name, without folder and extension, and with
/// [`JoinTags::ByMesh`] every file does. Face f of a file has the number f plus the faces of those before it.
///
/// # Errors
/// Those of [`read`] and of [`Mesh::join`].
pub fn read_files(paths: &[&Path], format: Format, tags: JoinTags, options: &MeshOptions) -> Result<Mesh> {
    options.check()?;
    if paths.is_empty() {
        return Err(Error::invalid("paths: none: a mesh has at least one face"));
    }
    let mut inputs = Vec::new();
    for path in paths {
        let mut input = read_input(path, format)?;
        let stem = text::one_line(&path.file_stem().unwrap_or_default().to_string_lossy());
        if tags == JoinTags::ByMesh {
            input.tag_names = vec![(0, stem)];
        } else if tags == JoinTags::Renumber && input.tag_names.is_empty() && input.tags.is_empty() {
            input.tag_names.push((0, stem));
        }
        inputs.push(input);
    }
    build(join(inputs, tags)?, options)
}

fn read_input(path: &Path, format: Format) -> Result<Input> {
    let bytes = file::read(path)?;
    parse(&bytes, format).map_err(|e| named(path, &e))
}

fn named(path: &Path, e: &Error) -> Error {
    Error::new(e.status(), format!("{}: {}", path.display(), e.message()))
}

/// Reads a mesh from the bytes of a file. 100,000 triangles of binary STL take tens of milliseconds.
///
/// # Errors
/// [`Status::Parse`](crate::Status) naming the line (ASCII) or the offset (binary) and the value: an empty
/// file, no triangle, an end within a triangle, a coordinate that is not a finite number, anything else that
/// the format does not have. [`Status::Unsupported`](crate::Status): what would take more than 20 bytes of memory for
/// each of the file, decompressed, and 16 MB. [`Status::InvalidArgument`](crate::Status) naming an option out of its
/// range.
pub fn read_memory(bytes: &[u8], format: Format, options: &MeshOptions) -> Result<Mesh> {
    options.check()?;
    build(parse(bytes, format)?, options)
}

/// What a file holds.
fn parse(bytes: &[u8], format: Format) -> Result<Input> {
    if bytes.is_empty() {
        return Err(Error::parse("offset 0: the file is empty"));
    }
    let input = match if format == Format::Detect { detect::format(bytes)? } else { format } {
        Format::Detect | Format::Stl => stl::read(bytes)?,
        Format::Ply => ply::read(bytes)?,
        Format::Obj => obj::read(bytes)?,
        Format::Vtk => vtk::read(bytes)?,
        // It may be compressed, and has checked what it holds.
        Format::Vtp => return vtp::read(bytes),
    };
    Demand::of(&input).check(bytes.len())?;
    Ok(input)
}

/// Writes the surface as it stands, in the format that the extension names, in any case. The file appears under
/// its name when it is complete.
///
/// | | holds |
/// |---|---|
/// | `.stl` | binary: triangles in f32 |
/// | `.ply` | binary: polygons, named data, tags and their names |
/// | `.obj` | text: polygons, tags and their names; of named data the vertices' red, green and blue alone |
/// | `.vtk` | legacy, binary: as `.ply` |
/// | `.vtp` | XML, appended bytes: as `.ply` |
///
/// All but STL give every coordinate back to the bit. Faces are numbered anew where the mesh lost some.
///
/// # Errors
/// [`Status::Unsupported`](crate::Status) for another extension, for a coordinate beyond the range of the f32
/// of STL, and for data of a name that the format has for something else: in PLY x, y and z of vertices and
/// vertex_indices and tag of faces, in any case; in VTK and VTP tag of faces, where the mesh has tags or the data
/// would be read as such; [`Status::Io`](crate::Status) with the path
/// and the system's reason; [`Status::Memory`](crate::Status).
pub fn write(mesh: &Mesh, path: &Path) -> Result<()> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let bytes = match extension.to_str() {
        Some("stl") => stl::write(mesh),
        Some("ply") => ply::write(mesh),
        Some("obj") => obj::write(mesh),
        Some("vtk") => vtk::write(mesh),
        Some("vtp") => vtp::write(mesh),
        _ => {
            let what = format!(
                "the extension \"{}\" is of no format that can be written: .stl, .ply, .obj, .vtk, .vtp",
                extension.display()
            );
            return Err(named(path, &Error::unsupported(what)));
        }
    };
    file::write(path, &bytes.map_err(|e| named(path, &e))?)
}
