// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes.

use super::arrays::{elements, path, slice};
use super::constants::{
    EMB_FORMAT_DETECT, EMB_FORMAT_OBJ, EMB_FORMAT_PLY, EMB_FORMAT_STL, EMB_FORMAT_VTK, EMB_FORMAT_VTP,
    EMB_ORIENT_ALTERNATE, EMB_ORIENT_AUTO, EMB_ORIENT_FLIP, EMB_ORIENT_KEEP,
};
use super::error::{emb_status, guard, plain};
use super::handle::{Handle, give, lend, release, share, writable};
use super::run::{emb_run, with_run};
use super::versioned::{self, Versioned};
use crate::error::{Error, Result, try_with_capacity};
use crate::io::{self, Format};
use crate::mesh::{Mesh, MeshOptions, Orient, Report};
use std::ffi::{c_char, c_void};
use std::mem::{offset_of, size_of};

/// A surface mesh: welded vertices, polygon faces, tags. Immutable.
pub struct emb_mesh {
    _opaque: (),
}

impl Handle for emb_mesh {
    type Target = Mesh;
}

/// How vertices and faces become a mesh; fill it with emb_mesh_options_init. A point p of the input becomes
/// shift + scale * rotation * p, in double, before welding.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_mesh_options {
    /// sizeof(emb_mesh_options)
    pub struct_size: usize,
    /// Uniform scale, > 0; 1 by default. 0.001 turns millimetres into metres.
    pub scale: f64,
    /// Row-major rotation matrix; the identity by default.
    pub rotation: [f64; 9],
    /// Shift, after scale and rotation; 0 by default.
    pub shift: [f64; 3],
    /// Vertices nearer than this times the diagonal of the mesh become one; 0, the default: those with
    /// equal positions; -1: none. Of meshes that stand, in emb_mesh_join and emb_mesh_transform, 0 welds none either.
    pub weld_tolerance: f64,
    /// EMB_ORIENT_AUTO, the default, EMB_ORIENT_KEEP, EMB_ORIENT_FLIP or EMB_ORIENT_ALTERNATE. In emb_mesh_join and
    /// emb_mesh_transform AUTO turns nothing unless weld_tolerance is above 0.
    pub orient: i32,
    /// EMB_FORMAT_DETECT, the default, or the format the bytes must be in; used when reading.
    pub format: i32,
    /// The first vertex is number 0, the default, or 1; used with arrays.
    pub index_base: i32,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_mesh_options {
    const FIRST_SIZE: usize = offset_of!(emb_mesh_options, index_base) + size_of::<i32>();
    const DEFAULT: emb_mesh_options = emb_mesh_options {
        struct_size: size_of::<emb_mesh_options>(),
        scale: 1.0,
        rotation: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        shift: [0.0; 3],
        weld_tolerance: 0.0,
        orient: EMB_ORIENT_AUTO,
        format: EMB_FORMAT_DETECT,
        index_base: 0,
    };
}

/// What a mesh is like after welding and before orientation: of a file, as read; of a mesh made by repair, join, split or
/// transform, as its faces were before it was oriented. So the volume of a mesh that was inside out is negative here.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct emb_mesh_report {
    /// sizeof(emb_mesh_report), set by the caller
    pub struct_size: usize,
    /// 1: no boundary edges.
    pub closed: i32,
    /// 1: each edge of two faces is run through once each way.
    pub consistent: i32,
    /// 1: closed, and the signed volume is negative.
    pub inside_out: i32,
    /// Pieces of faces connected by edges.
    pub components: i32,
    /// Vertices after welding.
    pub vertices: u64,
    /// Faces of the input.
    pub faces: u64,
    /// Triangles they are cut into.
    pub triangles: u64,
    /// Edges of one face.
    pub boundary_edges: u64,
    /// Edges of more than two faces.
    pub nonmanifold_edges: u64,
    /// Edges of two faces that run through it the same way.
    pub inconsistent_edges: u64,
    /// Faces of no area.
    pub degenerate_faces: u64,
    /// Faces that repeat an earlier one.
    pub duplicate_faces: u64,
    /// Pairs of faces that intersect; UINT64_MAX: not looked for. emb_mesh_diagnose looks for them.
    pub self_intersections: u64,
    /// Signed volume, cubed units of the coordinates; it means something where the mesh is closed.
    pub volume: f64,
    /// Area, squared units of the coordinates.
    pub area: f64,
    /// Bounds, lower corner.
    pub lo: [f64; 3],
    /// Bounds, upper corner.
    pub hi: [f64; 3],
    /// Faces of more than three corners that are not plane or cross themselves; they are cut into triangles, too.
    pub warped_faces: u64,
}

