// SPDX-License-Identifier: MIT OR Apache-2.0
//! Single faces, edges and vertices: their measures, and the signed distance to one of them alone, by its
//! pseudonormal (Baerentzen & Aanaes 2005).

use super::Mesh;
use super::measure::{Sum, area, twice_area};
use crate::math::{Vec3, cross_of_differences, length, positive_zero, unit};
use crate::primitive::inside::{Inside, contains};
use crate::primitive::polygon::{are_collinear, area_vector, foot_on_plane, projection};
use crate::primitive::triangle::{self, Prepared, V3, nearest};
use std::ops::Range;

/// One element of the surface as it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// A face of [`Mesh::half_edges`].
    Face(u32),
    /// The edge of a half-edge.
    Edge(u32),
    /// A vertex.
    Vertex(u32),
}

/// What there is to measure of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Unit normal: of a face that of its area vector; of an edge and a vertex the pseudonormal. Zero where
    /// there is none.
    pub normal: Vec3,
    /// Centroid: of a face by area (by its corners where it has none), of an edge its middle, of a vertex
    /// the vertex.
    pub centroid: Vec3,
    /// Area of a face, length of an edge, 0 for a vertex.
    pub size: f64,
}

impl Mesh {
    /// The measures of an element. Linear in the faces at it. Panics on a number out of range, as indexing does.
    pub fn measure(&self, element: Element) -> Measure {
        match element {
            Element::Face(f) => self.measure_face(f),
            Element::Edge(h) => {
                let [a, b] = self.ends(h);
                Measure { normal: unit(self.edge_normal(h)), centroid: a + (b - a) * 0.5, size: length(b - a) }
            }
            Element::Vertex(v) => {
                Measure { normal: unit(self.vertex_normal(v)), centroid: self.vertices()[v as usize], size: 0.0 }
            }
        }
    }

    /// Signed distance from a point to one element alone, and the nearest point of it. The magnitude is the
    /// distance; negative where the point is behind the element's normal. Panics on a number out of range.
    pub fn distance(&self, element: Element, p: Vec3) -> (f64, Vec3) {
        let (foot, normal) = match element {
            Element::Face(f) => (self.foot_on_face(f, p), self.measure_face(f).normal),
            Element::Edge(h) => {
                let [a, b] = self.ends(h);
                let squared = (b - a).dot(b - a);
                let along = if squared > 0.0 { ((p - a).dot(b - a) / squared).clamp(0.0, 1.0) } else { 0.0 };
                (a + (b - a) * along, self.edge_normal(h))
            }
            Element::Vertex(v) => (self.vertices()[v as usize], self.vertex_normal(v)),
        };
        let distance = length(p - foot);
        let behind = (p - foot).dot(normal) < 0.0;
        (positive_zero(if behind { -distance } else { distance }), foot + Vec3::ZERO)
    }

    /// Whether a point lies in a face of [`Mesh::half_edges`]: off its plane, whether its foot along the normal of the
    /// area vector does. Corners off the plane through the first count by their feet, too. Exact for what is in the
    /// plane to rounding. Panics on a number out of range.
    pub fn face_contains(&self, f: u32, p: Vec3, how: Inside) -> bool {
        let corners = self.half_edges().corners(f).iter().map(|&v| self.vertices()[v as usize]);
        let first = self.vertices()[self.half_edges().corners(f)[0] as usize];
        let area = area_vector(corners.clone());
        let ([u, v], normal) = (projection(area), unit(area));
        let flat = |q: Vec3| {
            let foot = foot_on_plane(q, first, normal);
            [foot[u], foot[v]]
        };
        contains(corners.map(flat), flat(p), how)
    }

