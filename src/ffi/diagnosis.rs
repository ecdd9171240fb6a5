// SPDX-License-Identifier: MIT OR Apache-2.0
//! Diagnoses of meshes: how they are made, their counts, components, loops and text. `diagnosis_lists.rs` has the rest.

use super::diagnosis_structs::{emb_diagnosis_options, emb_diagnosis_summary, emb_mesh_component, emb_mesh_loop};
use super::error::{emb_status, guard, plain};
use super::handle::{Handle, give, lend, release, share, writable};
use super::lists::give_text;
use super::mesh::{describe, emb_mesh, emb_mesh_report};
use super::run::{emb_run, with_run};
use super::versioned;
use crate::error::Error;
use crate::mesh::{Diagnosis, DiagnosisOptions};
use crate::query;
use std::ffi::c_char;

/// What is the matter with a mesh as read, fault by fault. Immutable; it does not need the mesh any more.
///
/// Faces are input faces, by their numbers; vertices are numbered as emb_mesh_vertices gives them. Every list is
/// ascending in its first number. Lists are had by two calls: with `capacity` 0 a getter writes the number of items to
/// *out_count alone, else the list too, each array with room for `capacity` items (pairs: 2 * capacity numbers);
/// where there are several arrays, each may be NULL. Their errors: EMB_ERROR_NULL_ARGUMENT,
/// EMB_ERROR_INVALID_ARGUMENT (a capacity below the count). Their cost: a copy. Any thread.
pub struct emb_diagnosis {
    _opaque: (),
}

impl Handle for emb_diagnosis {
    type Target = Diagnosis;
}

/// Fills options with defaults. `size` is sizeof *options, as the caller knows it; nothing is written beyond.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_options_init(options: *mut emb_diagnosis_options, size: usize) -> emb_status {
    // SAFETY: the size is what the caller says, as the header asks.
    guard(|| unsafe { versioned::init("options", options, size) })
}

/// Tells of a mesh as read, after welding, before orientation and repair: all that emb_mesh_report counts, one by one,
/// and the pairs of faces that intersect. Two faces intersect where they meet in more than the vertices and edges that
/// they share, touching included, decided by exact predicates (Shewchuk 1997); copies of one face do not count against
/// each other, nor do faces of zero area. `options` may be NULL. The same bits with any pool.
/// On success *out_diagnosis is the caller's, to be freed with emb_diagnosis_free.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (options), EMB_ERROR_MEMORY, EMB_ERROR_CANCELLED.
/// Cost: near linear in the faces and the pairs found; about 2 s a million triangles on one thread, less with
/// intersection_limit 0. Whether a mesh has an inside emb_mesh_has_inside says at once.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_diagnose(
    mesh: *const emb_mesh,
    options: *const emb_diagnosis_options,
    run: *const emb_run,
    out_diagnosis: *mut *mut emb_diagnosis,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let given = versioned::read_or_default("options", options)?;
        let options = DiagnosisOptions {
            sliver_ratio: given.sliver_ratio,
            off_plane_ratio: given.off_plane_ratio,
            intersection_limit: usize::try_from(given.intersection_limit).unwrap_or(usize::MAX),
        };
        writable("out_diagnosis", out_diagnosis)?;
        with_run(run, |run| {
            give(out_diagnosis, query::diagnose(mesh, &options, run)?);
            Ok(())
        })
    })
}

/// One more reference to the same diagnosis, to be freed like the first; NULL for NULL. O(1). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_clone(diagnosis: *const emb_diagnosis) -> *mut emb_diagnosis {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { share(diagnosis) }
}

/// Gives up a reference. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_free(diagnosis: *mut emb_diagnosis) {
    // SAFETY: a handle or NULL that is not used again, as the header asks.
    plain((), || unsafe { release(diagnosis) });
}

/// The report of the mesh, as emb_mesh_report_get writes it, with self_intersections filled where they were looked for.
/// The caller sets struct_size. O(1). Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (struct_size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_report(
    diagnosis: *const emb_diagnosis,
    report: *mut emb_mesh_report,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let diagnosis = lend("diagnosis", diagnosis)?;
        let size = versioned::result_size("report", report)?;
        let mut known = describe(&diagnosis.report);
        if let Some(found) = &diagnosis.intersections {
            known.self_intersections = found.count;
        }
        versioned::write_result(report, size, known);
        Ok(())
    })
}

/// The counts beyond the report. The caller sets struct_size. O(1). Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (struct_size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_summary_get(
    diagnosis: *const emb_diagnosis,
    summary: *mut emb_diagnosis_summary,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let diagnosis = lend("diagnosis", diagnosis)?;
        let size = versioned::result_size("summary", summary)?;
        versioned::write_result(summary, size, emb_diagnosis_summary::of(diagnosis));
        Ok(())
    })
}

/// The diagnosis as English text for a reader: a fact a line, what is wrong with how many and where the first few are,
/// the first twenty components and boundary loops, and at the end what to do. *out_size is its size, the zero byte at
/// the end counted; with `capacity` 0 that is all, else out_text takes it. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (a capacity below the size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_text(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_text: *mut c_char,
    out_size: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe { give_text("out_text", &lend("diagnosis", diagnosis)?.text(), capacity, out_text, out_size) })
}

/// The component `index`, which is below emb_diagnosis_summary.components; by lowest face. The caller sets struct_size.
/// O(1). Any thread. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (index, struct_size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_component(
    diagnosis: *const emb_diagnosis,
    index: usize,
    component: *mut emb_mesh_component,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let all = &lend("diagnosis", diagnosis)?.components;
        let known = all.get(index).ok_or_else(|| beyond(index, all.len(), "components"))?;
        let size = versioned::result_size("component", component)?;
        versioned::write_result(component, size, emb_mesh_component::of(known));
        Ok(())
    })
}

/// The boundary loop `index`, which is below emb_diagnosis_summary.boundary_loops; by lowest vertex. The caller sets
/// struct_size. O(1). Any thread. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (index, struct_size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_loop(
    diagnosis: *const emb_diagnosis,
    index: usize,
    boundary: *mut emb_mesh_loop,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let all = &lend("diagnosis", diagnosis)?.loops;
        let known = all.get(index).ok_or_else(|| beyond(index, all.len(), "boundary loops"))?;
        let size = versioned::result_size("boundary", boundary)?;
        versioned::write_result(boundary, size, emb_mesh_loop::of(known));
        Ok(())
    })
}

/// An index out of range.
pub(super) fn beyond(index: usize, count: usize, what: &str) -> Error {
    match count {
        0 => Error::invalid(format!("index: {index}: there are no {what}")),
        _ => Error::invalid(format!("index: {index} is not below the {count} {what}")),
    }
}
