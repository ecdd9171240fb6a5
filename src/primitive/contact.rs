// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether two triangles meet beyond the vertices and edges that they share, decided exactly by Shewchuk's
//! predicates (1997). Touching counts. No triangle here is without area.

use crate::math::Vec3;
use robust::{Coord, Coord3D, orient2d, orient3d};

fn above(t: [Vec3; 3], p: Vec3) -> f64 {
    let [a, b, c, d] = [t[0], t[1], t[2], p].map(|q| Coord3D { x: q.x, y: q.y, z: q.z });
    orient3d(a, b, c, d)
}

/// The plane to drop a coplanar problem into: along the largest component of a rough normal, which only
/// has to be nonzero.
fn dropped(t: [Vec3; 3]) -> impl Fn(Vec3) -> Coord<f64> {
    let n = crate::math::cross_of_differences(t[0], t[1], t[2]).abs();
    let axis = if n.x >= n.y && n.x >= n.z {
        0
    } else if n.y >= n.z {
        1
    } else {
        2
    };
    move |p| Coord { x: p[(axis + 1) % 3], y: p[(axis + 2) % 3] }
}

/// Room for the rounding of a projection, relative to lengths.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Whether an axis proves that two triangles are farther apart than `slack`: the normals, and the normals of
/// the edges in their planes (Gottschalk 1996, without the nine across edges of both). False proves nothing.
#[inline]
pub(crate) fn are_clear(s: &[Vec3; 3], t: &[Vec3; 3], slack: f64) -> bool {
    let origin = s[0];
    let (s, t) = (s.map(|c| c - origin), t.map(|c| c - origin));
    let size = s.iter().chain(&t).map(|c| greatest(c.abs().to_array())).fold(0.0, greater);
    let room = ROUNDING * size + slack;
    let separates = |axis: Vec3| {
        let (p, q) = (s.map(|c| c.dot(axis)), t.map(|c| c.dot(axis)));
        let gap = greater(least(q) - greatest(p), least(p) - greatest(q));
        // Products below the range of f64 separate nothing.
        gap > room * axis.abs().element_sum() && gap > 1e-280
    };
    let (of_s, of_t) = ([s[1], s[2] - s[1], -s[2]], [t[1] - t[0], t[2] - t[1], t[0] - t[2]]);
    let (up_s, up_t) = (of_s[0].cross(of_s[1]), of_t[0].cross(of_t[1]));
    // Fourth powers of larger sizes are beyond the range of f64.
    separates(up_s)
        || separates(up_t)
        || (size < 1e60
            && (of_s.iter().any(|e| separates(up_s.cross(*e))) || of_t.iter().any(|e| separates(up_t.cross(*e)))))
}

/// One instruction, where `f64::max` spends three on NaN.
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

fn greatest(x: [f64; 3]) -> f64 {
    greater(greater(x[0], x[1]), x[2])
}

fn least(x: [f64; 3]) -> f64 {
    -greatest(x.map(|x| -x))
}

/// Whether two closed triangles meet.
pub(crate) fn triangles_touch(s: [Vec3; 3], t: [Vec3; 3]) -> bool {
    let sides_of_t = t.map(|c| above(s, c));
    if is_one_sided(sides_of_t) {
        return false;
    }
    if sides_of_t == [0.0; 3] {
        return (0..3).any(|k| touches_in_plane(t[k], t[(k + 1) % 3], s)) || touches_in_plane(s[0], s[1], t);
    }
    let sides_of_s = s.map(|c| above(t, c));
    if is_one_sided(sides_of_s) {
        return false;
    }
    // What they have in common is a point or a segment, which ends on an edge of one of them.
    (0..3).any(|k| pierces(t[k], t[(k + 1) % 3], [sides_of_t[k], sides_of_t[(k + 1) % 3]], s))
        || (0..3).any(|k| pierces(s[k], s[(k + 1) % 3], [sides_of_s[k], sides_of_s[(k + 1) % 3]], t))
}

fn is_one_sided(sides: [f64; 3]) -> bool {
    sides.iter().all(|s| *s > 0.0) || sides.iter().all(|s| *s < 0.0)
}

/// Whether two triangles with the first corner in common meet beyond it. What they have in common then
/// reaches an edge opposite to that corner.
pub(crate) fn meet_beyond_corner(s: [Vec3; 3], t: [Vec3; 3]) -> bool {
    segment_touches(t[1], t[2], s) || segment_touches(s[1], s[2], t)
}

