// SPDX-License-Identifier: MIT OR Apache-2.0
//! Loops closed by triangles over them.

use crate::common::random::Random;
use crate::common::{Soup, bodies, points};
use crate::{as_given, build, mesh_of, pipes, points_in, questions_agree, same_with_every_layout, signs_are_those_of};
use embound::geometry::{Geometry, Open, RefitCheck, SdfOptions, SignMethod};
use embound::math::{Aabb, Vec3};
use embound::mesh::{JoinTags, Mesh, MeshOptions, Orient};
use embound::parallel::Run;
use std::f64::consts::{FRAC_PI_2, TAU};

fn options() -> SdfOptions {
    SdfOptions { open: Open::Cap, ..SdfOptions::default() }
}

/// A box around the body, with room.
fn around(soup: &Soup) -> Aabb {
    let b = Aabb::of(soup.vertices.iter().map(|p| Vec3::from_array(*p)));
    Aabb::new(b.lo - (b.hi - b.lo) * 0.2, b.hi + (b.hi - b.lo) * 0.2)
}

/// Of a plane rim all triangulations are the same surface.
struct Plane {
    open: Soup,
    whole: Soup,
}

fn plane_rims() -> Vec<Plane> {
    let ball = bodies::icosphere(3);
    let sides = 20;
    let mut dome = Soup { vertices: vec![[0.0, 0.0, 1.0]], triangles: vec![] };
    for row in 0..6 {
        for k in 0..sides {
            let (a, b) = (FRAC_PI_2 * f64::from(row) / 6.0, TAU * f64::from(k) / f64::from(sides));
            dome.vertices.push([libm::cos(a) * libm::cos(b), libm::cos(a) * libm::sin(b), libm::sin(a)]);
            let at = |row: u32, k: u32| 1 + row * sides + k % sides;
            match row {
                5 => dome.triangles.push([at(5, k), at(5, k + 1), 0]),
                _ => dome.triangles.extend([
                    [at(row, k), at(row, k + 1), at(row + 1, k + 1)],
                    [at(row, k), at(row + 1, k + 1), at(row + 1, k)],
                ]),
            }
        }
    }
    let mut whole = dome.clone();
    whole.vertices.push([0.0; 3]);
    let middle = whole.vertices.len() as u32 - 1;
    whole.triangles.extend((0..sides).map(|k| [1 + (k + 1) % sides, 1 + k, middle]));
    let cube = bodies::unit_cube();
    let missing = |soup: &Soup, t: usize| Plane { open: soup.without(|k| k == t), whole: soup.clone() };
    let lidless = cube.without(|t| cube.corners(t).iter().all(|c| c[2] == 1.0));
    let bar = pipes::all().swap_remove(0);
    let ends = |t: usize| bar.whole.corners(t).iter().any(|c| c[0].abs() > 5.0);
    let closed = {
        let short = bar.whole.map(|p| {
            [
                if p[0] < -5.0 {
                    -0.5
                } else if p[0] > 5.0 {
                    1.5
                } else {
                    p[0]
                },
                p[1],
                p[2],
            ]
        });
        (short.without(|t| ends(t) && short.corners(t).iter().all(|c| c[0] == short.corners(t)[0][0])), short)
    };
    vec![
        Plane { open: dome, whole },
        missing(&ball, 100),
        Plane { open: lidless, whole: cube.clone() },
        missing(&cube, 5),
        missing(&bodies::tetrahedron(), 3),
        Plane { open: closed.0, whole: closed.1 },
        missing(&bodies::bracket(), 11),
    ]
}

#[test]
fn plane_rims_are_capped_as_they_were() {
    let mut random = Random(81);
    for (number, Plane { open, whole }) in plane_rims().iter().enumerate() {
        for scale in [1e-6, 1.0, 1e6] {
            let whole = whole.scaled(scale);
            let reference = build(&whole.mesh(), &SdfOptions::default());
            for (k, soup) in as_given(&open.scaled(scale)).iter().enumerate() {
                let mesh = mesh_of(soup);
                assert!(mesh.surface().boundary_edges > 2);
                let at = points_in(soup, around(&whole), 60, &mut random);
                let g = same_with_every_layout(&mesh, &options(), &at);
                assert_eq!(g.properties().sign_method, SignMethod::Pseudonormal, "{number} {k}");
                for p in &at {
                    let p = Vec3::from_array(*p);
                    let (a, b) = (g.value(p), reference.value(p));
                    assert!((a - b).abs() < 1e-14 * scale, "{number} {k} {p}: {a} and {b}");
                }
                assert!(signs_are_those_of(&whole, &g, &at, scale) > 100, "{number} {k}");
            }
        }
    }
}

