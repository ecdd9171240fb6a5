// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which faces of a mesh are in a place.

use super::arrays::numbers;
use super::error::{emb_status, guard};
use super::geometry::emb_geom;
use super::handle::lend;
use super::lists::give_list;
use crate::math::{Aabb, Vec3};
use crate::query;

/// The input faces of a mesh, ascending, that have a point in common with the closed box from lo to hi: exactly,
/// touching included. Infinite corners are legal, and lo = hi. A face that is cut into triangles is told of once,
/// of faces that repeat each other the lowest, and one that the mesh left out for its lack of corners never.
/// g is one mesh, or one that is moved, placed, scaled, labelled or complemented; where it is moved, its corners
/// are where that brings them, rounded once a step. Refused: a union, an intersection or a difference of more than
/// one mesh, whose faces have the same numbers, and everything in which there is something else than a mesh, or
/// that changes its shape.
/// Coordinates and their products must be within 1e-90 and 1e90 for exactness.
/// capacity 0: only out_count is written; else out_faces holds `capacity` elements, at least as many as there are
/// faces.
/// Cost: grows with the faces near the box; of a mesh that is turned, with those near the turned box. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (NaN, lo > hi, a capacity too small),
/// EMB_ERROR_UNSUPPORTED (not one mesh), EMB_ERROR_MEMORY.
/// cbindgen:ptrs-as-arrays=[[lo;3], [hi;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_overlapping(
    g: *const emb_geom,
    lo: *const f64,
    hi: *const f64,
    capacity: usize,
    out_faces: *mut i64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let (lo, hi) = (numbers::<3>("lo", lo)?, numbers::<3>("hi", hi)?);
        let faces = query::faces_overlapping(g, Aabb::new(Vec3::from(lo), Vec3::from(hi)))?;
        give_list("out_faces", &faces, capacity, out_faces, out_count)
    })
}

/// The input faces of a mesh, ascending, whose distance from a point is at most `radius` (>= 0, INFINITY: all): the
/// distance to each face as emb_geom_closest computes it, so that the face it names is among them where radius is
/// the magnitude of its value. g, what is refused, capacity, out_faces, out_count, cost and threads as for
/// emb_geom_overlapping.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (a point that is not finite, a radius that is NaN or
/// negative, a capacity too small), EMB_ERROR_UNSUPPORTED (not one mesh), EMB_ERROR_MEMORY.
/// cbindgen:ptrs-as-arrays=[[point;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_geom_within(
    g: *const emb_geom,
    point: *const f64,
    radius: f64,
    capacity: usize,
    out_faces: *mut i64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let g = lend("g", g)?;
        let faces = query::faces_within(g, Vec3::from(numbers::<3>("point", point)?), radius)?;
        give_list("out_faces", &faces, capacity, out_faces, out_count)
    })
}
