// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constructors of the bodies in closed form.

use super::arrays::{elements, numbers, slice};
use super::error::emb_status;
use super::geometry::{construct, emb_geom};
use crate::error::{Error, Result};
use crate::geometry::Geometry;

/// A matrix of nine numbers that may be missing.
///
/// # Safety
/// `data` is NULL or holds nine numbers.
unsafe fn rotation(data: *const f64) -> Result<Option<[f64; 9]>> {
    if data.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise.
    unsafe { numbers("rotation", data) }.map(Some)
}

/// The corners of a polygon.
///
/// # Safety
/// `points` is NULL or holds `2 * count` numbers during `'a`.
unsafe fn corners<'a>(count: usize, points: *const f64) -> Result<&'a [[f64; 2]]> {
    // SAFETY: the caller's promise.
    let numbers = unsafe { slice("points", points, elements::<f64>("count", count, 2)?) }?;
    Ok(numbers.as_chunks().0)
}

/// A count that C gives as a signed number.
fn unsigned(name: &str, count: i32) -> Result<u32> {
    u32::try_from(count).map_err(|_| Error::invalid(format!("{name}: {count} is negative")))
}

/// A ball. Exact. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, or radius not > 0).
/// cbindgen:ptrs-as-arrays=[[center;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_sphere(center: *const f64, radius: f64, out_geom: *mut *mut emb_geom) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || Geometry::sphere(numbers("center", center)?, radius)) }
}

/// The axis-aligned box [lo, hi], lo < hi. Exact, inside too.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT.
/// cbindgen:ptrs-as-arrays=[[lo;3], [hi;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_box(lo: *const f64, hi: *const f64, out_geom: *mut *mut emb_geom) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || Geometry::cuboid(numbers("lo", lo)?, numbers("hi", hi)?)) }
}

/// The half space behind the plane through `point`: `normal` points out of the body and need not have length 1.
/// Exact. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, normal zero). O(1).
/// cbindgen:ptrs-as-arrays=[[point;3], [normal;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_plane(
    point: *const f64,
    normal: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || Geometry::plane(numbers("point", point)?, numbers("normal", normal)?)) }
}

/// A torus: the points within `minor` of the circle of radius `major` around `center`, in the plane across `axis`,
/// which need not have length 1. Exact. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (unless
/// 0 < minor < major; not finite, axis zero). O(1).
/// cbindgen:ptrs-as-arrays=[[center;3], [axis;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_torus(
    center: *const f64,
    axis: *const f64,
    major: f64,
    minor: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || Geometry::torus(numbers("center", center)?, numbers("axis", axis)?, major, minor)) }
}

/// A cylinder with flat ends at `a` and `b`. Exact.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, radius not > 0, a equal to b). O(1).
/// cbindgen:ptrs-as-arrays=[[a;3], [b;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_cylinder(
    a: *const f64,
    b: *const f64,
    radius: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || Geometry::cylinder(numbers("a", a)?, numbers("b", b)?, radius)) }
}

/// A cylinder without ends around the line through `point` along `axis`, which need not have length 1. Exact.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, radius not > 0, axis zero). O(1).
/// cbindgen:ptrs-as-arrays=[[point;3], [axis;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_infinite_cylinder(
    point: *const f64,
    axis: *const f64,
    radius: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe {
        construct(out_geom, || Geometry::infinite_cylinder(numbers("point", point)?, numbers("axis", axis)?, radius))
    }
}

/// A capsule: the points within `radius` of the segment from `a` to `b`. Exact.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, radius not > 0, a equal to b). O(1).
/// cbindgen:ptrs-as-arrays=[[a;3], [b;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_capsule(
    a: *const f64,
    b: *const f64,
    radius: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || Geometry::capsule(numbers("a", a)?, numbers("b", b)?, radius)) }
}

