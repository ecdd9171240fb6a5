// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether pseudonormals may decide the sign. They are right (Baerentzen & Aanaes 2005) where the surface
//! is embedded: where triangles meet in shared edges and vertices only, and each connected piece has the
//! outside on its outer and the inside on its inner side. Both are checked exactly when the geometry is
//! built. That is stronger than comparing each vertex and edge pseudonormal with a crossing count, which
//! misses an edge that pokes through a face between two vertices, and needs fewer crossing counts: one a
//! piece.

use super::{NO_TRIANGLE, Sign, Surface, UNCLEAR};
use crate::bvh::Leaves;
use crate::error::{Error, Result, Status, try_with_capacity};
use crate::geometry::SignMethod;
use crate::geometry::contacts::Contacts;
use crate::math::Vec3;
use crate::mesh::{HalfEdges, Mesh, Sets};
use crate::parallel::Run;
use std::collections::HashSet;

impl Surface {
    /// Zeroes the pseudonormals that say nothing of the surface beyond them, and leaves those places to
    /// the crossings: at triangles without area, and at vertices where several fans of faces meet.
    pub(super) fn distrust_unclear_normals(&mut self, mesh: &Mesh) {
        let topology = mesh.half_edges();
        for (v, normal) in self.vertex_normals.iter_mut().enumerate() {
            let outgoing = topology.outgoing(v as u32);
            if outgoing.first().is_none_or(|&h| topology.around_vertex(h).count() != outgoing.len()) {
                *normal = Vec3::ZERO;
            }
        }
        let mut edges = HashSet::new();
        for t in 0..self.triangles.len() {
            if self.normal(t as u32) == Vec3::ZERO {
                let v = self.triangles[t].vertex;
                for k in 0..3 {
                    self.vertex_normals[v[k] as usize] = Vec3::ZERO;
                    edges.insert(undirected(v[k], v[(k + 1) % 3]));
                }
            }
        }
        if edges.is_empty() {
            return;
        }
        for (t, neighbours) in self.triangles.iter().zip(&mut self.neighbours) {
            for (k, neighbour) in neighbours.iter_mut().enumerate() {
                if edges.contains(&undirected(t.vertex[k], t.vertex[(k + 1) % 3])) {
                    *neighbour = UNCLEAR;
                }
            }
        }
    }

    /// Hands the sign to the crossings where the surface is not embedded. `topology` is that of the triangles.
    pub(super) fn check_embedding(
        &mut self,
        mesh: &Mesh,
        topology: &HalfEdges,
        asked: SignMethod,
        run: &Run,
    ) -> Result<()> {
        let fault = match self.contact(mesh, topology, run)? {
            Some([t, s]) => {
                format!(
                    "faces {} and {} meet, but for rounding, where they share no edge or vertex",
                    self.face(t),
                    self.face(s)
                )
            }
            None => match self.first_misplaced_piece()? {
                Some(t) => format!("the piece of face {} lies inside another, or is inside out", self.face(t)),
                None => return Ok(()),
            },
        };
        if asked == SignMethod::Pseudonormal {
            let message = format!("options.sign: PSEUDONORMAL is not right on this mesh: {fault}; use AUTO or RAY");
            return Err(Error::new(Status::Topology, message));
        }
        self.sign = Sign::Crossings;
        Ok(())
    }

    /// A pair of triangles that meet where they should not: of all such pairs the same one in every run.
    fn contact(&self, mesh: &Mesh, topology: &HalfEdges, run: &Run) -> Result<Option<[u32; 2]>> {
        let Some(tree) = &self.tree else { return Ok(None) };
        let contacts = Contacts::new(&self.vertices, mesh.triangles(), topology, self.rounding(), false)?;
        let mut order = try_with_capacity("triangles", self.triangles.len())?;
        let mut start = try_with_capacity("leaves", self.leaves.len() + 1)?;
        start.push(0);
        for leaf in &self.leaves {
            order.extend(leaf.triangle.iter().filter(|t| **t != NO_TRIANGLE));
            start.push(order.len() as u32);
        }
        Ok(contacts.find(tree, &Leaves { order, start }, 1, run)?.pairs.first().copied())
    }

    /// Walls thinner than this have one side to a point beside them: either of their faces may be the nearest.
    fn rounding(&self) -> f64 {
        16.0 * f64::EPSILON * self.diagonal
    }

    /// The first triangle of the first connected piece whose two sides are not outside and inside.
    fn first_misplaced_piece(&self) -> Result<Option<u32>> {
        let mut pieces = Sets::new(self.vertices.len())?;
        for t in &self.triangles {
            pieces.join(t.vertex[0], t.vertex[1]);
            pieces.join(t.vertex[0], t.vertex[2]);
        }
        let mut seen = HashSet::new();
        Ok((0..self.triangles.len() as u32).find(|&t| {
            let normal = self.normal(t);
            let piece = pieces.find(self.triangles[t as usize].vertex[0]);
            normal != Vec3::ZERO && seen.insert(piece) && !self.sides_are_right(t, normal)
        }))
    }

    fn sides_are_right(&self, t: u32, normal: Vec3) -> bool {
        let [a, b, c] = self.corners(t);
        let middle = a / 3.0 + b / 3.0 + c / 3.0;
        let size = (b - a).length().max((c - b).length()).max((a - c).length());
        // Large beside the rounding of the coordinates, and small beside any wall that has two sides.
        let step = 64.0 * f64::EPSILON * size.max(middle.abs().max_element());
        (self.winding(middle + normal * step), self.winding(middle - normal * step)) == (0, 1)
    }
}

fn undirected(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}