#[test]
fn every_question_sees_the_caps() {
    let mut random = Random(82);
    for Plane { open, whole } in plane_rims() {
        questions_agree(&build(&mesh_of(&open), &options()), around(&whole), &mut random);
    }
}

#[test]
fn shells_that_caps_close_find_their_orientation_as_closed_ones_do() {
    // Of three domes in each other, as files have them: solid, hollow and solid again.
    let dome = |r: f64| bodies::icosphere(3).without(|t| t == 40).scaled(r);
    let shells = dome(3.0).and(&dome(2.0).flipped()).and(&dome(1.0));
    let whole = bodies::nested_shells(3);
    let mut random = Random(83);
    let at = points::all_kinds(&whole, 100, &mut random);
    for soup in as_given(&shells) {
        assert!(signs_are_those_of(&whole, &build(&mesh_of(&soup), &options()), &at, 1.0) > 150);
    }
    // Two of them side by side, one inside out.
    let apart = dome(1.0).and(&dome(1.0).flipped().translated([3.0, 0.0, 0.0]));
    let balls = bodies::icosphere(3).and(&bodies::icosphere(3).translated([3.0, 0.0, 0.0]));
    let g = build(&apart.mesh(), &options());
    let outside = build(&apart.mesh_kept(), &options());
    assert!(outside.value(Vec3::new(3.0, 0.0, 0.0)) > 0.0 && g.value(Vec3::ZERO) < -0.9);
    // As with closed shells, each keeps the side it was given but for the volume of the outermost: itself.
    assert!(signs_are_those_of(&balls, &g, &points::all_kinds(&balls, 100, &mut random), 1.0) > 150);
}

#[test]
fn kept_as_given_an_inside_out_body_stays_so() {
    let ball = bodies::icosphere(2).without(|t| t == 7);
    for (soup, orient, side) in [
        (ball.flipped(), Orient::Keep, 1.0),
        (ball.clone(), Orient::Keep, -1.0),
        (ball.clone(), Orient::Flip, 1.0),
        (ball.flipped(), Orient::Auto, -1.0),
    ] {
        let mesh = soup.mesh_with(&MeshOptions { orient, ..MeshOptions::default() });
        assert!(build(&mesh, &options()).value(Vec3::ZERO) * side > 0.9, "{orient:?}");
        // What is made of it knows how it was oriented.
        let moved = mesh.rebuilt(&MeshOptions { shift: [0.1, 0.0, 0.0], ..MeshOptions::default() }).expect("moved");
        assert!(build(&moved, &options()).value(Vec3::new(0.1, 0.0, 0.0)) * side > 0.9, "{orient:?}");
        let parts = mesh.split(embound::mesh::SplitBy::Component).expect("parts");
        assert!(build(&parts[0], &options()).value(Vec3::ZERO) * side > 0.9, "{orient:?}");
        let joined = Mesh::join(&[&mesh, &moved], JoinTags::Keep, &MeshOptions::default()).expect("joined");
        assert!(build(&joined, &options()).value(Vec3::ZERO) * side > 0.8, "{orient:?}");
    }
}