// SAFETY: repr(C), size first, numbers.
unsafe impl Versioned for emb_mesh_report {
    const FIRST_SIZE: usize = offset_of!(emb_mesh_report, hi) + size_of::<[f64; 3]>();
    const DEFAULT: emb_mesh_report = emb_mesh_report {
        struct_size: size_of::<emb_mesh_report>(),
        closed: 0,
        consistent: 0,
        inside_out: 0,
        components: 0,
        vertices: 0,
        faces: 0,
        triangles: 0,
        boundary_edges: 0,
        nonmanifold_edges: 0,
        inconsistent_edges: 0,
        degenerate_faces: 0,
        duplicate_faces: 0,
        self_intersections: u64::MAX,
        volume: 0.0,
        area: 0.0,
        lo: [0.0; 3],
        hi: [0.0; 3],
        warped_faces: 0,
    };
}

/// The options, checked as far as C's types leave them open.
///
/// # Safety
/// `given` is NULL or points to a struct of the size that it states.
pub(super) unsafe fn options(given: *const emb_mesh_options) -> Result<(MeshOptions, Format)> {
    // SAFETY: the caller's promise.
    let given = unsafe { versioned::read_or_default("options", given) }?;
    let orient = match given.orient {
        EMB_ORIENT_AUTO => Orient::Auto,
        EMB_ORIENT_KEEP => Orient::Keep,
        EMB_ORIENT_FLIP => Orient::Flip,
        EMB_ORIENT_ALTERNATE => Orient::Alternate,
        other => return Err(Error::invalid(format!("options.orient: {other} is not an EMB_ORIENT_*"))),
    };
    let format = match given.format {
        EMB_FORMAT_DETECT => Format::Detect,
        EMB_FORMAT_STL => Format::Stl,
        EMB_FORMAT_PLY => Format::Ply,
        EMB_FORMAT_OBJ => Format::Obj,
        EMB_FORMAT_VTK => Format::Vtk,
        EMB_FORMAT_VTP => Format::Vtp,
        other => return Err(Error::invalid(format!("options.format: {other} is not an EMB_FORMAT_*"))),
    };
    let index_base = match given.index_base {
        base @ 0..=1 => base as u32,
        other => return Err(Error::invalid(format!("options.index_base: {other} is neither 0 nor 1"))),
    };
    let options = MeshOptions {
        scale: given.scale,
        rotation: given.rotation,
        shift: given.shift,
        weld_tolerance: given.weld_tolerance,
        orient,
        index_base,
    };
    Ok((options, format))
}

/// Fills options with defaults. `size` is sizeof *options, as the caller knows it; nothing is written beyond.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_options_init(options: *mut emb_mesh_options, size: usize) -> emb_status {
    // SAFETY: the size is what the caller says, as the header asks.
    guard(|| unsafe { versioned::init("options", options, size) })
}

/// Reads a mesh from a file: STL, PLY, OBJ, legacy VTK PolyData or VTP, as text or as bytes of either order, found from
/// the content. All solids, groups and pieces of a file come together, with tags: of STL the number of the solid, of OBJ
/// a number for each group and material, of PLY, VTK and VTP an integer `tag` of the faces; their names are kept, and so
/// are named data of vertices and faces (emb_mesh_field_get). Nothing is changed but this: vertices are welded and faces
/// oriented as `options` say (NULL: defaults). The calling thread tells `run` 0 before and 1 after. On success *out_mesh
/// is the caller's, to be freed with emb_mesh_free.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT, EMB_ERROR_IO, EMB_ERROR_PARSE (truncated, empty,
/// coordinates that are not finite; the message names the offset or the line), EMB_ERROR_UNSUPPORTED (another kind of
/// VTK data; what would take more than 20 bytes of memory for each of the file, decompressed, and 16 MB),
/// EMB_ERROR_MEMORY, EMB_ERROR_CANCELLED. Cost: linear in the size of the file.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_read(
    path: *const c_char,
    options: *const emb_mesh_options,
    run: *const emb_run,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let file = self::path("path", path)?;
        read(options, run, out_mesh, |format, options| io::read(file, format, options))
    })
}

/// As emb_mesh_read, from the `size` bytes of a file in memory, which are not kept.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_read_memory(
    bytes: *const c_void,
    size: usize,
    options: *const emb_mesh_options,
    run: *const emb_run,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let bytes = slice("bytes", bytes.cast::<u8>(), elements::<u8>("size", size, 1)?)?;
        read(options, run, out_mesh, |format, options| io::read_memory(bytes, format, options))
    })
}

