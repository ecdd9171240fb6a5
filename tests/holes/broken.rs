// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bodies broken in ways that do not change what is inside: no sign is wrong farther than an edge from a hole.

use crate::common::random::Random;
use crate::common::winding::winding_number;
use crate::common::{Soup, bodies, points};
use crate::{diagonal, geometry};
use embound::geometry::SignMethod;

struct Broken {
    name: &'static str,
    broken: Soup,
    whole: Soup,
    /// Triangles of the whole that are missing.
    missing: Vec<usize>,
}

fn all() -> Vec<Broken> {
    let ball = bodies::icosphere(3);
    let slab = bodies::leaning_pyramid();
    let two = bodies::overlapping_spheres(3);
    let without = |soup: &Soup, missing: &[usize]| soup.without(|t| missing.contains(&t));
    let broken = |name, broken, whole: &Soup, missing: &[usize]| Broken {
        name,
        broken,
        whole: whole.clone(),
        missing: missing.to_vec(),
    };
    vec![
        broken("slab", slab.clone(), &slab, &[]),
        broken("twice", ball.duplicated(), &ball, &[]),
        broken("slab twice, turned", slab.double_sided(), &slab, &[]),
        broken("every second turned", ball.flipped_where(|t| t % 2 == 1), &ball, &[]),
        broken("through each other", two.clone(), &two, &[]),
        broken("through each other, a hole each", without(&two, &[40, 2000]), &two, &[40, 2000]),
        broken("one missing", without(&ball, &[100]), &ball, &[100]),
        broken("one missing, inside out", without(&ball, &[100]).flipped(), &ball, &[100]),
        broken("one missing, every second turned", without(&ball, &[100]).flipped_where(|t| t % 2 == 1), &ball, &[100]),
        broken("one missing, twice", without(&ball, &[100]).duplicated(), &ball, &[100]),
    ]
}

/// Whether a point is farther from the missing triangles than their longest edge.
fn is_far(Broken { whole, missing, .. }: &Broken, p: [f64; 3]) -> bool {
    missing.iter().all(|&t| {
        let corners = whole.corners(t);
        let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
        let edge = (0..3).map(|k| apart(corners[k], corners[(k + 1) % 3])).fold(0.0, f64::max);
        // What is this far from the corners is at least half as far from the triangle between them.
        corners.iter().all(|c| apart(*c, p) > 1.2 * edge)
    })
}

#[test]
fn no_sign_is_wrong_farther_than_an_edge_from_a_hole() {
    let mut random = Random(51);
    for body in all() {
        for scale in [1e-6, 1.0, 1e6] {
            let [broken, whole] = [&body.broken, &body.whole].map(|soup| soup.scaled(scale));
            let here = Broken { name: body.name, broken, whole, missing: body.missing.clone() };
            let methods = [SignMethod::Auto, SignMethod::Winding, SignMethod::Ray];
            let all = methods.map(|sign| geometry(&here.broken, sign));
            let mut compared = 0;
            for p in points::all_kinds(&here.whole, 300, &mut random).into_iter().filter(|p| is_far(&here, *p)) {
                let winding = winding_number(&here.whole, p);
                for (g, sign) in all.iter().zip(methods) {
                    let value = g.value(p.into());
                    if value.abs() > 1e-11 * diagonal(&here.whole) && (winding - winding.round()).abs() < 1e-6 {
                        assert_eq!(value < 0.0, winding >= 0.5, "{} {sign:?} {scale}: {value} at {p:?}", here.name);
                        compared += 1;
                    }
                }
            }
            assert!(compared > 1000, "{}: {compared}", here.name);
        }
    }
}
