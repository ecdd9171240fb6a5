// SPDX-License-Identifier: MIT OR Apache-2.0
//! One geometry or more of every kind of node.

use crate::common::bodies;
use embound::geometry::{Accelerator, Blend, ExpressionOptions, Geometry, Open, RefitCheck, SdfOptions, SignMethod};
use embound::math::{Aabb, Vec3};
use embound::mesh::{Mesh, MeshOptions};
use embound::parallel::Run;

pub fn mesh(accelerator: Accelerator) -> Geometry {
    let soup = bodies::torus(0.8, 0.3, 24, 14);
    let tags: Vec<i32> = (0..soup.triangles.len() as i32).map(|t| t % 7 - 3).collect();
    let mesh =
        Mesh::from_triangles(&soup.xyz(), &soup.indices(), Some(&tags), &MeshOptions::default()).expect("a mesh");
    let options = SdfOptions { accelerator, ..SdfOptions::default() };
    Geometry::from_mesh(&mesh, &options, &Run::SERIAL).expect("a geometry")
}

fn of(soup: &crate::common::Soup, sign: SignMethod) -> Geometry {
    let options = SdfOptions { sign, ..SdfOptions::default() };
    Geometry::from_mesh(&soup.mesh(), &options, &Run::SERIAL).expect("a geometry")
}

/// A box without two of its sides.
fn open(open: Open) -> Geometry {
    let cube = bodies::unit_cube();
    let soup =
        cube.without(|t| cube.corners(t).iter().all(|c| c[0] == 1.0) || cube.corners(t).iter().all(|c| c[0] == 0.0));
    let options = SdfOptions { open, open_lo: [0.1; 3], open_hi: [0.9; 3], ..SdfOptions::default() };
    Geometry::from_mesh(&soup.mesh(), &options, &Run::SERIAL).expect("a geometry")
}

fn balls(n: usize) -> Vec<Geometry> {
    let ball = |k: usize| {
        let x = k as f64;
        Geometry::sphere([libm::sin(x), libm::cos(1.7 * x), libm::sin(2.3 * x)], 0.05 + 0.001 * (k % 7) as f64)
    };
    (0..n).map(|k| ball(k).expect("a ball")).collect()
}

/// The kinds of mesh.
pub fn meshes() -> Vec<(&'static str, Geometry)> {
    let kept = bodies::icosphere(2);
    let grown: Vec<f64> = kept.xyz().iter().map(|x| 1.25 * x).collect();
    let ball = of(&kept, SignMethod::Auto);
    let refit = ball.refit(&grown, RefitCheck::Check, &Run::SERIAL).expect("moved");
    vec![
        ("full", mesh(Accelerator::Auto)),
        ("compact", mesh(Accelerator::Compact)),
        ("brute", mesh(Accelerator::None)),
        ("two triangles", of(&bodies::sheet(1), SignMethod::None)),
        ("tetrahedron", of(&bodies::tetrahedron(), SignMethod::Auto)),
        ("rays", of(&bodies::cubes_sharing_an_edge(), SignMethod::Auto)),
        ("doubts", of(&bodies::overlapping_spheres(2), SignMethod::Auto)),
        ("flat triangles", of(&bodies::with_flat_triangles(&bodies::unit_cube()), SignMethod::Auto)),
        ("capped", open(Open::Cap)),
        ("swept", open(Open::Sweep)),
        ("a soup", of(&bodies::lattice_soup(200), SignMethod::None)),
        ("holes", of(&bodies::icosphere(2).without(|t| t % 40 == 3), SignMethod::Auto)),
        ("open, by rays", of(&bodies::icosphere(1).without(|t| t < 20), SignMethod::Ray)),
        ("terrain", of(&bodies::sheet(4), SignMethod::Axis)),
        ("refit beside what it was", Geometry::union(&[ball, refit]).expect("a union")),
    ]
}

