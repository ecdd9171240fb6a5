// SPDX-License-Identifier: MIT OR Apache-2.0
//! Polygon meshes: welded vertices, half-edge topology, report, orientation, pseudonormals, tags.

mod options;

pub use options::{MeshOptions, Orient};

use crate::error::Result;
use crate::math::Vec3;

/// A triangle of the surface as it stands after welding and orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Indices into [`Mesh::vertices`], counter-clockwise seen from outside.
    pub vertices: [u32; 3],
    /// The input face it comes from.
    pub face: u32,
}

/// What a mesh is like: see the fields.
#[derive(Clone, Debug, Default)]
pub struct Report {
    pub closed: bool,
    pub consistent: bool,
    pub inside_out: bool,
    pub components: usize,
    pub vertices: usize,
    pub faces: usize,
    pub triangles: usize,
    pub boundary_edges: usize,
    pub nonmanifold_edges: usize,
    pub inconsistent_edges: usize,
    pub degenerate_faces: usize,
    pub duplicate_faces: usize,
    pub volume: f64,
    pub area: f64,
    pub lo: [f64; 3],
    pub hi: [f64; 3],
}

/// The topology of the surface as it stands, after orientation and without duplicate faces: what a
/// sign needs to know.
#[derive(Clone, Copy, Debug, Default)]
pub struct Surface {
    /// Edges of one face.
    pub boundary_edges: usize,
    /// Edges of more than two faces.
    pub nonmanifold_edges: usize,
    /// Edges that are not crossed as often in one direction as in the other (boundary edges included):
    /// zero means that the winding number is an integer everywhere off the surface.
    pub unbalanced_edges: usize,
    /// Signed volume of the triangles as they stand: negative where KEEP left the mesh inside out.
    pub volume: f64,
}

/// Face, edge and angle-weighted vertex pseudonormals (Baerentzen & Aanaes 2005).
#[derive(Clone, Debug, Default)]
pub struct Pseudonormals {
    /// Unit normal of each triangle; zero where its area is zero.
    pub triangle: Vec<Vec3>,
    /// For each triangle, the pseudonormals of its edges 0-1, 1-2, 2-0: the sum of the unit normals of
    /// the faces at the edge.
    pub edge: Vec<[Vec3; 3]>,
    /// For each vertex, the sum of the unit normals at it, weighted by the angle.
    pub vertex: Vec<Vec3>,
}

/// A surface mesh. Immutable.
pub struct Mesh {
    _todo: (),
}

impl Mesh {
    pub fn from_triangles(
        _xyz: &[f64],
        _indices: &[u32],
        _tags: Option<&[i32]>,
        _options: &MeshOptions,
    ) -> Result<Mesh> {
        todo!()
    }

    pub fn from_polygons(
        _xyz: &[f64],
        _offsets: &[usize],
        _indices: &[u32],
        _tags: Option<&[i32]>,
        _options: &MeshOptions,
    ) -> Result<Mesh> {
        todo!()
    }

    /// Vertices after transformation and welding; none is unused.
    pub fn vertices(&self) -> &[Vec3] {
        todo!()
    }

    /// Triangles of the surface as it stands: oriented, exact duplicates left out (the lowest input face stays),
    /// faces that welding collapsed (a vertex twice) left out; ordered by input face.
    pub fn triangles(&self) -> &[Triangle] {
        todo!()
    }

    /// The tag of an input face.
    pub fn tag(&self, _face: u32) -> i32 {
        todo!()
    }

    /// As read, after welding and before any repair.
    pub fn report(&self) -> &Report {
        todo!()
    }

    pub fn surface(&self) -> Surface {
        todo!()
    }

    pub fn pseudonormals(&self) -> Pseudonormals {
        todo!()
    }
}
