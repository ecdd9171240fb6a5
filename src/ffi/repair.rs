// SPDX-License-Identifier: MIT OR Apache-2.0
//! Repair of meshes.

use super::constants::{
    EMB_FILL_TAG_AROUND, EMB_FILL_TAG_GIVEN, EMB_REPAIR_ALL, EMB_REPAIR_DEGENERATE, EMB_REPAIR_DUPLICATES,
    EMB_REPAIR_HOLES, EMB_REPAIR_ORIENT, EMB_REPAIR_SPLIT, EMB_REPAIR_WELD,
};
use super::error::{emb_status, guard};
use super::handle::{give, lend, writable};
use super::mesh::emb_mesh;
use super::run::{emb_run, with_run};
use super::versioned::{self, Versioned};
use crate::error::{Error, Result};
use crate::mesh::{RepairOptions, Repairs};
use std::mem::{offset_of, size_of};

/// What to repair; fill it with emb_repair_options_init.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_repair_options {
    /// sizeof(emb_repair_options)
    pub struct_size: usize,
    /// EMB_REPAIR_* flags, EMB_REPAIR_ALL by default.
    pub flags: i32,
    /// EMB_FILL_TAG_AROUND, the default, or EMB_FILL_TAG_GIVEN.
    pub fill_tag_rule: i32,
    /// The tag of triangles that fill holes, under EMB_FILL_TAG_GIVEN.
    pub fill_tag: i32,
    /// EMB_REPAIR_WELD: vertices nearer than this times the diagonal become one; 0, the default: those with equal
    /// positions; otherwise between 1e-12 and 0.5.
    pub weld_tolerance: f64,
    /// EMB_REPAIR_HOLES: holes with more edges stay; 1,000 by default, 2,048 at most. Filling one takes the cube of
    /// their number: 1,000 edges take 1.5 seconds, 2,000 take 13.
    pub hole_edges: usize,
    /// EMB_REPAIR_HOLES: holes of more than three edges (three are a missing triangle) stay where their rim is longer
    /// than this times the diagonal of the box around the faces that edges connect with it. 0.5 by default, the rim of
    /// a round hole of 0.16 diagonals across: what a scanner did not see, and not the open end of a pipe or a box
    /// without a lid. The rim of a flat sheet is at least 2.
    pub hole_length: f64,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_repair_options {
    const FIRST_SIZE: usize = offset_of!(emb_repair_options, hole_length) + size_of::<f64>();
    const DEFAULT: emb_repair_options = emb_repair_options {
        struct_size: size_of::<emb_repair_options>(),
        flags: EMB_REPAIR_ALL,
        fill_tag_rule: EMB_FILL_TAG_AROUND,
        fill_tag: 0,
        weld_tolerance: 0.0,
        hole_edges: 1000,
        hole_length: 0.5,
    };
}

/// What a repair did.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_repair_result {
    /// sizeof(emb_repair_result), set by the caller
    pub struct_size: usize,
    /// Vertices that are gone after welding.
    pub vertices_welded: u64,
    /// Faces that welding left fewer than three corners.
    pub faces_collapsed: u64,
    /// Faces of zero area that left.
    pub degenerate_faces: u64,
    /// Corners that the neighbours of these took over.
    pub corners_added: u64,
    /// Faces that repeated an earlier one and left.
    pub duplicate_faces: u64,
    /// Vertices added for fans of faces that met in one.
    pub vertices_split: u64,
    /// Faces turned over.
    pub faces_turned: u64,
    /// Components turned over as a whole.
    pub components_turned: u64,
    /// Holes filled.
    pub holes_filled: u64,
    /// Holes left: of too many edges or too long, not to be filled without edges of more than two faces, or not closed
    /// because more than two faces meet on the way.
    pub holes_left: u64,
    /// Triangles that fill holes.
    pub faces_added: u64,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_repair_result {
    const FIRST_SIZE: usize = offset_of!(emb_repair_result, faces_added) + size_of::<u64>();
    const DEFAULT: emb_repair_result = emb_repair_result {
        struct_size: size_of::<emb_repair_result>(),
        vertices_welded: 0,
        faces_collapsed: 0,
        degenerate_faces: 0,
        corners_added: 0,
        duplicate_faces: 0,
        vertices_split: 0,
        faces_turned: 0,
        components_turned: 0,
        holes_filled: 0,
        holes_left: 0,
        faces_added: 0,
    };
}

/// Fills options with defaults. `size` is sizeof *options, as the caller knows it; nothing is written beyond.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_repair_options_init(options: *mut emb_repair_options, size: usize) -> emb_status {
    // SAFETY: the size is what the caller says, as the header asks.
    guard(|| unsafe { versioned::init("options", options, size) })
}

