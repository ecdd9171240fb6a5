// SPDX-License-Identifier: MIT OR Apache-2.0
//! Every exact shape with random numbers, and crowds of parts.

use super::{direction, placed, rotation, vector};
use crate::common::random::Random;
use embound::geometry::Geometry;
use embound::math::Vec3;

/// A polygon around a point that it sees whole.
pub fn star(random: &mut Random, center: [f64; 2], least: f64, most: f64) -> Vec<[f64; 2]> {
    let n = 3 + random.below(7);
    (0..n)
        .map(|k| {
            let angle = std::f64::consts::TAU * (k as f64 + random.range(0.1, 0.9)) / n as f64;
            let r = random.range(least, most);
            [center[0] + r * angle.cos(), center[1] + r * angle.sin()]
        })
        .collect()
}

/// One of each exact shape, of a size around 1 near the origin.
pub fn exact(random: &mut Random) -> Vec<(&'static str, Geometry)> {
    let (a, axis, r) = (vector(random, 1.0), direction(random), random.range(0.2, 0.9));
    let h = random.range(0.5, 2.0);
    let b = (a + axis * h).to_array();
    let angle = random.range(10.0, 150.0);
    let half = [random.range(0.3, 1.0), random.range(0.3, 1.0), random.range(0.3, 1.0)];
    let turn = rotation(random);
    let least = half[0].min(half[1]).min(half[2]);
    let ring = star(random, [1.25, 0.0], 0.25, 1.0);
    let outline = star(random, [0.0, 0.0], 0.25, 1.0);
    let (a, axis) = (a.to_array(), axis.to_array());
    let corner = [a[0] + half[0], a[1] + half[1], a[2] + half[2]];
    let toward = [axis[1], axis[2] + 0.3, -axis[0]];
    let all = vec![
        ("sphere", Geometry::sphere(a, r)),
        ("cuboid", Geometry::cuboid(a, corner)),
        ("plane", Geometry::plane(a, axis)),
        ("plane z", Geometry::plane(a, [0.0, 0.0, -2.0])),
        ("torus", Geometry::torus(a, axis, r + 0.1, r * random.range(0.1, 1.0))),
        ("cylinder", Geometry::cylinder(a, b, r)),
        ("infinite cylinder", Geometry::infinite_cylinder(a, axis, r)),
        ("capsule", Geometry::capsule(a, b, r)),
        ("capsule by tips", Geometry::capsule_tips(a, b, 0.45 * h)),
        ("infinite cone", Geometry::infinite_cone(a, axis, angle)),
        ("cone", Geometry::cone(a, axis, h, angle)),
        ("box", Geometry::rounded_box(a, half, 0.0, Some(turn))),
        ("rounded box", Geometry::rounded_box(a, half, random.unit() * least, Some(turn))),
        ("rounded cylinder", Geometry::rounded_cylinder(a, axis, r, h, random.unit() * r.min(0.5 * h))),
        ("revolved polygon", Geometry::revolved_polygon(a, axis, &ring)),
        ("prism", Geometry::prism(a, b, toward, 3 + random.below(6) as u32, r)),
        ("extruded polygon", Geometry::extruded_polygon(a, Some(turn), &outline, -0.5, h)),
        ("ellipsoid", Geometry::ellipsoid(a, half, Some(turn))),
    ];
    all.into_iter().map(|(name, g)| (name, g.unwrap_or_else(|e| panic!("{name}: {e}")))).collect()
}

pub fn one(random: &mut Random) -> Geometry {
    let all = exact(random);
    all[random.below(all.len())].1.clone()
}

/// What a crowd is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crowd {
    Balls,
    Boxes,
    Mixed,
    WithPlanes,
    Composites,
    Heap,
    Copies,
}

pub const CROWDS: [Crowd; 7] =
    [Crowd::Balls, Crowd::Boxes, Crowd::Mixed, Crowd::WithPlanes, Crowd::Composites, Crowd::Heap, Crowd::Copies];

fn ball(random: &mut Random, size: f64) -> Geometry {
    Geometry::sphere(vector(random, 1.0).to_array(), size * random.range(0.1, 1.0)).unwrap()
}

fn cuboid(random: &mut Random, size: f64) -> Geometry {
    let (p, d) = (vector(random, 1.0), Vec3::from_array(random.point([0.1; 3], [1.0; 3])) * size);
    Geometry::cuboid((p - d).to_array(), (p + d).to_array()).unwrap()
}

/// A shape of about this size somewhere in the cube of half size 1.
fn small(random: &mut Random, size: f64) -> Geometry {
    let v = vector(random, 1.0).to_array();
    let turn = direction(random).to_array();
    one(random).scale(0.5 * size).unwrap().rotate(turn, 77.0, [0.0; 3]).unwrap().translate(v).unwrap()
}

fn composite(random: &mut Random, size: f64) -> Geometry {
    let (a, b) = (ball(random, size), ball(random, size));
    let near = a.bounds().center().to_array();
    let other = cuboid(random, size).translate(near).unwrap();
    match random.below(4) {
        0 => a.difference(&other),
        1 => Geometry::union(&[a, b]),
        2 => Geometry::intersection(&[a, other.rotate([1.0, 2.0, 3.0], 50.0, near).unwrap()]),
        _ => placed(&a, random).0.scale(0.5).unwrap().complement().unwrap().complement(),
    }
    .unwrap()
}

/// `n` parts within a cube of half size about 1.
pub fn crowd(kind: Crowd, n: usize, random: &mut Random) -> Vec<Geometry> {
    let size = 0.5 / (n as f64).cbrt().max(1.0);
    let mut all: Vec<Geometry> = (0..n)
        .map(|k| match kind {
            Crowd::Balls => ball(random, size),
            Crowd::Boxes => cuboid(random, size),
            Crowd::Mixed => small(random, size),
            Crowd::WithPlanes if k % 7 == 3 => {
                let out = direction(random);
                Geometry::plane((out * -1.2).to_array(), out.to_array()).unwrap()
            }
            Crowd::WithPlanes => small(random, size),
            Crowd::Composites => composite(random, size),
            Crowd::Heap => {
                if k % 2 == 0 {
                    ball(random, 1.0)
                } else {
                    cuboid(random, 1.0)
                }
            }
            Crowd::Copies => ball(random, size),
        })
        .collect();
    if kind == Crowd::Copies {
        // Every part three times over, at random places of the list; and faces that coincide.
        for k in 0..n {
            if k % 3 != 0 {
                all[k] = all[random.below(k)].clone();
            }
        }
        for k in (3..n).step_by(5) {
            let b = all[k].bounds();
            all[k] = Geometry::cuboid(b.lo.to_array(), b.hi.to_array()).unwrap();
        }
    }
    all
}