/// # Safety
/// Pointers as the header asks.
unsafe fn read(
    given: *const emb_mesh_options,
    run: *const emb_run,
    out_mesh: *mut *mut emb_mesh,
    reader: impl FnOnce(Format, &MeshOptions) -> Result<Mesh>,
) -> Result<()> {
    // SAFETY: the caller's promise.
    unsafe {
        let (options, format) = options(given)?;
        writable("out_mesh", out_mesh)?;
        with_run(run, |run| {
            run.tell(0.0)?;
            let mesh = reader(format, &options)?;
            run.tell(1.0)?;
            give(out_mesh, mesh);
            Ok(())
        })
    }
}

/// A mesh from triangles. `xyz` holds 3 * vertex_count coordinates, `indices` 3 * triangle_count vertex numbers
/// from options.index_base on, counter-clockwise seen from outside, `tags` one number a triangle (a boundary
/// condition, say) or NULL for 0. Vertices are welded. The arrays are not kept. On success *out_mesh is the
/// caller's, to be freed with emb_mesh_free.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (naming the coordinate or the index),
/// EMB_ERROR_MEMORY. Cost: linear, up to a sort.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_from_triangles(
    vertex_count: usize,
    xyz: *const f64,
    triangle_count: usize,
    indices: *const u32,
    tags: *const i32,
    options: *const emb_mesh_options,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let xyz = slice("xyz", xyz, elements::<f64>("vertex_count", vertex_count, 3)?)?;
        from_triangles(xyz, triangle_count, indices, tags, options, out_mesh)
    })
}

/// As emb_mesh_from_triangles, from float coordinates, each of which is a double too.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_from_triangles_f32(
    vertex_count: usize,
    xyz: *const f32,
    triangle_count: usize,
    indices: *const u32,
    tags: *const i32,
    options: *const emb_mesh_options,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let count = elements::<f64>("vertex_count", vertex_count, 3)?;
        let given = slice("xyz", xyz, count)?;
        let mut xyz = try_with_capacity("coordinates", count)?;
        xyz.extend(given.iter().map(|c| f64::from(*c)));
        from_triangles(&xyz, triangle_count, indices, tags, options, out_mesh)
    })
}

/// # Safety
/// Pointers as the header asks.
unsafe fn from_triangles(
    xyz: &[f64],
    triangle_count: usize,
    indices: *const u32,
    tags: *const i32,
    given: *const emb_mesh_options,
    out_mesh: *mut *mut emb_mesh,
) -> Result<()> {
    // SAFETY: the caller's promise.
    unsafe {
        let indices = slice("indices", indices, elements::<u32>("triangle_count", triangle_count, 3)?)?;
        let tags = optional_tags(tags, triangle_count)?;
        let (options, _) = options(given)?;
        writable("out_mesh", out_mesh)?;
        give(out_mesh, Mesh::from_triangles(xyz, indices, tags, &options)?);
        Ok(())
    }
}

/// # Safety
/// `tags` is NULL or holds `count` tags during `'a`.
unsafe fn optional_tags<'a>(tags: *const i32, count: usize) -> Result<Option<&'a [i32]>> {
    if tags.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise.
    unsafe { slice("tags", tags, count) }.map(Some)
}

/// A mesh from polygons, plane or not quite (emb_mesh_report.warped_faces counts those): face f has the vertices
/// indices[offsets[f]] to indices[offsets[f+1] - 1], at least three. `offsets` holds face_count + 1 numbers that begin
/// with 0 and do not fall. Each face is cut into triangles that keep its boundary, in about n log n of its corners. One
/// that crosses itself is cut for the least area, in the cube of its corners (some 20 ms for 250); of more than 250, it
/// is parted where it comes to a vertex again, each part is cut by the same rules, and a part of more than 250 that
/// still crosses itself is cut from one corner, and may cover what it does not enclose. So tangles take 0.1 ms a corner
/// at worst. The rest as in emb_mesh_from_triangles; the same errors.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_from_polygons(
    vertex_count: usize,
    xyz: *const f64,
    face_count: usize,
    offsets: *const usize,
    indices: *const u32,
    tags: *const i32,
    options: *const emb_mesh_options,
    out_mesh: *mut *mut emb_mesh,
) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let xyz = slice("xyz", xyz, elements::<f64>("vertex_count", vertex_count, 3)?)?;
        let offsets = slice("offsets", offsets, elements::<usize>("face_count", face_count.saturating_add(1), 1)?)?;
        check_offsets(offsets)?;
        let corners = elements::<u32>("offsets[face_count]", offsets[face_count], 1)?;
        let indices = slice("indices", indices, corners)?;
        let tags = optional_tags(tags, face_count)?;
        let (options, _) = self::options(options)?;
        writable("out_mesh", out_mesh)?;
        give(out_mesh, Mesh::from_polygons(xyz, offsets, indices, tags, &options)?);
        Ok(())
    })
}

