// SPDX-License-Identifier: MIT OR Apache-2.0
//! Below a sheet, and no side of it: terrain and baffles.

use crate::bodies::terrain;
use crate::common::lattices::{around, compared};
use crate::common::random::Random;
use crate::common::{Soup, bodies, points};
use crate::{classes_hold, geometry, pierced};
use embound::geometry::{Geometry, SdfOptions, SignMethod};
use embound::math::{Aabb, Vec3};
use embound::parallel::Run;
use embound::query;

/// Whether a triangle lies ahead of a point, along an axis, but for the rims of triangles.
fn is_met(soup: &Soup, p: [f64; 3], axis: usize) -> Option<bool> {
    Some(pierced(soup, p, axis)?.iter().any(|(height, _)| *height > p[axis]))
}

fn turned(soup: &Soup, axis: usize) -> Soup {
    soup.map(|p| [0, 1, 2].map(|k| p[(k + 2 - axis) % 3]))
}

#[test]
fn solid_is_what_lies_below_a_terrain() {
    let mut random = Random(71);
    for fold in [0.0, 0.7] {
        for axis in 0..3 {
            for scale in [1e-6, 1.0, 1e6] {
                let body = turned(&terrain(12, fold), axis).scaled(scale);
                let options = SdfOptions { sign: SignMethod::Axis, axis: axis as i32, ..SdfOptions::default() };
                let g = Geometry::from_mesh(&body.mesh(), &options, &Run::SERIAL).unwrap();
                assert_eq!(g.properties().sign_method, SignMethod::Axis);
                let (mut inside, mut outside) = (0, 0);
                for p in points::uniform(&body, 1.3, 1500, &mut random) {
                    let value = g.value(p.into());
                    let Some(met) = is_met(&body, p, axis) else { continue };
                    assert_eq!(value < 0.0, met, "{value} at {p:?}");
                    *(if met { &mut inside } else { &mut outside }) += 1;
                }
                assert!(inside > 300 && outside > 300, "{inside} {outside}");
                // Down without end, and nothing above.
                let b = g.bounds();
                assert_eq!(b.lo[axis], f64::NEG_INFINITY);
                let (lo, hi) = body.bounds();
                let mut deep = [0, 1, 2].map(|k| 0.5 * (lo[k] + hi[k]));
                deep[axis] = -1e9 * scale;
                assert!(g.value(deep.into()) < 0.0);
                let mut high = Aabb::new(lo.into(), hi.into());
                (high.lo[axis], high.hi[axis]) = (hi[axis] + scale, hi[axis] + 2.0 * scale);
                assert_eq!(query::classify_box(&g, high), 1);
            }
        }
    }
}

#[test]
fn below_a_terrain_classes_hold_and_are_found() {
    let mut random = Random(72);
    for fold in [0.0, 0.7] {
        let body = terrain(12, fold);
        let g = geometry(&body, SignMethod::Axis);
        assert!(classes_hold(&body, &g, &mut random) > 400);
        classes_hold(&body, &g.complement().unwrap(), &mut random);
        // Well within the rim and below all of it.
        let below = Aabb::new(Vec3::new(0.4, 0.4, -3.0), Vec3::new(0.6, 0.6, -2.0));
        assert_eq!(query::classify_box(&g, below), -1);
        assert_eq!(query::classify_box(&g, Aabb::new(Vec3::new(0.4, 0.4, -3.0), Vec3::new(2.6, 0.6, -2.0))), 0);
    }
}

#[test]
fn a_baffle_is_a_wall_with_a_thickness() {
    let plate = bodies::sheet(6);
    let options = SdfOptions { sign: SignMethod::None, ..SdfOptions::default() };
    let baffle = Geometry::from_mesh(&plate.mesh(), &options, &Run::SERIAL).unwrap();
    let wall = baffle.annular(0.1).unwrap();
    let mut random = Random(73);
    let mut inside = 0;
    for p in points::uniform(&plate.and(&plate.translated([0.0, 0.0, 0.5])), 1.2, 3000, &mut random) {
        let beyond = [0, 1].map(|k| (p[k] - p[k].clamp(0.0, 6.0)).powi(2));
        let distance = (beyond[0] + beyond[1] + p[2] * p[2]).sqrt();
        assert!((wall.value(p.into()) - (distance - 0.1)).abs() < 1e-14);
        assert!(baffle.value(p.into()) >= 0.0);
        inside += usize::from(wall.value(p.into()) <= 0.0);
    }
    assert!(inside > 200);
    assert!(compared(&wall, &around(&plate.and(&plate.translated([0.0, 0.0, 0.3])), [11, 12, 9], 1.3)) > 50);
}