    fn measure_face(&self, f: u32) -> Measure {
        let corners = || self.half_edges().corners(f).iter().map(|&v| self.vertices()[v as usize]);
        let first = self.vertices()[self.half_edges().corners(f)[0] as usize];
        let (mut size, mut moment) = (Sum::default(), [Sum::default(); 3]);
        for t in self.pieces(f) {
            let piece = area(t);
            size.add(piece);
            let offset = ((t[0] - first) + (t[1] - first) + (t[2] - first)) / 3.0 * piece;
            moment.iter_mut().zip(offset.to_array()).for_each(|(m, c)| m.add(c));
        }
        let size = size.value();
        let offset = if size > 0.0 {
            Vec3::from_array(moment.map(Sum::value)) / size
        } else {
            corners().map(|p| p - first).sum::<Vec3>() / corners().count() as f64
        };
        // Of a triangle the bits that decide its sign.
        let normal = match self.triangles_of(f) {
            Range { start, end } if end - start == 1 => self.piece_normal(start),
            _ => unit(area_vector(corners())),
        };
        Measure { normal, centroid: first + offset, size }
    }

    fn pieces(&self, f: u32) -> impl Iterator<Item = [Vec3; 3]> {
        self.triangles()[self.triangles_of(f)].iter().map(|t| t.corners(self.vertices()))
    }

    fn ends(&self, half_edge: u32) -> [Vec3; 2] {
        let topology = self.half_edges();
        [topology.origin(half_edge), topology.target(half_edge)].map(|v| self.vertices()[v as usize])
    }

    /// Unit normal of a triangle; zero where its area is.
    fn piece_normal(&self, triangle: usize) -> Vec3 {
        let [a, b, c] = self.triangles()[triangle].corners(self.vertices());
        if are_collinear(a, b, c) { Vec3::ZERO } else { unit(cross_of_differences(a, b, c)) }
    }

    /// The sum of the unit normals of the triangles at an edge.
    fn edge_normal(&self, half_edge: u32) -> Vec3 {
        let topology = self.half_edges();
        let (from, to) = (topology.origin(half_edge), topology.target(half_edge));
        let leaving = |a: u32, b: u32| topology.outgoing(a).iter().copied().filter(move |&h| topology.target(h) == b);
        let mut faces: Vec<u32> = leaving(from, to).chain(leaving(to, from)).map(|h| topology.face(h)).collect();
        faces.sort_unstable();
        faces.dedup();
        let mut sum = Vec3::ZERO;
        for f in faces {
            for t in self.triangles_of(f) {
                let v = self.triangles()[t].vertices;
                let has_edge = (0..3).any(|k| {
                    let ends = (v[k], v[(k + 1) % 3]);
                    ends == (from, to) || ends == (to, from)
                });
                if has_edge {
                    sum += self.piece_normal(t);
                }
            }
        }
        sum
    }

    /// The sum of the unit normals of the triangles at a vertex, weighted by the angle.
    fn vertex_normal(&self, vertex: u32) -> Vec3 {
        let topology = self.half_edges();
        let mut faces: Vec<u32> = topology.outgoing(vertex).iter().map(|&h| topology.face(h)).collect();
        faces.dedup();
        let mut sum = Vec3::ZERO;
        for t in faces.into_iter().flat_map(|f| self.triangles_of(f)) {
            let corners = self.triangles()[t].corners(self.vertices());
            for k in (0..3).filter(|&k| self.triangles()[t].vertices[k] == vertex) {
                let (p, q, r) = (corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
                let angle = libm::atan2(length(twice_area(corners)), (q - p).dot(r - p));
                sum += angle * self.piece_normal(t);
            }
        }
        sum
    }

    fn foot_on_face(&self, f: u32, p: Vec3) -> Vec3 {
        let mut best = (f64::INFINITY, p);
        for corners in self.pieces(f) {
            let prepared = Prepared::new(corners);
            let foot = nearest(&prepared, V3::from_vec(p));
            if foot.squared < best.0 {
                best = (foot.squared, triangle::point(corners, triangle::normal(corners), p, &foot));
            }
        }
        if best.0 == f64::INFINITY { self.vertices()[self.half_edges().corners(f)[0] as usize] } else { best.1 }
    }
}
