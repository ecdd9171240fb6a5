// SPDX-License-Identifier: MIT OR Apache-2.0
//! Surfaces with holes, and without an inside that could be told: which side points are on, and that all questions agree.

#[path = "../common/mod.rs"]
mod common;

mod automatic;
mod bodies;
mod broken;
mod moved;
mod rays;
mod terrain;
mod winding;

use common::Soup;
use common::random::Random;
use embound::geometry::{Accelerator, Geometry, SdfOptions, SignMethod};
use embound::math::{Aabb, Vec3};
use embound::parallel::Run;
use embound::query;

fn with(soup: &Soup, sign: SignMethod, accelerator: Accelerator) -> Geometry {
    let options = SdfOptions { sign, accelerator, axis: 2, ..SdfOptions::default() };
    Geometry::from_mesh(&soup.mesh(), &options, &Run::SERIAL).unwrap()
}

fn geometry(soup: &Soup, sign: SignMethod) -> Geometry {
    with(soup, sign, Accelerator::Auto)
}

fn diagonal(soup: &Soup) -> f64 {
    let (lo, hi) = soup.bounds();
    (0..3).map(|d| (hi[d] - lo[d]).powi(2)).sum::<f64>().sqrt()
}

/// Where the line through a point along an axis pierces triangles, and whether each faces up the axis; none where it comes
/// near the rim of one.
fn pierced(soup: &Soup, p: [f64; 3], axis: usize) -> Option<Vec<(f64, bool)>> {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut found = Vec::new();
    for t in 0..soup.triangles.len() {
        let [a, b, c] = soup.corners(t);
        let cross =
            |p: [f64; 3], q: [f64; 3], r: [f64; 3]| (q[u] - p[u]) * (r[v] - p[v]) - (q[v] - p[v]) * (r[u] - p[u]);
        let [x, y, z] = [cross(p, b, c), cross(a, p, c), cross(a, b, p)];
        let all = cross(a, b, c);
        if all == 0.0 {
            continue; // along the axis
        }
        let least = [x, y, z].map(|w| w / all).into_iter().fold(f64::INFINITY, f64::min);
        if least.abs() < 1e-9 {
            return None;
        }
        if least > 0.0 {
            found.push(((x * a[axis] + y * b[axis] + z * c[axis]) / all, all > 0.0));
        }
    }
    Some(found)
}

/// A box in and around a body.
fn box_around(soup: &Soup, random: &mut Random, size: f64) -> Aabb {
    let (lo, hi) = soup.bounds();
    let part = size * diagonal(soup);
    let center = random.point([0, 1, 2].map(|k| lo[k] - 0.2 * part), [0, 1, 2].map(|k| hi[k] + 0.2 * part));
    let half = random.point([0.0; 3], [part; 3]);
    Aabb::new(Vec3::from(center) - Vec3::from(half), Vec3::from(center) + Vec3::from(half))
}

/// No class is a lie at any of many points; how many boxes were called something.
#[track_caller]
fn classes_hold(soup: &Soup, g: &Geometry, random: &mut Random) -> usize {
    let mut known = 0;
    for k in 0..1500 {
        let b = box_around(soup, random, 0.5f64.powi(1 + k % 10));
        let class = query::classify_box(g, b);
        known += usize::from(class != 0);
        for _ in 0..if class == 0 { 0 } else { 60 } {
            let p = random.point(b.lo.to_array(), b.hi.to_array());
            // Ends as often as what lies between.
            let p = [0, 1, 2].map(|k| [p[k], b.lo[k], b.hi[k], p[k]][random.below(4)]);
            let value = g.value(p.into());
            assert!(if class < 0 { value < 0.0 } else { value > 0.0 }, "{class}, but {value} at {p:?} of {b:?}");
        }
    }
    known
}
