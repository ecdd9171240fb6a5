// SPDX-License-Identifier: MIT OR Apache-2.0
//! Polygon meshes: welded vertices, half-edge topology, report, orientation, pseudonormals, tags.

mod arrays;
mod assembly;
mod boundary;
mod build;
mod caps;
mod clean;
mod closed;
mod copies;
mod data;
mod diagnosis;
mod duplicates;
mod ears;
mod edges;
mod element;
mod faces;
mod half_edge;
mod input;
mod lobes;
mod measure;
mod nesting;
mod options;
mod orient;
mod pseudonormal;
mod repair;
mod report;
mod triangulate;
mod weld;

pub(crate) use assembly::join;
pub use assembly::{JoinTags, SplitBy};
pub(crate) use boundary::{boundary_loops, one_way_edges};
pub(crate) use build::{LARGEST_COORDINATE, SMALLEST_DIAGONAL, build};
pub(crate) use caps::{Caps, cap_plane};
pub(crate) use closed::NO_FACE;
pub(crate) use data::Data;
pub use data::{Field, FieldType};
pub use diagnosis::{
    BoundaryLoop, Component, Diagnosis, DiagnosisOptions, Duplicate, FaceMeasure, InconsistentEdge, Intersections,
    Lists, NO_COMPONENT, NonmanifoldVertex,
};
pub use element::{Element, Measure};
pub(crate) use faces::{Faces, Sets};
pub use half_edge::HalfEdges;
pub(crate) use input::Input;
pub(crate) use measure::volume;
pub use options::{MeshOptions, Orient};
pub(crate) use pseudonormal::normal_and_angles;
pub use repair::{RepairOptions, Repairs};

pub use crate::primitive::inside::{Inside, contains as polygon_contains};

use crate::error::Result;
use crate::math::{Aabb, Vec3};

/// A triangle of the surface as it stands after welding and orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Indices into [`Mesh::vertices`], counter-clockwise seen from outside.
    pub vertices: [u32; 3],
    /// The input face it comes from.
    pub face: u32,
    /// Whether orientation turned the face over: corners 1 and 2 then stand exchanged.
    pub turned: bool,
}

/// What a mesh is like as read: after welding, before any repair. Edges are those of the input's faces;
/// faces that welding left fewer than three corners have none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// No edge has exactly one face.
    pub closed: bool,
    /// No two faces run along their common edge the same way. Edges of more than two faces do not count.
    pub consistent: bool,
    /// Of negative volume, and every edge is crossed as often one way as the other, so closed.
    pub inside_out: bool,
    /// Sets of faces connected over edges.
    pub components: usize,
    /// Vertices that faces use, after welding.
    pub vertices: usize,
    /// Input faces.
    pub faces: usize,
    /// Triangles that the input's faces amount to: two fewer than corners each.
    pub triangles: usize,
    /// Edges of one face.
    pub boundary_edges: usize,
    /// Edges of more than two faces.
    pub nonmanifold_edges: usize,
    /// Edges that two faces run along the same way.
    pub inconsistent_edges: usize,
    /// Faces that lost corners by welding, and faces of exactly zero area.
    pub degenerate_faces: usize,
    /// Faces that repeat an earlier one, in either winding.
    pub duplicate_faces: usize,
    /// Faces of more than three corners that are farther from a plane than 1e-5 of their size (rounding of
    /// their coordinates to f32 is allowed for) or cross themselves.
    pub warped_faces: usize,
    /// Flux of the field (x, 0, 0) through the faces as they run: of a closed and consistent mesh, the
    /// volume it encloses, negative where it is inside out; of an open one it depends on where the mesh lies.
    pub volume: f64,
    /// Area of all faces.
    pub area: f64,
    /// Lower corner of the box around the vertices.
    pub lo: [f64; 3],
    /// Upper corner.
    pub hi: [f64; 3],
}

