// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rays and triangles, watertight. On which side of an edge a ray passes is the sign of one determinant (as in Woop,
//! Benthin & Wald 2013, without their rounded shear), in plain arithmetic where that is certain and exactly where it
//! is not. A ray that meets an edge exactly is moved by an infinitesimal (e, e^2, e^3), the same for every triangle
//! (Edelsbrunner & Muecke 1990): so moved it meets no edge, and passes through a closed mesh as often inwards as
//! outwards. Whether a meeting lies within the ray's range is decided exactly, too.

use crate::math::{Expansion, Vec3, difference, plane_and_ray, positive_zero, product};

/// Half a unit in the last place of 1.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// What a determinant is off by, relative to the sum of the magnitudes of its terms: Shewchuk's bound for orient3d.
const SIDE_ERROR: f64 = 8.0 * UNIT;

/// The same of the plane's distance along a ray.
const RANGE_ERROR: f64 = 16.0 * UNIT;

/// Keeps underflow from being taken for certainty.
const TINY: f64 = 1e-290;

/// The points `origin + t * direction` with t between two numbers, both of them included. The direction is scaled by a
/// power of two so that its largest coordinate is at least 1 and below 2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub(crate) origin: Vec3,
    pub(crate) direction: Vec3,
    /// What t is multiplied by where the direction is scaled: a power of two.
    scale: f64,
    /// The range, so scaled.
    pub(crate) from: f64,
    pub(crate) to: f64,
}

impl Ray {
    /// None where the origin or the direction is not finite, or the direction zero or too small to be told from it.
    pub(crate) fn new(origin: Vec3, direction: Vec3, [from, to]: [f64; 2]) -> Option<Ray> {
        let largest = direction.abs().max_element();
        if !origin.is_finite() || !direction.is_finite() || largest < f64::MIN_POSITIVE {
            return None;
        }
        // The power of two below it; its inverse is a double, too.
        let scale = f64::from_bits(largest.to_bits() & 0x7FF0_0000_0000_0000);
        let direction = direction * (1.0 / scale);
        Some(Ray { origin, direction, scale, from: from * scale, to: to * scale })
    }

    /// t as the caller counts it.
    pub(crate) fn unscaled(&self, t: f64) -> f64 {
        t / self.scale
    }

    /// And back.
    pub(crate) fn scaled(&self, t: f64) -> f64 {
        t * self.scale
    }

    /// +1 where the ray passes through the triangle towards the side that its corners are counter-clockwise seen from
    /// (it leaves the body there), -1 where the other way, 0 where it misses it.
    #[inline(always)]
    pub(crate) fn meets(&self, corners: [Vec3; 3]) -> i32 {
        let turn = self.line_meets(corners);
        if turn == 0 || !self.reaches(corners, turn) { 0 } else { turn }
    }

    /// The same of the line.
    #[inline(always)]
    fn line_meets(&self, corners: [Vec3; 3]) -> i32 {
        let d = self.direction;
        // (No `map`, which is not always inlined, here and below.)
        let at = [corners[0] - self.origin, corners[1] - self.origin, corners[2] - self.origin];
        let mut side = [0; 3];
        for k in 0..3 {
            let (u, v) = (at[k], at[(k + 1) % 3]);
            let (a, b, c) = ((u.y * v.z, u.z * v.y), (u.z * v.x, u.x * v.z), (u.x * v.y, u.y * v.x));
            let volume = d.x * (a.0 - a.1) + d.y * (b.0 - b.1) + d.z * (c.0 - c.1);
            let terms = d.x.abs() * (a.0.abs() + a.1.abs())
                + d.y.abs() * (b.0.abs() + b.1.abs())
                + d.z.abs() * (c.0.abs() + c.1.abs());
            let error = SIDE_ERROR * terms + TINY;
            side[k] = i32::from(volume > error) - i32::from(volume < -error);
        }
        let (least, most) = (side[0].min(side[1]).min(side[2]), side[0].max(side[1]).max(side[2]));
        if least < 0 && most > 0 {
            return 0;
        }
        if side[0] * side[1] * side[2] == 0 { self.line_meets_exactly(corners, side) } else { side[0] }
    }

