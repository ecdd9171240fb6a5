// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether triangles meet, by a plain exact method in integers: the corners of what two triangles have in common
//! are computed as fractions and compared with what the triangles share.

use super::*;

type Point = [i128; 3];
/// A point with a denominator > 0.
type Fraction = (Point, i128);

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn times(a: Point, s: i128) -> Point {
    a.map(|c| c * s)
}

fn normal(t: [Point; 3]) -> Point {
    cross(minus(t[1], t[0]), minus(t[2], t[0]))
}

/// `a + (b - a) * above / below`, where that is between the two.
fn between(a: Point, b: Point, above: i128, below: i128) -> Option<Fraction> {
    let (above, below) = if below < 0 { (-above, -below) } else { (above, below) };
    let along = times(minus(b, a), above);
    (below > 0 && above >= 0 && above <= below).then(|| ([0, 1, 2].map(|k| a[k] * below + along[k]), below))
}

fn is_in_triangle((p, w): Fraction, t: [Point; 3]) -> bool {
    let n = normal(t);
    let from = |a: Point| minus(p, times(a, w));
    dot(n, from(t[0])) == 0 && (0..3).all(|k| dot(n, cross(minus(t[(k + 1) % 3], t[k]), from(t[k]))) >= 0)
}

fn is_on_segment((p, w): Fraction, a: Point, b: Point) -> bool {
    let (from, along) = (minus(p, times(a, w)), minus(b, a));
    let reach = dot(from, along);
    cross(from, along) == [0; 3] && reach >= 0 && reach <= w * dot(along, along)
}

/// The corners of what two triangles have in common, some of them twice.
fn common_corners(s: [Point; 3], t: [Point; 3]) -> Vec<Fraction> {
    let mut found = Vec::new();
    for (of, other) in [(s, t), (t, s)] {
        found.extend(of.iter().map(|p| (*p, 1)).filter(|p| is_in_triangle(*p, other)));
        let n = normal(other);
        for k in 0..3 {
            let (a, b) = (of[k], of[(k + 1) % 3]);
            let crossing = between(a, b, dot(n, minus(other[0], a)), dot(n, minus(b, a)));
            found.extend(crossing.filter(|p| is_in_triangle(*p, other)));
        }
    }
    let n = normal(s);
    if t.iter().all(|p| dot(n, minus(*p, s[0])) == 0) {
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let (p, q) = (s[i], t[j]);
            let (u, v) = (minus(s[(i + 1) % 3], p), minus(t[(j + 1) % 3], q));
            let below = dot(n, cross(u, v));
            let other = between(q, t[(j + 1) % 3], dot(n, cross(minus(q, p), u)), below);
            let crossing = between(p, s[(i + 1) % 3], dot(n, cross(minus(q, p), v)), below);
            found.extend(crossing.filter(|_| other.is_some()));
        }
    }
    found
}

/// Whether two triangles, neither flat, have more in common than the corners and edges they share.
pub fn meet_beyond(s: [Point; 3], t: [Point; 3]) -> bool {
    let shared: Vec<Point> = s.iter().copied().filter(|p| t.contains(p)).collect();
    common_corners(s, t).into_iter().any(|p| match *shared {
        [] => true,
        [a] => p.0 != times(a, p.1),
        [a, b] => !is_on_segment(p, a, b),
        _ => true,
    })
}

/// The pairs of faces of a soup of integer positions that meet, by looking at all of them.
pub fn all_pairs(soup: &Soup) -> Vec<[u32; 2]> {
    let corners: Vec<[Point; 3]> =
        (0..soup.triangles.len()).map(|t| soup.corners(t).map(|p| p.map(|c| c as i128))).collect();
    let sorted = |t: usize| {
        let mut c = corners[t];
        c.sort_unstable();
        c
    };
    let full: Vec<usize> = (0..corners.len()).filter(|t| normal(corners[*t]) != [0; 3]).collect();
    let mut found = Vec::new();
    for (k, &s) in full.iter().enumerate() {
        for &t in &full[k + 1..] {
            if sorted(s) != sorted(t) && meet_beyond(corners[s], corners[t]) {
                found.push([s as u32, t as u32]);
            }
        }
    }
    found
}

#[test]
fn the_twin_knows_what_touching_is() {
    let t = [[0, 0, 0], [4, 0, 0], [0, 4, 0]];
    for (s, meets) in [
        ([[1, 1, -1], [1, 1, 1], [2, 1, 1]], true),
        ([[1, 1, 0], [1, 1, 1], [2, 1, 1]], true),
        ([[3, 3, -1], [3, 3, 1], [4, 3, 1]], false),
        // An edge shared: flat neighbours, folded ones, a roof.
        ([[0, 0, 0], [4, 0, 0], [0, -4, 0]], false),
        ([[0, 0, 0], [4, 0, 0], [1, 1, 0]], true),
        ([[0, 0, 0], [4, 0, 0], [1, 1, 1]], false),
        // A corner shared: beside, into, along an edge, through.
        ([[0, 0, 0], [-1, 0, 0], [0, -1, 0]], false),
        ([[0, 0, 0], [1, 1, 0], [0, 0, 3]], true),
        ([[0, 0, 0], [2, 0, 0], [0, 0, 3]], true),
        ([[0, 0, 0], [2, 2, -1], [2, 2, 1]], true),
        // Within, around, and coplanar but apart.
        ([[1, 1, 0], [2, 1, 0], [1, 2, 0]], true),
        ([[-9, -9, 0], [20, -9, 0], [-9, 20, 0]], true),
        ([[5, 5, 0], [6, 5, 0], [5, 6, 0]], false),
    ] {
        assert!(meet_beyond(s, t) == meets && meet_beyond(t, s) == meets, "{s:?}");
    }
}
