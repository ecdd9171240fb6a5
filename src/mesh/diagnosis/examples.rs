// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where the first few faults of each kind lie, so that the text can say so without the mesh.

use super::{Diagnosis, Intersections, Mesh};
use crate::math::{Aabb, Vec3};

/// Faults of a kind that the text names.
pub(super) const SHOWN: usize = 3;

/// Positions of the first of each list.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Examples {
    pub nonmanifold_edges: Vec<Vec3>,
    pub inconsistent_edges: Vec<Vec3>,
    pub nonmanifold_vertices: Vec<Vec3>,
    pub flat_faces: Vec<Vec3>,
    pub duplicates: Vec<Vec3>,
    pub slivers: Vec<Vec3>,
    pub warped_faces: Vec<Vec3>,
    pub off_plane_faces: Vec<Vec3>,
    pub intersections: Vec<Vec3>,
}

impl Examples {
    pub fn of(found: &Diagnosis, mesh: &Mesh) -> Examples {
        let middle = |[a, b]: [u32; 2]| mesh.vertices[a as usize] * 0.5 + mesh.vertices[b as usize] * 0.5;
        let centre = |face: u32| mesh.box_of_input(face).center();
        Examples {
            nonmanifold_edges: first(&found.nonmanifold_edges, |e| middle(*e)),
            inconsistent_edges: first(&found.inconsistent_edges, |e| middle(e.vertices)),
            nonmanifold_vertices: first(&found.nonmanifold_vertices, |v| mesh.vertices[v.vertex as usize]),
            flat_faces: first(&found.flat_faces, |f| centre(*f)),
            duplicates: first(&found.duplicates, |d| centre(d.face)),
            slivers: first(&found.slivers, |s| centre(s.face)),
            warped_faces: first(&found.warped_faces, |s| centre(s.face)),
            off_plane_faces: first(&found.off_plane_faces, |s| centre(s.face)),
            intersections: Vec::new(),
        }
    }
}

fn first<T>(list: &[T], place: impl Fn(&T) -> Vec3) -> Vec<Vec3> {
    list.iter().take(SHOWN).map(place).collect()
}

impl Diagnosis {
    /// Adds what was found of a mesh's intersections.
    pub(crate) fn with_intersections(mut self, mesh: &Mesh, found: Intersections) -> Diagnosis {
        let between = |pair: &[u32; 2]| {
            let [a, b] = pair.map(|f| mesh.box_of_input(f));
            a.intersection(b).center()
        };
        self.examples.intersections = first(&found.pairs, between);
        self.intersections = Some(found);
        self
    }
}

impl Mesh {
    /// The box around an input face that is left.
    fn box_of_input(&self, face: u32) -> Aabb {
        let corners = self.half_edges.face_of_input(face).map(|f| self.half_edges.corners(f)).unwrap_or_default();
        Aabb::of(corners.iter().map(|&v| self.vertices[v as usize]))
    }
}
