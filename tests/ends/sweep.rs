// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bodies that leave the domain.

use crate::common::random::Random;
use crate::common::{Soup, bodies};
use crate::{as_given, build, mesh_of, pipes, points_in, questions_agree, same_with_every_layout, signs_are_those_of};
use embound::geometry::{Geometry, Open, RefitCheck, SdfOptions, SignMethod};
use embound::math::{Aabb, Vec3};
use embound::mesh::{MeshOptions, Orient};
use embound::parallel::Run;

fn cube(scale: f64) -> Aabb {
    Aabb::new(Vec3::ZERO, Vec3::splat(scale))
}

fn options(scale: f64) -> SdfOptions {
    SdfOptions { open: Open::Sweep, open_hi: [scale; 3], ..SdfOptions::default() }
}

/// Values of what is swept against those of the body that goes on.
fn goes_on(g: &Geometry, whole: &Geometry, at: &[[f64; 3]], scale: f64) {
    for p in at {
        let p = Vec3::from_array(*p);
        let (a, b) = (g.value(p), whole.value(p));
        assert!((a - b).abs() < 1e-13 * scale, "{p}: {a} and {b}");
    }
}

#[test]
fn pipes_go_on_beyond_the_box_however_their_faces_run() {
    let mut random = Random(71);
    for pipe in pipes::all() {
        for scale in [1e-6, 1.0, 1e6] {
            let whole = pipe.whole.scaled(scale);
            let reference = build(&whole.mesh(), &SdfOptions::default());
            assert_eq!(reference.properties().sign_method, SignMethod::Pseudonormal, "{}", pipe.name);
            for (k, soup) in as_given(&pipe.open.scaled(scale)).iter().enumerate() {
                let mesh = mesh_of(soup);
                let at = points_in(soup, cube(scale), 60, &mut random);
                let g = same_with_every_layout(&mesh, &options(scale), &at);
                assert_eq!(g.properties().sign_method, SignMethod::Pseudonormal, "{} {k}", pipe.name);
                goes_on(&g, &reference, &at, scale);
                assert!(signs_are_those_of(&whole, &g, &at, scale) > 100, "{} {k}", pipe.name);
                // No end is nearest anywhere in the box, nor to its corners.
                let (b, reach) = (g.bounds(), 1.2 * cube(scale).diagonal());
                let far = (0..3).any(|d| b.lo[d] < -reach) && (0..3).any(|d| b.hi[d] > scale + reach);
                assert!(far, "{}: {b:?}", pipe.name);
            }
        }
    }
}

#[test]
fn every_question_sees_what_was_swept() {
    let mut random = Random(72);
    for pipe in pipes::all() {
        let around = Aabb::new(Vec3::splat(-0.5), Vec3::splat(1.5));
        questions_agree(&build(&mesh_of(&pipe.open), &options(1.0)), around, &mut random);
    }
}

#[test]
fn every_sign_of_a_closed_body_is_that_of_a_swept_one() {
    let mut random = Random(73);
    for pipe in pipes::all() {
        let mesh = mesh_of(&pipe.open);
        let auto = build(&mesh, &options(1.0));
        for sign in [SignMethod::Pseudonormal, SignMethod::Ray] {
            let g = build(&mesh, &SdfOptions { sign, ..options(1.0) });
            assert_eq!(g.properties().sign_method, sign);
            for p in points_in(&pipe.open, cube(1.0), 50, &mut random) {
                let p = Vec3::from_array(p);
                assert_eq!(g.value(p).to_bits(), auto.value(p).to_bits(), "{} {p}", pipe.name);
            }
        }
    }
}

#[test]
fn what_is_kept_inside_out_stays_so() {
    let mut random = Random(74);
    for pipe in pipes::all() {
        let kept = MeshOptions { orient: Orient::Keep, ..MeshOptions::default() };
        let [out, inward] = [pipe.open.clone(), pipe.open.flipped()].map(|s| build(&s.mesh_with(&kept), &options(1.0)));
        let read = build(&mesh_of(&pipe.open), &options(1.0));
        for p in points_in(&pipe.open, cube(1.0), 50, &mut random) {
            let p = Vec3::from_array(p);
            assert_eq!(out.value(p).to_bits(), read.value(p).to_bits(), "{}", pipe.name);
            assert!((inward.value(p) + read.value(p)).abs() < 1e-15, "{}", pipe.name);
        }
    }
}

