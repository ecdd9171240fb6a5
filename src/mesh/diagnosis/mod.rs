// SPDX-License-Identifier: MIT OR Apache-2.0
//! Everything that a mesh report counts, told one by one: where the faults of a mesh lie, what its components
//! and its boundary loops are. Of the mesh as read, after welding and before orientation and repair.

mod components;
mod copies;
mod digits;
mod edges;
mod examples;
mod faces;
mod lists;
mod loops;
mod nearly;
mod text;
mod vertices;

pub use components::Component;
pub use edges::InconsistentEdge;
pub use faces::{Duplicate, FaceMeasure};
pub use lists::Lists;
pub use loops::BoundaryLoop;
pub use vertices::NonmanifoldVertex;

use super::edges::Edges;
use super::faces::Faces;
use super::{Mesh, Report, Surface, Triangle, duplicates};
use crate::error::{Error, Result, try_with_capacity};
use crate::math::Vec3;
use examples::Examples;

/// What to look for, and where faults begin.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagnosisOptions {
    /// A face is a sliver where its smallest height is less than this times its longest edge; more exactly,
    /// where twice its area is less than this times its squared length (see [`Diagnosis::slivers`]). From 0,
    /// which finds none, to 1.
    pub sliver_ratio: f64,
    /// A face of more than three corners is listed where these are off a plane by more than this times the
    /// diagonal of its box. From 0 to 1; 0: not looked for.
    pub off_plane_ratio: f64,
    /// Most pairs of faces that intersect to look for and to list; 0: not looked for.
    pub intersection_limit: usize,
}

impl Default for DiagnosisOptions {
    fn default() -> DiagnosisOptions {
        DiagnosisOptions { sliver_ratio: 1e-3, off_plane_ratio: 0.0, intersection_limit: 1_000_000 }
    }
}

impl DiagnosisOptions {
    /// Every value is in its range, or [`crate::Status::InvalidArgument`] naming the one that is not.
    pub fn check(&self) -> Result<()> {
        for (name, ratio) in [("sliver_ratio", self.sliver_ratio), ("off_plane_ratio", self.off_plane_ratio)] {
            if !(0.0..=1.0).contains(&ratio) {
                return Err(Error::invalid(format!("options.{name}: {ratio} is not between 0 and 1")));
            }
        }
        Ok(())
    }
}

/// Pairs of input faces that meet beyond the vertices and edges they share.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Intersections {
    /// Two different faces each, the lower first; ascending. No more than were asked for.
    pub pairs: Vec<[u32; 2]>,
    /// How many there are, or at least are.
    pub count: u64,
    /// Whether the search went to its end, so that `count` is exact.
    pub complete: bool,
}

/// What is the matter with a mesh as read, one by one. Numbers of faces are those of input faces, numbers of
/// vertices those of [`Mesh::vertices`]; every list is ascending in its first number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnosis {
    /// The counts.
    pub report: Report,
    /// The two vertices of each edge of more than two faces, the lower first.
    pub nonmanifold_edges: Vec<[u32; 2]>,
    /// The faces at each of these edges.
    pub nonmanifold_edge_faces: Lists,
    /// Edges that two faces run along the same way.
    pub inconsistent_edges: Vec<InconsistentEdge>,
    /// Vertices at which the faces do not form one fan or one disc.
    pub nonmanifold_vertices: Vec<NonmanifoldVertex>,
    /// Faces that welding took corners from; those left with fewer than three are gone.
    pub shrunk_faces: Vec<u32>,
    /// Faces of three or more corners and exactly zero area.
    pub flat_faces: Vec<u32>,
    /// Faces that repeat an earlier one.
    pub duplicates: Vec<Duplicate>,
    /// Faces of some area, but less than asked for: each with twice its area over its squared length, which of a
    /// triangle is its smallest height over its longest edge. (The length of a polygon: from its first corner
    /// to the farthest, and from there to the farthest again, the longer of the two.)
    pub slivers: Vec<FaceMeasure>,
    /// Faces that the report counts as warped: off a plane or crossing themselves. Each with the number of
    /// [`Diagnosis::off_plane_faces`].
    pub warped_faces: Vec<FaceMeasure>,
    /// Faces whose corners are off a plane by more than asked for: each with half the room between two planes around its corners, over
    /// the diagonal of its box.
    pub off_plane_faces: Vec<FaceMeasure>,
    /// Sets of faces connected over edges, by lowest face.
    pub components: Vec<Component>,
    /// The component of each input face; [`NO_COMPONENT`] for faces that are gone.
    pub component_of_face: Vec<u32>,
    /// Chains of boundary edges, by lowest vertex.
    pub loops: Vec<BoundaryLoop>,
    /// The vertices of each of these, in order.
    pub loop_vertices: Lists,
    /// None where they were not looked for.
    pub intersections: Option<Intersections>,
    /// How many faces orientation has turned over since.
    pub turned_faces: usize,
    /// The topology of the surface as it stands.
    pub surface: Surface,
    /// What was looked for.
    sought: DiagnosisOptions,
    /// A weld_tolerance that would join half the boundary edges or more, and how many.
    weldable: Option<(f64, usize)>,
    /// Closed components that lie within others and face outward as they do.
    solid_within: usize,
    examples: Examples,
}

