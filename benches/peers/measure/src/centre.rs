// SPDX-License-Identifier: MIT OR Apache-2.0
//! The worst case of every search: the centre of a sphere, where all triangles are nearly as near.

use crate::ask::TOLERANCE;
use crate::random::Random;
use case::{Case, Verdict, row, seconds};
use embound::geometry::Geometry;
use embound::math::Vec3;

/// At the exact centre and within 1e-6 of it, beside looking at every triangle.
pub fn ask(case: &Case, g: &Geometry, brute: &Geometry) {
    let mut random = Random(3);
    let about: Vec<Vec3> = (0..200).map(|_| Vec3::from_array(random.point([-1e-6; 3], [1e-6; 3]))).collect();
    let exact = vec![Vec3::ZERO; 20];
    let few = &about[..20.min(200_000_000 / case.triangles.len()).max(2)];
    let each = |g: &Geometry, points: &[Vec3]| {
        let (time, values) = seconds(|| points.iter().map(|p| g.value(*p)).collect::<Vec<f64>>());
        (time * 1e9 / points.len() as f64, values)
    };
    let (slow, expected) = each(brute, few);
    row(&case.name, "centre, every triangle", "embound", slow, "ns", None);
    let (time, values) = each(g, &about);
    let verdict = Verdict::of(values.into_iter().zip(expected), case.diagonal, true, TOLERANCE);
    row(&case.name, "centre within 1e-6", "embound", time, "ns", Some(verdict));
    let (time, values) = each(g, &exact);
    let pairs = values.into_iter().zip([brute.value(Vec3::ZERO)]);
    let verdict = Verdict::of(pairs, case.diagonal, true, TOLERANCE);
    row(&case.name, "centre", "embound", time, "ns", Some(verdict));
}
