// SPDX-License-Identifier: MIT OR Apache-2.0
//! The constants of the C ABI. Values are never reused.

/// Version of this header: major. The library's own is emb_version_number().
pub const EMB_VERSION_MAJOR: u32 = 0;
/// Version of this header: minor.
pub const EMB_VERSION_MINOR: u32 = 1;
/// Version of this header: patch.
pub const EMB_VERSION_PATCH: u32 = 0;

/// Success.
pub const EMB_OK: i32 = 0;
/// A required pointer was NULL.
pub const EMB_ERROR_NULL_ARGUMENT: i32 = -1;
/// An argument's value is outside what the function takes.
pub const EMB_ERROR_INVALID_ARGUMENT: i32 = -2;
/// A file could not be read or written.
pub const EMB_ERROR_IO: i32 = -3;
/// A file's content is not what its format asks for; the message names the offset or the line.
pub const EMB_ERROR_PARSE: i32 = -4;
/// Understood, but this version or this geometry cannot do it.
pub const EMB_ERROR_UNSUPPORTED: i32 = -5;
/// The mesh is unfit for the sign asked for.
pub const EMB_ERROR_TOPOLOGY: i32 = -6;
/// The progress callback asked to stop.
pub const EMB_ERROR_CANCELLED: i32 = -7;
/// A user's callback failed (returned NaN), or an expression has no value at a point asked for.
pub const EMB_ERROR_CALLBACK: i32 = -8;
/// Memory could not be had.
pub const EMB_ERROR_MEMORY: i32 = -9;
/// A defect in embound itself.
pub const EMB_ERROR_INTERNAL: i32 = -99;

/// emb_array: double.
pub const EMB_F64: i32 = 0;
/// emb_array: float. A nonzero value keeps its sign: its magnitude lies within [FLT_MIN, FLT_MAX].
pub const EMB_F32: i32 = 1;
/// emb_array: int32_t; sign fills, counts, tags and parts only.
pub const EMB_I32: i32 = 2;
/// emb_array: int8_t; sign fills and counts only. A count above 127 is written as 127.
pub const EMB_I8: i32 = 3;

/// Faces are oriented consistently, and closed bodies outward: one that is inside out is turned over with its cavities, and a
/// consistent cavity stays one.
pub const EMB_ORIENT_AUTO: i32 = 0;
/// Faces stay as given: a mesh whose normals point inward stays inside out (internal flow).
pub const EMB_ORIENT_KEEP: i32 = 1;
/// Every face is turned over, and nothing else done.
pub const EMB_ORIENT_FLIP: i32 = 2;
/// As EMB_ORIENT_AUTO, but every closed shell alternates with those around it, whatever it was as given: outermost
/// shells face outward, those within them inward, and so on.
pub const EMB_ORIENT_ALTERNATE: i32 = 3;

/// The format is found from the content.
pub const EMB_FORMAT_DETECT: i32 = 0;
/// STL, binary or ASCII.
pub const EMB_FORMAT_STL: i32 = 1;
/// PLY, ASCII or binary of either byte order.
pub const EMB_FORMAT_PLY: i32 = 2;
/// Wavefront OBJ.
pub const EMB_FORMAT_OBJ: i32 = 3;
/// Legacy VTK PolyData, ASCII or binary.
pub const EMB_FORMAT_VTK: i32 = 4;
/// XML VTK PolyData (.vtp): ASCII, base64 or appended, compressed by zlib or not.
pub const EMB_FORMAT_VTP: i32 = 5;

/// No half-edge, vertex: in index results.
pub const EMB_NO_INDEX: u32 = 0xFFFFFFFF;

/// An input face, by its number.
pub const EMB_ELEMENT_FACE: i32 = 0;
/// An edge, by one of its half-edges.
pub const EMB_ELEMENT_EDGE: i32 = 1;
/// A vertex.
pub const EMB_ELEMENT_VERTEX: i32 = 2;

/// Named data of the vertices.
pub const EMB_ON_VERTICES: i32 = 0;
/// Named data of the faces.
pub const EMB_ON_FACES: i32 = 1;

