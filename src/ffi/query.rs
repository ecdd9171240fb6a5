// SPDX-License-Identifier: MIT OR Apache-2.0
//! The questions.

use super::arrays::{elements, numbers, points, slice};
use super::constants::{EMB_FILL_BAND, EMB_FILL_EXACT, EMB_FILL_SIGN};
use super::error::{emb_status, guard, quiet, quiet_alone};
use super::geometry::emb_geom;
use super::handle::{lend, peek};
use super::results::{ClosestWriter, CrossingsWriter, HitWriter, emb_closest_out, emb_crossings_out, emb_hit_out};
use super::run::{emb_run, with_run};
use super::versioned;
use super::writer::{Integers, Numbers, Reals, Writer, emb_array, emb_lattice, lattice};
use crate::error::{Error, Result};
use crate::geometry::Geometry;
use crate::math::{Aabb, Vec3, f32_same_sign};
use crate::query::{self, FillMode};
use std::ffi::c_void;

/// A question about one point or box, which cannot fail: `fallback` for NULL. It must cost little, so the
/// caller's environment is kept only for those who need it.
///
/// # Safety
/// `g` is NULL or a handle.
unsafe fn ask<R: Copy>(g: *const emb_geom, fallback: R, question: impl FnOnce(&Geometry) -> R) -> R {
    // SAFETY: the caller's promise.
    match unsafe { peek(g) } {
        None => fallback,
        Some(g) if g.has_functions() => quiet(fallback, || question(g)),
        Some(g) => quiet_alone(fallback, || question(g)),
    }
}

/// The value at a point, in units of length where the geometry is exact. It cannot fail: NaN for a coordinate
/// that is not finite, for NULL and where a user's function failed; never -0. The thread's last message stays as it
/// is. Any thread, unless the geometry has a user's function that is not thread-safe in it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_value(g: *const emb_geom, x: f64, y: f64, z: f64) -> f64 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(g, f64::NAN, |g| g.value(Vec3::new(x, y, z))) }
}

/// emb_geom_value as a float that keeps the sign: a nonzero value has a magnitude within [FLT_MIN, FLT_MAX].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_value_f32(g: *const emb_geom, x: f32, y: f32, z: f32) -> f32 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(g, f32::NAN, |g| f32_same_sign(g.value(Vec3::new(x.into(), y.into(), z.into())))) }
}

/// emb_geom_value as an emb_value_fn, for solvers that take (function, user): `geom` is a const emb_geom *.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_value_fn(geom: *mut c_void, x: f64, y: f64, z: f64) -> f64 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { emb_geom_value(geom.cast_const().cast(), x, y, z) }
}

/// The values at `count` points, in the order given: out_values[i] has the bits of emb_geom_value(g, x[i*stride],
/// y[i*stride], z[i*stride]). Three arrays with stride 1, or p, p+1, p+2 with stride 3. Arrays may be NULL where
/// count is 0; out_values must not overlap the others.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (stride 0, more than memory can hold),
/// EMB_ERROR_CALLBACK, EMB_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_values(
    g: *const emb_geom,
    count: usize,
    x: *const f64,
    y: *const f64,
    z: *const f64,
    stride: usize,
    run: *const emb_run,
    out_values: *mut f64,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let points = points(count, [x, y, z], stride)?;
        let out = Writer::required("out_values", out_values, count)?;
        with_run(run, |run| {
            query::values(g, &points, run, &|start, values| out.put([start, 0, 0], values.iter().copied()))
        })
    })
}

/// emb_geom_values from float points to float values, which keep their sign as in emb_geom_value_f32.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_values_f32(
    g: *const emb_geom,
    count: usize,
    x: *const f32,
    y: *const f32,
    z: *const f32,
    stride: usize,
    run: *const emb_run,
    out_values: *mut f32,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let points = points(count, [x, y, z], stride)?;
        let out = Writer::required("out_values", out_values, count)?;
        with_run(run, |run| {
            query::values(g, &points, run, &|start, values| {
                out.put([start, 0, 0], values.iter().map(|v| f32_same_sign(*v)));
            })
        })
    })
}

