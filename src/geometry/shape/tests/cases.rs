// SPDX-License-Identifier: MIT OR Apache-2.0
//! One or more of each exact shape, with its inside written down plainly.

use super::super::{Cuboid, Ellipsoid, Extruded, Plane, Revolved, RoundedBox, Shape, Sphere};
use super::Frame;
use crate::math::{Vec3, length};

pub(super) struct Case {
    pub(super) name: &'static str,
    pub(super) shape: Box<dyn Shape>,
    /// The same in its own frame.
    pub(super) home: Box<dyn Shape>,
    /// Of points of its own frame.
    pub(super) inside: fn(Vec3) -> bool,
}

/// Arguments of constructors, brought to a frame.
struct Arguments<'a>(&'a Frame);

impl Arguments<'_> {
    fn at(&self, x: f64, y: f64, z: f64) -> [f64; 3] {
        self.0.out(Vec3::new(x, y, z)).to_array()
    }

    fn along(&self, x: f64, y: f64, z: f64) -> [f64; 3] {
        (self.0.turn * Vec3::new(x, y, z)).to_array()
    }

    fn long(&self, x: f64) -> f64 {
        x * self.0.scale
    }

    fn turn(&self) -> Option<[f64; 9]> {
        Some(self.0.turn.transpose().to_cols_array())
    }

    fn outline(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        points.iter().map(|p| p.map(|x| self.long(x))).collect()
    }
}

/// An L with a slanted end, and a polygon with a notch in a half plane.
const ANGLE: [[f64; 2]; 6] = [[-1.0, -1.0], [1.0, -0.5], [1.0, 0.0], [0.0, 0.25], [0.0, 1.0], [-1.0, 1.0]];
const GOBLET: [[f64; 2]; 7] =
    [[0.0, -1.0], [0.75, -1.0], [0.25, -0.25], [1.0, 1.0], [0.5, 1.0], [0.0, 0.25], [0.0, -0.5]];
const WASHER: [[f64; 2]; 4] = [[0.5, -0.25], [0.5, 0.25], [1.25, 0.5], [1.0, -0.25]];
const SPOOL: [[f64; 2]; 5] = [[0.0, 1.0], [0.0, -1.0], [0.5, -1.0], [1.0, 0.0], [0.5, 1.0]];

/// By crossings of a ray, in plain arithmetic.
fn in_polygon(points: &[[f64; 2]], x: f64, y: f64) -> bool {
    let mut inside = false;
    for (k, a) in points.iter().enumerate() {
        let b = points[(k + 1) % points.len()];
        if (a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) {
            inside = !inside;
        }
    }
    inside
}

fn radius(p: Vec3) -> f64 {
    (p.x * p.x + p.y * p.y).sqrt()
}

fn in_box(p: Vec3, half: Vec3) -> bool {
    p.abs().cmplt(half).all()
}

fn rounded(p: Vec3, core: Vec3, radius: f64) -> bool {
    length((p.abs() - core).max(Vec3::ZERO)) < radius
}

fn in_ellipsoid(p: Vec3, axes: Vec3) -> bool {
    let q = p / axes;
    q.dot(q) < 1.0
}

fn in_prism(p: Vec3, sides: u32, radius: f64) -> bool {
    let step = 2.0 * std::f64::consts::PI / f64::from(sides);
    let apothem = radius * libm::cos(0.5 * step);
    let within = |k: u32| {
        let angle = (f64::from(k) + 0.5) * step;
        p.x * libm::cos(angle) + p.y * libm::sin(angle) < apothem
    };
    (0..sides).all(within)
}

type Make = fn(&Arguments) -> crate::error::Result<Box<dyn Shape>>;

fn boxed<S: Shape + 'static>(shape: crate::error::Result<S>) -> crate::error::Result<Box<dyn Shape>> {
    Ok(Box::new(shape?))
}

/// Half of tan 25 degrees and the like, to the last digit that matters here.
fn tan(degrees: f64) -> f64 {
    libm::tan(degrees * std::f64::consts::PI / 180.0)
}

