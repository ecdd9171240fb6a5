// SPDX-License-Identifier: MIT OR Apache-2.0
//! The half-edges of a mesh, and what there is to measure of its faces, edges and vertices.

use super::arrays::numbers;
use super::constants::{EMB_ELEMENT_EDGE, EMB_ELEMENT_FACE, EMB_ELEMENT_VERTEX, EMB_NO_INDEX};
use super::error::{emb_status, guard, plain};
use super::handle::{lend, peek, writable};
use super::lists::{portion, put_portion};
use super::mesh::emb_mesh;
use super::versioned::{self, Versioned};
use super::writer::Writer;
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::mesh::{Element, HalfEdges, Mesh};
use std::mem::{offset_of, size_of};

/// What there is to measure of one face, edge or vertex of a mesh as it stands.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_mesh_measure {
    /// sizeof(emb_mesh_measure), set by the caller
    pub struct_size: usize,
    /// Unit normal: of a face that of its area vector, of an edge and a vertex the pseudonormal (Baerentzen & Aanaes
    /// 2005: the sum of the normals at it, at a vertex weighted by the angle); zero where there is none.
    pub normal: [f64; 3],
    /// Centroid of a face by area, middle of an edge, position of a vertex.
    pub centroid: [f64; 3],
    /// Area of a face, length of an edge, 0 for a vertex.
    pub size: f64,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_mesh_measure {
    const FIRST_SIZE: usize = offset_of!(emb_mesh_measure, size) + size_of::<f64>();
    const DEFAULT: emb_mesh_measure = emb_mesh_measure {
        struct_size: size_of::<emb_mesh_measure>(),
        normal: [0.0; 3],
        centroid: [0.0; 3],
        size: 0.0,
    };
}

/// A question about the topology that cannot fail: `fallback` for NULL and for numbers out of range.
///
/// # Safety
/// `mesh` is NULL or a handle.
unsafe fn ask<R: Copy>(mesh: *const emb_mesh, fallback: R, question: impl FnOnce(&Mesh) -> Option<R>) -> R {
    // SAFETY: the caller's promise.
    let answer = plain(None, || unsafe { peek(mesh) }.and_then(question));
    answer.unwrap_or(fallback)
}

/// The half-edge, where there is one of this number.
fn half_edge(mesh: &Mesh, h: u32) -> Option<&HalfEdges> {
    let topology = mesh.half_edges();
    ((h as usize) < topology.count()).then_some(topology)
}

/// Vertices of the mesh as it stands, after welding; 0 for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_vertex_count(mesh: *const emb_mesh) -> usize {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, 0, |m| Some(m.vertices().len())) }
}

/// Faces of the input: their numbers are below it, those of faces that welding left fewer than three corners
/// included. 0 for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_face_count(mesh: *const emb_mesh) -> usize {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, 0, |m| Some(m.face_count())) }
}

/// Triangles that the faces as they stand are cut into; 0 for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_triangle_count(mesh: *const emb_mesh) -> usize {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, 0, |m| Some(m.triangle_count())) }
}

/// 1: the mesh as it stands has an inside without a doubt: each of its edges has as many faces one way as the other, so its
/// winding number is a whole one everywhere. 0: it is open or disagrees with itself, and for NULL; emb_geom_from_mesh
/// gives it a sign where its holes are small, or where it is told how. O(1): known since the mesh was made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_has_inside(mesh: *const emb_mesh) -> i32 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, 0, |m| Some(i32::from(m.surface().unbalanced_edges == 0))) }
}

/// 1: orientation turned the input face over when the mesh was made. Its corners then stand the other way round in
/// emb_mesh_triangles and the half-edges, corners 1 and 2 of a triangle exchanged; what emb_geom_closest says of corners
/// (barycentric, feature) is of those given. 0: it did not, the face has no triangle left, or is beyond the last,
/// and for NULL. O(log n). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_face_is_turned(mesh: *const emb_mesh, face: i64) -> i32 {
    let is_turned = |m: &Mesh| {
        let triangles = m.triangles();
        let first = triangles.partition_point(|t| i64::from(t.face) < face);
        triangles.get(first).is_some_and(|t| i64::from(t.face) == face && t.turned)
    };
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, 0, |m| Some(i32::from(is_turned(m)))) }
}

/// Half-edges: corners of all faces as they stand; 0 for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_half_edge_count(mesh: *const emb_mesh) -> usize {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, 0, |m| Some(m.half_edges().count())) }
}

/// Copies the positions of the vertices first .. first + count - 1 to out_xyz (3 * count numbers). Vertices are
/// ordered by the lowest input vertex that each was welded from; those that no face uses are left out. So with
/// emb_mesh_options.weld_tolerance -1 and every vertex used, vertex v is vertex v of the arrays given.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (beyond the last vertex). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_vertices(
    mesh: *const emb_mesh,
    first: usize,
    count: usize,
    out_xyz: *mut f64,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let positions = &mesh.vertices()[portion("vertices", first, count, mesh.vertices().len())?];
        let out = Writer::required("out_xyz", out_xyz, 3 * count)?;
        out.put([0; 3], (0..3 * count).map(|i| positions[i / 3][i % 3]));
        Ok(())
    })
}

