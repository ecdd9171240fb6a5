// SPDX-License-Identifier: MIT OR Apache-2.0
//! The solid angle of a plane triangle (van Oosterom & Strackee 1983, "The solid angle of a plane triangle").

use super::triangle::{Prepared, V3, nearest};
use crate::math::{Vec3, length};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Nearer to an edge than this, in lengths of it, a point is on it.
const ON_EDGE: f64 = 1e-13;

/// A solid angle that does not count.
const NOTHING: f64 = 1e-6;

/// The solid angle under which a triangle is seen, positive from behind: 4 pi in sum, from within a closed surface. Its sign
/// is exact, and on the plane of the triangle that of a point moved as [`super::crossing`] moves lines, so that with the
/// crossings of a vertical line it makes a sum which does not jump there. None on an edge or a corner, where there is no
/// telling.
pub(crate) fn solid_angle([a, b, c]: [Vec3; 3], p: Vec3) -> Option<f64> {
    let [u, v, w] = [a - p, b - p, c - p];
    let [lu, lv, lw] = [length(u), length(v), length(w)];
    let across = u.dot(v.cross(w)).abs();
    let below = lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv;
    if across + below.abs() > ON_EDGE * (lu * lv * lw) {
        return Some(2.0 * libm::atan2(across * side([a, b, c], p), below));
    }
    // Beside what is next to a line, rounding alone decides; what can be seen of it is nothing.
    let apart = nearest(&Prepared::new([a, b, c]), V3::from_vec(p)).squared.sqrt();
    let longest = length(b - a).max(length(c - b)).max(length(a - c));
    // A strip of the width w is seen under 2 w / d at most.
    (2.0 * length((b - a).cross(c - a)) <= NOTHING * apart * longest).then_some(0.0)
}

/// +1 behind the plane of a triangle, -1 before it; 0 where it has none.
fn side([a, b, c]: [Vec3; 3], p: Vec3) -> f64 {
    let at = |p: Vec3| Coord3D { x: p.x, y: p.y, z: p.z };
    let flat = |x: f64, y: f64| Coord { x, y };
    let behind = orient3d(at(a), at(b), at(c), at(p));
    if behind != 0.0 {
        return behind.signum();
    }
    // Moved up, by less along x, by less still along y.
    let normal = [
        orient2d(flat(a.x, a.y), flat(b.x, b.y), flat(c.x, c.y)),
        orient2d(flat(a.y, a.z), flat(b.y, b.z), flat(c.y, c.z)),
        orient2d(flat(a.z, a.x), flat(b.z, b.x), flat(c.z, c.x)),
    ];
    normal.into_iter().find(|n| *n != 0.0).map_or(0.0, |n| -n.signum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_is_all_around_from_within_and_nothing_from_without() {
        let corner = |k: u32| Vec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let sum = |p: Vec3| {
            let of = |f: &[u32; 4]| {
                let [a, b, c, d] = f.map(corner);
                solid_angle([a, b, c], p).unwrap() + solid_angle([a, c, d], p).unwrap()
            };
            faces.iter().map(of).sum::<f64>() / (4.0 * std::f64::consts::PI)
        };
        // On a face and moved up: out through the top, into the bottom.
        for (p, winding) in [
            ([0.5, 0.25, 0.75], 1.0),
            ([1.5, 0.2, 0.4], 0.0),
            ([0.3, 0.4, 1.0], 0.0),
            ([0.3, 0.4, 0.0], 1.0),
            ([1.0, 0.4, 0.3], 0.0),
            ([0.0, 0.4, 0.3], 1.0),
            ([0.4, 1.0, 0.3], 0.0),
            ([0.4, 0.0, 0.3], 1.0),
        ] {
            let found = sum(Vec3::from_array(p));
            assert!((found - winding).abs() < 1e-14, "{found} at {p:?}");
        }
    }
}