/// A capsule by its outermost points: `tip_a` and `tip_b` lie on the surface. Exact.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, radius not > 0, tips not more than two
/// radii apart). O(1).
/// cbindgen:ptrs-as-arrays=[[tip_a;3], [tip_b;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_capsule_tips(
    tip_a: *const f64,
    tip_b: *const f64,
    radius: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe {
        construct(out_geom, || Geometry::capsule_tips(numbers("tip_a", tip_a)?, numbers("tip_b", tip_b)?, radius))
    }
}

/// A cone without end: opens from `tip` along `axis`, which need not have length 1; `angle` is the full one between
/// opposite sides, in degrees. Exact. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (unless
/// 0 < angle < 180; not finite, axis zero). O(1).
/// cbindgen:ptrs-as-arrays=[[tip;3], [axis;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_infinite_cone(
    tip: *const f64,
    axis: *const f64,
    angle: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || Geometry::infinite_cone(numbers("tip", tip)?, numbers("axis", axis)?, angle)) }
}

/// A cone with a flat base: opens from `tip` along `axis`, which need not have length 1, and ends `height` from the
/// tip; `angle` is the full one between opposite sides, in degrees. Exact. Errors: EMB_ERROR_NULL_ARGUMENT,
/// EMB_ERROR_INVALID_ARGUMENT (unless 0 < angle < 180 and height > 0; not finite, axis zero). O(1).
/// cbindgen:ptrs-as-arrays=[[tip;3], [axis;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_cone(
    tip: *const f64,
    axis: *const f64,
    height: f64,
    angle: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe { construct(out_geom, || Geometry::cone(numbers("tip", tip)?, numbers("axis", axis)?, height, angle)) }
}

/// A box around `center` with its edges and corners rounded by `radius`; `half` are the outer half sizes, the rounding
/// included. `rotation` (row major, a rotation to within 1e-9) turns it around its centre; NULL: sides along the axes.
/// With radius 0 it is a sharp box in any orientation. Exact. Errors: EMB_ERROR_NULL_ARGUMENT,
/// EMB_ERROR_INVALID_ARGUMENT (unless each half size is > 0 and 0 <= radius <= the least of them; not finite, not a
/// rotation). O(1).
/// cbindgen:ptrs-as-arrays=[[center;3], [half;3], [rotation;9]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_rounded_box(
    center: *const f64,
    half: *const f64,
    radius: f64,
    rotation: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe {
        construct(out_geom, || {
            Geometry::rounded_box(numbers("center", center)?, numbers("half", half)?, radius, self::rotation(rotation)?)
        })
    }
}

/// A cylinder around `center` along `axis`, which need not have length 1, with its edges rounded by `rounding`;
/// `radius` and `height` are the outer ones, the rounding included. Exact. Errors: EMB_ERROR_NULL_ARGUMENT,
/// EMB_ERROR_INVALID_ARGUMENT (unless radius and height are > 0 and 0 <= rounding <= the lesser of radius and height/2;
/// not finite, axis zero). O(1).
/// cbindgen:ptrs-as-arrays=[[center;3], [axis;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_rounded_cylinder(
    center: *const f64,
    axis: *const f64,
    radius: f64,
    height: f64,
    rounding: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe {
        construct(out_geom, || {
            Geometry::rounded_cylinder(numbers("center", center)?, numbers("axis", axis)?, radius, height, rounding)
        })
    }
}

/// An ellipsoid around `center`. `rotation` (row major, a rotation to within 1e-9) turns it around its centre; NULL:
/// semi-axes along the axes. Exact, inside too, by a root finder that always ends (Eberly 2013).
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (not finite, a semi-axis not > 0, not a rotation). O(1).
/// cbindgen:ptrs-as-arrays=[[center;3], [semi_axes;3], [rotation;9]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_ellipsoid(
    center: *const f64,
    semi_axes: *const f64,
    rotation: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe {
        construct(out_geom, || {
            Geometry::ellipsoid(numbers("center", center)?, numbers("semi_axes", semi_axes)?, self::rotation(rotation)?)
        })
    }
}

