// SPDX-License-Identifier: MIT OR Apache-2.0
//! Diagnoses of meshes.

use super::diagnosis_structs::{emb_diagnosis_options, emb_diagnosis_summary, emb_mesh_component, emb_mesh_loop};
use super::error::{emb_status, guard, plain};
use super::handle::{Handle, give, lend, release, share, writable};
use super::lists::{give_columns, give_list, give_text, put_portion};
use super::mesh::{describe, emb_mesh, emb_mesh_report};
use super::run::{emb_run, with_run};
use super::versioned;
use super::writer::Writer;
use crate::error::{Error, Result};
use crate::mesh::{Diagnosis, DiagnosisOptions, FaceMeasure};
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
/// Cost: near linear in the faces and the pairs found; about 2 s a million triangles on one thread.
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

/// Edges of more than two faces: two vertices each, the lower first, and the number of faces at each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_nonmanifold_edges(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_vertices: *mut u32,
    out_face_counts: *mut u64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let diagnosis = lend("diagnosis", diagnosis)?;
        let (edges, faces) = (&diagnosis.nonmanifold_edges, &diagnosis.nonmanifold_edge_faces);
        give_columns(edges.len(), capacity, out_count, || {
            let vertices = Writer::line("out_vertices", out_vertices, 2 * edges.len(), ("stride", 1))?;
            let counts = Writer::line("out_face_counts", out_face_counts, edges.len(), ("stride", 1))?;
            put_portion(vertices, (0..2 * edges.len()).map(|i| edges[i / 2][i % 2]));
            put_portion(counts, (0..edges.len()).map(|k| faces.get(k).map_or(0, |list| list.len() as u64)));
            Ok(())
        })
    })
}

/// The faces at the edge `index` of emb_diagnosis_nonmanifold_edges, ascending.
/// Errors besides: EMB_ERROR_INVALID_ARGUMENT (index).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_nonmanifold_edge_faces(
    diagnosis: *const emb_diagnosis,
    index: usize,
    capacity: usize,
    out_faces: *mut i64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let lists = &lend("diagnosis", diagnosis)?.nonmanifold_edge_faces;
        let faces = lists.get(index).ok_or_else(|| beyond(index, lists.len(), "non-manifold edges"))?;
        give_columns(faces.len(), capacity, out_count, || {
            let out = Writer::required("out_faces", out_faces, faces.len())?;
            out.put([0; 3], faces.iter().map(|f| i64::from(*f)));
            Ok(())
        })
    })
}

/// Edges that two faces run along the same way: two vertices and two faces each, the lower first.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_inconsistent_edges(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_vertices: *mut u32,
    out_faces: *mut i64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let edges = &lend("diagnosis", diagnosis)?.inconsistent_edges;
        give_columns(edges.len(), capacity, out_count, || {
            let vertices = Writer::line("out_vertices", out_vertices, 2 * edges.len(), ("stride", 1))?;
            let faces = Writer::line("out_faces", out_faces, 2 * edges.len(), ("stride", 1))?;
            put_portion(vertices, (0..2 * edges.len()).map(|i| edges[i / 2].vertices[i % 2]));
            put_portion(faces, (0..2 * edges.len()).map(|i| i64::from(edges[i / 2].faces[i % 2])));
            Ok(())
        })
    })
}

/// Vertices at which the faces do not form one fan or one disc, and into how many fans and discs they fall: an edge
/// of more than two faces parts them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_nonmanifold_vertices(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_vertices: *mut u32,
    out_fans: *mut u32,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let found = &lend("diagnosis", diagnosis)?.nonmanifold_vertices;
        give_columns(found.len(), capacity, out_count, || {
            let vertices = Writer::line("out_vertices", out_vertices, found.len(), ("stride", 1))?;
            let fans = Writer::line("out_fans", out_fans, found.len(), ("stride", 1))?;
            put_portion(vertices, found.iter().map(|v| v.vertex));
            put_portion(fans, found.iter().map(|v| v.fans));
            Ok(())
        })
    })
}

/// Faces that welding took corners from; those left with fewer than three are gone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_shrunk_faces(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_faces: *mut i64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe { give_faces(&lend("diagnosis", diagnosis)?.shrunk_faces, capacity, out_faces, out_count) })
}

/// Faces of three or more corners and exactly zero area.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_flat_faces(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_faces: *mut i64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe { give_faces(&lend("diagnosis", diagnosis)?.flat_faces, capacity, out_faces, out_count) })
}

/// # Safety
/// Pointers as the header asks.
unsafe fn give_faces(faces: &[u32], capacity: usize, out_faces: *mut i64, out_count: *mut usize) -> Result<()> {
    // SAFETY: the caller's promise.
    unsafe {
        give_columns(faces.len(), capacity, out_count, || {
            let out = Writer::required("out_faces", out_faces, faces.len())?;
            out.put([0; 3], faces.iter().map(|f| i64::from(*f)));
            Ok(())
        })
    }
}

