// SPDX-License-Identifier: MIT OR Apache-2.0
//! What has holes.

use crate::common::{Soup, bodies};

/// A pipe along z, open at both ends.
pub fn pipe(around: u32, along: u32, length: f64) -> Soup {
    let mut soup = Soup { vertices: vec![], triangles: vec![] };
    for k in 0..=along {
        for i in 0..around {
            let (s, c) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(around));
            soup.vertices.push([0.5 * c, 0.5 * s, length * f64::from(k) / f64::from(along)]);
        }
    }
    for k in 0..along {
        for i in 0..around {
            let at = |i: u32, k: u32| i % around + around * k;
            soup.triangles.push([at(i, k), at(i + 1, k), at(i + 1, k + 1)]);
            soup.triangles.push([at(i, k), at(i + 1, k + 1), at(i, k + 1)]);
        }
    }
    soup
}

/// A ball without what lies above a height.
pub fn bowl(level: u32, height: f64) -> Soup {
    let ball = bodies::icosphere(level);
    let is_above = |t: usize| ball.corners(t).iter().all(|c| c[2] >= height);
    ball.without(is_above)
}

/// Hills over a square, higher than wide if so asked; `fold`: they lean over.
pub fn terrain(n: u32, fold: f64) -> Soup {
    let mut soup = bodies::sheet(n as usize);
    let (lo, hi) = soup.bounds();
    for v in &mut soup.vertices {
        let [x, y] = [0, 1].map(|k| (v[k] - lo[k]) / (hi[k] - lo[k]));
        let z = 0.3 * libm::sin(7.0 * x) * libm::cos(5.0 * y) + 0.1 * libm::sin(23.0 * x + 11.0 * y);
        *v = [x + fold * z, y, z];
    }
    soup
}

/// Bodies with holes that are small, and with large ones, some through each other.
pub fn with_holes() -> Vec<(&'static str, Soup)> {
    let ball = bodies::icosphere(3);
    let torus = bodies::torus(1.0, 0.3, 40, 20);
    let overlapping = bodies::overlapping_spheres(3);
    let pierced = ball.without(|t| t % 131 == 7);
    vec![
        ("ball", bodies::icosphere(2)),
        ("cube", bodies::unit_cube()),
        ("ball without a triangle", ball.without(|t| t == 17)),
        ("ball without many", pierced.clone()),
        ("torus", torus.without(|t| (300..340).contains(&t) || t == 3)),
        ("slab", bodies::leaning_pyramid().without(|t| t == 1)),
        ("box without a lid", bodies::quartered(&bodies::quartered(&bodies::unit_cube())).without(|t| t < 20)),
        ("balls through each other", overlapping.without(|t| t % 201 == 5)),
        ("bowl", bowl(3, 0.5)),
        ("deep bowl", bowl(3, -0.4)),
        ("pipe", pipe(24, 20, 3.0)),
        ("ball and bowl", pierced.and(&bowl(2, 0.2).translated([0.7, 0.3, 0.1]))),
        ("book", bodies::book(3)),
        ("moebius strip", bodies::moebius_strip(40)),
        ("soup", bodies::lattice_soup(80)),
    ]
}
