// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pipes that are open at both ends, and the same ones gone on with beyond the unit cube and closed there.

use crate::common::Soup;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Where a pipe is cut: its middle, and two directions across it, the first turned into the second about its own.
#[derive(Clone, Copy)]
struct Cut {
    middle: [f64; 3],
    across: [[f64; 3]; 2],
}

/// An open pipe and its continuation.
pub struct Pipe {
    pub name: &'static str,
    pub open: Soup,
    pub whole: Soup,
}

fn wall(cuts: &[Cut], radius: f64, sides: usize) -> Soup {
    let mut soup = Soup::default();
    for cut in cuts {
        for k in 0..sides {
            let angle = TAU * k as f64 / sides as f64;
            let (u, v) = (radius * libm::cos(angle), radius * libm::sin(angle));
            let [a, b] = cut.across;
            soup.vertices.push([0, 1, 2].map(|d| cut.middle[d] + u * a[d] + v * b[d]));
        }
    }
    for c in 0..cuts.len() - 1 {
        for k in 0..sides {
            let at = |c: usize, k: usize| (c * sides + k % sides) as u32;
            let [a, b, d, e] = [at(c, k), at(c, k + 1), at(c + 1, k), at(c + 1, k + 1)];
            soup.triangles.extend([[a, b, e], [a, e, d]]);
        }
    }
    soup
}

/// Triangles over the first and the last of the cuts.
fn discs(mut soup: Soup, sides: usize) -> Soup {
    let last = (soup.vertices.len() - sides) as u32;
    for k in 1..sides as u32 - 1 {
        soup.triangles.extend([[0, k + 1, k], [last, last + k, last + k + 1]]);
    }
    soup
}

/// Pipes with cuts within the unit cube, and with one more at either end.
fn pipe(name: &'static str, inner: &[Cut], ends: [Cut; 2], radii: &[f64]) -> Pipe {
    let sides = 16;
    let long: Vec<Cut> = [&ends[..1], inner, &ends[1..]].concat();
    let (mut open, mut whole) = (Soup::default(), Soup::default());
    for (k, &radius) in radii.iter().enumerate() {
        let (part, closed) = (wall(inner, radius, sides), discs(wall(&long, radius, sides), sides));
        // A bore runs inward, and ends before what is around it does.
        let bore = |soup: Soup| if k == 1 { soup.flipped() } else { soup };
        let short = |p: [f64; 3]| if k == 1 { p.map(|c| if c.abs() > 5.0 { c * 0.9 } else { c }) } else { p };
        (open, whole) = (open.and(&bore(part)), whole.and(&bore(closed.map(short))));
    }
    Pipe { name, open, whole }
}

pub fn all() -> Vec<Pipe> {
    let (y, z) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let along_x = |x: f64| Cut { middle: [x, 0.52, 0.47], across: [y, z] };
    // Across an axis that leans, so that the ends do too.
    let leaning = |x: f64, slope: f64| Cut { middle: [x, 0.52, 0.47], across: [[slope, 1.0, 0.0], [-slope, 0.0, 1.0]] };
    let straight = [0.0, 0.3, 0.7, 1.0].map(along_x);
    let short = [0.03, 0.5, 0.96].map(along_x);
    let ends = [along_x(-20.0), along_x(21.0)];
    let elbow: Vec<Cut> = (0..=6)
        .map(|k| {
            let angle = FRAC_PI_2 * f64::from(k) / 6.0;
            let (s, c) = (libm::sin(angle), libm::cos(angle));
            Cut { middle: [0.3 + 0.4 * s, 0.7 - 0.4 * c, 0.47], across: [[-s, c, 0.0], z] }
        })
        .collect();
    let at = |middle: [f64; 3], u: [f64; 3]| Cut { middle, across: [u, z] };
    let bent: Vec<Cut> =
        [vec![at([0.0, 0.3, 0.47], [0.0, 1.0, 0.0])], elbow, vec![at([0.7, 1.0, 0.47], [-1.0, 0.0, 0.0])]].concat();
    let bent_ends = [at([-20.0, 0.3, 0.47], [0.0, 1.0, 0.0]), at([0.7, 21.0, 0.47], [-1.0, 0.0, 0.0])];
    let tilted = [leaning(0.0, 0.4), along_x(0.5), leaning(1.0, -0.7)];
    vec![
        pipe("straight", &straight, ends, &[0.2]),
        pipe("ends a little within", &short, ends, &[0.2]),
        pipe("bent", &bent, bent_ends, &[0.15]),
        pipe("tilted", &tilted, ends, &[0.2]),
        pipe("with a bore", &straight, ends, &[0.25, 0.15]),
        pipe("bent, with a bore", &bent, bent_ends, &[0.18, 0.1]),
    ]
}
