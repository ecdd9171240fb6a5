// SPDX-License-Identifier: MIT OR Apache-2.0
//! Signed distance to a simple polygon in the plane: the nearest edge, the sign by crossings of a ray with
//! exact predicates (Shewchuk 1997), and the exact tests that a polygon is simple.

use super::polygon::turn;
use super::profile::{length2, unit2};

/// Whether two closed segments share a point.
pub(crate) fn segments_meet(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> bool {
    let apart = |k: usize| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]);
    if apart(0) || apart(1) {
        return false;
    }
    let one_side = |x: f64, y: f64| (x > 0.0 && y > 0.0) || (x < 0.0 && y < 0.0);
    // All four zero: on one line, where overlapping boxes mean overlapping segments.
    !one_side(turn(a, b, c), turn(a, b, d)) && !one_side(turn(c, d, a), turn(c, d, b))
}

/// Whether the edge b-c runs back over a-b.
pub(crate) fn folds_back(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> bool {
    let same_way = |k: usize| (a[k] > b[k] && c[k] > b[k]) || (a[k] < b[k] && c[k] < b[k]);
    turn(a, b, c) == 0.0 && (same_way(0) || same_way(1))
}

/// An edge of a counter-clockwise polygon: the interior is to its left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub(crate) a: [f64; 2],
    pub(crate) b: [f64; 2],
    /// From a to b, of length 1.
    along: [f64; 2],
    length: f64,
}

#[derive(Clone, Copy)]
enum Nearest {
    Inner,
    Start,
    End,
}

impl Edge {
    pub(crate) fn new(a: [f64; 2], b: [f64; 2]) -> Edge {
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        Edge { a, b, along: unit2(x, y, [1.0, 0.0]), length: length2(x, y) }
    }

    fn normal(&self) -> [f64; 2] {
        [self.along[1], -self.along[0]]
    }

    /// Distance from the line through the edge.
    fn off_line(&self, p: [f64; 2]) -> f64 {
        let (x, y) = (p[0] - self.a[0], p[1] - self.a[1]);
        (x * self.along[1] - y * self.along[0]).abs()
    }

    /// Squared distance, and what of the edge is nearest.
    fn nearest(&self, p: [f64; 2]) -> (f64, Nearest) {
        let square = |q: [f64; 2]| {
            let (x, y) = (p[0] - q[0], p[1] - q[1]);
            x * x + y * y
        };
        let at = (p[0] - self.a[0]) * self.along[0] + (p[1] - self.a[1]) * self.along[1];
        if at <= 0.0 {
            (square(self.a), Nearest::Start)
        } else if at >= self.length {
            (square(self.b), Nearest::End)
        } else {
            let d = self.off_line(p);
            (d * d, Nearest::Inner)
        }
    }

    /// Whether the ray from `p` towards larger x crosses the edge; none where `p` is on it (horizontal edges
    /// aside).
    fn crosses(&self, p: [f64; 2]) -> Option<bool> {
        let up = self.b[1] > p[1];
        if up == (self.a[1] > p[1]) {
            return Some(false);
        }
        let side = turn(self.a, self.b, p);
        if side == 0.0 { None } else { Some((side > 0.0) == up) }
    }
}

/// Signed distance and its gradient, of length 1, for the polygon with these edges, whose corners are within
/// `lo` and `hi`. Edges may be missing where no ray towards larger x can cross them. Of several nearest
/// edges the first counts.
pub(crate) fn signed(edges: &[Edge], lo: [f64; 2], hi: [f64; 2], p: [f64; 2]) -> (f64, [f64; 2]) {
    let within = (0..2).all(|k| lo[k] <= p[k] && p[k] <= hi[k]);
    let (mut inside, mut on) = (false, false);
    let mut best: Option<(f64, Nearest, &Edge)> = None;
    for edge in edges {
        let (square, nearest) = edge.nearest(p);
        if best.is_none_or(|(least, ..)| square < least) {
            best = Some((square, nearest, edge));
        }
        if within {
            match edge.crosses(p) {
                Some(crossed) => inside ^= crossed,
                None => on = true,
            }
        }
    }
    let Some((_, nearest, edge)) = best else { return (f64::INFINITY, [1.0, 0.0]) };
    let corner = match nearest {
        Nearest::Inner => None,
        Nearest::Start => Some(edge.a),
        Nearest::End => Some(edge.b),
    };
    let (distance, away) = match corner {
        None => (edge.off_line(p), edge.normal()),
        Some(q) => {
            let (x, y) = (p[0] - q[0], p[1] - q[1]);
            let away = unit2(x, y, [0.0, 0.0]);
            let away = if inside { away.map(|c| -c) } else { away };
            (length2(x, y), if x == 0.0 && y == 0.0 { edge.normal() } else { away })
        }
    };
    if on || distance == 0.0 { (0.0, away) } else { (if inside { -distance } else { distance }, away) }
}
