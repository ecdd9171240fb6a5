// SPDX-License-Identifier: MIT OR Apache-2.0
//! The side by what most of six rays say.

use crate::bodies::{bowl, pipe, with_holes};
use crate::common::random::Random;
use crate::common::winding::winding_number;
use crate::common::{Soup, bodies, points};
use crate::{classes_hold, geometry, pierced};
use embound::geometry::SignMethod;

/// The winding number along a ray from its crossings; none where it comes near the rim of a triangle.
fn along(soup: &Soup, p: [f64; 3], axis: usize, ahead: bool) -> Option<i32> {
    let ahead_of = pierced(soup, p, axis)?.into_iter().filter(|(height, _)| (*height > p[axis]) == ahead);
    Some(ahead_of.map(|(_, faces_up)| if faces_up == ahead { 1 } else { -1 }).sum())
}

#[test]
fn four_of_six_rays_decide() {
    let mut random = Random(81);
    for (name, body) in with_holes().into_iter().filter(|(name, _)| !["soup", "moebius strip", "book"].contains(name)) {
        let mesh = body.mesh();
        let vertices = mesh.vertices().iter().map(|v| v.to_array()).collect();
        let as_it_stands = Soup { vertices, triangles: mesh.triangles().iter().map(|t| t.vertices).collect() };
        let g = geometry(&body, SignMethod::Ray);
        assert_eq!(g.properties().sign_method, SignMethod::Ray);
        let (lo, hi) = body.bounds();
        let mut compared = 0;
        for p in points::uniform(&body, 1.0, 700, &mut random) {
            assert!((0..3).all(|k| lo[k] <= p[k] && p[k] <= hi[k]));
            let rays = (0..6).map(|k| along(&as_it_stands, p, k / 2, k % 2 == 1)).collect::<Option<Vec<_>>>();
            let Some(rays) = rays else { continue };
            let value = g.value(p.into());
            assert_eq!(
                value < 0.0,
                rays.iter().filter(|w| **w >= 1).count() >= 4,
                "{name}: {value}, {rays:?} at {p:?}"
            );
            compared += 1;
        }
        assert!(compared > 600, "{name}: {compared}");
    }
}

#[test]
fn rays_and_the_winding_number_agree_where_it_is_clear() {
    let mut random = Random(82);
    let ball = bodies::icosphere(3);
    for body in [ball.without(|t| t == 7), ball.without(|t| t % 200 == 1), pipe(24, 40, 9.0)] {
        let [by_ray, by_winding] = [SignMethod::Ray, SignMethod::Winding].map(|sign| geometry(&body, sign));
        let (mut same, mut all) = (0, 0);
        for p in points::uniform(&body, 1.0, 2000, &mut random) {
            let winding = winding_number(&body, p);
            if !(0.05..0.95).contains(&winding) {
                all += 1;
                same += usize::from((by_ray.value(p.into()) < 0.0) == (by_winding.value(p.into()) < 0.0));
            }
        }
        assert!(all > 800 && same == all, "{same} of {all}");
    }
}

#[test]
fn by_rays_no_class_is_a_lie() {
    let mut random = Random(83);
    for (name, body) in with_holes() {
        let g = geometry(&body, SignMethod::Ray);
        let known = classes_hold(&body, &g, &mut random);
        assert!(known > 50, "{name}: {known}");
    }
    assert!(classes_hold(&bowl(3, 0.5), &geometry(&bowl(3, 0.5), SignMethod::Ray), &mut random) > 300);
}
