// SPDX-License-Identifier: MIT OR Apache-2.0
//! One triangle onto the lines of a lattice along one axis. Rows are those of equal second coordinate across the lines;
//! along a row the lines that meet the triangle are those between two of its edges. Rounded places of edge and plane
//! decide all but what lies within their error; `primitive/crossing.rs` decides the rest, and would have decided the
//! others alike.

use super::axis::Axis;
use crate::math::Vec3;
use crate::primitive::crossing::{AxisLine, is_right};
use std::ops::Range;

/// The lines along one axis: `u` and `v` tell a line (as in [`AxisLine`]), `w` the place along it.
pub(super) struct Lines<'a> {
    pub(super) axis: usize,
    pub(super) u: &'a Axis,
    pub(super) v: &'a Axis,
    pub(super) w: &'a Axis,
}

/// A line that meets a triangle.
pub(super) struct Meeting {
    pub(super) u: usize,
    pub(super) v: usize,
    /// How many points of the line lie below the triangle.
    pub(super) below: usize,
    /// Whether the turn is -1.
    pub(super) turned: bool,
}

impl Lines<'_> {
    /// Calls `found` for each line that meets the triangle, where points of the line lie below it. The triangle lies
    /// within `lo` and `hi`, and of its points only those in `around` count: along `w` these are all.
    #[inline(always)]
    pub(super) fn meetings(
        &self,
        t: [Vec3; 3],
        (lo, hi): (Vec3, Vec3),
        around: &[Range<usize>; 3],
        found: &mut impl FnMut(Meeting),
    ) {
        let &Lines { axis, u, v, w } = self;
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        // Half open both: a row through the highest corner meets nothing, nor does a line through the rightmost.
        let rows = v.narrowed(&around[b], |c| c < lo[b], |c| c >= hi[b]);
        let columns = u.narrowed(&around[a], |c| c < lo[a], |c| c >= hi[a]);
        let heights = w.narrowed(&around[axis], |c| c < lo[axis], |c| c > hi[axis]);
        if rows.is_empty() || columns.is_empty() || heights.end == 0 {
            return;
        }
        let plane = if heights.is_empty() { Plane::NONE } else { Plane::new(t, axis, lo, hi) };
        let mut order = [0, 1, 2];
        if t[order[1]][b] < t[order[0]][b] {
            order.swap(0, 1);
        }
        if t[order[2]][b] < t[order[1]][b] {
            order.swap(1, 2);
            if t[order[1]][b] < t[order[0]][b] {
                order.swap(0, 1);
            }
        }
        let long_rises = (order[0] + 1) % 3 == order[2];
        let [bottom, middle, top] = order.map(|k| [t[k][a], t[k][b]]);
        let margin = 4e-15 * lo[a].abs().max(hi[a].abs());
        let long = Edge::new(bottom, top, margin);
        let short = [Edge::new(bottom, middle, margin), Edge::new(middle, top, margin)];
        for row in rows {
            let y = v.at(row);
            let long = long.first_not_left(u, y, &columns);
            let short = short[usize::from(y >= middle[1])].first_not_left(u, y, &columns);
            let turned = if long_rises { long < short } else { short < long };
            for column in long.min(short)..long.max(short) {
                let at = [u.at(column), y];
                let below = if heights.is_empty() {
                    heights.start
                } else {
                    let line = AxisLine::through(axis, at);
                    plane.below(w, at, &heights, |z| line.below(z, t, if turned { -1 } else { 1 }))
                };
                if below > 0 {
                    found(Meeting { u: column, v: row, below, turned });
                }
            }
        }
    }
}

/// A rising edge, across the lines.
struct Edge {
    from: [f64; 2],
    to: [f64; 2],
    slope: f64,
    margin: f64,
}

impl Edge {
    #[inline(always)]
    fn new(from: [f64; 2], to: [f64; 2], margin: f64) -> Edge {
        Edge { from, to, slope: (to[0] - from[0]) / (to[1] - from[1]), margin }
    }

    /// The first of the columns that the edge does not pass right of, in a row that it spans.
    #[inline(always)]
    fn first_not_left(&self, u: &Axis, y: f64, columns: &Range<usize>) -> usize {
        let x = self.from[0] + (y - self.from[1]) * self.slope;
        // Far beyond the corners is rounding too: a slope may be beyond the range of numbers.
        let (low, high) = (x - self.margin, x + self.margin);
        if !(low.is_finite() && high.is_finite()) {
            let rest = columns.clone().find(|&k| !is_right(self.from, self.to, [u.at(k), y]));
            return rest.unwrap_or(columns.end);
        }
        let mut k = u.not_below(low).clamp(columns.start, columns.end);
        while k < columns.end && u.at(k) <= high && is_right(self.from, self.to, [u.at(k), y]) {
            k += 1;
        }
        k
    }
}

/// The plane of a triangle as a height over the lines, and its error.
struct Plane {
    at: Vec3,
    axes: [usize; 3],
    slope: [f64; 2],
    /// Infinite where the height is not worth computing.
    margin: f64,
}

impl Plane {
    const NONE: Plane = Plane { at: Vec3::ZERO, axes: [0; 3], slope: [0.0; 2], margin: f64::INFINITY };

    #[inline(always)]
    fn new(t: [Vec3; 3], axis: usize, lo: Vec3, hi: Vec3) -> Plane {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let normal = (t[1] - t[0]).cross(t[2] - t[0]);
        let size = (hi - lo).max_element();
        let up = normal[axis];
        if size < 1e-90 || up.abs() < 1e-10 * size * size {
            return Plane { margin: f64::INFINITY, ..Plane::NONE };
        }
        // The normal's elements are off by 6 roundings of size^2, a height by 32 of size^3 / up.
        let margin = 1.2e-14 * size * size * size / up.abs() + 1e-15 * lo[axis].abs().max(hi[axis].abs());
        Plane { at: t[0], axes: [a, b, axis], slope: [normal[a] / up, normal[b] / up], margin }
    }

    /// How many coordinates are below the plane, of which the first `heights.start` are and none from its end on.
    #[inline(always)]
    fn below(&self, w: &Axis, at: [f64; 2], heights: &Range<usize>, is_below: impl Fn(f64) -> bool) -> usize {
        if self.margin == f64::INFINITY {
            let (mut from, mut to) = (heights.start, heights.end);
            while from < to {
                let middle = from + (to - from) / 2;
                if is_below(w.at(middle)) {
                    from = middle + 1;
                } else {
                    to = middle;
                }
            }
            return from;
        }
        let [a, b, axis] = self.axes;
        let height = self.at[axis] - ((at[0] - self.at[a]) * self.slope[0] + (at[1] - self.at[b]) * self.slope[1]);
        let mut k = w.not_below(height - self.margin).clamp(heights.start, heights.end);
        while k < heights.end && w.at(k) <= height + self.margin && is_below(w.at(k)) {
            k += 1;
        }
        k
    }
}
