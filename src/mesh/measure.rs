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

/// The corners of a triangle. (Not by `map`, which may cost more than the corners where it is not inlined.)
#[inline]
pub(super) fn corners(vertices: &[Vec3], t: &Triangle) -> [Vec3; 3] {
    let [a, b, c] = t.vertices;
    [vertices[a as usize], vertices[b as usize], vertices[c as usize]]
}

/// Twice the area vector of a triangle.
pub(super) fn twice_area([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a)
}

/// The flux of the field (x, 0, 0) through a surface: by the divergence theorem the volume it encloses, if it
/// is closed. Summed about the plane x = `origin`, where the rounding of a part far away from 0 is small.
pub(super) struct Flux {
    about_origin: Sum,
    /// Twice the area as seen along x: of a closed surface nothing.
    shadow: Sum,
    origin: f64,
}

impl Flux {
    pub fn new(origin: f64) -> Flux {
        Flux { about_origin: Sum::default(), shadow: Sum::default(), origin }
    }

    /// Adds a triangle, given with its [`twice_area`].
    pub fn add(&mut self, [a, b, c]: [Vec3; 3], twice_area: Vec3) {
        let thrice = (a.x - self.origin) + (b.x - self.origin) + (c.x - self.origin);
        self.about_origin.add(thrice * twice_area.x * (1.0 / 6.0));
        self.shadow.add(twice_area.x);
    }

    /// The flux, of a surface that is closed, or at least winds around everything a whole number of times.
    pub fn closed(&self) -> f64 {
        self.about_origin.value()
    }

    /// The flux of any surface.
    pub fn open(&self) -> f64 {
        self.about_origin.value() + 0.5 * self.origin * self.shadow.value()
    }
}

/// Area of a triangle.
pub(super) fn area(corners: [Vec3; 3]) -> f64 {
    0.5 * length(twice_area(corners))
}

/// Signed volume of the cone from `apex` over a triangle.
pub(super) fn cone([a, b, c]: [Vec3; 3], apex: Vec3) -> f64 {
    (a - apex).dot((b - a).cross(c - a)) * (1.0 / 6.0)
}

/// Signed volume by the divergence theorem about `apex`: of a closed surface, whatever the apex is.
pub(crate) fn volume(vertices: &[Vec3], triangles: &[Triangle], apex: Vec3) -> f64 {
    let mut sum = Sum::default();
    for t in triangles {
        sum.add(cone(corners(vertices, t), apex));
    }
    sum.value()
}