/// Makes a repaired mesh; `mesh` stays as it is. The steps asked for (options NULL: all) are taken in this order; what is
/// not asked for is not done.
/// - EMB_REPAIR_WELD: vertices with equal positions, or nearer than the tolerance, become one. Faces that keep fewer than
///   three different corners leave.
/// - EMB_REPAIR_DEGENERATE: faces of exactly zero area leave; edges of their neighbours are cut at their corners, so
///   that no crack stays.
/// - EMB_REPAIR_DUPLICATES: of faces that repeat an earlier one, whichever way they run, the earliest stays, but for the
///   wall between two bodies in contact, given by each of them.
/// - EMB_REPAIR_HOLES: holes are filled by the triangulation of least area over their rims (Barequet & Sharir 1995, Liepa
///   2003), which avoids slivers and never gives an edge more than two faces. Rims that pass a vertex twice are cut
///   apart there. Cracks without area, where a vertex of one side lies within an edge of the other, close by
///   EMB_REPAIR_DEGENERATE then: the edge is cut at the vertex.
/// - EMB_REPAIR_SPLIT: a vertex where several fans of faces meet becomes as many at the same position (Gueziec et al.
///   2001); bodies that share no more than an edge come apart, sheets that would be open without each other stay
///   together, and so do bodies that share a wall.
/// - EMB_REPAIR_ORIENT: faces are turned over until neighbours agree, as the larger part of the area has it; closed
///   shells face outward, those directly inside them inward, and so on in turn. Open shells only become consistent.
///
/// What reads positions welds split vertices again: emb_mesh_read of a file that the mesh was written to (weld_tolerance
/// -1 keeps them, but not in STL), and emb_mesh_join and emb_mesh_transform where a weld_tolerance above 0 asks for it.
///
/// Faces keep their numbers, tags and data, so emb_geom_closest still names faces of the input; triangles that fill holes
/// take numbers from emb_mesh_face_count(mesh) on, data of vertices from the rim, and as data of faces NaN, or 0 where its
/// type is an integer. Where nothing is to be done, the mesh has the same bits. *result, whose struct_size the caller has
/// set, tells what was done; it may be NULL. On success *out_mesh is the caller's, to be freed with emb_mesh_free. The
/// calling thread tells `run` how far it is, and it alone works. Cost: near linear, and the cube of the edges of each
/// hole filled. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (options, struct sizes; more faces, corners or vertices
/// than 32 bits count), EMB_ERROR_TOPOLOGY (no face has an area), EMB_ERROR_MEMORY, EMB_ERROR_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_repair(
    mesh: *const emb_mesh,
    options: *const emb_repair_options,
    run: *const emb_run,
    result: *mut emb_repair_result,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let options = self::options(&versioned::read_or_default("options", options)?)?;
        let size = if result.is_null() { None } else { Some(versioned::result_size("result", result)?) };
        writable("out_mesh", out_mesh)?;
        with_run(run, |run| {
            let (repaired, done) = mesh.repaired_with(&options, run)?;
            if let Some(size) = size {
                versioned::write_result(result, size, told(&done));
            }
            give(out_mesh, repaired);
            Ok(())
        })
    })
}

fn options(given: &emb_repair_options) -> Result<RepairOptions> {
    let flags = given.flags;
    if flags & !EMB_REPAIR_ALL != 0 {
        return Err(Error::invalid(format!("options.flags: {flags} has bits that are no EMB_REPAIR_*")));
    }
    let fill_tag = match given.fill_tag_rule {
        EMB_FILL_TAG_AROUND => None,
        EMB_FILL_TAG_GIVEN => Some(given.fill_tag),
        other => return Err(Error::invalid(format!("options.fill_tag_rule: {other} is not an EMB_FILL_TAG_*"))),
    };
    Ok(RepairOptions {
        weld: flags & EMB_REPAIR_WELD != 0,
        degenerate: flags & EMB_REPAIR_DEGENERATE != 0,
        duplicates: flags & EMB_REPAIR_DUPLICATES != 0,
        split: flags & EMB_REPAIR_SPLIT != 0,
        orient: flags & EMB_REPAIR_ORIENT != 0,
        holes: flags & EMB_REPAIR_HOLES != 0,
        weld_tolerance: given.weld_tolerance,
        hole_edges: given.hole_edges,
        hole_length: given.hole_length,
        fill_tag,
    })
}

fn told(done: &Repairs) -> emb_repair_result {
    emb_repair_result {
        struct_size: size_of::<emb_repair_result>(),
        vertices_welded: done.vertices_welded as u64,
        faces_collapsed: done.faces_collapsed as u64,
        degenerate_faces: done.degenerate_faces as u64,
        corners_added: done.corners_added as u64,
        duplicate_faces: done.duplicate_faces as u64,
        vertices_split: done.vertices_split as u64,
        faces_turned: done.faces_turned as u64,
        components_turned: done.components_turned as u64,
        holes_filled: done.holes_filled as u64,
        holes_left: done.holes_left as u64,
        faces_added: done.faces_added as u64,
    }
}