/// The last offset says how long `indices` is, so it is believed only where all of them make sense.
fn check_offsets(offsets: &[usize]) -> Result<()> {
    if offsets[0] != 0 {
        return Err(Error::invalid(format!("offsets[0]: {} is not 0", offsets[0])));
    }
    match offsets.windows(2).position(|pair| pair[1] < pair[0]) {
        Some(f) => {
            Err(Error::invalid(format!("offsets[{}]: {} is less than {} before it", f + 1, offsets[f + 1], offsets[f])))
        }
        None => Ok(()),
    }
}

/// Writes the mesh as it stands, oriented; the format is chosen by the extension of `path`, in any case:
/// ".stl" (binary: triangles in float, which makes vertices one that are nearer to each other than 1e-7 of their
/// coordinates: shift a mesh that is far from the origin back first), ".ply" (binary), ".obj", ".vtk" (legacy, binary) or ".vtp" (XML, appended bytes).
/// All but STL hold polygons, coordinates to the bit, tags and their names; PLY, VTK and VTP all named data, OBJ of
/// them the vertices' red, green and blue alone. Faces are numbered anew where the mesh lost some. The file appears
/// under its name when it is complete. Vertices that stand apart at one position, as EMB_REPAIR_SPLIT leaves them, are
/// written apart but for STL, and are one again where the file is read with the default weld_tolerance: with -1 they stay
/// apart. In the same way an orientation kept or flipped needs EMB_ORIENT_KEEP when read. Any thread. Cost: linear; the
/// file's bytes are in memory meanwhile. Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_UNSUPPORTED (extension; a coordinate
/// beyond the float of STL; data of a name that the format has for something else: in .ply, in any case, x, y and z of
/// vertices and vertex_indices and tag of faces; in .vtk and .vtp tag of faces, where the mesh has tags, too, or the data
/// would be read as tags), EMB_ERROR_IO, EMB_ERROR_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_write(mesh: *const emb_mesh, path: *const c_char) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe { io::write(lend("mesh", mesh)?, self::path("path", path)?) })
}

/// Writes what the mesh is like, as read and before orientation, to *report, whose struct_size the caller has set;
/// nothing is written beyond that size. O(1): the report is made with the mesh. Any thread.
/// Errors: EMB_ERROR_NULL_ARGUMENT, EMB_ERROR_INVALID_ARGUMENT (struct_size).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_report_get(mesh: *const emb_mesh, report: *mut emb_mesh_report) -> emb_status {
    // SAFETY: pointers as the header asks.
    guard(|| unsafe {
        let mesh = lend("mesh", mesh)?;
        let size = versioned::result_size("report", report)?;
        versioned::write_result(report, size, describe(mesh.report()));
        Ok(())
    })
}

/// A report without intersections.
pub(super) fn describe(report: &Report) -> emb_mesh_report {
    emb_mesh_report {
        closed: report.closed.into(),
        consistent: report.consistent.into(),
        inside_out: report.inside_out.into(),
        components: i32::try_from(report.components).unwrap_or(i32::MAX),
        vertices: report.vertices as u64,
        faces: report.faces as u64,
        triangles: report.triangles as u64,
        boundary_edges: report.boundary_edges as u64,
        nonmanifold_edges: report.nonmanifold_edges as u64,
        inconsistent_edges: report.inconsistent_edges as u64,
        degenerate_faces: report.degenerate_faces as u64,
        duplicate_faces: report.duplicate_faces as u64,
        volume: report.volume,
        area: report.area,
        lo: report.lo,
        hi: report.hi,
        warped_faces: report.warped_faces as u64,
        ..emb_mesh_report::DEFAULT
    }
}

/// One more reference to the same mesh, to be freed like the first; NULL for NULL. O(1). Any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_clone(mesh: *const emb_mesh) -> *mut emb_mesh {
    // SAFETY: a handle or NULL, as the header asks.
    unsafe { share(mesh) }
}

/// Gives up a reference. Geometries made from the mesh live on. NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn emb_mesh_free(mesh: *mut emb_mesh) {
    // SAFETY: a handle or NULL that is not used again, as the header asks.
    plain((), || unsafe { release(mesh) });
}
