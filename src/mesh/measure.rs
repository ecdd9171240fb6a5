// SPDX-License-Identifier: MIT OR Apache-2.0
//! Volume and area of triangles, summed with compensation (Neumaier 1974): the same bits every time.

use super::Triangle;
use crate::math::{Vec3, length};

/// A compensated sum.
#[derive(Clone, Copy, Default)]
pub(super) struct Sum {
    total: f64,
    lost: f64,
}

impl Sum {
    pub fn add(&mut self, x: f64) {
        let t = self.total + x;
        self.lost += if self.total.abs() >= x.abs() { (self.total - t) + x } else { (x - t) + self.total };
        self.total = t;
    }

    pub fn value(self) -> f64 {
        self.total + self.lost
    }
}

/// The corners of a triangle.
pub(super) fn corners(vertices: &[Vec3], t: &Triangle) -> [Vec3; 3] {
    t.vertices.map(|v| vertices[v as usize])
}

/// Area of a triangle, and signed volume of the cone from `apex` over it.
pub(super) fn area_and_cone([a, b, c]: [Vec3; 3], apex: Vec3) -> (f64, f64) {
    let cross = (b - a).cross(c - a);
    (0.5 * length(cross), (a - apex).dot(cross) * (1.0 / 6.0))
}

/// Area of a triangle.
pub(super) fn area([a, b, c]: [Vec3; 3]) -> f64 {
    0.5 * length((b - a).cross(c - a))
}

/// Signed volume of the cone from `apex` over a triangle.
pub(super) fn cone([a, b, c]: [Vec3; 3], apex: Vec3) -> f64 {
    (a - apex).dot((b - a).cross(c - a)) * (1.0 / 6.0)
}

/// Signed volume by the divergence theorem about `apex`: of a closed surface, whatever the apex is.
pub(super) fn volume(vertices: &[Vec3], triangles: &[Triangle], apex: Vec3) -> f64 {
    let mut sum = Sum::default();
    for t in triangles {
        sum.add(cone(corners(vertices, t), apex));
    }
    sum.value()
}
