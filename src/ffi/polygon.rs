// SPDX-License-Identifier: MIT OR Apache-2.0
//! Points in polygons: of the caller's, and faces of a mesh.

use super::arrays::{elements, numbers, slice};
use super::constants::{EMB_POLYGON_ANGLE, EMB_POLYGON_CROSSING, EMB_POLYGON_WINDING};
use super::error::{emb_status, guard};
use super::handle::{lend, writable};
use super::mesh::emb_mesh;
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::mesh::{Inside, LARGEST_COORDINATE, polygon_contains};

/// Whether a point of the plane lies in a polygon of `count` corners, x y each, whichever way they run: 1 or 0 to
/// *out_inside. `method` is EMB_POLYGON_CROSSING, _WINDING or _ANGLE. Of a point on the boundary all three give the answer
/// for one an infinitesimal to the right and above. Fewer than three corners hold nothing. Cost: linear.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (method; a coordinate that is not finite or beyond 1e100 in
/// magnitude). Any thread.
/// cbindgen:ptrs-as-arrays=[[point;2]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_polygon_contains(
    count: usize,
    xy: *const f64,
    point: *const f64,
    method: i32,
    out_inside: *mut i32,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let corners = slice("xy", xy, elements::<f64>("count", count, 2)?)?;
        let point: [f64; 2] = numbers("point", point)?;
        let method = self::method(method)?;
        bounded("xy", corners)?;
        bounded("point", &point)?;
        writable("out_inside", out_inside)?;
        let corners = corners.chunks_exact(2).map(|c| [c[0], c[1]]);
        out_inside.write(polygon_contains(corners, point, method).into());
        Ok(())
    })
}

/// The same for an input face of a mesh as it stands and a point in space. A point off the face's plane counts by its foot
/// on it, along the normal of the face's area vector, however far off it is; so do corners of a face that is not plane (the
/// plane goes through its first corner). Right and above are the two axes that follow, in the cyclic order x y z, the one
/// that the area vector is longest along, exchanged where its component there is negative.
/// Errors: those of emb_polygon_contains, and EMB_ERROR_INVALID_ARGUMENT where the face is gone.
/// cbindgen:ptrs-as-arrays=[[point;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_face_contains(
    mesh: *const emb_mesh,
    face: u64,
    point: *const f64,
    method: i32,
    out_inside: *mut i32,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let found = u32::try_from(face).ok().and_then(|f| mesh.half_edges().face_of_input(f));
        let found = found.ok_or_else(|| Error::invalid(format!("face: the mesh as it stands has no face {face}")))?;
        let point: [f64; 3] = numbers("point", point)?;
        let method = self::method(method)?;
        bounded("point", &point)?;
        writable("out_inside", out_inside)?;
        out_inside.write(mesh.face_contains(found, Vec3::from_array(point), method).into());
        Ok(())
    })
}

fn method(method: i32) -> Result<Inside> {
    match method {
        EMB_POLYGON_CROSSING => Ok(Inside::Crossing),
        EMB_POLYGON_WINDING => Ok(Inside::Winding),
        EMB_POLYGON_ANGLE => Ok(Inside::Angle),
        other => Err(Error::invalid(format!("method: {other} is not an EMB_POLYGON_*"))),
    }
}

fn bounded(name: &str, values: &[f64]) -> Result<()> {
    let wrong = |c: &f64| !(c.is_finite() && c.abs() <= LARGEST_COORDINATE);
    let Some(k) = values.iter().position(wrong) else { return Ok(()) };
    let value = values[k];
    Err(Error::invalid(if value.is_finite() {
        format!("{name}[{k}]: {value:e} is beyond {LARGEST_COORDINATE:e}")
    } else {
        format!("{name}[{k}]: {value} is not finite")
    }))
}
