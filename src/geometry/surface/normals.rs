// SPDX-License-Identifier: MIT OR Apache-2.0
//! Normals of the triangles and pseudonormals of the vertices (Baerentzen & Aanaes 2005; angles after Thürmer & Wüthrich
//! 1998), triangle by triangle and vertex by vertex, and which of them say nothing of the surface.

use super::{PIECE, Surface, UNCLEAR};
use crate::error::{Result, filled, try_with_capacity};
use crate::math::Vec3;
use crate::mesh::{HalfEdges, normal_and_angles};
use crate::parallel::Run;
use std::collections::HashSet;

/// The normal of a triangle and what its corners add to the pseudonormals there.
#[derive(Clone, Copy)]
struct Share {
    normal: Vec3,
    angles: [f64; 3],
}

/// Of all triangles, unit vectors but for those without area, and of all vertices. `topology` is that of the triangles.
pub(super) fn normals(
    count: usize,
    corners: &(dyn Fn(usize) -> [Vec3; 3] + Sync),
    topology: &HalfEdges,
    vertices: usize,
    run: &Run,
) -> Result<(Vec<Vec3>, Vec<Vec3>)> {
    let mut shares = filled("normals", count, Share { normal: Vec3::ZERO, angles: [0.0; 3] })?;
    run.for_each_piece(&mut shares, PIECE, &|from, shares| {
        shares.iter_mut().zip(from..).for_each(|(share, t)| *share = Share::of(corners(t)));
        Ok(())
    })?;
    let mut of_vertices = filled("vertex normals", vertices, Vec3::ZERO)?;
    run.for_each_piece(&mut of_vertices, PIECE, &|from, normals| {
        for (normal, v) in normals.iter_mut().zip(from..) {
            for &h in topology.outgoing(v as u32) {
                let Share { normal: own, angles } = shares[h as usize / 3];
                *normal += angles[h as usize % 3] * own;
            }
        }
        Ok(())
    })?;
    let mut of_triangles = try_with_capacity("normals", count)?;
    of_triangles.extend(shares.iter().map(|share| share.normal));
    Ok((of_triangles, of_vertices))
}

impl Share {
    fn of(corners: [Vec3; 3]) -> Share {
        let (normal, angles) = normal_and_angles(corners);
        Share { normal, angles: angles.unwrap_or([0.0; 3]) }
    }
}

impl Surface {
    /// Zeroes the pseudonormals that say nothing of the surface beyond them, and leaves those places to
    /// the crossings: at triangles without area, and at vertices where several fans of triangles meet. `topology` is
    /// that of the triangles.
    pub(super) fn distrust_unclear_normals(&mut self, topology: &HalfEdges, run: &Run) -> Result<()> {
        run.for_each_piece(self.vertex_normals.edit("normals")?, PIECE, &|from, normals| {
            for (normal, v) in normals.iter_mut().zip(from..) {
                let outgoing = topology.outgoing(v as u32);
                if outgoing.first().is_none_or(|&h| topology.around_vertex(h).count() != outgoing.len()) {
                    *normal = Vec3::ZERO;
                }
            }
            Ok(())
        })?;
        let mut edges = HashSet::new();
        let vertex_normals = self.vertex_normals.edit("normals")?;
        for (v, normal) in self.triangles.vertex.iter().zip(&self.normals) {
            if *normal == Vec3::ZERO {
                for k in 0..3 {
                    vertex_normals[v[k] as usize] = Vec3::ZERO;
                    edges.insert(undirected(v[k], v[(k + 1) % 3]));
                }
            }
        }
        if edges.is_empty() {
            return Ok(());
        }
        let triangles = self.triangles.clone();
        for (t, neighbours) in triangles.vertex.iter().zip(self.own_neighbours()?) {
            for (k, neighbour) in neighbours.iter_mut().enumerate() {
                if edges.contains(&undirected(t[k], t[(k + 1) % 3])) {
                    *neighbour = UNCLEAR;
                }
            }
        }
        Ok(())
    }

    /// Makes sure that no other surface shares the neighbours, which are going to be marked.
    pub(super) fn own_neighbours(&mut self) -> Result<&mut [[u32; 3]]> {
        self.neighbours.edit("neighbours")
    }
}

fn undirected(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}