/// Tags of the meshes that become one stay as they are; of several names of a tag the first stays.
pub const EMB_JOIN_KEEP: i32 = 0;
/// Tags are numbered anew from 0, mesh after mesh, each mesh's by rising tag; names go along.
pub const EMB_JOIN_RENUMBER: i32 = 1;
/// Every face's tag is the number of its mesh or file.
pub const EMB_JOIN_BY_MESH: i32 = 2;

/// Vertices nearer than a tolerance become one.
pub const EMB_REPAIR_WELD: i32 = 1;
/// Faces of zero area leave; the faces next to them take over their corners, so that no crack opens.
pub const EMB_REPAIR_DEGENERATE: i32 = 2;
/// Faces that repeat an earlier one leave, but for the wall between two bodies in contact.
pub const EMB_REPAIR_DUPLICATES: i32 = 4;
/// Components become consistent, closed shells outward and inward in turn.
pub const EMB_REPAIR_ORIENT: i32 = 8;
/// Small holes are filled.
pub const EMB_REPAIR_HOLES: i32 = 16;
/// Fans of faces that meet in one vertex get one each: bodies that share a vertex or an edge come apart.
pub const EMB_REPAIR_SPLIT: i32 = 32;
/// All of these.
pub const EMB_REPAIR_ALL: i32 = 63;

/// Triangles that fill a hole get the tag of most faces round it.
pub const EMB_FILL_TAG_AROUND: i32 = 0;
/// Triangles that fill a hole get the tag given.
pub const EMB_FILL_TAG_GIVEN: i32 = 1;

/// Inside where a ray crosses the boundary an odd number of times. Exact; with each method polygons side by side share no
/// point of their boundaries and miss none.
pub const EMB_POLYGON_CROSSING: i32 = 0;
/// Inside where the boundary winds around the point, whichever way: also where a polygon covers itself twice. Exact.
pub const EMB_POLYGON_WINDING: i32 = 1;
/// Inside where the angles that the sides subtend sum to more than half a turn: the winding number to rounding, and on the
/// boundary itself.
pub const EMB_POLYGON_ANGLE: i32 = 2;

/// One mesh a tag, by rising tag.
pub const EMB_SPLIT_TAG: i32 = 0;
/// One mesh for what edges connect, by the lowest face of each.
pub const EMB_SPLIT_COMPONENT: i32 = 1;

/// Of a closed surface: pseudonormals where it meets itself in shared edges and vertices only and has the outside on its
/// outer side, crossings near the faces where it does not, and everywhere where those are many or edges have more than two
/// faces. emb_geom_properties.sign_method is EMB_SIGN_PSEUDONORMAL where pseudonormals decide everywhere, else
/// EMB_SIGN_RAY. Of a surface with small holes: EMB_SIGN_WINDING. A hole is small where, across it, it is less than a third
/// of the mesh and a cap over it less than 1/40 of the mesh's area; with a larger one the mesh is EMB_ERROR_TOPOLOGY, with a
/// message that names the loops. emb_geom_sign_text says what was chosen and why.
pub const EMB_SIGN_AUTO: i32 = 0;
/// Angle-weighted pseudonormals (Baerentzen & Aanaes 2005), for clean closed meshes.
pub const EMB_SIGN_PSEUDONORMAL: i32 = 1;
/// Inside is where the generalised winding number (Jacobson et al. 2013) is at least 1/2, for any mesh: bodies through each
/// other are their union, holes are closed by the surface on which the number is 1/2 (of a plane rim, the plane). From
/// exact crossings and, near holes, solid angles, by clusters (Barill et al. 2018) as far as these decide and exact beyond.
/// The sign may change across a hole while the value jumps from -d to d; it is that of every question. Beyond the bounds
/// of the mesh is outside. An open mesh is turned over as a whole where it would enclose a negative volume with caps over
/// its holes, unless it was read with EMB_ORIENT_KEEP or EMB_ORIENT_FLIP: then, where its holes are small as EMB_SIGN_AUTO
/// has it, the body is what is around it, as of a closed mesh. Of a closed mesh the same as EMB_SIGN_RAY, at the cost of
/// EMB_SIGN_AUTO. Cost: where no hole is large and they are few, little more than that of a closed mesh; of triangle soup,
/// milliseconds a point.
pub const EMB_SIGN_WINDING: i32 = 2;
/// Exact crossings of a ray, for closed meshes that intersect themselves. Of an open mesh, six rays along the axes: inside is
/// where at least four of them say so, within the bounds of the mesh.
pub const EMB_SIGN_RAY: i32 = 3;
/// Terrain: inside is below the highest face, seen down emb_sdf_options.axis (2: z falls), whichever way faces run and
/// without end; beside the sheet is outside. Of a ceiling take emb_geom_reflect. Below its rim the sign changes while the
/// value jumps. Lattices are not scanned: signs and crossings of them take longer than of a closed mesh.
pub const EMB_SIGN_AXIS: i32 = 4;
/// Unsigned: never inside (baffles, sheets, triangle soup).
pub const EMB_SIGN_NONE: i32 = 5;