/// The topology of the surface as it stands, after orientation and without faces that repeat others: what
/// a sign needs to know.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surface {
    /// Edges of one face.
    pub boundary_edges: usize,
    /// Edges of more than two faces.
    pub nonmanifold_edges: usize,
    /// Edges that are not crossed as often in one direction as in the other (boundary edges included):
    /// zero means that the winding number is an integer everywhere off the surface.
    pub unbalanced_edges: usize,
    /// Signed volume of a closed mesh as it stands: negative where KEEP left it inside out.
    pub volume: f64,
}

/// Face, edge and angle-weighted vertex pseudonormals (Baerentzen & Aanaes 2005).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pseudonormals {
    /// Unit normal of each triangle; zero where its area is zero.
    pub triangle: Vec<Vec3>,
    /// For each triangle, the pseudonormals of its edges 0-1, 1-2, 2-0: the sum of the unit normals of
    /// the faces at the edge.
    pub edge: Vec<[Vec3; 3]>,
    /// For each vertex, the sum of the unit normals at it, weighted by the angle.
    pub vertex: Vec<Vec3>,
}

/// A surface mesh. Immutable; plain index arrays, so any number of threads may read it at once.
///
/// `face` and `primitive` numbers anywhere in the library are those of the input's faces, whatever was
/// left out of the surface.
pub struct Mesh {
    vertices: Vec<Vec3>,
    triangles: Vec<Triangle>,
    /// None at all where every tag is 0.
    tags: Vec<i32>,
    tag_names: Vec<(i32, String)>,
    data: Data,
    /// Numbers of input faces are below this.
    face_count: usize,
    /// Input faces that lost corners by welding.
    shrunk: Vec<u32>,
    half_edges: HalfEdges,
    report: Report,
    surface: Surface,
    /// How it was oriented.
    orient: Orient,
}

impl Mesh {
    /// A mesh of triangles: `xyz` holds three coordinates a vertex, `indices` three vertices a triangle,
    /// `tags` a number a triangle (0 where there are none). Vertices that no triangle uses are left out.
    ///
    /// Time and memory are near linear.
    ///
    /// # Errors
    /// [`Status::InvalidArgument`](crate::Status) naming the argument and the value: an option out of its range, a
    /// length that is no multiple of three, no triangle at all, an index out of range, a coordinate that is
    /// not finite or comes to lie beyond 1e100, a box whose diagonal is not above 1e-90, no triangle with
    /// three different corners, more than 2^32 - 2 vertices or 2^32 - 1 indices.
    /// [`Status::Memory`](crate::Status) where memory cannot be had.
    pub fn from_triangles(xyz: &[f64], indices: &[u32], tags: Option<&[i32]>, options: &MeshOptions) -> Result<Mesh> {
        build::build(arrays::check(xyz, None, indices, tags, options)?, options)
    }

    /// A mesh of polygons: face f has the corners `indices[offsets[f]..offsets[f + 1]]`, at least three.
    /// Faces may be concave, may touch themselves (a hole joined to the rim by a bridge) and need not be quite
    /// plane: each is cut into triangles that keep its boundary ([`Report::warped_faces`] counts doubtful ones). One
    /// that crosses itself is cut for the least area; of more than 250 corners, it is parted where it comes to a vertex
    /// again, each part is cut by the same rules, and one of more than 250 that still crosses itself is cut from one
    /// corner, and may cover what it does not enclose.
    ///
    /// About n log n in the corners of a face; the cube for the least area, some 20 ms for 250 corners, so that tangles
    /// take 0.1 ms a corner at worst.
    ///
    /// # Errors
    /// Those of [`Mesh::from_triangles`]; offsets that do not begin with 0, fall, leave a face fewer than
    /// three corners or do not end with the count of indices.
    pub fn from_polygons(
        xyz: &[f64],
        offsets: &[usize],
        indices: &[u32],
        tags: Option<&[i32]>,
        options: &MeshOptions,
    ) -> Result<Mesh> {
        build::build(arrays::check(xyz, Some(offsets), indices, tags, options)?, options)
    }

