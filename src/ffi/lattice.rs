// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lattices written to files.

use super::arrays::{elements, path, slice};
use super::data::name;
use super::error::{emb_status, guard};
use super::reader;
use super::writer::{emb_array, emb_lattice, lattice};
use crate::error::{Result, try_with_capacity};
use crate::io::{self, GridField};
use std::ffi::c_char;

/// Writes values over a lattice to a file for ParaView or VisIt: VTK's XML with appended bytes, as point data.
/// arrays[k], which is only read, holds the values named names[k] (UTF-8, one line, each another) at the lattice's
/// points, in any of the four types and any layout. The extension of `path` is ".vti" (axes of even steps, to within
/// rounding; of each the first coordinate and the step are kept) or ".vtr" (any axes; their coordinates are kept). Axes
/// rise strictly, and each has at least one coordinate. `names` and `arrays` may be NULL where count is 0. The values
/// go to the file row by row, without a copy; it appears under its name when it is complete. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (the lattice, a name, an array), EMB_ERROR_UNSUPPORTED
/// (extension; an axis that does not rise, or for ".vti" not evenly), EMB_ERROR_IO, EMB_ERROR_MEMORY. Cost: linear in the values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_lattice_write(
    lattice: *const emb_lattice,
    path: *const c_char,
    count: usize,
    names: *const *const c_char,
    arrays: *const emb_array,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let lattice = self::lattice(lattice)?;
        let path = self::path("path", path)?;
        let axes = lattice.axes;
        let extent = axes.map(<[f64]>::len);
        let fields = fields(extent, count, names, arrays)?;
        io::write_grid(path, axes, &fields)
    })
}

/// # Safety
/// `names` and `arrays` are NULL or hold `count` elements, as [`emb_lattice_write`] asks.
unsafe fn fields<'a>(
    extent: [usize; 3],
    count: usize,
    names: *const *const c_char,
    arrays: *const emb_array,
) -> Result<Vec<GridField<'a>>> {
    let count = elements::<emb_array>("count", count, 1)?;
    // SAFETY: the caller's promise.
    let names = unsafe { slice("names", names, count) }?;
    let mut fields = try_with_capacity("fields", count)?;
    let mut at = arrays;
    for (k, text) in names.iter().enumerate() {
        // SAFETY: the caller's promise.
        let name = unsafe { name(&format!("names[{k}]"), *text) }?;
        // SAFETY: the caller's promise; `at` is array k.
        let (kind, row) = unsafe { reader::rows(&format!("arrays[{k}]"), at, extent) }?;
        // The next is behind this one, which may be of another release's size.
        // SAFETY: it was read just now.
        at = at.wrapping_byte_add(unsafe { at.cast::<usize>().read_unaligned() });
        fields.push(GridField::new(name, kind, row));
    }
    Ok(fields)
}
