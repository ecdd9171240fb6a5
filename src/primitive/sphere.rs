// SPDX-License-Identifier: MIT OR Apache-2.0
//! The ball: signed distance, gradient, crossings of a segment.

use crate::math::{Vec3, length, unit};

/// Signed distance.
pub(crate) fn value(center: Vec3, radius: f64, p: Vec3) -> f64 {
    length(p - center) - radius
}

/// Gradient of the distance; at the centre, where there is none, the x axis.
pub(crate) fn gradient(center: Vec3, p: Vec3) -> Vec3 {
    let g = unit(p - center);
    if g == Vec3::ZERO { Vec3::X } else { g }
}

/// Where the line a + t (b - a) enters and leaves, whether or not 0 <= t <= 1; none where it misses.
/// From the foot of the perpendicular: no cancellation.
pub(crate) fn interval(center: Vec3, radius: f64, a: Vec3, b: Vec3) -> Option<(f64, f64)> {
    let (d, m) = (b - a, a - center);
    let dd = d.dot(d);
    if dd == 0.0 {
        return None;
    }
    let half = m.dot(d);
    // Distance of the line to the centre, rather than half^2 - dd * c, which cancels.
    let foot = m - d * (half / dd);
    let room = radius * radius - foot.dot(foot);
    if room <= 0.0 {
        return None;
    }
    let reach = (room / dd).sqrt();
    let middle = -half / dd;
    Some((middle - reach, middle + reach))
}