/// A regular prism with flat ends at `a` and `b`: `radius` is that of the circle through its corners, and `toward`
/// points from the axis to the first of them (its part along the axis does not count). Exact.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (unless 3 <= sides <= 1000; not finite, radius not > 0, a
/// equal to b, toward along the axis). Cost: that of a value is linear in the sides.
/// cbindgen:ptrs-as-arrays=[[a;3], [b;3], [toward;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_prism(
    a: *const f64,
    b: *const f64,
    toward: *const f64,
    sides: i32,
    radius: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe {
        construct(out_geom, || {
            Geometry::prism(
                numbers("a", a)?,
                numbers("b", b)?,
                numbers("toward", toward)?,
                unsigned("sides", sides)?,
                radius,
            )
        })
    }
}

/// The closed polygon of `count` corners in the plane, drawn from z_lo to z_hi: a point (u, v, z) of this frame comes
/// to rotation * (u, v, z) + origin (row major, a rotation to within 1e-9; NULL: along the axes). `points` holds
/// 2 * count numbers, u and v of each corner, in either order of rotation. Exact.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (fewer than 3 corners, one that repeats the one before, a
/// polygon that touches or crosses itself, tested exactly; z_hi not above z_lo, not finite, not a rotation),
/// EMB_ERROR_UNSUPPORTED (more than 10000 corners), EMB_ERROR_MEMORY. Cost: that of a value is linear in count.
/// cbindgen:ptrs-as-arrays=[[origin;3], [rotation;9]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_extruded_polygon(
    origin: *const f64,
    rotation: *const f64,
    count: usize,
    points: *const f64,
    z_lo: f64,
    z_hi: f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe {
        construct(out_geom, || {
            let (origin, rotation) = (numbers("origin", origin)?, self::rotation(rotation)?);
            Geometry::extruded_polygon(origin, rotation, corners(count, points)?, z_lo, z_hi)
        })
    }
}

/// A solid of revolution: the closed polygon of `count` corners turned around `axis`, which need not have length 1.
/// `points` holds 2 * count numbers: of each corner its distance from the axis and its place along it from `origin`, in
/// either order of rotation. Edges on the axis are no surface. Exact.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (fewer than 3 corners, one at a negative distance, one that
/// repeats the one before, a polygon that touches or crosses itself, tested exactly; not finite, axis zero),
/// EMB_ERROR_UNSUPPORTED (more than 10000 corners), EMB_ERROR_MEMORY. Cost: that of a value is linear in count.
/// cbindgen:ptrs-as-arrays=[[origin;3], [axis;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_revolved_polygon(
    origin: *const f64,
    axis: *const f64,
    count: usize,
    points: *const f64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe {
        construct(out_geom, || {
            Geometry::revolved_polygon(numbers("origin", origin)?, numbers("axis", axis)?, corners(count, points)?)
        })
    }
}

/// Perlin noise (2002): amplitude times the sum over k < octaves of persistence^k noise(frequency * 2^k * p), the product
/// taken axis by axis. |noise| is mostly below 1 and never above 1.5; it is 0 where all its coordinates are whole and
/// repeats every 256. `seed` shuffles its table. EMB_SIGN_ONLY with a known Lipschitz constant: emb_geom_lower_bound makes a
/// lower bound of the distance of it. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (unless amplitude and
/// persistence are > 0, each frequency is >= 0 and 1 <= octaves <= 16; not finite). Cost: linear in the octaves.
/// cbindgen:ptrs-as-arrays=[[frequency;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_perlin(
    amplitude: f64,
    frequency: *const f64,
    persistence: f64,
    octaves: i32,
    seed: u64,
    out_geom: *mut *mut emb_geom,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    unsafe {
        construct(out_geom, || {
            let (frequency, octaves) = (numbers("frequency", frequency)?, unsigned("octaves", octaves)?);
            Geometry::perlin(amplitude, frequency, persistence, octaves, seed)
        })
    }
}
