// SPDX-License-Identifier: MIT OR Apache-2.0
//! The triangulation of least area over a closed loop of points in space (Barequet & Sharir 1995).

use super::polygon::are_collinear;
use crate::math::{Aabb, Vec3, length};

/// What a thin triangle counts for besides its area: this times L^4 / area, L its longest edge. So of the
/// triangulations of a plane loop, which all have one area, one without slivers is taken, and it matters more than
/// area only where a triangle is a thousand times longer than high.
const THIN: f64 = 1e-6;

/// The least area over a stretch of the loop, and the corner between its ends that gives it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stretch {
    area: f64,
    tip: u32,
}

impl Stretch {
    const NONE: Stretch = Stretch { area: f64::INFINITY, tip: 0 };
}

/// Spans a loop of n points with n - 2 triangles, whose corners ascend, of the least total area, slivers aside
/// ([`THIN`]; flat ones of three points only where nothing else is left); of equal ones those whose tips are lowest. Diagonals for
/// which `forbidden(i, k)`, i < k, holds are not used; the loop's own edges are not asked about. `table` is scratch
/// of n * n; `out` takes n - 2 triangles, as indices into `points`. False, with `out` untouched, where fewer than
/// three points are given, where a buffer is too short and where the diagonals left give no triangulation. Points may
/// coincide and may lie anyhow. Cubic time.
pub fn least_area(
    points: &[Vec3],
    forbidden: impl Fn(usize, usize) -> bool,
    table: &mut [Stretch],
    out: &mut [[u32; 3]],
) -> bool {
    let n = points.len();
    if n < 3 || n.checked_mul(n).is_none_or(|size| table.len() < size) || out.len() != n - 2 {
        return false;
    }
    let diagonal = Aabb::of(points.iter().copied()).diagonal();
    // More than any triangulation without slivers.
    let worst = diagonal * diagonal * n as f64;
    // Both ways round, so that what is looked at together lies together.
    for i in 0..n - 1 {
        (table[i * n + i + 1], table[(i + 1) * n + i]) = (Stretch::default(), Stretch::default());
    }
    for reach in 2..n {
        for i in 0..n - reach {
            let k = i + reach;
            let barred = reach + 1 < n && forbidden(i, k);
            let stretch = if barred { Stretch::NONE } else { best(points, table, i, k, worst) };
            (table[i * n + k], table[k * n + i]) = (stretch, stretch);
        }
    }
    if table[n - 1].area == f64::INFINITY {
        return false;
    }
    unfold(table, n, out);
    true
}

fn best(points: &[Vec3], table: &[Stretch], i: usize, k: usize, worst: f64) -> Stretch {
    let n = points.len();
    let (from_i, from_k) = (&table[i * n..][i + 1..k], &table[k * n..][i + 1..k]);
    let mut best = Stretch::NONE;
    for (tip, (a, b)) in (i + 1..k).zip(from_i.iter().zip(from_k)) {
        let sides = a.area + b.area;
        // What is no better without the triangle need not be measured.
        if sides < best.area {
            let area = sides + cost(points[i], points[tip], points[k], best.area - sides, worst);
            if area < best.area {
                best = Stretch { area, tip: tip as u32 };
            }
        }
    }
    best
}

/// The area of a triangle, and more where it is thin; where the area alone is beyond `enough`, anything beyond. One of
/// two equal corners costs nothing: where a loop comes to a point again, it is what parts the lobes.
fn cost(a: Vec3, b: Vec3, c: Vec3, enough: f64, worst: f64) -> f64 {
    if a == b || b == c || c == a {
        return 0.0;
    }
    let (u, v, w) = (b - a, c - b, a - c);
    let across = u.cross(w);
    // Most triangles of a tangle are too large: squares tell, where they neither overflow nor underflow.
    let squared = across.dot(across);
    if (1e-280..1e280).contains(&squared) && squared > 4.000_001 * (enough * enough) {
        return f64::INFINITY;
    }
    let area = 0.5 * length(across);
    if area > enough {
        return area;
    }
    let longest = u.dot(u).max(v.dot(v)).max(w.dot(w));
    let cost = area + THIN * longest * (longest / area);
    // Rounding gives points on a line less than this; false where the area is zero.
    let flat = area < 1e-12 * longest && are_collinear(a, b, c);
    if cost < worst && !flat { cost } else { worst }
}