/// A mesh with boundary loops is EMB_ERROR_TOPOLOGY where the sign needs a closed one.
pub const EMB_OPEN_ERROR: i32 = 0;
/// Boundary loops are capped: each is filled by triangles of the least area over its vertices, those of more than 1,000
/// edges by ears as seen along their area vector. The caps are surface like any other, for every question; closest points,
/// crossings and ray hits on them have primitive -1 and tag -1, piece and feature -1, NaN for barycentric weights, and the
/// part of the label. Each loop is capped by itself: the two rims of a wall get a cap each, which lie in each other and
/// close the bore. A fin that ends in the open gets a cap upon itself: no thickness. A mesh without boundary is taken as it
/// is. What is closed so is oriented as if the caps had been faces of the mesh (EMB_ORIENT_AUTO, EMB_ORIENT_ALTERNATE), or
/// stays as it is (EMB_ORIENT_KEEP, EMB_ORIENT_FLIP), and has every sign that a closed mesh can have; EMB_SIGN_NONE and
/// EMB_SIGN_AXIS are EMB_ERROR_INVALID_ARGUMENT with this. Edges that two faces run along the same way (one-sided strips,
/// or faces kept as given that disagree) are EMB_ERROR_TOPOLOGY. Cost: the cube of the edges of a loop.
pub const EMB_OPEN_CAP: i32 = 1;
/// Boundary loops are swept out of the box open_lo, open_hi, for bodies that leave the domain: each goes on straight along
/// an axis, out by the face of the box that its farthest vertex is nearest to, and is closed so far beyond box and body that
/// the end is nearest from no point of the box. In all else as EMB_OPEN_CAP. The box is finite, and lo < hi along each axis,
/// else EMB_ERROR_INVALID_ARGUMENT; no other choice looks at it. A loop that ends within the box, by more than a quarter of
/// the diagonal of the box around it, leads nowhere, and one that comes to opposite faces of the box without lying on a
/// third, as the rim of terrain does, leads out by several: EMB_ERROR_TOPOLOGY, naming the loop. emb_geom_bounds reaches to
/// the ends, far beyond the box: take the box itself for the domain.
pub const EMB_OPEN_SWEEP: i32 = 2;

/// A bounding volume hierarchy of some 200 bytes a triangle.
pub const EMB_ACCELERATOR_AUTO: i32 = 0;
/// None: every triangle is looked at. Slow; the reference for every other choice, with the same bits.
pub const EMB_ACCELERATOR_NONE: i32 = 1;
/// A hierarchy of about half the memory of AUTO's, some 100 bytes a triangle, which answers two to six times as slowly,
/// with the same bits. Lattices are filled point by point where they are not scanned.
pub const EMB_ACCELERATOR_COMPACT: i32 = 2;

