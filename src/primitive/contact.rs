// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether an edge of one triangle touches another triangle where the two should not meet, decided
//! exactly by Shewchuk's predicates (1997). Touching counts.

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

/// Whether the closed segment from `a` to `b` meets the closed triangle.
pub(crate) fn segment_touches(a: Vec3, b: Vec3, t: [Vec3; 3]) -> bool {
    let (start, end) = (above(t, a), above(t, b));
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

/// Whether the edge from `t[0]` to `b` runs within the plane of `t` and into it.
pub(crate) fn runs_into(b: Vec3, t: [Vec3; 3]) -> bool {
    if above(t, b) != 0.0 {
        return false;
    }
    let flat = dropped(t);
    let (b, t) = (flat(b), t.map(flat));
    let turn = orient2d(t[0], t[1], t[2]).signum();
    turn * orient2d(t[0], t[1], b) >= 0.0 && turn * orient2d(t[2], t[0], b) >= 0.0
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
        assert!(runs_into(v(2.0, 3.0, 0.0), T) && !runs_into(v(2.0, -3.0, 0.0), T) && !runs_into(v(1.0, 1.0, 1e-9), T));
    }
}
