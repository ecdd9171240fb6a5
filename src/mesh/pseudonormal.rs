// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pseudonormals: Baerentzen & Aanaes 2005, "Signed distance computation using the angle weighted
//! pseudonormal"; angles after Thürmer & Wüthrich 1998.

use super::Pseudonormals;
use super::Triangle;
use super::edges::Edges;
use super::measure::corners;
use crate::error::{Result, filled, try_with_capacity};
use crate::math::{Vec3, cross_of_differences, length, unit};
use crate::primitive::polygon;

/// The unit normal of a triangle and the angles that weigh it at its corners; none where its area is zero: it has no side
/// then, and must not lend one to its neighbours.
pub(crate) fn normal_and_angles([a, b, c]: [Vec3; 3]) -> (Vec3, Option<[f64; 3]>) {
    let cross = cross_of_differences(a, b, c);
    let twice_area = length(cross);
    let angle = |p: Vec3, q: Vec3, r: Vec3| libm::atan2(twice_area, (q - p).dot(r - p));
    let angles = (!polygon::are_collinear(a, b, c)).then(|| [angle(a, b, c), angle(b, c, a), angle(c, a, b)]);
    (unit(cross), angles)
}

impl Pseudonormals {
    pub(super) fn of(vertices: &[Vec3], triangles: &[Triangle]) -> Result<Pseudonormals> {
        let mut normals = Pseudonormals {
            triangle: try_with_capacity("triangle normals", triangles.len())?,
            edge: filled("edge normals", triangles.len(), [Vec3::ZERO; 3])?,
            vertex: filled("vertex normals", vertices.len(), Vec3::ZERO)?,
        };
        for t in triangles {
            let (normal, angles) = normal_and_angles(corners(vertices, t));
            let Some(angles) = angles else {
                normals.triangle.push(Vec3::ZERO);
                continue;
            };
            normals.triangle.push(normal);
            for (v, angle) in t.vertices.iter().zip(angles) {
                normals.vertex[*v as usize] += angle * normal;
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
