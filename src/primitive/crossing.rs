// SPDX-License-Identifier: MIT OR Apache-2.0
//! Exact crossings of axis-parallel lines and of segments with triangles, by Shewchuk's adaptive
//! predicates (1997). Lines are moved by an infinitesimal amount towards larger second and third
//! coordinates, so that a line through an edge or a vertex meets exactly the triangles it must: the
//! counts of a closed mesh are watertight.

use crate::math::{Vec3, volumes_of_differences};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// A line parallel to an axis, seen along it: the axes are permuted cyclically so that the line is
/// vertical.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisLine {
    axis: usize,
    at: [f64; 2],
}

impl AxisLine {
    /// The line through `p` along `axis`.
    pub(crate) fn new(axis: usize, p: Vec3) -> AxisLine {
        let p = p.to_array();
        AxisLine { axis, at: [p[(axis + 1) % 3], p[(axis + 2) % 3]] }
    }

    /// The line along `axis` with these next two coordinates, in cyclic order.
    pub(crate) fn through(axis: usize, at: [f64; 2]) -> AxisLine {
        AxisLine { axis, at }
    }

    fn flat(&self, p: Vec3) -> [f64; 2] {
        let p = p.to_array();
        [p[(self.axis + 1) % 3], p[(self.axis + 2) % 3]]
    }

    fn upright(&self, p: Vec3) -> Coord3D<f64> {
        let p = p.to_array();
        Coord3D { x: p[(self.axis + 1) % 3], y: p[(self.axis + 2) % 3], z: p[self.axis] }
    }

    /// +1 where the line meets the triangle and the triangle is counter-clockwise seen from above (a
    /// ray upwards leaves the body there), -1 where clockwise, 0 where the line misses it.
    #[inline]
    pub(crate) fn meets(&self, t: [Vec3; 3]) -> i32 {
        let corner = t.map(|c| self.flat(c));
        let [u, v] = self.at;
        let mut turns = 0;
        for k in 0..3 {
            let (from, to) = (corner[k], corner[(k + 1) % 3]);
            let rises = from[1] <= v && v < to[1];
            let falls = to[1] <= v && v < from[1];
            if rises && is_right(from, to, [u, v]) {
                turns += 1;
            } else if falls && is_right(to, from, [u, v]) {
                turns -= 1;
            }
        }
        turns
    }

    /// Whether the point at height `z` of the line lies below the triangle's plane, for a triangle that
    /// [`AxisLine::meets`] with `turn`. A point on the plane does not.
    #[inline]
    pub(crate) fn below(&self, z: f64, t: [Vec3; 3], turn: i32) -> bool {
        let [a, b, c] = t.map(|p| self.upright(p));
        let lowest = a.z.min(b.z).min(c.z);
        let highest = a.z.max(b.z).max(c.z);
        if z < lowest {
            return true;
        }
        if z > highest {
            return false;
        }
        let side = orient3d(a, b, c, Coord3D { x: self.at[0], y: self.at[1], z });
        if turn > 0 { side > 0.0 } else { side < 0.0 }
    }
}

/// Whether a rising edge passes to the right of a point in whose row it lies. At equality it does not: the infinitesimal
/// move puts the line to the right of the edge.
#[inline]
pub(crate) fn is_right(from: [f64; 2], to: [f64; 2], at: [f64; 2]) -> bool {
    (from[0] > at[0] || to[0] > at[0]) && orient2d(xy(from), xy(to), xy(at)) > 0.0
}

fn xy(p: [f64; 2]) -> Coord<f64> {
    Coord { x: p[0], y: p[1] }
}

fn xyz(p: Vec3) -> Coord3D<f64> {
    Coord3D { x: p.x, y: p.y, z: p.z }
}

/// Whether the open segment from `a` to `b` passes through the triangle: +1 leaving through its outer
/// side, -1 entering, 0 not at all. A segment that passes exactly through an edge meets exactly one of
/// the two triangles there; one through a vertex may be miscounted, which callers must check by parity.
pub(crate) fn segment_meets(a: Vec3, b: Vec3, t: [Vec3; 3]) -> i32 {
    let [p, q, r] = t.map(xyz);
    // Positive where the end is below the plane, that is behind the triangle.
    let (start, end) = (orient3d(p, q, r, xyz(a)), orient3d(p, q, r, xyz(b)));
    let (behind_start, behind_end) = (start > 0.0, end > 0.0);
    if behind_start == behind_end {
        return 0;
    }
    let left = |u: Vec3, v: Vec3| {
        // One order of the corners for both triangles of an edge.
        let swapped = (v.x, v.y, v.z) < (u.x, u.y, u.z);
        let (u, v) = if swapped { (v, u) } else { (u, v) };
        (orient3d(xyz(a), xyz(b), xyz(u), xyz(v)) >= 0.0) != swapped
    };
    let side = left(t[0], t[1]);
    if side != left(t[1], t[2]) || side != left(t[2], t[0]) {
        0
    } else if behind_start {
        1
    } else {
        -1
    }
}

/// Where the line from `a` (0) to `b` (1) meets the plane of a triangle, which has this normal, clamped to
/// [0, 1]. From the volumes over the triangle: a rounded normal says nothing where the segment runs nearly within the plane.
pub(crate) fn fraction(a: Vec3, b: Vec3, t: [Vec3; 3], normal: Vec3) -> f64 {
    let [start, end] = volumes_of_differences(t[0], t[1], t[2], [a, b]);
    let at = start / (start - end);
    if at.is_finite() {
        return at.clamp(0.0, 1.0);
    }
    // Volumes beyond the range of numbers.
    let across = normal.dot(b - a);
    if across == 0.0 { 0.5 } else { (normal.dot(t[0] - a) / across).clamp(0.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{cross_of_differences, unit};
    use crate::primitive::triangle::{Prepared, V3, nearest};

    #[test]
    fn a_segment_in_the_plane_but_for_rounding_crosses_within_the_triangle() {
        let mut met = 0;
        for k in 0..5000 {
            let x = 0.0007 * f64::from(k);
            let t = [Vec3::new(0.1, 0.3 + x, 0.7), Vec3::new(0.58, 0.9, 1.34 - x), Vec3::new(0.9 - x, 0.2, 0.4)];
            let normal = unit(cross_of_differences(t[0], t[1], t[2]));
            let a = t[0] + (t[0] - t[1]) * 0.7 + (t[0] - t[2]) * 0.1 * x;
            let b = t[0] * 0.2 + t[1] * 0.5 + t[2] * 0.3;
            if segment_meets(a, b, t) != 0 {
                met += 1;
                let at = a + (b - a) * fraction(a, b, t, normal);
                let off = nearest(&Prepared::new(t), V3::from_vec(at)).squared.sqrt();
                assert!(off < 1e-12, "{off} at {x}");
            }
        }
        assert!(met > 0);
    }
}