/// No component.
pub const NO_COMPONENT: u32 = u32::MAX;

/// What every part of a diagnosis looks at.
struct Subject<'a> {
    mesh: &'a Mesh,
    vertices: &'a [Vec3],
    faces: &'a Faces,
    edges: Edges,
    of_half_edge: Vec<u32>,
    /// Whether orientation turned each face over.
    turned: Vec<bool>,
}

impl<'a> Subject<'a> {
    fn new(mesh: &'a Mesh) -> Result<Subject<'a>> {
        let faces = mesh.half_edges.faces();
        let vertices = &mesh.vertices[..];
        let mut turned = try_with_capacity("faces", faces.len())?;
        turned.extend((0..faces.len()).map(|f| mesh.triangles[faces.triangles_of(f).start].turned));
        let edges = Edges::of(vertices.len(), faces.half_edges())?;
        Ok(Subject { mesh, vertices, faces, edges, of_half_edge: faces.of_half_edges()?, turned })
    }

    /// The ends of a half-edge as its face ran when read.
    fn ends_as_read(&self, half_edge: u32) -> [u32; 2] {
        let topology = &self.mesh.half_edges;
        let ends = [topology.origin(half_edge), topology.target(half_edge)];
        if self.turned[self.of_half_edge[half_edge as usize] as usize] { [ends[1], ends[0]] } else { ends }
    }

    fn input_face(&self, half_edge: u32) -> u32 {
        self.faces.input[self.of_half_edge[half_edge as usize] as usize]
    }

    /// The corners of a triangle as its face ran when read.
    fn corners_as_read(&self, t: &Triangle) -> [Vec3; 3] {
        let [a, b, c] = t.corners(self.vertices);
        if t.turned { [a, c, b] } else { [a, b, c] }
    }
}

impl Mesh {
    /// Everything but the intersections. Near linear time.
    pub(crate) fn diagnosis(&self, options: &DiagnosisOptions) -> Result<Diagnosis> {
        options.check()?;
        let subject = Subject::new(self)?;
        let mut found = Diagnosis { report: self.report.clone(), surface: self.surface, ..Diagnosis::default() };
        found.turned_faces = subject.turned.iter().filter(|turned| **turned).count();
        found.list_edges(&subject)?;
        found.list_vertices(&subject)?;
        found.list_duplicates(&subject, &duplicates::find(subject.faces, subject.vertices.len())?)?;
        found.list_faces(&subject, options)?;
        found.list_components(&subject)?;
        found.list_loops(&subject)?;
        found.sought = options.clone();
        found.weldable = nearly::weldable(&subject)?;
        found.solid_within = nearly::solid_within(&subject, &found)?;
        found.examples = Examples::of(&found, self);
        Ok(found)
    }
}

/// Adds an item to a list whose length the input decides.
fn push<T>(list: &mut Vec<T>, what: &str, item: T) -> Result<()> {
    list.try_reserve(1).map_err(|_| Error::memory(what, list.len() + 1))?;
    list.push(item);
    Ok(())
}
