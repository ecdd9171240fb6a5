// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bodies moved, turned, grown and bent. Each shares what it is made from.

use super::arrays::numbers;
use super::error::emb_status;
use super::geometry::{construct, emb_geom};
use super::handle::lend;
use crate::error::Result;

/// Three numbers, zero where they are missing.
///
/// # Safety
/// `data` is NULL or holds three numbers.
unsafe fn or_origin(name: &str, data: *const f64) -> Result<[f64; 3]> {
    if data.is_null() {
        return Ok([0.0; 3]);
    }
    // SAFETY: the caller's promise.
    unsafe { numbers(name, data) }
}

/// The body moved by `shift`. O(1), shares g. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite).
/// cbindgen:ptrs-as-arrays=[[shift;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_translate(
    g: *const emb_geom,
    shift: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.translate(numbers("shift", shift)?)) }
}

/// The body placed rigidly: its point q comes to rotation * q + shift. `rotation` is row major and must be a
/// rotation to within 1e-9 (in each element of its transpose times itself; it is made one to rounding), so bring a
/// matrix that came from floats or was multiplied up over many steps back to one first. O(1), shares g: cheap enough for
/// every time step of a moving body (of one that also bends, see emb_geom_refit). Placements of placements become one.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, or not a rotation).
/// cbindgen:ptrs-as-arrays=[[rotation;9], [shift;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_place(
    g: *const emb_geom,
    rotation: *const f64,
    shift: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.place(numbers("rotation", rotation)?, numbers("shift", shift)?)) }
}

/// The body turned by `degrees`, right-handed, about the axis through `point` (NULL: the origin) along `axis`, which
/// need not have length 1. O(1), shares g.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, axis zero).
/// cbindgen:ptrs-as-arrays=[[axis;3], [point;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_rotate(
    g: *const emb_geom,
    axis: *const f64,
    degrees: f64,
    point: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.rotate(numbers("axis", axis)?, degrees, or_origin("point", point)?)) }
}

/// The body scaled by `factor` about the origin; values are scaled with it, and one that is exact stays so. O(1),
/// shares g. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, factor not > 0, or with the factors of
/// nested scalings beyond the range of numbers).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_scale(g: *const emb_geom, factor: f64, out_geom: *mut *mut emb_geom) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.scale(factor)) }
}

/// The body reflected in a plane of coordinates through the origin: 0 the yz plane (x changes sign), 1 the xz plane, 2
/// the xy plane. O(1), shares g. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (plane).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_reflect(g: *const emb_geom, plane: i32, out_geom: *mut *mut emb_geom) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.reflect(plane)) }
}

/// The body reflected in the plane through `point` across `normal`, which need not have length 1. O(1), shares g.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, normal zero).
/// cbindgen:ptrs-as-arrays=[[point;3], [normal;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_reflect_in(
    g: *const emb_geom,
    point: *const f64,
    normal: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.reflect_in(numbers("point", point)?, numbers("normal", normal)?)) }
}

/// The body under a linear map: its point q comes to matrix * q + shift (row major; shift NULL: zero). Values are
/// multiplied by the least factor by which the matrix lengthens, so that a distance becomes a lower bound of the distance.
/// O(1), shares g. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, or a matrix without an inverse to
/// within rounding).
/// cbindgen:ptrs-as-arrays=[[matrix;9], [shift;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_affine(
    g: *const emb_geom,
    matrix: *const f64,
    shift: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.affine(numbers("matrix", matrix)?, or_origin("shift", shift)?)) }
}

/// The body grown by `distance`, or shrunk where it is negative: value - distance. Exact where g is and no edge or
/// curvature of its surface is in the way, else a lower bound of the distance where the value is 1-Lipschitz. O(1),
/// shares g. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_offset(
    g: *const emb_geom,
    distance: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.offset(distance)) }
}

/// The shell of points within `half_thickness` of the surface: |value| - half_thickness. Exact on and outside the
/// shell where g is; within it, and so by its kind, only where no edge or curvature of the surface is in the way of
/// either side (balls, planes, tori, cylinders without end): beside a box's edge the inner wall is further than this
/// says. Else a lower bound of the distance where the value is 1-Lipschitz.
/// O(1), shares g. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, not > 0).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_annular(
    g: *const emb_geom,
    half_thickness: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.annular(half_thickness)) }
}

/// The same body with its value divided by its Lipschitz constant (Hart 1996): what was EMB_SIGN_ONLY becomes a lower
/// bound of the distance. O(1), shares g. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_UNSUPPORTED (no constant is known).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_lower_bound(g: *const emb_geom, out_geom: *mut *mut emb_geom) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.lower_bound()) }
}

/// The body blurred: the mean of 27 values at 0 and +-h along each axis, where one that is displaced along n axes
/// weighs alpha^(3-n) ((1-alpha)/2)^n. Never exact. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (h not finite and
/// > 0, alpha not between 0 and 1). Cost: O(1) here, 27 values for one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_blur(
    g: *const emb_geom,
    h: f64,
    alpha: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.blur(h, alpha)) }
}

/// The body mollified: the mean of the values at samples^3 points evenly in [-d, d] along each axis, with binomial
/// weights. Never exact. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (d not finite and > 0, samples not between 1
/// and 32), EMB_ERROR_MEMORY. Cost: samples^3 here, as many values for one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_mollify(
    g: *const emb_geom,
    d: f64,
    samples: i32,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.mollify(d, samples)) }
}

/// The body cut at the coordinate planes and pulled apart by +-extent along each axis: the value at p - clamp(p,
/// -extent, extent). O(1), shares g. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, an extent not >= 0).
/// cbindgen:ptrs-as-arrays=[[extent;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_elongate(
    g: *const emb_geom,
    extent: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.elongate(numbers("extent", extent)?)) }
}

/// The body twisted about the z axis by `degrees` a unit of height, right-handed. A twist stretches the more the
/// further out: of a body within bounds the value is divided by the most by which they are stretched, and beyond them is
/// at least the distance to them, so that it is a lower bound of the distance where g's value is 1-Lipschitz; of others
/// EMB_SIGN_ONLY, and the value g's own. O(1), shares g.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_twist(g: *const emb_geom, degrees: f64, out_geom: *mut *mut emb_geom) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || lend("g", g)?.twist(degrees)) }
}

/// The section of the body by a plane, as a body of the plane of x and y that is the same at every z: the value at (x,
/// y) is that at origin + x u + y v, where u and v are made unit vectors at a right angle from u_axis and v_axis. O(1),
/// shares g. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, an axis zero, axes parallel).
/// cbindgen:ptrs-as-arrays=[[origin;3], [u_axis;3], [v_axis;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_slice(
    g: *const emb_geom,
    origin: *const f64,
    u_axis: *const f64,
    v_axis: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe {
        construct(out_geom, || {
            lend("g", g)?.slice(numbers("origin", origin)?, numbers("u_axis", u_axis)?, numbers("v_axis", v_axis)?)
        })
    }
}
