// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether a point lies in a plane polygon, three ways: crossing number, winding number (both after Hormann &
//! Agathos 2001, with Shewchuk's exact predicates) and the sum of the angles that the sides subtend.

use super::polygon::turn;

/// How to decide. On the boundary all three give the answer for a point an infinitesimal to the right and, by far less,
/// above, so that polygons side by side share no point and miss none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Inside {
    /// Inside where a ray to the right crosses the boundary an odd number of times: where a polygon covers
    /// itself twice is outside. Exact.
    #[default]
    Crossing,
    /// Inside where the boundary winds around the point, whichever way: where a polygon covers itself twice is
    /// inside. Exact.
    Winding,
    /// Inside where the subtended angles sum to more than half a turn either way: the sum is a whole number of turns,
    /// to rounding, the winding number. On the boundary, where it would be anything, the winding number counts.
    Angle,
}

/// Whether `p` lies in the polygon, whose coordinates are finite; nowhere lies in one of fewer than three corners, and
/// no point that is not finite in any. Linear.
pub fn contains(polygon: impl ExactSizeIterator<Item = [f64; 2]> + Clone, p: [f64; 2], how: Inside) -> bool {
    if polygon.len() < 3 || !p.iter().all(|c| c.is_finite()) {
        return false;
    }
    let scale = to_unit_size(polygon.clone().chain([p]));
    let scaled = move |q: [f64; 2]| q.map(|c| c * scale);
    let (polygon, p) = (polygon.map(scaled), scaled(p));
    let next = polygon.clone().skip(1).chain(polygon.clone().take(1));
    let sides = polygon.zip(next);
    let winds = || sides.clone().map(|(a, b)| crosses(a, b, p)).sum::<i64>() != 0;
    match how {
        Inside::Crossing => sides.filter(|(a, b)| crosses(*a, *b, p) != 0).count() % 2 == 1,
        Inside::Winding => winds(),
        Inside::Angle if sides.clone().any(|(a, b)| is_on(a, b, p)) => winds(),
        Inside::Angle => sides.map(|(a, b)| angle(a, b, p)).sum::<f64>().abs() > std::f64::consts::PI,
    }
}

/// The power of two that brings the largest coordinate to about 1: exact, and products neither overflow nor underflow.
fn to_unit_size(points: impl Iterator<Item = [f64; 2]>) -> f64 {
    let largest = points.flatten().fold(0.0f64, |largest, c| largest.max(c.abs()));
    let exponent = (largest.to_bits() >> 52).clamp(1, 2045);
    f64::from_bits((2046 - exponent) << 52)
}

/// +1 where the side passes the right of `p` upwards, -1 downwards, 0 not at all.
fn crosses(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> i64 {
    let upwards = a[1] <= p[1] && b[1] > p[1];
    if !(upwards || b[1] <= p[1] && a[1] > p[1]) {
        return 0;
    }
    let [low, high] = if upwards { [a, b] } else { [b, a] };
    match (turn(low, high, p) > 0.0, upwards) {
        (false, _) => 0,
        (true, true) => 1,
        (true, false) => -1,
    }
}

/// Whether `p` lies on the side.
fn is_on(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> bool {
    (0..2).all(|k| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k])) && turn(a, b, p) == 0.0
}

/// The angle from `a` to `b` seen from `p`, between minus and plus half a turn, with the exact sign: near a side another
/// would be off by a whole turn.
fn angle(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    let (u, v) = ([a[0] - p[0], a[1] - p[1]], [b[0] - p[0], b[1] - p[1]]);
    libm::atan2(turn(a, b, p), u[0] * v[0] + u[1] * v[1])
}
