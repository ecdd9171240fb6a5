// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bvh crate's nearest shape, over triangles. The distance to a triangle is the one by regions of
//! C. Ericson, Real-Time Collision Detection, 5.1.5.

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use bvh::point_query::PointDistance;
use case::Case;
use nalgebra::{Point3, Vector3};

struct Triangle {
    corners: [Point3<f64>; 3],
    node: usize,
}

/// The hierarchy and what it is over.
pub struct Boxes {
    tree: Bvh<f64, 3>,
    triangles: Vec<Triangle>,
}

pub fn build(case: &Case) -> Boxes {
    let corners = |t: &[u32; 3]| t.map(|v| Point3::from(case.vertices[v as usize]));
    let mut triangles: Vec<Triangle> =
        case.triangles.iter().map(|t| Triangle { corners: corners(t), node: 0 }).collect();
    let tree = Bvh::build(&mut triangles);
    Boxes { tree, triangles }
}

impl Boxes {
    pub fn distance(&self, p: [f64; 3]) -> f64 {
        self.tree.nearest_to(Point3::from(p), &self.triangles).map_or(f64::NAN, |(_, distance)| distance)
    }
}

impl Bounded<f64, 3> for Triangle {
    fn aabb(&self) -> Aabb<f64, 3> {
        self.corners.iter().fold(Aabb::empty(), |b, c| b.grow(c))
    }
}

impl BHShape<f64, 3> for Triangle {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl PointDistance<f64, 3> for Triangle {
    fn distance_squared(&self, p: Point3<f64>) -> f64 {
        (p - self.closest(p)).norm_squared()
    }
}

impl Triangle {
    fn closest(&self, p: Point3<f64>) -> Point3<f64> {
        let [a, b, c] = self.corners;
        let (ab, ac) = (b - a, c - a);
        let along = |from: Point3<f64>| -> (f64, f64) { (ab.dot(&(p - from)), ac.dot(&(p - from))) };
        let ((d1, d2), (d3, d4), (d5, d6)) = (along(a), along(b), along(c));
        if d1 <= 0.0 && d2 <= 0.0 {
            return a;
        }
        if d3 >= 0.0 && d4 <= d3 {
            return b;
        }
        if d6 >= 0.0 && d5 <= d6 {
            return c;
        }
        let vc = d1 * d4 - d3 * d2;
        if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
            return a + ab * (d1 / (d1 - d3));
        }
        let vb = d5 * d2 - d1 * d6;
        if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
            return a + ac * (d2 / (d2 - d6));
        }
        let va = d3 * d6 - d5 * d4;
        let (u, v) = (d4 - d3, d5 - d6);
        if va <= 0.0 && u >= 0.0 && v >= 0.0 {
            return b + (c - b) * (u / (u + v));
        }
        let inverse: f64 = 1.0 / (va + vb + vc);
        let step: Vector3<f64> = ab * (vb * inverse) + ac * (vc * inverse);
        a + step
    }
}
