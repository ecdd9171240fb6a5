// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether pseudonormals may decide the sign. They are right (Baerentzen & Aanaes 2005) where the surface
//! is embedded: where triangles meet in shared edges and vertices only, and each connected piece has the
//! outside on its outer and the inside on its inner side. Both are checked exactly when the geometry is
//! built. That is stronger than comparing each vertex and edge pseudonormal with a crossing count, which
//! misses an edge that pokes through a face between two vertices, and needs fewer crossing counts: one a
//! piece.

use super::{Sign, Surface};
use crate::error::{Error, Result, Status};
use crate::geometry::SignMethod;
use crate::math::{Aabb, Vec3};
use crate::mesh::{Mesh, Sets};
use crate::parallel::Run;
use crate::primitive::contact::{folded, runs_into, segment_touches};
use crate::primitive::triangle::{V3, nearest};
use std::collections::HashSet;
use std::sync::atomic::{AtomicU64, Ordering};

/// Triangles checked per chunk of work.
const CHUNK: usize = 1024;

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
        for (t, normals) in self.triangles.iter().zip(&mut self.edge_normals) {
            for (k, normal) in normals.iter_mut().enumerate() {
                if edges.contains(&undirected(t.vertex[k], t.vertex[(k + 1) % 3])) {
                    *normal = Vec3::ZERO;
                }
            }
        }
    }

    /// Hands the sign to the crossings where the surface is not embedded.
    pub(super) fn check_embedding(&mut self, asked: SignMethod, run: &Run) -> Result<()> {
        let fault = match self.first_contact(run)? {
            Some((t, s)) => {
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

    /// The lowest pair of triangles that meet where they should not.
    fn first_contact(&self, run: &Run) -> Result<Option<(u32, u32)>> {
        let least = AtomicU64::new(u64::MAX);
        run.for_each_chunk(self.triangles.len().div_ceil(CHUNK), &|chunk| {
            for t in chunk * CHUNK..self.triangles.len().min((chunk + 1) * CHUNK) {
                if let Some(s) = self.contact_of(t as u32) {
                    least.fetch_min((t as u64) << 32 | u64::from(s), Ordering::Relaxed);
                }
            }
            Ok(())
        })?;
        let least = least.into_inner();
        Ok((least != u64::MAX).then_some(((least >> 32) as u32, least as u32)))
    }

    /// The lowest triangle that an edge of `t` meets where it should not. Each edge is looked at from the
    /// triangle in which it rises to the higher vertex. A triangle without area is represented by its
    /// edges, which its neighbours share.
    fn contact_of(&self, t: u32) -> Option<u32> {
        let corners = self.corners(t);
        let vertex = self.triangles[t as usize].vertex;
        let mut found: Option<u32> = None;
        for k in (0..3).filter(|&k| vertex[k] < vertex[(k + 1) % 3]) {
            let edge = Aabb::of([corners[k], corners[(k + 1) % 3]]);
            let edge = Aabb::new(edge.lo - self.rounding(), edge.hi + self.rounding());
            self.overlapping(edge, |s| {
                let is_better = s != t && found.is_none_or(|f| s < f);
                if is_better && self.touches(t, k, s, edge) {
                    found = Some(s);
                }
            });
        }
        found
    }

    /// Walls thinner than this have one side to a point beside them: either of their faces may be the nearest.
    fn rounding(&self) -> f64 {
        16.0 * f64::EPSILON * self.diagonal
    }

    fn is_near(&self, p: Vec3, triangle: u32) -> bool {
        let foot = nearest(&self.prepared(triangle), V3::from_vec(p));
        foot.squared <= self.rounding() * self.rounding()
    }

    /// Whether edge `k` of triangle `t` meets triangle `s` beyond what they share. `edge` is the box around it.
    fn touches(&self, t: u32, k: usize, s: u32, edge: Aabb) -> bool {
        let other = self.corners(s);
        if Aabb::of(other).intersection(edge).is_empty() || self.normal(s) == Vec3::ZERO {
            return false;
        }
        let (corners, vertex) = (self.corners(t), self.triangles[t as usize].vertex);
        let (i, j) = (k, (k + 1) % 3);
        let of_other = self.triangles[s as usize].vertex;
        let at = |v: u32| of_other.iter().position(|&w| w == v);
        let from = |first: usize| [other[first], other[(first + 1) % 3], other[(first + 2) % 3]];
        match (at(vertex[i]), at(vertex[j])) {
            (None, None) => {
                let is_near = |k: usize| self.is_near(corners[k], s);
                segment_touches(corners[i], corners[j], other) || is_near(i) || is_near(j)
            }
            (Some(shared), None) => runs_into(corners[j], from(shared)),
            (None, Some(shared)) => runs_into(corners[i], from(shared)),
            (Some(_), Some(end)) => folded(corners[(k + 2) % 3], from(end)),
        }
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