#[test]
fn loops_with_edges_along_the_axis_are_swept() {
    // Cells that end in a step, open there: on its rim are edges along x.
    let axis = [0.0, 0.25, 0.5, 0.75, 1.0];
    let stair = bodies::cells(&axis, &axis, &axis, |i, j, k| j < 2 && k < 2 && (i < 2 || i == 2 && j == 0));
    let open = stair.without(|t| {
        let corners = stair.corners(t);
        let is = |axis: usize, at: f64| corners.iter().all(|c| c[axis] == at);
        is(0, 0.75) || is(0, 0.5) || (is(1, 0.25) && corners.iter().all(|c| c[0] >= 0.5))
    });
    let whole = bodies::cells(&[0.0, 0.5, 0.75, 30.0], &axis, &axis, |_, j, k| j < 2 && k < 2);
    let options = SdfOptions { open_hi: [0.9, 1.0, 1.0], ..options(1.0) };
    let domain = Aabb::new(Vec3::ZERO, Vec3::new(0.9, 1.0, 1.0));
    let reference = build(&whole.mesh(), &SdfOptions::default());
    let mut random = Random(75);
    for soup in as_given(&open) {
        let at = points_in(&soup, domain, 200, &mut random);
        let g = same_with_every_layout(&mesh_of(&soup), &options, &at);
        goes_on(&g, &reference, &at, 1.0);
        assert!(signs_are_those_of(&whole, &g, &at, 1.0) > 300);
        questions_agree(&g, domain, &mut random);
    }
}

#[test]
fn a_mesh_without_boundary_is_taken_as_it_is() {
    let ball = bodies::sphere_at(3, [0.5; 3], 0.3);
    let [swept, plain] = [options(1.0), SdfOptions::default()].map(|options| build(&ball.mesh(), &options));
    assert_eq!(swept.fingerprint(), plain.fingerprint());
}

#[test]
fn vertices_move_and_what_is_swept_goes_along() {
    let kept = MeshOptions { orient: Orient::Keep, weld_tolerance: -1.0, ..MeshOptions::default() };
    let mut random = Random(76);
    for pipe in pipes::all() {
        let g = build(&pipe.open.mesh_with(&kept), &options(1.0));
        let bent = pipe.open.map(|[x, y, z]| [x, y + 0.05 * libm::sin(3.0 * x), z + 0.02 * y]);
        let anew = build(&bent.mesh_with(&kept), &options(1.0));
        for check in [RefitCheck::Check, RefitCheck::Trust] {
            let moved = g.refit(&bent.xyz(), check, &Run::SERIAL).expect("moved");
            assert_eq!(moved.bounds(), anew.bounds());
            for p in points_in(&bent, cube(1.0), 60, &mut random) {
                let p = Vec3::from_array(p);
                let (a, b) = (moved.closest(p), anew.closest(p));
                assert_eq!((a.value.to_bits(), a.primitive), (b.value.to_bits(), b.primitive), "{}", pipe.name);
            }
        }
        let more = [pipe.open.xyz(), vec![0.0; 3]].concat();
        assert!(g.refit(&more, RefitCheck::Check, &Run::SERIAL).is_err());
    }
}

#[test]
fn many_loops_are_swept_at_once() {
    // A plate with holes through it, cut off at all four sides of the box: of its rim every side is one loop with the
    // others, so it is cut into strips before.
    let mut soup = Soup::default();
    for k in 0..12 {
        let y = 0.04 + 0.08 * f64::from(k);
        let bar = bodies::cuboid([-0.1, y, 0.4], [1.1, y + 0.03, 0.5]);
        soup =
            soup.and(&bar.without(|t| {
                bar.corners(t).iter().all(|c| c[0] == -0.1) || bar.corners(t).iter().all(|c| c[0] == 1.1)
            }));
    }
    let g = build(&mesh_of(&soup), &options(1.0));
    let mut whole = Soup::default();
    for k in 0..12 {
        let y = 0.04 + 0.08 * f64::from(k);
        whole = whole.and(&bodies::cuboid([-30.0, y, 0.4], [30.0, y + 0.03, 0.5]));
    }
    let reference = build(&whole.mesh(), &SdfOptions::default());
    let mut random = Random(77);
    let at: Vec<[f64; 3]> = (0..2000).map(|_| random.point([0.0; 3], [1.0; 3])).collect();
    goes_on(&g, &reference, &at, 1.0);
    assert_eq!(g.properties().sign_method, SignMethod::Pseudonormal);
}
