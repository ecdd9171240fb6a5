// SPDX-License-Identifier: MIT OR Apache-2.0
//! Boxes and balls around bodies that do not know their own.

use super::arrays::numbers;
use super::constants::{EMB_BOUNDING_FOUND, EMB_BOUNDING_NOTHING, EMB_BOUNDING_REACHES_START};
use super::error::{emb_status, guard};
use super::geometry::emb_geom;
use super::handle::{lend, writable};
use super::run::{emb_run, with_run};
use crate::error::Result;
use crate::math::{Aabb, Vec3};
use crate::query::{self, Bounding};

/// The start box.
///
/// # Safety
/// Each pointer is NULL or holds three numbers.
unsafe fn start(lo: *const f64, hi: *const f64) -> Result<Aabb> {
    // SAFETY: the caller's promise.
    let (lo, hi) = unsafe { (numbers::<3>("start_lo", lo)?, numbers::<3>("start_hi", hi)?) };
    Ok(Aabb::new(Vec3::from(lo), Vec3::from(hi)))
}

/// A box around a body, found by subdividing a start box as an octree: for functions that do not know their bounds
/// (emb_geom_bounds costs nothing where they are known). The start box is halved `depth` times (1 to 16) along each
/// axis; what may hold a part of the body is kept, and the result is widened by `safety` >= 0 widths of the finest
/// cells. *out_state: EMB_BOUNDING_FOUND; EMB_BOUNDING_REACHES_START, the body may reach the border of the start box;
/// EMB_BOUNDING_NOTHING, none of it lies in there; in the last two the box is infinite. Right wherever boxes can be
/// classified. A callback of whose slope nothing is known (no lipschitz, no kind but EMB_SIGN_ONLY), and what is made with
/// it, is taken to be 1-Lipschitz: where it is steeper the answer may be wrong. A body smaller than the finest cells is
/// found as well. Runs on the calling thread; run serves to cancel.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT, EMB_ERROR_CALLBACK, EMB_ERROR_CANCELLED. Cost: some
/// 10 to 1,000 times 2^depth values, for round and slanted bodies: depth 8 takes milliseconds, 16 up to seconds.
/// cbindgen:ptrs-as-arrays=[[start_lo;3], [start_hi;3], [out_lo;3], [out_hi;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_bounding_box(
    g: *const emb_geom,
    start_lo: *const f64,
    start_hi: *const f64,
    depth: i32,
    safety: f64,
    run: *const emb_run,
    out_lo: *mut f64,
    out_hi: *mut f64,
    out_state: *mut i32,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let start = start(start_lo, start_hi)?;
        writable("out_lo", out_lo)?;
        writable("out_hi", out_hi)?;
        writable("out_state", out_state)?;
        with_run(run, |run| {
            let (b, state) = match query::bounding_box(g, start, depth, safety, run)? {
                Bounding::Found(b) => (b, EMB_BOUNDING_FOUND),
                Bounding::ReachesStart => (Aabb::ALL, EMB_BOUNDING_REACHES_START),
                Bounding::Nothing => (Aabb::ALL, EMB_BOUNDING_NOTHING),
            };
            out_lo.cast::<[f64; 3]>().write(b.lo.to_array());
            out_hi.cast::<[f64; 3]>().write(b.hi.to_array());
            out_state.write(state);
            Ok(())
        })
    })
}

/// A ball around a body: about the middle of the box that emb_geom_bounding_box finds, as large as the farthest cell
/// needs, which is less than half the box's diagonal for round bodies. Arguments and errors as there; in the states
/// other than EMB_BOUNDING_FOUND the centre is zero and the radius infinite.
/// cbindgen:ptrs-as-arrays=[[start_lo;3], [start_hi;3], [out_center;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_bounding_sphere(
    g: *const emb_geom,
    start_lo: *const f64,
    start_hi: *const f64,
    depth: i32,
    safety: f64,
    run: *const emb_run,
    out_center: *mut f64,
    out_radius: *mut f64,
    out_state: *mut i32,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let start = start(start_lo, start_hi)?;
        writable("out_center", out_center)?;
        writable("out_radius", out_radius)?;
        writable("out_state", out_state)?;
        with_run(run, |run| {
            let (center, radius, state) = match query::bounding_sphere(g, start, depth, safety, run)? {
                Bounding::Found((center, radius)) => (center, radius, EMB_BOUNDING_FOUND),
                Bounding::ReachesStart => (Vec3::ZERO, f64::INFINITY, EMB_BOUNDING_REACHES_START),
                Bounding::Nothing => (Vec3::ZERO, f64::INFINITY, EMB_BOUNDING_NOTHING),
            };
            out_center.cast::<[f64; 3]>().write(center.to_array());
            out_radius.write(radius);
            out_state.write(state);
            Ok(())
        })
    })
}