type Entry = (&'static str, Make, fn(Vec3) -> bool);

const ALL: [Entry; 25] = [
    ("ball", |a| boxed(Sphere::new(a.at(0.5, 0.0, 0.0), a.long(0.75))), |p| length(p - Vec3::X * 0.5) < 0.75),
    ("plane", |a| boxed(Plane::new(a.at(0.5, 0.25, 0.0), a.along(0.0, 0.0, -3.0))), |p| p.z > 0.0),
    (
        "slanted plane",
        |a| boxed(Plane::new(a.at(0.0, 0.25, 0.0), a.along(3.0, 4.0, 0.0))),
        |p| 0.6 * p.x + 0.8 * p.y < 0.2,
    ),
    (
        "torus",
        |a| boxed(Revolved::torus(a.at(0.0, 0.0, 0.25), a.along(0.0, 0.0, 1.0), a.long(1.0), a.long(0.375))),
        |p| {
            let (q, z) = (radius(p) - 1.0, p.z - 0.25);
            q * q + z * z < 0.375 * 0.375
        },
    ),
    (
        "cylinder",
        |a| boxed(Revolved::cylinder(a.at(0.0, 0.0, -0.5), a.at(0.0, 0.0, 1.0), a.long(0.5))),
        |p| radius(p) < 0.5 && p.z > -0.5 && p.z < 1.0,
    ),
    (
        "coin",
        |a| boxed(Revolved::cylinder(a.at(0.0, 0.0, -0.125), a.at(0.0, 0.0, 0.25), a.long(1.0))),
        |p| radius(p) < 1.0 && p.z > -0.125 && p.z < 0.25,
    ),
    (
        "infinite cylinder",
        |a| boxed(Revolved::infinite_cylinder(a.at(0.0, 0.0, 7.0), a.along(0.0, 0.0, 5.0), a.long(0.75))),
        |p| radius(p) < 0.75,
    ),
    (
        "capsule",
        |a| boxed(Revolved::capsule(a.at(0.0, 0.0, -0.5), a.at(0.0, 0.0, 1.0), a.long(0.5))),
        |p| length(p - Vec3::Z * p.z.clamp(-0.5, 1.0)) < 0.5,
    ),
    (
        "capsule by tips",
        |a| boxed(Revolved::capsule_tips(a.at(0.0, 0.0, -1.0), a.at(0.0, 0.0, 1.5), a.long(0.5))),
        |p| length(p - Vec3::Z * p.z.clamp(-0.5, 1.0)) < 0.5,
    ),
    (
        "infinite cone",
        |a| boxed(Revolved::infinite_cone(a.at(0.0, 0.0, -0.5), a.along(0.0, 0.0, 1.0), 50.0)),
        |p| radius(p) < (p.z + 0.5) * tan(25.0),
    ),
    (
        "wide infinite cone",
        |a| boxed(Revolved::infinite_cone(a.at(0.0, 0.0, 0.5), a.along(0.0, 0.0, -1.0), 140.0)),
        |p| radius(p) < (0.5 - p.z) * tan(70.0),
    ),
    (
        "cone",
        |a| boxed(Revolved::cone(a.at(0.0, 0.0, -1.0), a.along(0.0, 0.0, 1.0), a.long(1.75), 60.0)),
        |p| p.z < 0.75 && radius(p) < (p.z + 1.0) * tan(30.0),
    ),
    (
        "flat cone",
        |a| boxed(Revolved::cone(a.at(0.0, 0.0, -0.25), a.along(0.0, 0.0, 1.0), a.long(0.5), 120.0)),
        |p| p.z < 0.25 && radius(p) < (p.z + 0.25) * tan(60.0),
    ),
    (
        "rounded cylinder",
        |a| {
            boxed(Revolved::rounded_cylinder(
                a.at(0.0, 0.0, 0.5),
                a.along(0.0, 0.0, 1.0),
                a.long(1.0),
                a.long(1.5),
                a.long(0.25),
            ))
        },
        |p| {
            let (q, s) = ((radius(p) - 0.75).max(0.0), ((p.z - 0.5).abs() - 0.5).max(0.0));
            q * q + s * s < 0.0625
        },
    ),
    (
        "goblet",
        |a| boxed(Revolved::polygon(a.at(0.0, 0.0, 0.0), a.along(0.0, 0.0, 1.0), &a.outline(&GOBLET))),
        |p| in_polygon(&GOBLET, radius(p), p.z),
    ),
    (
        "washer",
        |a| boxed(Revolved::polygon(a.at(0.0, 0.0, 0.0), a.along(0.0, 0.0, 1.0), &a.outline(&WASHER))),
        |p| in_polygon(&WASHER, radius(p), p.z),
    ),
    (
        "spool",
        |a| boxed(Revolved::polygon(a.at(0.0, 0.0, 0.0), a.along(0.0, 0.0, 1.0), &a.outline(&SPOOL))),
        |p| in_polygon(&SPOOL, radius(p), p.z),
    ),
    (
        "rounded box",
        |a| boxed(RoundedBox::new(a.at(0.0, 0.25, 0.0), [1.0, 0.5, 0.75].map(|x| a.long(x)), a.long(0.25), a.turn())),
        |p| rounded(p - Vec3::Y * 0.25, Vec3::new(0.75, 0.25, 0.5), 0.25),
    ),
    (
        "round box",
        |a| boxed(RoundedBox::new(a.at(0.0, 0.0, 0.0), [1.0, 0.5, 0.5].map(|x| a.long(x)), a.long(0.5), a.turn())),
        |p| rounded(p, Vec3::new(0.5, 0.0, 0.0), 0.5),
    ),
    (
        "turned box",
        |a| boxed(RoundedBox::new(a.at(0.0, 0.0, 0.5), [1.0, 0.5, 0.75].map(|x| a.long(x)), 0.0, a.turn())),
        |p| in_box(p - Vec3::Z * 0.5, Vec3::new(1.0, 0.5, 0.75)),
    ),
    (
        "triangular prism",
        |a| boxed(Extruded::prism(a.at(0.0, 0.0, -0.5), a.at(0.0, 0.0, 0.75), a.along(2.0, 0.0, 5.0), 3, a.long(1.0))),
        |p| p.z > -0.5 && p.z < 0.75 && in_prism(p, 3, 1.0),
    ),
    (
        "hexagonal prism",
        |a| boxed(Extruded::prism(a.at(0.0, 0.0, -0.5), a.at(0.0, 0.0, 0.75), a.along(1.0, 0.0, 0.0), 6, a.long(1.0))),
        |p| p.z > -0.5 && p.z < 0.75 && in_prism(p, 6, 1.0),
    ),
    (
        "angle",
        |a| boxed(Extruded::polygon(a.at(0.0, 0.0, 0.0), a.turn(), &a.outline(&ANGLE), a.long(-0.75), a.long(0.5))),
        |p| p.z > -0.75 && p.z < 0.5 && in_polygon(&ANGLE, p.x, p.y),
    ),
    (
        "ellipsoid",
        |a| boxed(Ellipsoid::new(a.at(0.0, 0.0, 0.25), [0.5, 1.25, 0.75].map(|x| a.long(x)), a.turn())),
        |p| in_ellipsoid(p - Vec3::Z * 0.25, Vec3::new(0.5, 1.25, 0.75)),
    ),
    (
        "pancake",
        |a| boxed(Ellipsoid::new(a.at(0.0, 0.0, 0.0), [1.25, 1.25, 0.125].map(|x| a.long(x)), a.turn())),
        |p| in_ellipsoid(p, Vec3::new(1.25, 1.25, 0.125)),
    ),
];

/// All shapes in a frame; the one that cannot be turned only at home.
pub(super) fn cases(frame: &Frame) -> Vec<Case> {
    let both = |make: Make| (make(&Arguments(frame)).unwrap(), make(&Arguments(&Frame::HOME)).unwrap());
    let mut all: Vec<Case> = ALL
        .iter()
        .map(|&(name, make, inside)| {
            let (shape, home) = both(make);
            Case { name, shape, home, inside }
        })
        .collect();
    if frame.turn == Frame::HOME.turn {
        let (shape, home) = both(|a| boxed(Cuboid::new(a.at(-1.0, -0.5, -0.75), a.at(1.0, 0.5, 0.75))));
        all.push(Case { name: "box", shape, home, inside: |p| in_box(p, Vec3::new(1.0, 0.5, 0.75)) });
    }
    all
}