#[test]
fn fins_and_sheets_become_what_has_no_thickness() {
    let mut random = Random(84);
    // A fin on a body, and sheets afloat: surface all the same, with nothing inside.
    let cube = bodies::unit_cube();
    let corner = cube.vertices.iter().position(|p| *p == [1.0, 0.0, 0.0]).expect("a corner") as u32;
    let above = cube.vertices.iter().position(|p| *p == [1.0, 0.0, 1.0]).expect("a corner") as u32;
    let mut fin = cube.clone();
    fin.vertices.push([2.0, -0.5, 0.5]);
    fin.triangles.push([corner, above, 8]);
    let triangle = Soup { vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]], triangles: vec![[0, 1, 2]] };
    for (open, body) in [(fin, Some(cube)), (triangle, None), (bodies::sheet(3), None), (bodies::book(5), None)] {
        let g = build(&open.mesh(), &options());
        let unsigned = build(&open.mesh(), &SdfOptions { sign: SignMethod::None, ..SdfOptions::default() });
        let solid = body.as_ref().map(|body| build(&body.mesh(), &SdfOptions::default()));
        for p in points_in(&open, around(&open), 100, &mut random) {
            let p = Vec3::from_array(p);
            let inside = solid.as_ref().is_some_and(|solid| solid.value(p) < 0.0);
            let value = g.value(p);
            assert!((value.abs() - unsigned.value(p)).abs() < 1e-15, "{p}");
            assert!(value == 0.0 || (value < 0.0) == inside || value.abs() < 1e-12, "{p}: {value}");
        }
        questions_agree(&g, around(&open), &mut random);
    }
}

#[test]
fn large_loops_are_capped_by_ears() {
    let n = 1200;
    // Round, and of any shape, where what is steep may meet the body.
    for (wave, sign) in [([0.05, 2.0, 0.1], SignMethod::Pseudonormal), ([0.3, 7.0, 0.02], SignMethod::Ray)] {
        let mut open = Soup { vertices: vec![[0.0, 0.0, 2.0]], triangles: vec![] };
        for k in 0..n {
            let a = std::f64::consts::TAU * f64::from(k) / f64::from(n);
            let r = 1.0 + wave[0] * libm::sin(wave[1] * a);
            open.vertices.push([r * libm::cos(a), r * libm::sin(a), wave[2] * libm::cos(3.0 * a)]);
            open.triangles.push([0, k + 1, (k + 1) % n + 1]);
        }
        let g = build(&open.mesh(), &options());
        assert_eq!(g.properties().sign_method, sign);
        assert_eq!(g.properties().primitives, u64::from(2 * n - 2));
        assert!(g.value(Vec3::new(0.0, 0.0, 1.0)) < -0.3 && g.value(Vec3::new(0.0, 0.0, -0.5)) > 0.3);
        questions_agree(&g, around(&open), &mut Random(85));
    }
}

#[test]
fn caps_stay_the_triangles_they_are_when_vertices_move() {
    let kept = MeshOptions { orient: Orient::Keep, weld_tolerance: -1.0, ..MeshOptions::default() };
    let ball = bodies::icosphere(3);
    let open = ball.without(|t| t % 100 == 3);
    let g = build(&open.mesh_with(&kept), &options());
    let grown = open.map(|p| [1.5 * p[0], p[1], p[2] + 0.2 * p[0]]);
    let moved = g.refit(&grown.xyz(), RefitCheck::Check, &Run::SERIAL).expect("moved");
    let anew = build(&ball.map(|p| [1.5 * p[0], p[1], p[2] + 0.2 * p[0]]).mesh(), &SdfOptions::default());
    let mut random = Random(86);
    for p in points_in(&grown, around(&grown), 200, &mut random) {
        let p = Vec3::from_array(p);
        assert!((moved.value(p) - anew.value(p)).abs() < 1e-14, "{p}");
    }
}

#[test]
fn polygons_with_a_lid_missing_are_capped() {
    let cube = bodies::unit_cube();
    let xyz: Vec<f64> = (0..8).flat_map(|k: usize| [0, 1, 2].map(|axis| (k >> axis & 1) as f64)).collect();
    let indices = [0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2];
    let offsets: Vec<usize> = (0..=5).map(|f| 4 * f).collect();
    let mesh = Mesh::from_polygons(&xyz, &offsets, &indices, None, &MeshOptions::default()).expect("a box");
    let (g, whole): (Geometry, Geometry) = (build(&mesh, &options()), build(&cube.mesh(), &SdfOptions::default()));
    let mut random = Random(87);
    for _ in 0..500 {
        let p = Vec3::from_array(random.point([-0.5; 3], [1.5; 3]));
        assert!((g.value(p) - whole.value(p)).abs() < 1e-15);
        assert_eq!(g.closest(p).primitive < 0, g.closest(p).piece < 0);
    }
    questions_agree(&g, Aabb::new(Vec3::splat(-0.3), Vec3::splat(1.3)), &mut random);
}