    /// The same where the side of some edges is not known yet.
    #[cold]
    #[inline(never)]
    fn line_meets_exactly(&self, corners: [Vec3; 3], side: [i32; 3]) -> i32 {
        let mut all = side[0] + side[1] + side[2];
        for k in (0..3).filter(|k| side[*k] == 0) {
            let side = self.side_of_edge(corners[k], corners[(k + 1) % 3]);
            // Parallel to the edge, the ray has the other two on different sides.
            if side == 0 || side * all < 0 {
                return 0;
            }
            all += side;
        }
        all.signum()
    }

    /// On which side the line, moved by the infinitesimal, passes an edge; 0 where it is parallel to it.
    fn side_of_edge(&self, u: Vec3, v: Vec3) -> i32 {
        let d = self.direction;
        let (p, q): ([_; 3], [_; 3]) =
            ([0, 1, 2].map(|k| difference(u[k], self.origin[k])), [0, 1, 2].map(|k| difference(v[k], self.origin[k])));
        let mut volume = Expansion::<128>::ZERO;
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                volume.add_product(p[j][a], q[k][b], d[i]);
                volume.add_product(-p[k][a], q[j][b], d[i]);
            }
        }
        if volume.sign() != 0 {
            return volume.sign();
        }
        // What the move adds is its product with (u - v) x direction, of which the first coordinate that is not zero
        // counts.
        let along: [_; 3] = [0, 1, 2].map(|k| difference(u[k], v[k]));
        for (j, k) in [(1, 2), (2, 0), (0, 1)] {
            let mut minor = Expansion::<16>::ZERO;
            for part in 0..2 {
                minor.add_product(along[j][part], d[k], 1.0);
                minor.add_product(-along[k][part], d[j], 1.0);
            }
            if minor.sign() != 0 {
                return minor.sign();
            }
        }
        0
    }

    /// Whether the place where the line meets a triangle, which it does with `turn`, is in the range.
    fn reaches(&self, corners: [Vec3; 3], turn: i32) -> bool {
        let after = |t: f64| self.side_of_plane(corners, t) * turn;
        (self.from == f64::NEG_INFINITY || (self.from < f64::INFINITY && after(self.from) >= 0))
            && (self.to == f64::INFINITY || (self.to > f64::NEG_INFINITY && after(self.to) <= 0))
    }

    /// The sign of what the normal has in common with the way from the place `t` of the ray to the plane.
    fn side_of_plane(&self, [a, b, c]: [Vec3; 3], t: f64) -> i32 {
        let (u, v, w, r) = (b - a, c - a, a - self.origin, self.direction * t);
        let normal = u.cross(v);
        let (u, v) = (u.abs(), v.abs());
        let terms = Vec3::new(u.y * v.z + u.z * v.y, u.z * v.x + u.x * v.z, u.x * v.y + u.y * v.x);
        let across = normal.dot(w - r);
        let error = RANGE_ERROR * terms.dot(w.abs() + r.abs()) + TINY;
        if across.abs() > error {
            return if across > 0.0 { 1 } else { -1 };
        }
        self.side_of_plane_exactly([a, b, c], t)
    }

    #[cold]
    #[inline(never)]
    fn side_of_plane_exactly(&self, [a, b, c]: [Vec3; 3], t: f64) -> i32 {
        let (u, v): ([_; 3], [_; 3]) =
            ([0, 1, 2].map(|k| difference(b[k], a[k])), [0, 1, 2].map(|k| difference(c[k], a[k])));
        let mut across = Expansion::<400>::ZERO;
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            let ([w0, w1], [r0, r1]) = (difference(a[i], self.origin[i]), product(self.direction[i], t));
            for (x, y) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                for way in [w0, w1, -r0, -r1] {
                    across.add_product(u[j][x], v[k][y], way);
                    across.add_product(-u[k][x], v[j][y], way);
                }
            }
        }
        across.sign()
    }

    /// Where the ray meets a triangle that it does meet, scaled.
    pub(crate) fn place(&self, corners: [Vec3; 3]) -> f64 {
        let d = self.direction;
        let [across, along] = plane_and_ray(corners[0], corners[1], corners[2], self.origin, d);
        let at = across / along;
        // Not beyond the corners, where the ray runs nearly within the plane.
        let (mut first, mut last, mut size) = (f64::INFINITY, f64::NEG_INFINITY, 0.0f64);
        for c in corners {
            let ahead = (c - self.origin).dot(d) / d.dot(d);
            (first, last) = (first.min(ahead), last.max(ahead));
            size = size.max((c - self.origin).abs().max_element());
        }
        let room = 64.0 * f64::EPSILON * size;
        let at = if at >= first - room && at <= last + room { at } else { at.max(first).min(last) };
        positive_zero(at.max(self.from).min(self.to))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(x: f64, y: f64, z: f64) -> Vec3 {
        Vec3::new(x, y, z)
    }

    const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

    /// The faces of an octahedron, outward.
    fn octahedron() -> Vec<[Vec3; 3]> {
        let mut faces = Vec::new();
        for k in 0..8 {
            let [x, y, z] = [0, 1, 2].map(|bit| if k >> bit & 1 == 0 { 1.0 } else { -1.0 });
            let face = [v(x, 0.0, 0.0), v(0.0, y, 0.0), v(0.0, 0.0, z)];
            faces.push(if x * y * z > 0.0 { face } else { [face[0], face[2], face[1]] });
        }
        faces
    }

    #[test]
    fn lines_through_corners_and_edges_come_in_as_often_as_they_go_out() {
        let faces = octahedron();
        let steps = [-1.0, -0.5, 0.0, 0.25, 0.5, 1.0];
        let mut met = 0;
        for k in 0..216 {
            let (x, y, z) = (steps[k % 6], steps[k / 6 % 6], steps[k / 36]);
            for (dx, dy, dz) in
                [(1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (1.0, 1.0, 0.0), (-0.5, 1.0, 0.5), (1.0, -1.0, 1e-9)]
            {
                let ray = Ray::new(v(x, y, z), v(dx, dy, dz), ALL).unwrap();
                let turns: Vec<i32> = faces.iter().map(|f| ray.meets(*f)).filter(|turn| *turn != 0).collect();
                assert_eq!(turns.iter().sum::<i32>(), 0, "{ray:?}");
                // It is convex.
                assert!(turns.len() <= 2, "{ray:?}");
                met += turns.len();
            }
        }
        assert!(met > 500, "{met}");
    }

    #[test]
    fn ends_of_the_range_are_included_exactly() {
        let t = [v(-1.0, -1.0, 0.3), v(1.0, -1.0, 0.3), v(0.0, 1.0, 0.3)];
        let meets = |from: f64, to: f64| Ray::new(v(0.0, 0.0, 0.0), v(0.0, 0.0, 0.1), [from, to]).unwrap().meets(t);
        // 0.3 is a little less than three times 0.1.
        assert_eq!(meets(0.0, 3.0), 1);
        assert_eq!(meets(0.0, 3.0 * (1.0 - f64::EPSILON)), 0);
        assert_eq!(meets(3.0, 4.0), 0);
        assert_eq!(meets(f64::NEG_INFINITY, f64::INFINITY), 1);
        let from_plane = |z: f64| Ray::new(v(0.0, 0.0, 0.3), v(0.0, 0.0, z), [0.0, 1.0]).unwrap().meets(t);
        assert_eq!((from_plane(1.0), from_plane(-1.0)), (1, -1));
    }

    #[test]
    fn directions_of_any_length_meet_alike() {
        let t = [v(-1.0, -1.0, 2.0), v(1.0, -1.0, 2.0), v(0.0, 1.0, 2.0)];
        for length in [1e-300, 1e-6, 1.0, 3.0, 1e300] {
            let ray = Ray::new(v(0.1, 0.2, 0.0), v(0.0, 0.0, length), [0.0, f64::INFINITY]).unwrap();
            assert_eq!(ray.meets(t), 1);
            let at = ray.unscaled(ray.place(t)) * length;
            assert!((at - 2.0).abs() < 1e-14, "{at}");
        }
        assert!(Ray::new(Vec3::ZERO, Vec3::ZERO, ALL).is_none());
        assert!(Ray::new(Vec3::ZERO, v(f64::NAN, 1.0, 0.0), ALL).is_none());
    }
}
