// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether a triangle keeps clear of a box, by thirteen separating axes (Akenine-Moller 2001): the box's own
//! three, the triangle's normal, and the nine across one edge of each.

use crate::math::{Aabb, Vec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Whether a triangle and a box, both closed, the box possibly infinite, have a point in common: exactly, by
/// Shewchuk's predicates (1997). An edge of either separates only where it is the nearest to the other, and a box
/// without thickness, or a triangle without area, is apart from what a slightly thicker box is apart from, too: the
/// thirteen axes suffice for all of them.
pub(crate) fn meets(t: [Vec3; 3], b: Aabb) -> bool {
    if t.iter().any(|c| b.contains(*c)) {
        return true;
    }
    // Finite from here on, and no larger than it need be.
    let b = b.intersection(Aabb::of(t));
    if b.is_empty() || are_apart(t, b) {
        return false;
    }
    let corner = |k: usize| {
        let side = |bit: usize, axis: usize| if k >> bit & 1 == 0 { b.lo[axis] } else { b.hi[axis] };
        Vec3::new(side(0, 0), side(1, 1), side(2, 2))
    };
    let xyz = |p: Vec3| Coord3D { x: p.x, y: p.y, z: p.z };
    let [p, q, r] = t.map(xyz);
    let above = |k: usize| orient3d(p, q, r, xyz(corner(k)));
    if (0..8).all(|k| above(k) > 0.0) || (0..8).all(|k| above(k) < 0.0) {
        return false;
    }
    // Seen along each axis: the sides of the triangle.
    !(0..3).any(|axis| {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let flat = |p: Vec3| Coord { x: p[i], y: p[j] };
        let rectangle = [(b.lo[i], b.lo[j]), (b.lo[i], b.hi[j]), (b.hi[i], b.lo[j]), (b.hi[i], b.hi[j])]
            .map(|(x, y)| Coord { x, y });
        (0..3).any(|k| {
            let (p, q, r) = (flat(t[k]), flat(t[(k + 1) % 3]), flat(t[(k + 2) % 3]));
            let third = orient2d(p, q, r);
            let sides = rectangle.map(|c| orient2d(p, q, c));
            (third <= 0.0 && sides.iter().all(|s| *s > 0.0)) || (third >= 0.0 && sides.iter().all(|s| *s < 0.0))
        })
    })
}

/// Whether an axis proves that the triangle and the box are apart by more than rounding. False is not proof of
/// the contrary.
pub(crate) fn are_apart(t: [Vec3; 3], b: Aabb) -> bool {
    let center = b.center();
    let half = (b.hi - center).max(center - b.lo);
    let size = b.lo.abs().max(b.hi.abs()).max_element() + t.iter().map(|c| c.abs().max_element()).fold(0.0, f64::max);
    let slack = Vec3::splat(32.0 * f64::EPSILON * size);
    let half = half + slack;
    let corner = t.map(|c| c - center);
    let separates = |axis: Vec3| {
        let along = corner.map(|c| c.dot(axis));
        let reach = half.dot(axis.abs()) * (1.0 + 1e-12);
        let (least, most) = (along[0].min(along[1]).min(along[2]), along[0].max(along[1]).max(along[2]));
        // What is no number separates nothing.
        least > reach || most < -reach
    };
    let edges = [corner[1] - corner[0], corner[2] - corner[1], corner[0] - corner[2]];
    [Vec3::X, Vec3::Y, Vec3::Z].into_iter().any(separates)
        || separates(edges[0].cross(edges[1]))
        || edges.iter().any(|e| {
            let across = [Vec3::new(0.0, -e.z, e.y), Vec3::new(e.z, 0.0, -e.x), Vec3::new(-e.y, e.x, 0.0)];
            across.into_iter().any(separates)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Aabb = Aabb { lo: Vec3::ZERO, hi: Vec3::ONE };

    fn v(x: f64, y: f64, z: f64) -> Vec3 {
        Vec3::new(x, y, z)
    }

    #[test]
    fn triangles_that_meet_the_box_are_never_called_apart() {
        for t in [
            [v(0.2, 0.2, 0.2), v(0.3, 0.2, 0.2), v(0.2, 0.3, 0.2)],
            [v(-9.0, -9.0, 0.5), v(9.0, -9.0, 0.5), v(0.0, 9.0, 0.5)],
            [v(-1.0, 0.5, 0.5), v(2.0, 0.5, 0.5), v(0.5, 0.5, 0.5)],
            [v(1.0, 1.0, 1.0), v(2.0, 1.0, 1.0), v(1.0, 2.0, 1.0)],
            [v(1.5, 0.5, 0.5), v(0.5, 1.5, 0.5), v(1.5, 1.5, 0.5)],
        ] {
            assert!(!are_apart(t, UNIT), "{t:?}");
        }
    }

    #[test]
    fn each_kind_of_axis_separates() {
        for t in [
            [v(1.1, 0.0, 0.0), v(2.0, 1.0, 0.0), v(2.0, 0.0, 1.0)],
            // Across the corner: the normal.
            [v(3.2, 0.0, 0.0), v(0.0, 3.2, 0.0), v(0.0, 0.0, 3.2)],
            // Past an edge of the box: across an edge of both.
            [v(2.2, -0.1, 0.5), v(-0.1, 2.2, 0.5), v(3.0, 3.0, 0.6)],
        ] {
            assert!(are_apart(t, UNIT), "{t:?}");
        }
    }
}
