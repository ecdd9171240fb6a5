// SPDX-License-Identifier: MIT OR Apache-2.0
//! The winding number as a sum of solid angles, dense and in f64: an independent test of signs
//! (van Oosterom & Strackee 1983, "The solid angle of a plane triangle").

use super::Soup;

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The solid angle of a triangle seen from `p`, positive where it turns its back (p is inside).
pub fn solid_angle(corners: [[f64; 3]; 3], p: [f64; 3]) -> f64 {
    let [a, b, c] = corners.map(|q| sub(q, p));
    let [la, lb, lc] = [a, b, c].map(|v| dot(v, v).sqrt());
    let below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    2.0 * libm::atan2(dot(a, cross(b, c)), below)
}

/// 1 inside a closed outward surface, 0 outside; between for an open one.
pub fn winding_number(soup: &Soup, p: [f64; 3]) -> f64 {
    let total: f64 = (0..soup.triangles.len()).map(|t| solid_angle(soup.corners(t), p)).sum();
    total / (4.0 * std::f64::consts::PI)
}