/// Where the surface meets itself is looked for anew, and there crossings decide the sign: right whatever the motion was.
pub const EMB_REFIT_CHECK: i32 = 0;
/// The caller knows that the motion does not bring the surface to meet itself where it did not before (a flag that waves, a
/// membrane that bulges), and no body into another of the same mesh: the sign is decided as it was. Where that is not so,
/// signs are wrong wherever such a place is the nearest, however far away, and values, fills, crossings and classes may
/// disagree there: nothing that is said of signs elsewhere holds.
pub const EMB_REFIT_TRUST: i32 = 1;

/// The block is not copied: it stays the caller's, unchanged, until `drop` is run.
pub const EMB_UNPACK_BORROW: i32 = 1;
/// The caller knows that the arrays of the block are whole, as another process may have found out: header, directory and
/// nodes are looked at as ever, arrays are not, and nothing of them is read before it is asked for. Where they are damaged
/// all the same, answers may be anything, calls may fail with EMB_ERROR_INTERNAL, and they may not return.
pub const EMB_UNPACK_TRUST: i32 = 2;

/// The value is the signed distance to the surface. Of a mesh that passes through itself, all of its faces count: inside,
/// the value may be the distance to a face that lies within the body.
pub const EMB_EXACT: i32 = 0;
/// The magnitude of the value is not above the distance to the surface.
pub const EMB_LOWER_BOUND: i32 = 1;
/// Only the sign of the value means anything.
pub const EMB_SIGN_ONLY: i32 = 2;

/// min(a, b) - h^2 width / 4, h = max(width - |a - b|, 0) / width (Quilez 2013): values further apart than the width
/// are left alone.
pub const EMB_BLEND_SMOOTH: i32 = 0;
/// -width log(exp(-a / width) + exp(-b / width)) (Ricci 1973): smooth everywhere.
pub const EMB_BLEND_EXPONENTIAL: i32 = 1;
/// The caller's function.
pub const EMB_BLEND_CUSTOM: i32 = 2;

/// emb_geom_fill: the value.
pub const EMB_FILL_EXACT: i32 = 0;
/// emb_geom_fill: the value where its magnitude is below `band`, exactly +-band elsewhere.
pub const EMB_FILL_BAND: i32 = 1;
/// emb_geom_fill: -1, 0 or +1.
pub const EMB_FILL_SIGN: i32 = 2;

/// emb_crossings_out: `where` is the coordinate along the axis.
pub const EMB_CROSSING_COORDINATE: i32 = 0;
/// emb_crossings_out: `where` is 0 at the lattice point, 1 at its neighbour.
pub const EMB_CROSSING_FRACTION: i32 = 1;
/// emb_crossings_out: `none` is written to `where` on edges that the surface does not cross.
pub const EMB_ELSEWHERE_WRITE: i32 = 0;
/// emb_crossings_out: nothing is written, to any of the arrays, on edges that the surface does not cross.
pub const EMB_ELSEWHERE_LEAVE: i32 = 1;

/// emb_geom_bounding_box: the body lies within the result.
pub const EMB_BOUNDING_FOUND: i32 = 0;
/// emb_geom_bounding_box: the body may reach the border of the start box; the result is infinite.
pub const EMB_BOUNDING_REACHES_START: i32 = 1;
/// emb_geom_bounding_box: no part of the body lies in the start box; the result is infinite.
pub const EMB_BOUNDING_NOTHING: i32 = 2;

const _: () = {
    assert!(parse(env!("CARGO_PKG_VERSION_MAJOR")) == EMB_VERSION_MAJOR);
    assert!(parse(env!("CARGO_PKG_VERSION_MINOR")) == EMB_VERSION_MINOR);
    assert!(parse(env!("CARGO_PKG_VERSION_PATCH")) == EMB_VERSION_PATCH);
};

/// The number that a part of the version is.
const fn parse(text: &str) -> u32 {
    let (digits, mut value, mut k) = (text.as_bytes(), 0, 0);
    while k < digits.len() {
        value = value * 10 + (digits[k] - b'0') as u32;
        k += 1;
    }
    value
}
