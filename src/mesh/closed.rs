// SPDX-License-Identifier: MIT OR Apache-2.0
//! An open mesh with triangles that close it.

use super::edges::{Edges, turn_over};
use super::faces::Faces;
use super::half_edge::HalfEdges;
use super::orient::{self, Parts};
use super::{Data, Mesh, Orient, Surface, Triangle, measure};
use crate::error::{Error, Result, try_copy, try_with_capacity};
use crate::math::{Aabb, Vec3};

/// In the place of the face of a triangle that no input face is the origin of: one that closes the surface.
pub(crate) const NO_FACE: u32 = u32::MAX;

impl Mesh {
    /// The mesh, which holds no face twice, with more vertices, and with triangles that close it, on which no data are. It
    /// is oriented as if the triangles had been among the faces that were read.
    pub(crate) fn closed_by(&self, more: &[Vec3], closing: &[[u32; 3]]) -> Result<Mesh> {
        let count = self.triangles.len() + closing.len();
        if 3 * count >= u32::MAX as usize {
            return Err(Error::unsupported(format!(
                "mesh: closed, it has {} corners, more than {}",
                3 * count,
                u32::MAX - 1
            )));
        }
        let mut vertices = try_with_capacity("vertices", self.vertices.len() + more.len())?;
        vertices.extend(self.vertices.iter().chain(more));
        let mut triangles = try_with_capacity("triangles", count)?;
        triangles.extend_from_slice(&self.triangles);
        triangles.extend(closing.iter().map(|&vertices| Triangle { vertices, face: NO_FACE, turned: false }));
        if matches!(self.orient, Orient::Keep | Orient::Flip) {
            return self.closed_as(vertices, triangles, false);
        }
        // Whether parts that are closed now were consistent when they were read counts, as orient.rs has it. What
        // more than two faces meet in may then have come apart; as the loops were found it does not.
        if triangles.iter().any(|t| t.turned) {
            let mut as_read = try_copy("triangles", &triangles)?;
            as_read.iter_mut().filter(|t| t.turned).for_each(turn);
            let closed = self.closed_as(try_copy("vertices", &vertices)?, as_read, true)?;
            if closed.surface.unbalanced_edges == 0 {
                return Ok(closed);
            }
        }
        self.closed_as(vertices, triangles, true)
    }

    fn closed_as(&self, vertices: Vec<Vec3>, mut triangles: Vec<Triangle>, oriented: bool) -> Result<Mesh> {
        let mut faces = Faces::with_capacity(triangles.len(), 3 * triangles.len())?;
        triangles.iter().zip(0..).for_each(|(t, k)| faces.push(&t.vertices, k));
        let mut edges = Edges::of(vertices.len(), faces.half_edges())?;
        let of_half_edge = faces.of_half_edges()?;
        if oriented {
            let mut numbered = try_copy("triangles", &triangles)?;
            numbered.iter_mut().zip(0..).for_each(|(t, k)| t.face = k);
            let parts = Parts {
                vertices: &vertices,
                faces: &faces,
                triangles: &numbered,
                edges: &edges,
                of_half_edge: &of_half_edge,
            };
            let turned = orient::outward(&parts, self.orient == Orient::Alternate)?;
            turn_over(&faces.start, &mut faces.corners, &turned);
            edges = edges.renumbered(&faces, &of_half_edge, &turned);
            triangles.iter_mut().zip(&turned).filter(|(_, turned)| **turned).for_each(|(t, _)| turn(t));
        }
        let center = Aabb::of(vertices.iter().copied()).center();
        let volume = measure::volume(&vertices, &triangles, center);
        let surface = Surface::of(&faces, &edges, volume);
        let half_edges = HalfEdges::new(vertices.len(), faces, of_half_edge, &edges)?;
        Ok(Mesh {
            vertices,
            triangles,
            tags: try_copy("tags", &self.tags)?,
            tag_names: Vec::new(),
            data: Data::default(),
            face_count: self.face_count,
            shrunk: Vec::new(),
            half_edges,
            report: self.report.clone(),
            surface,
            orient: self.orient,
        })
    }
}

fn turn(t: &mut Triangle) {
    t.vertices.swap(1, 2);
    t.turned = !t.turned;
}