/// The closest point of the surface to each of `count` points, given as in emb_geom_values, with what is known
/// there. Where nothing is nearer than max_distance (INFINITY: no limit) the value is +-max_distance, ids are -1 and
/// vectors NaN. On a mesh ties go to the lowest face, so every accelerator and instruction set gives the same answer.
/// Of an EMB_SIGN_ONLY geometry the value is no distance: neither is max_distance, and the part is that of the least value.
/// Gradients are analytic but for functions that know none; their direction is the unit normal, and their length is 1
/// where the geometry is exact. Of a union or intersection part, tag, face and point are those of the part whose value
/// it is, and the point may lie within another; of bodies that are blended, bent, blurred, sampled or an
/// expression, and of what is not EMB_EXACT but for set operations on what is, the closest point is NaN.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (max_distance NaN or not > 0),
/// EMB_ERROR_CALLBACK, EMB_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_closest(
    g: *const emb_geom,
    count: usize,
    x: *const f64,
    y: *const f64,
    z: *const f64,
    stride: usize,
    max_distance: f64,
    run: *const emb_run,
    out: *const emb_closest_out,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let points = points(count, [x, y, z], stride)?;
        let out = ClosestWriter::new(out, count)?;
        with_run(run, |run| query::closest(g, &points, max_distance, run, &|start, results| out.put(start, results)))
    })
}

/// The values at the points of a lattice, written to an array of the caller's layout. `mode`:
/// EMB_FILL_EXACT: the value; EMB_FILL_BAND: the value where its magnitude is below `band` (finite, > 0), exactly
/// +-band elsewhere, so that the bits do not depend on how a domain was cut into boxes; EMB_FILL_SIGN: -1, 0, +1.
/// `band` is ignored in the other modes. Arrays of integers take signs only.
/// Cost: on a mesh, signs are a scan of its triangles over the lattice, and a narrow band costs little more: a nanosecond
/// or so a point and some tens of them a triangle near the lattice. What lies on the surface to within rounding is
/// asked point by point. Of other geometries without user functions, signs are asked for near the surface alone, as
/// emb_geom_classify_box tells.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT, EMB_ERROR_UNSUPPORTED (EXACT or BAND of an
/// EMB_SIGN_ONLY geometry), EMB_ERROR_CALLBACK, EMB_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_fill(
    g: *const emb_geom,
    lattice: *const emb_lattice,
    mode: i32,
    band: f64,
    run: *const emb_run,
    out: *const emb_array,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let lattice = self::lattice(lattice)?;
        let mode = fill_mode(mode, band)?;
        let out = Numbers::over("out", &versioned::read("out", out)?, lattice.n())?;
        if mode != FillMode::Sign && matches!(out, Numbers::Integers(_)) {
            return Err(Error::invalid("out.type: an array of integers takes EMB_FILL_SIGN only"));
        }
        with_run(run, |run| match mode {
            FillMode::Sign => query::fill_signs(g, &lattice, run, &|at, signs| put_signs(&out, at, signs)),
            _ => query::fill(g, &lattice, mode, run, &|at, values| put_values(&out, at, values)),
        })
    })
}

fn fill_mode(mode: i32, band: f64) -> Result<FillMode> {
    match mode {
        EMB_FILL_EXACT => Ok(FillMode::Exact),
        EMB_FILL_BAND if band.is_finite() && band > 0.0 => Ok(FillMode::Band(band)),
        EMB_FILL_BAND => Err(Error::invalid(format!("band: {band} is not finite and > 0"))),
        EMB_FILL_SIGN => Ok(FillMode::Sign),
        other => Err(Error::invalid(format!("mode: {other} is not an EMB_FILL_*"))),
    }
}

fn put_signs(out: &Numbers, at: [usize; 3], signs: &[i8]) {
    match out {
        Numbers::Reals(Reals::F64(writer)) => writer.put(at, signs.iter().map(|s| f64::from(*s))),
        Numbers::Reals(Reals::F32(writer)) => writer.put(at, signs.iter().map(|s| f32::from(*s))),
        Numbers::Integers(Integers::I32(writer)) => writer.put(at, signs.iter().map(|s| i32::from(*s))),
        Numbers::Integers(Integers::I8(writer)) => writer.put_copy(at, signs),
    }
}

/// Integers hold signs alone.
fn put_values(out: &Numbers, at: [usize; 3], values: &[f64]) {
    let values = values.iter();
    match out {
        Numbers::Reals(Reals::F64(writer)) => writer.put(at, values.copied()),
        Numbers::Reals(Reals::F32(writer)) => writer.put(at, values.map(|v| f32_same_sign(*v))),
        Numbers::Integers(_) => {}
    }
}

