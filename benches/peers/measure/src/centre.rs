// SPDX-License-Identifier: MIT OR Apache-2.0
//! The worst case of every search: the centre of a sphere, where all triangles are nearly as near.

use crate::Outcome;
use crate::ask::TOLERANCE;
use crate::files::{geometry, mesh};
use crate::icosphere::icosphere;
use crate::random::Random;
use case::{Case, Verdict, bounds, row, seconds};
use embound::geometry::{Accelerator, Geometry};
use embound::math::Vec3;
use embound::parallel::Run;
use std::path::PathBuf;

/// The same of a sphere of nearly as many triangles as asked, and nothing else.
pub fn alone(triangles: usize) -> Outcome {
    let sphere = icosphere(triangles);
    let (lo, hi) = bounds(&sphere.vertices);
    let case = Case {
        name: format!("icosphere-{triangles}"),
        directory: PathBuf::new(),
        vertices: sphere.vertices,
        triangles: sphere.triangles,
        diagonal: Vec3::from_array([0, 1, 2].map(|d| hi[d] - lo[d])).length(),
    };
    println!("case\t{}\t{}\t{:e}", case.name, case.triangles.len(), case.diagonal);
    let mesh = mesh(&case)?;
    let g = geometry(&mesh, Accelerator::Auto, &Run::SERIAL)?;
    ask(&case, &g, &geometry(&mesh, Accelerator::None, &Run::SERIAL)?);
    Ok(())
}

/// At the exact centre and within 1e-6 of it, beside looking at every triangle.
pub fn ask(case: &Case, g: &Geometry, brute: &Geometry) {
    let mut random = Random(3);
    // Large spheres take their time.
    let count = (20_000_000 / case.triangles.len()).clamp(10, 200);
    let about: Vec<Vec3> = (0..count).map(|_| Vec3::from_array(random.point([-1e-6; 3], [1e-6; 3]))).collect();
    let exact = vec![Vec3::ZERO; count.min(20)];
    let few = &about[..count.min(20)];
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
    let visited = |points: &[Vec3]| -> Option<(f64, usize)> {
        let each: Vec<_> = points.iter().map(|p| g.leaves_visited(*p)).collect::<Option<_>>()?;
        let (_, all) = *each.first()?;
        Some((each.iter().map(|(visited, _)| *visited).sum::<usize>() as f64 / each.len() as f64, all))
    };
    if let (Some((near, all)), Some((at, _))) = (visited(&about), visited(&exact[..1])) {
        row(&case.name, "centre, leaves in all", "embound", all as f64, "leaves", None);
        row(&case.name, "centre, leaves visited", "embound", at, "leaves", None);
        row(&case.name, "centre within 1e-6, leaves visited", "embound", near, "leaves", None);
    }
}