/// Whether the closed segment from `a` to `b` meets the closed triangle.
pub(crate) fn segment_touches(a: Vec3, b: Vec3, t: [Vec3; 3]) -> bool {
    pierces(a, b, [above(t, a), above(t, b)], t)
}

/// The same, given on which sides of the triangle's plane the ends lie.
fn pierces(a: Vec3, b: Vec3, [start, end]: [f64; 2], t: [Vec3; 3]) -> bool {
    if (start > 0.0 && end > 0.0) || (start < 0.0 && end < 0.0) {
        return false;
    }
    if start == 0.0 && end == 0.0 {
        return touches_in_plane(a, b, t);
    }
    let side = |u: Vec3, v: Vec3| above([a, b, u], v);
    let sides = [side(t[0], t[1]), side(t[1], t[2]), side(t[2], t[0])];
    sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
}

/// The same where all five points lie in one plane: no edge's line separates the two.
fn touches_in_plane(a: Vec3, b: Vec3, t: [Vec3; 3]) -> bool {
    let flat = dropped(t);
    let (a, b, t) = (flat(a), flat(b), t.map(flat));
    let turn = orient2d(t[0], t[1], t[2]).signum();
    let apart = |s: f64, u: f64| s < 0.0 && u < 0.0;
    let outside_an_edge = (0..3).any(|k| {
        let (from, to) = (t[k], t[(k + 1) % 3]);
        apart(turn * orient2d(from, to, a), turn * orient2d(from, to, b))
    });
    let sides = t.map(|c| orient2d(a, b, c));
    !(outside_an_edge || sides.iter().all(|s| *s < 0.0) || sides.iter().all(|s| *s > 0.0))
}

/// Whether `c`, the corner opposite to the edge `t[0]`-`t[1]` in the other triangle of the edge, lies in
/// the plane of `t` and on its side of the edge: the two triangles are folded onto each other.
pub(crate) fn folded(c: Vec3, t: [Vec3; 3]) -> bool {
    if above(t, c) != 0.0 {
        return false;
    }
    let flat = dropped(t);
    let (c, t) = (flat(c), t.map(flat));
    orient2d(t[0], t[1], t[2]).signum() * orient2d(t[0], t[1], c) >= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const T: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    fn v(x: f64, y: f64, z: f64) -> Vec3 {
        Vec3::new(x, y, z)
    }

    #[test]
    fn segments_through_a_triangle_or_touching_it_are_found() {
        for (a, b) in [
            (v(0.2, 0.2, -1.0), v(0.2, 0.2, 1.0)),
            (v(0.2, 0.2, 0.0), v(0.2, 0.2, 1.0)),
            (v(1.0, 0.0, -1.0), v(1.0, 0.0, 1.0)),
            (v(0.5, 0.5, -1.0), v(0.5, 0.5, 1.0)),
            (v(-1.0, 0.25, 0.0), v(2.0, 0.25, 0.0)),
            (v(0.1, 0.1, 0.0), v(0.2, 0.2, 0.0)),
            (v(1.0, 0.0, 0.0), v(2.0, 0.0, 0.0)),
        ] {
            assert!(segment_touches(a, b, T) && segment_touches(b, a, T), "{a} {b}");
        }
    }

    #[test]
    fn segments_that_miss_are_not_found() {
        for (a, b) in [
            (v(0.2, 0.2, 1e-300), v(0.2, 0.2, 1.0)),
            (v(0.5, 0.5 + 1e-15, -1.0), v(0.5, 0.5 + 1e-15, 1.0)),
            (v(-1.0, 2.0, 0.0), v(2.0, 2.0, 0.0)),
            (v(1.0 + 1e-15, 0.0, 0.0), v(2.0, 0.0, 0.0)),
            (v(-0.1, 1.0, 0.0), v(-0.1, -1.0, 0.0)),
        ] {
            assert!(!segment_touches(a, b, T) && !segment_touches(b, a, T), "{a} {b}");
        }
    }

    #[test]
    fn folds_are_told_from_flat_neighbours() {
        assert!(folded(v(0.3, 2.0, 0.0), T) && !folded(v(0.3, -2.0, 0.0), T) && !folded(v(0.3, 2.0, 1e-9), T));
    }
}
