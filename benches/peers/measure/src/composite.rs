// SPDX-License-Identifier: MIT OR Apache-2.0
//! A union of many balls on a cubic lattice, asked at random points, beside the plain minimum over all.

use crate::Outcome;
use crate::ask::TOLERANCE;
use crate::random::Random;
use case::{Verdict, peer, row, seconds, version};
use embound::geometry::Geometry;
use embound::math::Vec3;

const RADIUS: f64 = 0.02;
const SPACING: f64 = 0.05;

/// The cube of the nearest whole number to the cube root of `count` balls.
pub fn balls(count: usize) -> Outcome {
    peer("embound", version(crate::LOCK, "embound"), "f64, signed");
    let side = (count as f64).cbrt().round() as usize;
    let place = |k: usize| SPACING * (k as f64 - 0.5 * (side - 1) as f64);
    let centers: Vec<[f64; 3]> =
        (0..side.pow(3)).map(|k| [k % side, k / side % side, k / side / side].map(place)).collect();
    let parts: Vec<Geometry> = centers.iter().map(|c| Geometry::sphere(*c, RADIUS)).collect::<Result<_, _>>()?;
    let (built, g) = seconds(|| Geometry::union(&parts));
    let (g, name) = (g?, format!("balls-{}", centers.len()));
    let reach = 0.6 * SPACING * side as f64;
    let mut random = Random(4);
    let points: Vec<Vec3> = (0..200_000).map(|_| Vec3::from_array(random.point([-reach; 3], [reach; 3]))).collect();
    std::hint::black_box(points.iter().step_by(10).map(|p| g.value(*p)).sum::<f64>());
    let (time, values) = seconds(|| points.iter().map(|p| g.value(*p)).collect::<Vec<f64>>());
    let plain = |p: &Vec3| {
        let distances = centers.iter().map(|c| (*p - Vec3::from_array(*c)).length() - RADIUS);
        distances.fold(f64::INFINITY, f64::min)
    };
    let few = points.iter().zip(&values).step_by(1_000);
    let verdict = Verdict::of(few.map(|(p, v)| (*v, plain(p))), 2.0 * reach, true, TOLERANCE);
    row(&name, "uniform", "embound", time * 1e9 / points.len() as f64, "ns", Some(verdict));
    row(&name, "build", "embound", built, "s", None);
    Ok(())
}
