// SPDX-License-Identifier: MIT OR Apache-2.0
//! The solid angle of some triangles by its expansion about their middle, to first order (Barill et al. 2018, "Fast
//! winding numbers for soups and clouds"), with a bound on the rest.
//!
//! With F(y) = y / |y|^3 the solid angle is the sum of n F(x - p) over the area. About the middle c, with r = c - p, it is
//! N F(r) + M : DF(r), N the sum of n and M that of (x - c) n, and the second derivative of F, the third of 1 / |y|, is
//! nowhere above 6 / |y|^4: what is left out is at most 3 A R^2 / (|r| - R)^4 for an area A within R of c.

use crate::math::{Vec3, length};
use crate::store::plain;

#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(super) struct Expansion {
    center: Vec3,
    /// Everything is within this of the centre.
    radius: f64,
    pub(super) area: f64,
    /// The sum of the area vectors.
    normal: Vec3,
    /// Columns of M: x - c times each component of n.
    moment: [Vec3; 3],
}

plain! {
    Expansion { center: Vec3, radius: f64, area: f64, normal: Vec3, moment: [Vec3; 3] }
}

/// Of rounding, relative to the solid angle that the area could have.
const ROUNDING: f64 = 1e-12;

impl Expansion {
    pub(super) fn of(triangles: &[[Vec3; 3]]) -> Expansion {
        let middle = |t: &[Vec3; 3]| t[0] / 3.0 + t[1] / 3.0 + t[2] / 3.0;
        let vector = |t: &[Vec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]) * 0.5;
        let (mut area, mut center, mut any) = (0.0, Vec3::ZERO, Vec3::ZERO);
        // About the first corner, where products do not cancel.
        let from = triangles[0][0];
        for t in triangles {
            let own = length(vector(t));
            area += own;
            center += (middle(t) - from) * own;
            any += (middle(t) - from) / triangles.len() as f64;
        }
        let center = from + if area > 0.0 && (center / area).is_finite() { center / area } else { any };
        let (mut radius, mut normal, mut moment) = (0.0f64, Vec3::ZERO, [Vec3::ZERO; 3]);
        for t in triangles {
            let (n, off) = (vector(t), middle(t) - center);
            normal += n;
            for (k, column) in moment.iter_mut().enumerate() {
                *column += off * n[k];
            }
            radius = t.iter().fold(radius, |most, c| most.max(length(*c - center)));
        }
        Expansion { center, radius: radius * (1.0 + 1e-12), area: area * (1.0 + 1e-12), normal, moment }
    }

    /// The solid angle from a point, and how far off it may be: infinitely where the point is near.
    pub(super) fn solid_angle(&self, p: Vec3) -> (f64, f64) {
        let r = self.center - p;
        let far = length(r);
        let clear = far - self.radius;
        if clear <= 0.5 * self.radius || far == 0.0 {
            return (0.0, f64::INFINITY);
        }
        let (u, [x, y, z]) = (r / far, self.moment);
        let first = self.normal.dot(u) / (far * far);
        let trace = x.x + y.y + z.z;
        let along = u.dot(x) * u.x + u.dot(y) * u.y + u.dot(z) * u.z;
        let second = (trace - 3.0 * along) / (far * far * far);
        let (spread, seen) = (self.radius / clear, self.area / (clear * clear));
        (first + second, seen * (3.0 * spread * spread + ROUNDING))
    }
}