/// Faces that repeat an earlier one, whichever way they run: each with the earliest that it repeats, and with 1 where
/// both run the same way, else 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_duplicates(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_faces: *mut i64,
    out_originals: *mut i64,
    out_same_way: *mut i32,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let found = &lend("diagnosis", diagnosis)?.duplicates;
        give_columns(found.len(), capacity, out_count, || {
            let faces = Writer::line("out_faces", out_faces, found.len(), ("stride", 1))?;
            let originals = Writer::line("out_originals", out_originals, found.len(), ("stride", 1))?;
            let ways = Writer::line("out_same_way", out_same_way, found.len(), ("stride", 1))?;
            put_portion(faces, found.iter().map(|d| i64::from(d.face)));
            put_portion(originals, found.iter().map(|d| i64::from(d.original)));
            put_portion(ways, found.iter().map(|d| i32::from(d.same_way)));
            Ok(())
        })
    })
}

/// Slivers, and for each its smallest height over its longest edge (emb_diagnosis_options.sliver_ratio).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_slivers(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_faces: *mut i64,
    out_ratios: *mut f64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        give_measures(&lend("diagnosis", diagnosis)?.slivers, capacity, out_faces, out_ratios, out_count)
    })
}

/// Faces that emb_mesh_report.warped_faces counts, and by how much each is off a plane, over the diagonal of the box
/// around it: nothing where a plane face crosses itself.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_warped_faces(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_faces: *mut i64,
    out_ratios: *mut f64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        give_measures(&lend("diagnosis", diagnosis)?.warped_faces, capacity, out_faces, out_ratios, out_count)
    })
}

/// Faces whose corners are off a plane by more than emb_diagnosis_options.off_plane_ratio, and by how much, over the
/// diagonal of the box around the face.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_off_plane_faces(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_faces: *mut i64,
    out_ratios: *mut f64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        give_measures(&lend("diagnosis", diagnosis)?.off_plane_faces, capacity, out_faces, out_ratios, out_count)
    })
}

/// # Safety
/// Pointers as the header asks.
unsafe fn give_measures(
    found: &[FaceMeasure],
    capacity: usize,
    out_faces: *mut i64,
    out_ratios: *mut f64,
    out_count: *mut usize,
) -> Result<()> {
    // SAFETY: the caller's promise.
    unsafe {
        give_columns(found.len(), capacity, out_count, || {
            let faces = Writer::line("out_faces", out_faces, found.len(), ("stride", 1))?;
            let ratios = Writer::line("out_ratios", out_ratios, found.len(), ("stride", 1))?;
            put_portion(faces, found.iter().map(|m| i64::from(m.face)));
            put_portion(ratios, found.iter().map(|m| m.ratio));
            Ok(())
        })
    }
}

/// Pairs of faces that intersect, the lower of each first: as many as were listed, none where they were not looked for
/// (emb_diagnosis_options.intersection_limit).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_intersections(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_faces: *mut i64,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let diagnosis = lend("diagnosis", diagnosis)?;
        let pairs = diagnosis.intersections.as_ref().map_or(&[][..], |found| &found.pairs);
        give_columns(pairs.len(), capacity, out_count, || {
            let out = Writer::required("out_faces", out_faces, 2 * pairs.len())?;
            out.put([0; 3], (0..2 * pairs.len()).map(|i| i64::from(pairs[i / 2][i % 2])));
            Ok(())
        })
    })
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

/// The component of each input face; EMB_NO_INDEX for those that welding left fewer than three corners.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_face_components(
    diagnosis: *const emb_diagnosis,
    capacity: usize,
    out_components: *mut u32,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let all = &lend("diagnosis", diagnosis)?.component_of_face;
        give_list("out_components", all, capacity, out_components, out_count)
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

/// The vertices of the boundary loop `index`, in order, each once, from the lowest on (of a chain that does not close,
/// from the lower of its ends). It runs the way the faces at it ran when read, where these agree: seen from outside,
/// clockwise round a hole. Errors besides: EMB_ERROR_INVALID_ARGUMENT (index).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_diagnosis_loop_vertices(
    diagnosis: *const emb_diagnosis,
    index: usize,
    capacity: usize,
    out_vertices: *mut u32,
    out_count: *mut usize,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let lists = &lend("diagnosis", diagnosis)?.loop_vertices;
        let vertices = lists.get(index).ok_or_else(|| beyond(index, lists.len(), "boundary loops"))?;
        give_list("out_vertices", vertices, capacity, out_vertices, out_count)
    })
}

fn beyond(index: usize, count: usize, what: &str) -> Error {
    Error::invalid(format!("index: {index} is not below the {count} {what}"))
}
