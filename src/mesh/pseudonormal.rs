// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pseudonormals: Baerentzen & Aanaes 2005, "Signed distance computation using the angle weighted
//! pseudonormal"; angles after Thürmer & Wüthrich 1998.

use super::Pseudonormals;
use super::Triangle;
use super::edges::Edges;
use super::faces::filled;
use super::measure::corners;
use crate::error::{Result, try_with_capacity};
use crate::math::{Vec3, cross_of_differences, length, unit};
use crate::primitive::polygon;

impl Pseudonormals {
    pub(super) fn of(vertices: &[Vec3], triangles: &[Triangle]) -> Result<Pseudonormals> {
        let mut normals = Pseudonormals {
            triangle: try_with_capacity("triangle normals", triangles.len())?,
            edge: filled("edge normals", triangles.len(), [Vec3::ZERO; 3])?,
            vertex: filled("vertex normals", vertices.len(), Vec3::ZERO)?,
        };
        for t in triangles {
            let [a, b, c] = corners(vertices, t);
            // A triangle of zero area has no side, and must not lend one to its neighbours.
            if polygon::are_collinear(a, b, c) {
                normals.triangle.push(Vec3::ZERO);
                continue;
            }
            let cross = cross_of_differences(a, b, c);
            let normal = unit(cross);
            normals.triangle.push(normal);
            let twice_area = length(cross);
            for (v, (p, q, r)) in t.vertices.iter().zip([(a, b, c), (b, c, a), (c, a, b)]) {
                normals.vertex[*v as usize] += libm::atan2(twice_area, (q - p).dot(r - p)) * normal;
            }
        }
        normals.add_edges(vertices.len(), triangles)?;
        Ok(normals)
    }

    fn add_edges(&mut self, vertices: usize, triangles: &[Triangle]) -> Result<()> {
        let edges = Edges::of(
            vertices,
            triangles.iter().flat_map(|t| {
                let [a, b, c] = t.vertices;
                [(a, b), (b, c), (c, a)]
            }),
        )?;
        for edge in edges.iter() {
            let sum = edge.iter().fold(Vec3::ZERO, |sum, &h| sum + self.triangle[h as usize / 3]);
            for &h in edge {
                self.edge[h as usize / 3][h as usize % 3] = sum;
            }
        }
        Ok(())
    }
}
