// SPDX-License-Identifier: MIT OR Apache-2.0
//! The lists of a diagnosis.

use super::diagnosis::{beyond, emb_diagnosis};
use super::error::{emb_status, guard};
use super::handle::lend;
use super::lists::{give_columns, give_list, put_portion};
use super::writer::Writer;
use crate::error::Result;
use crate::mesh::FaceMeasure;

/// Edges of more than two faces: two vertices each, the lower first, and the number of faces at each.
/// Capacity, errors and cost: see emb_diagnosis.
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
/// Also EMB_ERROR_INVALID_ARGUMENT: index.
/// Capacity, errors and cost: see emb_diagnosis.
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
/// Capacity, errors and cost: see emb_diagnosis.
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
/// Capacity, errors and cost: see emb_diagnosis.
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
/// Capacity, errors and cost: see emb_diagnosis.
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
/// Capacity, errors and cost: see emb_diagnosis.
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
/// Capacity, errors and cost: see emb_diagnosis.
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
/// Capacity, errors and cost: see emb_diagnosis.
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
/// Capacity, errors and cost: see emb_diagnosis.
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
/// Capacity, errors and cost: see emb_diagnosis.
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
/// Capacity, errors and cost: see emb_diagnosis.
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

/// The component of each input face; EMB_NO_INDEX for those that welding left fewer than three corners.
/// Capacity, errors and cost: see emb_diagnosis.
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

/// The vertices of the boundary loop `index`, in order, each once, from the lowest on (of a chain that does not close,
/// from the lower of its ends). It runs the way the faces at it ran when read, where these agree: seen from outside,
/// clockwise round a hole. Also EMB_ERROR_INVALID_ARGUMENT: index.
/// Capacity, errors and cost: see emb_diagnosis.
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
