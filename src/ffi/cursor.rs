// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values one after another, for solvers that call a function for each point.

use super::error::{emb_status, guard, plain, quiet, quiet_alone};
use super::geometry::emb_geom;
use super::handle::{Handle, give, lend, peek, release, writable};
use crate::geometry::Cursor;
use crate::math::Vec3;
use std::ffi::c_void;

/// A geometry, and what was found around the points it was asked about lately, so that a point near others costs a
/// fraction of one by itself.
pub struct emb_cursor {
    _opaque: (),
}

impl Handle for emb_cursor {
    type Target = Cursor;
}

/// A cursor for solvers that ask for one value after another, points that follow one another lying close together: node
/// after node of a grid, or a search along an edge. It pays on meshes, moved, complemented, offset, labelled or in small
/// unions and intersections, too; other geometries answer as they are. The spacing of the points is learnt from the first
/// two and again where it changes; it pays from some sixteen points on in a cube of four spacings, and points all
/// over the place cost a little more than without it. It takes up to about 6 MB for each mesh. `g` is kept alive.
/// On success *out_cursor is the caller's, to be freed with emb_cursor_free. Whole boxes are filled faster by
/// emb_geom_fill, many points by emb_geom_values.
/// Errors: EMB_ERROR_NULL_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_cursor_new(g: *const emb_geom, out_cursor: *mut *mut emb_cursor) -> emb_status {
    // SAFETY: a handle or NULL, and an output that is checked.
    guard(|| unsafe {
        writable("out_cursor", out_cursor)?;
        let cursor = Cursor::new(lend("g", g)?);
        give(out_cursor, cursor);
        Ok(())
    })
}

/// emb_geom_value of the cursor's geometry, to the bit, whatever was asked before; NaN for NULL. One cursor for each
/// thread: where several share one, a thread that comes while another is answered is answered without its help.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_cursor_value(cursor: *const emb_cursor, x: f64, y: f64, z: f64) -> f64 {
    let value = |cursor: &Cursor| cursor.value(Vec3::new(x, y, z));
    // SAFETY: a handle or NULL, as the header asks.
    match unsafe { peek(cursor) } {
        None => f64::NAN,
        Some(cursor) if cursor.geometry().has_functions() => quiet(f64::NAN, || value(cursor)),
        Some(cursor) => quiet_alone(f64::NAN, || value(cursor)),
    }
}

/// emb_cursor_value as an emb_value_fn, for solvers that take (function, user): `cursor` is a const emb_cursor *.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_cursor_value_fn(cursor: *mut c_void, x: f64, y: f64, z: f64) -> f64 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { emb_cursor_value(cursor.cast_const().cast(), x, y, z) }
}

/// Frees a cursor. NULL is fine. Not while a call uses it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_cursor_free(cursor: *mut emb_cursor) {
    // SAFETY: a handle or NULL that is not used again, as the header asks.
    plain((), || unsafe { release(cursor) });
}