/// Where the surface crosses the edges of a lattice along `axis` (0, 1, 2): edge (i, j, k) joins the point (i, j, k) to
/// its neighbour along the axis, so there are n[axis] - 1 of them along it. An edge is crossed where one end is inside
/// (value <= 0) and the other outside; the crossing is then the zero end itself where one is zero, and of several the one
/// nearest the outside end. The bits are those of emb_geom_intercepts on the same ends, in either order.
/// Cost: on a mesh, a scan of its triangles over the lattice and some hundred nanoseconds a crossing; edges that the
/// surface does not meet cost what writing them does, which EMB_ELSEWHERE_LEAVE saves. Of other geometries without
/// user functions, the edges near the surface alone are asked for.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT, EMB_ERROR_CALLBACK, EMB_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_crossings(
    g: *const emb_geom,
    lattice: *const emb_lattice,
    axis: i32,
    run: *const emb_run,
    out: *const emb_crossings_out,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let lattice = self::lattice(lattice)?;
        if !(0..=2).contains(&axis) {
            return Err(Error::invalid(format!("axis: {axis} is not 0, 1 or 2")));
        }
        let axis = axis as usize;
        let mut edges = lattice.n();
        edges[axis] = edges[axis].saturating_sub(1);
        let out = CrossingsWriter::new(out, edges)?;
        with_run(run, |run| query::crossings(g, &lattice, axis, out.form, run, &|at, n, found| out.put(at, n, found)))
    })
}

/// Where the surface crosses `count` segments from a[3i..3i+2] to b[3i..3i+2], 3 * count coordinates each. Ends on
/// opposite sides: t is the crossing, the zero end itself where one is zero, and of several the one nearest the outside
/// end. Ends on one side: NaN, while the count still says how often the surface was met. A ray first; bracketed bisection
/// on the value where a broken mesh disagrees with itself. Swapping a and b gives the same point. Arrays may be NULL where
/// count is 0. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT, EMB_ERROR_CALLBACK, EMB_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_intercepts(
    g: *const emb_geom,
    count: usize,
    a: *const f64,
    b: *const f64,
    run: *const emb_run,
    out: *const emb_hit_out,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let length = elements::<f64>("count", count, 3)?;
        let (a, b) = (slice("a", a, length)?, slice("b", b, length)?);
        let out = HitWriter::new(out, count)?;
        with_run(run, |run| query::intercepts(g, a, b, run, &|start, results| out.put(start, results)))
    })
}

/// Which side of the surface a closed box lies on: -1: the value is negative at every double of it, +1: positive at every
/// one, rounding included; 0: mixed, or not known, or NULL, NaN or lo > hi. lo = hi is legal. Never wrong, so a solver may
/// skip what it calls uniform. Of a mesh every box is told apart that no triangle comes near, of balls, boxes and planes
/// every one; of other shapes and of composites 0 includes boxes merely near the surface (nearer than half their
/// diagonal), the more the longer and thinner they are. The thread's last message stays as it is. Any thread.
/// cbindgen:ptrs-as-arrays=[[lo;3], [hi;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_classify_box(g: *const emb_geom, lo: *const f64, hi: *const f64) -> i32 {
    // SAFETY: pointers as the header asks.
    let corners = || unsafe { Ok::<_, Error>((numbers::<3>("lo", lo)?, numbers::<3>("hi", hi)?)) };
    let Ok((lo, hi)) = corners() else {
        return 0;
    };
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(g, 0, |g| query::classify_box(g, Aabb::new(Vec3::from(lo), Vec3::from(hi)))) }
}

/// emb_geom_classify_box of `count` boxes [lo[3i..3i+2], hi[3i..3i+2]]. Arrays may be NULL where count is 0.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (NaN or lo > hi, naming the box), EMB_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_classify_boxes(
    g: *const emb_geom,
    count: usize,
    lo: *const f64,
    hi: *const f64,
    run: *const emb_run,
    out_class: *mut i32,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let length = elements::<f64>("count", count, 3)?;
        let (lo, hi) = (slice("lo", lo, length)?, slice("hi", hi, length)?);
        let out = Writer::required("out_class", out_class, count)?;
        with_run(run, |run| {
            query::classify_boxes(g, lo, hi, run, &|start, classes| out.put([start, 0, 0], classes.iter().copied()))
        })
    })
}