/// Reads the triangles off the table: each but the first stands on a side of an earlier one.
fn unfold(table: &[Stretch], n: usize, out: &mut [[u32; 3]]) {
    let triangle = |i: u32, k: u32| [i, table[i as usize * n + k as usize].tip, k];
    out[0] = triangle(0, n as u32 - 1);
    let mut found = 1;
    for at in 0..out.len() {
        let [i, tip, k] = out[at];
        for (from, to) in [(i, tip), (tip, k)] {
            if to - from > 1 {
                out[found] = triangle(from, to);
                found += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fill(points: &[Vec3], forbidden: impl Fn(usize, usize) -> bool) -> Option<Vec<[u32; 3]>> {
        let n = points.len();
        let (mut table, mut out) = (vec![Stretch::default(); n * n], vec![[0; 3]; n.saturating_sub(2)]);
        least_area(points, forbidden, &mut table, &mut out).then_some(out)
    }

    fn area(points: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
        let of = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|k| points[k as usize]);
            0.5 * length((b - a).cross(c - a))
        };
        triangles.iter().map(of).sum()
    }

    /// The least area by trying every triangulation.
    fn least(points: &[Vec3], i: usize, k: usize) -> f64 {
        let of = |m: usize| area(points, &[[i as u32, m as u32, k as u32]]);
        let all = (i + 1..k).map(|m| least(points, i, m) + of(m) + least(points, m, k));
        if k - i < 2 { 0.0 } else { all.fold(f64::INFINITY, f64::min) }
    }

    /// A zigzag crown of n points.
    fn crown(n: u32) -> Vec<Vec3> {
        let point = |k: u32| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(n);
            let height = f64::from(k * k % 7) * 0.3;
            Vec3::new(libm::cos(angle) * (1.0 + 0.2 * height), libm::sin(angle), height)
        };
        (0..n).map(point).collect()
    }

    #[test]
    fn no_triangulation_of_a_crown_has_less_area() {
        for n in 3..10 {
            let points = crown(n);
            let triangles = fill(&points, |_, _| false).unwrap();
            let expected = least(&points, 0, points.len() - 1);
            let excess = area(&points, &triangles) - expected;
            assert!(excess > -1e-12 && excess < 1e-4 * expected, "{n} points");
        }
    }

    #[test]
    fn each_edge_of_the_loop_is_run_along_once_and_each_diagonal_both_ways() {
        let points = crown(9);
        let n = points.len() as u32;
        let triangles = fill(&points, |_, _| false).unwrap();
        let mut runs: Vec<(u32, u32)> = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
        runs.sort_unstable();
        for i in 0..n {
            let next = (i + 1) % n;
            assert_eq!(runs.iter().filter(|r| **r == (i, next)).count(), 1);
            assert_eq!(runs.iter().filter(|r| **r == (next, i)).count(), 0);
        }
        for &(a, b) in runs.iter().filter(|(a, b)| (a + 1) % n != *b) {
            assert!(runs.binary_search(&(b, a)).is_ok(), "{a} {b}");
        }
    }

    #[test]
    fn forbidden_diagonals_are_left_alone() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
        assert_eq!(fill(&square, |_, _| false), Some(vec![[0, 1, 3], [1, 2, 3]]));
        assert_eq!(fill(&square, |i, k| (i, k) == (1, 3)), Some(vec![[0, 2, 3], [0, 1, 2]]));
        assert_eq!(fill(&square, |_, _| true), None);
    }

    #[test]
    fn points_on_a_straight_side_get_no_flat_triangles() {
        let side = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]];
        let points = side.map(|[x, y]| Vec3::new(x, y, 0.0));
        let triangles = fill(&points, |_, _| false).unwrap();
        assert!((area(&points, &triangles) - 3.0).abs() < 1e-12);
        assert!(triangles.iter().all(|t| area(&points, &[*t]) > 0.1), "{triangles:?}");
        let line = [0.0, 1.0, 2.0, 3.0].map(|x| Vec3::new(x, 0.0, 0.0));
        assert_eq!(fill(&line, |_, _| false).map(|t| t.len()), Some(2));
    }

    #[test]
    fn scale_changes_nothing() {
        let points = crown(17);
        let unit = fill(&points, |_, _| false);
        for power in [-300, -60, 60, 300] {
            let scaled: Vec<Vec3> = points.iter().map(|p| *p * libm::ldexp(1.0, power)).collect();
            assert_eq!(fill(&scaled, |_, _| false), unit, "2^{power}");
        }
    }

    #[test]
    fn a_triangle_has_no_diagonals_and_two_points_no_triangles() {
        let points = crown(3);
        assert_eq!(fill(&points, |_, _| true), Some(vec![[0, 1, 2]]));
        assert_eq!(fill(&points[..2], |_, _| false), None);
    }
}
