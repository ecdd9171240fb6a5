// SPDX-License-Identifier: MIT OR Apache-2.0
//! Plane polygons cut into triangles by clipping ears (Meisters 1975), with exact predicates (Shewchuk 1997).

use crate::math::Vec3;
use robust::{Coord, orient2d};

/// Whether three points lie on one line, exactly.
pub fn are_collinear(a: Vec3, b: Vec3, c: Vec3) -> bool {
    let turns = |u: usize, v: usize| turn([a[u], a[v]], [b[u], b[v]], [c[u], c[v]]) != 0.0;
    !(turns(0, 1) || turns(1, 2) || turns(2, 0))
}

/// Whether all points lie on one line, exactly.
pub fn are_on_a_line(mut points: impl Iterator<Item = Vec3> + Clone) -> bool {
    let Some(first) = points.next() else { return true };
    let Some(other) = points.clone().find(|p| *p != first) else { return true };
    points.all(|p| are_collinear(first, other, p))
}

/// Whether the diagonals from the first corner cut a polygon into counter-clockwise triangles that do not
/// overlap: whether it is star-shaped seen from there, as every convex one is.
pub fn is_cut_by_fan(points: &[[f64; 2]]) -> bool {
    let side = |k: usize, l: usize| turn(points[0], points[k], points[l]) > 0.0;
    (2..points.len()).all(|k| side(k - 1, k) && side(1, k))
}

/// Twice the area vector of a polygon: counter-clockwise around it where the polygon is plane (Newell).
pub fn area_vector(points: impl Iterator<Item = Vec3> + Clone) -> Vec3 {
    let Some(origin) = points.clone().next() else { return Vec3::ZERO };
    let next = points.clone().skip(1).chain([origin]);
    points.zip(next).fold(Vec3::ZERO, |sum, (p, q)| sum + (p - origin).cross(q - origin))
}

/// The two axes to keep so that a polygon with this area vector is counter-clockwise in them.
pub fn projection(area_vector: Vec3) -> [usize; 2] {
    let size = area_vector.abs();
    let drop = if size.z >= size.x && size.z >= size.y {
        2
    } else if size.y >= size.x {
        1
    } else {
        0
    };
    let (u, v) = ((drop + 1) % 3, (drop + 2) % 3);
    if area_vector[drop] < 0.0 { [v, u] } else { [u, v] }
}

/// The foot of `p` on the plane through `origin` with this unit normal; `p` itself where it is off the plane by no
/// more than rounding its coordinates explains, so that what lies in the plane keeps its bits.
pub fn foot_on_plane(p: Vec3, origin: Vec3, normal: Vec3) -> Vec3 {
    let height = (p - origin).dot(normal);
    let rounding = 8.0 * f64::EPSILON * normal.abs().dot(p.abs().max(origin.abs()));
    if height.abs() <= rounding { p } else { p - normal * height }
}

/// Cuts a counter-clockwise polygon, which may touch but not cross itself, into `points.len() - 2` triangles
/// of positive area; triangles of zero area only where nothing else is left. `ring` is scratch of
/// `points.len()`; `out` takes the triangles, as indices into `points`. False where the polygon crosses itself so that no ear
/// can be found. Cubic time at worst, quadratic as a rule.
pub fn clip_ears(points: &[[f64; 2]], ring: &mut [u32], out: &mut [[u32; 3]]) -> bool {
    for (k, slot) in ring.iter_mut().enumerate() {
        *slot = k as u32;
    }
    let (mut left, mut at) = (points.len(), 0);
    for triangle in out.iter_mut() {
        let ring = &mut ring[..left];
        let ears = |k: usize| corner_at(ring, (at + k) % left);
        let found = (0..left)
            .find(|&k| is_ear(points, ring, ears(k)))
            .or_else(|| (0..left).find(|&k| is_flat(points, ears(k))));
        let Some(k) = found else { return false };
        *triangle = ears(k);
        let tip = (at + k) % left;
        ring.copy_within(tip + 1.., tip);
        left -= 1;
        // Going on past the neighbour keeps the triangles from fanning out of one corner.
        at = (tip + 1) % left.max(1);
    }
    true
}

fn corner_at(ring: &[u32], k: usize) -> [u32; 3] {
    let n = ring.len();
    [ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]]
}

/// Twice the signed area of a, b, c; its sign is exact.
pub(crate) fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let coordinate = |p: [f64; 2]| Coord { x: p[0], y: p[1] };
    orient2d(coordinate(a), coordinate(b), coordinate(c))
}

/// Convex, and no other point of the ring in it or on it.
fn is_ear(points: &[[f64; 2]], ring: &[u32], ear: [u32; 3]) -> bool {
    let ear = ear.map(|k| points[k as usize]);
    let [a, b, c] = ear;
    turn(a, b, c) > 0.0 && !ring.iter().any(|&k| blocks(points[k as usize], ear))
}

/// Whether a point lies in a counter-clockwise triangle or on it. Points that coincide with its corners do not count: a
/// polygon that touches itself there has its other edges outside.
pub(crate) fn blocks(p: [f64; 2], [a, b, c]: [[f64; 2]; 3]) -> bool {
    p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0
}

/// Three different points on one line.
pub(crate) fn is_flat(points: &[[f64; 2]], ear: [u32; 3]) -> bool {
    let [a, b, c] = ear.map(|k| points[k as usize]);
    a != b && b != c && c != a && turn(a, b, c) == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clip(points: &[[f64; 2]]) -> Option<f64> {
        let n = points.len();
        let (mut ring, mut out) = (vec![0; n], vec![[0; 3]; n - 2]);
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|k| points[k as usize]);
            assert!(turn(a, b, c) >= 0.0);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        };
        clip_ears(points, &mut ring, &mut out).then(|| out.iter().map(area).sum())
    }

    #[test]
    fn a_comb_is_cut_into_triangles_of_its_area() {
        let mut comb = vec![[0.0, 0.0], [10.0, 0.0]];
        for k in (0..10).rev() {
            let x = f64::from(k);
            comb.extend([[x + 1.0, 5.0], [x + 0.5, 1.0]]);
        }
        comb.push([0.0, 5.0]);
        let area: f64 = (0..comb.len())
            .map(|k| (comb[k], comb[(k + 1) % comb.len()]))
            .map(|(p, q)| 0.5 * (p[0] * q[1] - p[1] * q[0]))
            .sum();
        assert!((clip(&comb).unwrap() - area).abs() < 1e-12);
    }

    #[test]
    fn points_on_a_straight_edge_are_kept() {
        assert_eq!(clip(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 2.0]]), Some(2.0));
    }

    #[test]
    fn a_hole_joined_by_a_bridge_stays_open() {
        let square = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]];
        let hole = [[1.0, 1.0], [1.0, 2.0], [2.0, 2.0], [2.0, 1.0]];
        let ring: Vec<[f64; 2]> = square.iter().chain(&square[..1]).chain(&hole).chain(&hole[..1]).copied().collect();
        assert_eq!(clip(&ring), Some(8.0));
    }

    #[test]
    fn a_bow_tie_has_no_ears() {
        assert_eq!(clip(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 1.0]]), None);
    }

    #[test]
    fn collinearity_is_exact() {
        let p = |k: f64| Vec3::new(0.1 + k * 0.25, 3.0 - k * 0.5, 1e3 + k);
        let q = Vec3::new(0.1 + 0.5, 3.0 - 1.0, 1e3f64.next_up() + 2.0);
        assert!(are_collinear(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0), Vec3::new(3.0, 6.0, 9.0)));
        assert!(!are_collinear(p(0.0), p(1.0), q));
    }
}