    /// Vertices after transformation and welding, ordered by the lowest input vertex of each; none is
    /// unused and no coordinate is -0.0.
    pub fn vertices(&self) -> &[Vec3] {
        &self.vertices
    }

    /// Triangles of the surface as it stands: oriented, ordered by input face. Left out are faces that
    /// welding left fewer than three corners; nothing else is. (A geometry made of the mesh takes one of each
    /// set of copies: the lowest input face; the wall between two bodies in contact, given by each of them,
    /// stays whole.)
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The number of triangles of the surface.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// The number of input faces: their numbers are below it.
    pub fn face_count(&self) -> usize {
        self.face_count
    }

    /// The tag of an input face; 0 where no tags were given and for faces that do not exist.
    pub fn tag(&self, face: u32) -> i32 {
        self.tags.get(face as usize).copied().unwrap_or(0)
    }

    /// The names of tags, ascending by tag: those of the file's solids, groups, or of the files.
    pub fn tag_names(&self) -> &[(i32, String)] {
        &self.tag_names
    }

    /// The name of a tag, where it has one.
    pub fn tag_name(&self, tag: i32) -> Option<&str> {
        let at = self.tag_names.binary_search_by_key(&tag, |(t, _)| *t).ok()?;
        Some(&self.tag_names[at].1)
    }

    /// Named data of the vertices: item v is vertex v's. Where welding joined vertices of different values (a
    /// seam), item v is what the lowest corner has, and the items from the count of vertices on are those of
    /// other corners.
    pub fn vertex_fields(&self) -> &[Field] {
        &self.data.vertex
    }

    /// The item of the vertex data that belongs to the corner where a half-edge begins: its vertex's, unless a
    /// seam runs there.
    pub fn vertex_data_row(&self, half_edge: u32) -> u32 {
        self.data.row(half_edge, self.half_edges.origin(half_edge))
    }

    /// Named data of the faces, by the number of the input face.
    pub fn face_fields(&self) -> &[Field] {
        &self.data.face
    }

    /// Whether a tag has a name, or any face as it stands a tag other than 0.
    pub(crate) fn is_tagged(&self) -> bool {
        !self.tag_names.is_empty() || self.half_edges.faces().input.iter().any(|f| self.tag(*f) != 0)
    }

    /// Rows of the vertex data: vertices, and other corners of seams.
    pub(crate) fn row_count(&self) -> usize {
        self.vertices.len() + self.data.seam_rows.len()
    }

    /// Data of vertices and faces, with their seams.
    pub(crate) fn data(&self) -> &Data {
        &self.data
    }

    /// Input faces that welding took corners from, ascending; those left with fewer than three are gone.
    pub fn shrunk_faces(&self) -> &[u32] {
        &self.shrunk
    }

    /// The triangles that a face of [`Mesh::half_edges`] is cut into, as indices of [`Mesh::triangles`].
    pub fn triangles_of(&self, face: u32) -> std::ops::Range<usize> {
        self.half_edges.faces().triangles_of(face as usize)
    }

    /// How it was oriented.
    pub(crate) fn orient(&self) -> Orient {
        self.orient
    }

    /// The topology of the faces of the surface, which keep all their corners.
    pub fn half_edges(&self) -> &HalfEdges {
        &self.half_edges
    }

    /// The box around the vertices.
    pub fn bounds(&self) -> Aabb {
        Aabb::of(self.vertices.iter().copied())
    }

    /// As read, after welding and before any repair.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Of the surface as it stands, without faces that repeat others: what a sign needs to know.
    pub fn surface(&self) -> Surface {
        self.surface
    }

    /// Pseudonormals of the surface as it stands, computed by this call in near linear time.
    ///
    /// # Errors
    /// [`Status::Memory`](crate::Status).
    pub fn pseudonormals(&self) -> Result<Pseudonormals> {
        Pseudonormals::of(&self.vertices, &self.triangles)
    }
}

impl std::fmt::Debug for Mesh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Mesh").field("report", &self.report).field("surface", &self.surface).finish_non_exhaustive()
    }
}