/// Copies the triangles first .. first + count - 1: out_vertices takes 3 * count vertices, counter-clockwise seen from
/// outside (not as given where emb_mesh_face_is_turned), out_faces the input face of each; either may be NULL.
/// Triangles are ordered by input face, those of one face together. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (beyond the last triangle). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_triangles(
    mesh: *const emb_mesh,
    first: usize,
    count: usize,
    out_vertices: *mut u32,
    out_faces: *mut i64,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let range = portion("triangles", first, count, mesh.triangle_count())?;
        let triangles = &mesh.triangles()[range];
        let vertices = Writer::line("out_vertices", out_vertices, 3 * count, ("stride", 1))?;
        let faces = Writer::line("out_faces", out_faces, count, ("stride", 1))?;
        put_portion(vertices, (0..3 * count).map(|i| triangles[i / 3].vertices[i % 3]));
        put_portion(faces, triangles.iter().map(|t| i64::from(t.face)));
        Ok(())
    })
}

/// Copies the half-edges first .. first + count - 1: the vertex that each leaves, the half-edge that runs the other way
/// along its edge (EMB_NO_INDEX at boundary edges, at edges of more than two faces and where both faces run the same
/// way) and its input face; each array takes `count` numbers or is NULL. The half-edges of a face have consecutive
/// numbers, in its order, counter-clockwise seen from outside.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (beyond the last half-edge). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_half_edges(
    mesh: *const emb_mesh,
    first: usize,
    count: usize,
    out_origin: *mut u32,
    out_twin: *mut u32,
    out_face: *mut i64,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let topology = mesh.half_edges();
        let range = portion("half-edges", first, count, topology.count())?;
        let range = || range.clone().map(|h| h as u32);
        let origin = Writer::line("out_origin", out_origin, count, ("stride", 1))?;
        let twin = Writer::line("out_twin", out_twin, count, ("stride", 1))?;
        let face = Writer::line("out_face", out_face, count, ("stride", 1))?;
        put_portion(origin, range().map(|h| topology.origin(h)));
        put_portion(twin, range().map(|h| topology.twin(h).unwrap_or(EMB_NO_INDEX)));
        put_portion(face, range().map(|h| i64::from(topology.input_face(topology.face(h)))));
        Ok(())
    })
}

/// Corners of an input face as it stands; 0 where the face is gone, for numbers out of range and for NULL. O(1), or
/// O(log n) where faces are gone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_face_corner_count(mesh: *const emb_mesh, face: u64) -> usize {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe {
        ask(mesh, 0, |m| {
            let f = m.half_edges().face_of_input(u32::try_from(face).ok()?)?;
            Some(m.half_edges().around_face(f).len())
        })
    }
}

/// The first half-edge of an input face; the others follow it. EMB_NO_INDEX where the face is gone, for numbers out of
/// range and for NULL. Cost as emb_mesh_face_corner_count.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_face_half_edge(mesh: *const emb_mesh, face: u64) -> u32 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe {
        ask(mesh, EMB_NO_INDEX, |m| {
            let f = m.half_edges().face_of_input(u32::try_from(face).ok()?)?;
            Some(m.half_edges().around_face(f).start)
        })
    }
}

/// Half-edges that leave a vertex: 0 for numbers out of range and for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_vertex_half_edge_count(mesh: *const emb_mesh, vertex: u32) -> usize {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, 0, |m| ((vertex as usize) < m.vertices().len()).then(|| m.half_edges().outgoing(vertex).len())) }
}

/// The k-th half-edge that leaves a vertex, ascending; EMB_NO_INDEX where there is none, and for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_vertex_half_edge(mesh: *const emb_mesh, vertex: u32, k: usize) -> u32 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe {
        ask(mesh, EMB_NO_INDEX, |m| {
            let known = (vertex as usize) < m.vertices().len();
            known.then(|| m.half_edges().outgoing(vertex))?.get(k).copied()
        })
    }
}

/// The vertex that a half-edge leaves; EMB_NO_INDEX for numbers out of range and for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_half_edge_origin(mesh: *const emb_mesh, half_edge: u32) -> u32 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, EMB_NO_INDEX, |m| Some(self::half_edge(m, half_edge)?.origin(half_edge))) }
}

/// The vertex that a half-edge leads to; EMB_NO_INDEX for numbers out of range and for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_half_edge_target(mesh: *const emb_mesh, half_edge: u32) -> u32 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, EMB_NO_INDEX, |m| Some(self::half_edge(m, half_edge)?.target(half_edge))) }
}

