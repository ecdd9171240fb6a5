// SPDX-License-Identifier: MIT OR Apache-2.0
//! The points of a lattice that rounding may take for points of a triangle: all that lie within a small distance of it,
//! and some more.

use super::axis::{Axis, common};
use crate::math::Vec3;
use std::ops::Range;

/// Boxes of up to so many points are looked at point by point.
const FEW: usize = 24;

/// Bound of the rounding of the volume that a point spans with a triangle, in cubes of their size.
const ROUNDING: f64 = 1e-14;

/// Calls `found` for each point within `room` of the triangle, which lies within `lo` and `hi`, among those of `ranges`,
/// which hold nothing farther than `room` from that box.
#[inline(always)]
pub(super) fn near(
    axes: &[Axis; 3],
    t: [Vec3; 3],
    (lo, hi): (Vec3, Vec3),
    room: f64,
    ranges: &[Range<usize>; 3],
    found: &mut impl FnMut([usize; 3]),
) {
    let (e, f) = (t[1] - t[0], t[2] - t[0]);
    let normal = e.cross(f);
    let size = (hi - lo).max_element() + room;
    // The 1-norm is at least the length.
    let steep = normal.abs().element_sum();
    let most = 2.0 * room * steep + ROUNDING * size * size * size;
    let count = ranges.iter().fold(1usize, |n, r| n.saturating_mul(r.len()));
    if count <= FEW {
        for k in ranges[2].clone() {
            for j in ranges[1].clone() {
                for i in ranges[0].clone() {
                    let p = Vec3::new(axes[0].at(i), axes[1].at(j), axes[2].at(k));
                    if normal.dot(p - t[0]).abs() <= most {
                        found([i, j, k]);
                    }
                }
            }
        }
        return;
    }
    near_large(axes, t, (lo, hi), room, ranges, (normal, steep, most), found);
}

/// The same where there are many points.
fn near_large(
    axes: &[Axis; 3],
    t: [Vec3; 3],
    (lo, hi): (Vec3, Vec3),
    room: f64,
    ranges: &[Range<usize>; 3],
    (normal, steep, most): (Vec3, f64, f64),
    found: &mut impl FnMut([usize; 3]),
) {
    let flat = most <= 8.0 * room * steep;
    // Towards which the triangle faces, or, where it has no direction, along which it is longest.
    let up = if flat { largest(normal.abs()) } else { largest(hi - lo) };
    let (u, v) = ((up + 1) % 3, (up + 2) % 3);
    let mut at = [0; 3];
    if !flat {
        for k in ranges[up].clone() {
            let Some([low, high]) = section(t, up, axes[up].at(k), room) else { continue };
            at[up] = k;
            for j in common(&axes[v].within(low[v] - room, high[v] + room), &ranges[v]) {
                for i in common(&axes[u].within(low[u] - room, high[u] + room), &ranges[u]) {
                    (at[u], at[v]) = (i, j);
                    found(at);
                }
            }
        }
        return;
    }
    let tall = most / normal[up].abs();
    let (slope_u, slope_v) = (normal[u] / normal[up], normal[v] / normal[up]);
    for j in ranges[v].clone() {
        let y = axes[v].at(j);
        let Some([low, high]) = section(t, v, y, room) else { continue };
        for i in common(&axes[u].within(low[u] - room, high[u] + room), &ranges[u]) {
            let height = t[0][up] - ((axes[u].at(i) - t[0][u]) * slope_u + (y - t[0][v]) * slope_v);
            for k in common(&axes[up].within(height - tall, height + tall), &ranges[up]) {
                (at[u], at[v], at[up]) = (i, j, k);
                found(at);
            }
        }
    }
}

fn largest(v: Vec3) -> usize {
    let most = v.max_element();
    if v.x == most {
        0
    } else if v.y == most {
        1
    } else {
        2
    }
}

/// Around the part of a triangle that lies within `room` of `height` along an axis; rounding is far below `room`.
fn section(t: [Vec3; 3], axis: usize, height: f64, room: f64) -> Option<[Vec3; 2]> {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (from, to) = (height - 2.0 * room, height + 2.0 * room);
    for k in 0..3 {
        let (p, q) = (t[k], t[(k + 1) % 3]);
        let (p, q) = if p[axis] <= q[axis] { (p, q) } else { (q, p) };
        if q[axis] < from || p[axis] > to {
            continue;
        }
        let rise = q[axis] - p[axis];
        let place = |h: f64| if rise > 0.0 { ((h - p[axis]) / rise).clamp(0.0, 1.0) } else { f64::from(h >= height) };
        for end in [from, to] {
            let at = p + (q - p) * place(end);
            (low, high) = (low.min(at), high.max(at));
        }
    }
    (low.x <= high.x).then_some([low, high])
}