/// Every kind of node but meshes; small.
pub fn small() -> Vec<(&'static str, Geometry)> {
    let ball = Geometry::sphere([0.1, -0.2, 0.3], 0.7).expect("a ball");
    let cuboid = Geometry::cuboid([-0.5, -0.4, -0.3], [0.6, 0.5, 0.4]).expect("a box");
    let turn = [0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6];
    let wave: Vec<f64> = (0..35).map(|k| 0.1 * libm::sin(f64::from(k))).collect();
    let samples: Vec<f64> = (0..60).map(|k| 0.3 * libm::sin(1.3 * f64::from(k)) + 0.05).collect();
    let (x, y, z) = ([-1.0, -0.5, 0.1, 0.4, 1.0], [1.0, 0.5, 0.0, -1.0], [-1.0, 0.0, 2.0]);
    let ell = [[0.0, -0.6], [0.8, -0.6], [0.5, 0.1], [0.7, 0.9], [0.0, 0.6]];
    let bounds = Aabb::new(Vec3::splat(-1.5), Vec3::splat(1.5));
    let all = [
        ("sphere", Ok(ball.clone())),
        ("cuboid", Ok(cuboid.clone())),
        ("plane", Geometry::plane([0.1, 0.2, -0.1], [1.0, 2.0, -0.5])),
        ("torus", Geometry::torus([0.1, 0.0, 0.2], [1.0, 1.0, 0.3], 0.8, 0.2)),
        ("cylinder", Geometry::cylinder([0.0, 0.1, -0.9], [0.3, 0.2, 0.8], 0.4)),
        ("infinite cylinder", Geometry::infinite_cylinder([0.0; 3], [0.2, 0.3, 1.0], 0.4)),
        ("capsule", Geometry::capsule([-0.5, 0.0, 0.1], [0.5, 0.2, 0.0], 0.3)),
        ("infinite cone", Geometry::infinite_cone([0.1, 0.2, -0.7], [0.1, 0.2, 1.0], 40.0)),
        ("cone", Geometry::cone([0.1, 0.2, -0.7], [0.1, 0.2, 1.0], 1.1, 50.0)),
        ("rounded box", Geometry::rounded_box([0.1; 3], [0.5, 0.4, 0.3], 0.1, Some(turn))),
        ("rounded cylinder", Geometry::rounded_cylinder([0.0; 3], [0.0, 1.0, 1.0], 0.6, 1.0, 0.1)),
        ("revolved", Geometry::revolved_polygon([0.0, 0.1, 0.0], [0.1, 0.0, 1.0], &ell)),
        ("prism", Geometry::prism([0.0; 3], [0.2, 0.1, 0.9], [1.0, 0.0, 0.0], 7, 0.6)),
        ("extruded", Geometry::extruded_polygon([0.0, 0.1, 0.2], Some(turn), &ell, -0.4, 0.5)),
        ("ellipsoid", Geometry::ellipsoid([0.1, 0.0, 0.0], [0.9, 0.4, 0.6], Some(turn))),
        ("perlin", Geometry::perlin(0.4, [1.0, 2.0, 1.5], 0.5, 3, 77)),
        ("height field", Geometry::height_field([&x, &[-1.0, -0.7, -0.2, 0.1, 0.3, 0.6, 1.0]], &wave)),
        ("grid", Geometry::grid([&x, &y, &z], &samples)),
        (
            "bounded expression",
            Geometry::expression("x^2+y^2+2*z^2-0.6", &ExpressionOptions { bounds, lipschitz: 0.0 }),
        ),
        ("expression", Geometry::expression("max(abs(x),y,z)-0.5", &ExpressionOptions::default())),
        ("nothing", Geometry::union(&[])),
        ("everything", Geometry::intersection(&[])),
        ("union", Geometry::union(&[ball.clone(), cuboid.clone()])),
        ("difference", cuboid.difference(&ball)),
        ("balls", Geometry::union(&balls(60))),
        ("crowd", Ok(crowd())),
        ("rest of a crowd", crowd().complement()),
        ("smooth", Geometry::smooth_union(&[ball.clone(), cuboid.clone()], &Blend::Smooth(0.2))),
        ("exponential", Geometry::smooth_intersection(&[ball.clone(), cuboid.clone()], &Blend::Exponential(0.05))),
        ("repeat", ball.repeat([1.7, -1.5, 0.0], [3, 2, 1])),
        ("translate", ball.translate([0.1, 0.2, 0.3])),
        ("place", cuboid.place(turn, [0.1, 0.2, 0.3]).and_then(|g| g.rotate([1.0, 2.0, 3.0], 25.0, [0.1; 3]))),
        ("scale", cuboid.scale(0.7)),
        ("reflect", cuboid.reflect_in([0.1; 3], [1.0, 2.0, 0.5])),
        ("affine", cuboid.affine([1.0, 0.3, 0.0, 0.0, 1.5, 0.1, 0.2, 0.0, 0.8], [0.1, 0.0, 0.2])),
        ("slice", cuboid.slice([0.0, 0.1, 0.0], [1.0, 0.2, 0.1], [0.0, 1.0, 1.0])),
        ("elongate", ball.elongate([0.3, 0.0, 0.1])),
        ("twist", cuboid.twist(40.0)),
        (
            "unbounded twist",
            Geometry::infinite_cylinder([0.3, 0.0, 0.0], [0.0, 0.0, 1.0], 0.4).and_then(|g| g.twist(40.0)),
        ),
        ("offset", cuboid.offset(0.1)),
        ("annular", cuboid.annular(0.05)),
        ("lower bound", Geometry::perlin(0.4, [1.0; 3], 0.5, 2, 5).and_then(|g| g.lower_bound())),
        ("blur", cuboid.blur(0.05, 0.4)),
        ("mollify", cuboid.mollify(0.1, 4)),
        ("part", ball.part(-7)),
        (
            "cut out",
            cuboid.union_of_two(&ball).twist(40.0).and_then(|g| g.simplified(Aabb::new(Vec3::ZERO, Vec3::splat(0.2)))),
        ),
    ];
    all.map(|(name, g)| (name, g.unwrap_or_else(|e| panic!("{name}: {e}")))).into()
}

trait OfTwo {
    fn union_of_two(&self, other: &Geometry) -> Geometry;
}

impl OfTwo for Geometry {
    fn union_of_two(&self, other: &Geometry) -> Geometry {
        Geometry::union(&[self.clone(), other.clone()]).expect("a union")
    }
}

/// Balls, boxes, labels, a plane that stands beside, and one body many times.
pub fn crowd() -> Geometry {
    let mut parts = balls(20);
    let cuboid = Geometry::cuboid([-0.1; 3], [0.1, 0.2, 0.1]).expect("a box");
    for k in 0..12 {
        let x = f64::from(k) * 0.3 - 1.5;
        parts.push(cuboid.translate([x, 0.3 * x, -x]).and_then(|g| g.part(k)).expect("a part"));
    }
    parts.push(Geometry::plane([0.0, 0.0, -1.5], [0.0, 0.0, 1.0]).expect("a plane"));
    Geometry::union(&parts).expect("a union")
}
