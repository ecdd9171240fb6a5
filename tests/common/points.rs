// SPDX-License-Identifier: MIT OR Apache-2.0
//! Points to ask about: in the box around a mesh, near its surface, and exactly on its features.

use super::Soup;
use super::random::Random;

fn mix(corners: [[f64; 3]; 3], w: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|d| corners[0][d] * w[0] + corners[1][d] * w[1] + corners[2][d] * w[2])
}

fn diagonal(soup: &Soup) -> f64 {
    let (lo, hi) = soup.bounds();
    (0..3).map(|d| (hi[d] - lo[d]).powi(2)).sum::<f64>().sqrt()
}

/// Uniform in the bounding box, scaled about its middle.
pub fn uniform(soup: &Soup, scale: f64, count: usize, random: &mut Random) -> Vec<[f64; 3]> {
    let (lo, hi) = soup.bounds();
    let room = [0, 1, 2].map(|d| (hi[d] - lo[d]) * (scale - 1.0) * 0.5);
    let (lo, hi) = ([0, 1, 2].map(|d| lo[d] - room[d]), [0, 1, 2].map(|d| hi[d] + room[d]));
    (0..count).map(|_| random.point(lo, hi)).collect()
}

/// A random point of each of `count` random triangles, moved by up to `reach` diagonals.
pub fn near(soup: &Soup, reach: f64, count: usize, random: &mut Random) -> Vec<[f64; 3]> {
    let d = diagonal(soup) * reach;
    let mut points = Vec::new();
    for _ in 0..count {
        let (u, v) = (random.unit(), random.unit());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        let p = mix(soup.corners(random.below(soup.triangles.len())), [1.0 - u - v, u, v]);
        let step = random.point([-d; 3], [d; 3]);
        points.push([0, 1, 2].map(|k| p[k] + step[k]));
    }
    points
}

/// Vertices, middles of edges and centroids of random triangles.
pub fn on_features(soup: &Soup, count: usize, random: &mut Random) -> Vec<[f64; 3]> {
    let weights = [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.25, 0.75], [1.0 / 3.0; 3], [0.5, 0.25, 0.25]];
    (0..count).map(|k| mix(soup.corners(random.below(soup.triangles.len())), weights[k % 5])).collect()
}

/// All of these, `count` of each.
pub fn all_kinds(soup: &Soup, count: usize, random: &mut Random) -> Vec<[f64; 3]> {
    let mut points = uniform(soup, 1.5, count, random);
    points.extend(near(soup, 1e-2, count, random));
    points.extend(near(soup, 1e-9, count, random));
    points.extend(on_features(soup, count, random));
    points
}