/// The next half-edge round the face; EMB_NO_INDEX for numbers out of range and for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_half_edge_next(mesh: *const emb_mesh, half_edge: u32) -> u32 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, EMB_NO_INDEX, |m| Some(self::half_edge(m, half_edge)?.next(half_edge))) }
}

/// The previous half-edge round the face; EMB_NO_INDEX for numbers out of range and for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_half_edge_previous(mesh: *const emb_mesh, half_edge: u32) -> u32 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, EMB_NO_INDEX, |m| Some(self::half_edge(m, half_edge)?.previous(half_edge))) }
}

/// The half-edge that runs the other way along the edge, in the other face; EMB_NO_INDEX at boundary edges, at edges of
/// more than two faces, where both faces run the same way, for numbers out of range and for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_half_edge_twin(mesh: *const emb_mesh, half_edge: u32) -> u32 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { ask(mesh, EMB_NO_INDEX, |m| self::half_edge(m, half_edge)?.twin(half_edge)) }
}

/// The next half-edge that leaves the same vertex, counter-clockwise seen from outside; EMB_NO_INDEX where the fan of
/// faces ends, for numbers out of range and for NULL. Going on until the first half-edge comes round visits one fan; where
/// EMB_NO_INDEX comes first, at a boundary, what lies before the first is reached the other way, by the next half-edge of
/// the face after the twin. Where several meet in a vertex, emb_mesh_vertex_half_edge has them all. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_half_edge_around(mesh: *const emb_mesh, half_edge: u32) -> u32 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe {
        ask(mesh, EMB_NO_INDEX, |m| {
            let topology = self::half_edge(m, half_edge)?;
            topology.twin(topology.previous(half_edge))
        })
    }
}

/// The input face of a half-edge; -1 for numbers out of range and for NULL. O(1).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_half_edge_face(mesh: *const emb_mesh, half_edge: u32) -> i64 {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe {
        ask(mesh, -1, |m| {
            let topology = self::half_edge(m, half_edge)?;
            Some(i64::from(topology.input_face(topology.face(half_edge))))
        })
    }
}

/// Measures an input face (EMB_ELEMENT_FACE), the edge of a half-edge (EMB_ELEMENT_EDGE) or a vertex
/// (EMB_ELEMENT_VERTEX); measure->struct_size is set by the caller. Cost: linear in the faces at it. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (element, or an index that has none: out of range, or a
/// face that is gone).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_measure_get(
    mesh: *const emb_mesh,
    element: i32,
    index: u64,
    measure: *mut emb_mesh_measure,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let element = self::element(mesh, element, index)?;
        let size = versioned::result_size("measure", measure)?;
        let known = mesh.measure(element);
        let result = emb_mesh_measure {
            normal: known.normal.to_array(),
            centroid: known.centroid.to_array(),
            size: known.size,
            ..emb_mesh_measure::DEFAULT
        };
        versioned::write_result(measure, size, result);
        Ok(())
    })
}

/// The signed distance from a point to one input face, to the edge of one half-edge or to one vertex, alone; negative
/// behind its normal (for an edge and a vertex the pseudonormal, from which only the sign comes). out_point, the
/// nearest point of it, may be NULL. Cost: linear in the faces at it. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (element or index as in emb_mesh_measure_get; a
/// coordinate that is not finite).
/// cbindgen:ptrs-as-arrays=[[point;3],[out_point;3]]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_distance(
    mesh: *const emb_mesh,
    element: i32,
    index: u64,
    point: *const f64,
    out_distance: *mut f64,
    out_point: *mut f64,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let element = self::element(mesh, element, index)?;
        let p = Vec3::from_array(numbers("point", point)?);
        if !p.is_finite() {
            return Err(Error::invalid(format!("point: ({}, {}, {}) is not finite", p.x, p.y, p.z)));
        }
        writable("out_distance", out_distance)?;
        let foot = Writer::line("out_point", out_point, 3, ("stride", 1))?;
        let (distance, nearest) = mesh.distance(element, p);
        out_distance.write(distance);
        put_portion(foot, nearest.to_array().into_iter());
        Ok(())
    })
}

/// The element that a caller names.
fn element(mesh: &Mesh, element: i32, index: u64) -> Result<Element> {
    let topology = mesh.half_edges();
    let number = u32::try_from(index).ok();
    let below = |count: usize| number.filter(|n| (*n as usize) < count);
    let (found, what) = match element {
        EMB_ELEMENT_FACE => (number.and_then(|f| topology.face_of_input(f)).map(Element::Face), "face"),
        EMB_ELEMENT_EDGE => (below(topology.count()).map(Element::Edge), "half-edge"),
        EMB_ELEMENT_VERTEX => (below(mesh.vertices().len()).map(Element::Vertex), "vertex"),
        other => return Err(Error::invalid(format!("element: {other} is not an EMB_ELEMENT_*"))),
    };
    found.ok_or_else(|| Error::invalid(format!("index: the mesh as it stands has no {what} {index}")))
}
