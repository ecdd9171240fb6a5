// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether a point lies in a plane polygon, three ways: crossing number, winding number (both after Hormann &
//! Agathos 2001, with Shewchuk's exact predicates) and the sum of the angles that the sides subtend.

use robust::{Coord, orient2d};

/// How to decide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Inside {
    /// Inside where a ray to the right crosses the boundary an odd number of times: where a polygon covers
    /// itself twice is outside. Exact; of a point on the boundary the answer is that of a point an infinitesimal
    /// to the right and above, so that polygons side by side share no point and miss none.
    #[default]
    Crossing,
    /// Inside where the boundary winds around the point, whichever way: where a polygon covers itself twice is
    /// inside. Exact; the boundary as above.
    Winding,
    /// Inside where the subtended angles sum to more than half a turn either way. The sum is a multiple of a turn
    /// off the boundary, to rounding; on the boundary it is between, and the answer is either.
    Angle,
}

/// Whether `p` lies in the polygon; nowhere lies in one of fewer than three corners. Linear.
pub fn contains(polygon: impl ExactSizeIterator<Item = [f64; 2]> + Clone, p: [f64; 2], how: Inside) -> bool {
    if polygon.len() < 3 {
        return false;
    }
    let next = polygon.clone().skip(1).chain(polygon.clone().take(1));
    let sides = polygon.zip(next);
    match how {
        Inside::Crossing => sides.filter(|(a, b)| crosses(*a, *b, p) != 0).count() % 2 == 1,
        Inside::Winding => sides.map(|(a, b)| crosses(a, b, p)).sum::<i64>() != 0,
        Inside::Angle => sides.map(|(a, b)| angle(a, b, p)).sum::<f64>().abs() > std::f64::consts::PI,
    }
}

/// +1 where the side passes the right of `p` upwards, -1 downwards, 0 not at all.
fn crosses(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> i64 {
    let upwards = a[1] <= p[1] && b[1] > p[1];
    if !(upwards || b[1] <= p[1] && a[1] > p[1]) {
        return 0;
    }
    let [low, high] = if upwards { [a, b] } else { [b, a] };
    let [low, high, p] = [low, high, p].map(|q| Coord { x: q[0], y: q[1] });
    match (orient2d(low, high, p) > 0.0, upwards) {
        (false, _) => 0,
        (true, true) => 1,
        (true, false) => -1,
    }
}

/// The angle from `a` to `b` seen from `p`, between minus and plus half a turn.
fn angle(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    let (u, v) = ([a[0] - p[0], a[1] - p[1]], [b[0] - p[0], b[1] - p[1]]);
    libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
}
