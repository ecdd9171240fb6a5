// SPDX-License-Identifier: MIT OR Apache-2.0
//! The side by the generalised winding number, against the sum of all solid angles.

use crate::common::lattices::{around, compared, through};
use crate::common::random::Random;
use crate::common::winding::winding_number;
use crate::common::{Soup, bodies, points};
use crate::{bodies::with_holes, classes_hold, diagonal, geometry, with};
use embound::geometry::{Accelerator, Geometry, SdfOptions, SignMethod};
use embound::math::Vec3;
use embound::parallel::Run;

fn area([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let [u, v] = [b, c].map(|p| Vec3::from(p) - Vec3::from(a));
    0.5 * u.cross(v).length()
}

/// Of points: how many were compared. Beyond the bounds is outside, whatever the sum.
#[track_caller]
fn agree(soup: &Soup, points: &[[f64; 3]]) -> usize {
    let g = geometry(soup, SignMethod::Winding);
    let mesh = soup.mesh();
    let turned = Soup {
        vertices: mesh.vertices().iter().map(|v| v.to_array()).collect(),
        triangles: mesh.triangles().iter().map(|t| t.vertices).collect(),
    };
    // Of what has no area the sum knows nothing but rounding.
    let turned = turned.without(|t| area(turned.corners(t)) < 1e-12 * diagonal(soup).powi(2));
    let (lo, hi) = soup.bounds();
    let mut compared = 0;
    for p in points.iter().filter(|p| (0..3).all(|k| lo[k] <= p[k] && p[k] <= hi[k])) {
        let value = g.value(Vec3::from_array(*p));
        let winding = winding_number(&turned, *p);
        if value.abs() < 1e-11 * diagonal(soup) || (winding - 0.5).abs() < 1e-9 {
            continue;
        }
        compared += 1;
        assert_eq!(value < 0.0, winding >= 0.5, "value {value}, winding number {winding} at {p:?}");
    }
    compared
}

#[test]
fn the_side_is_that_of_the_winding_number_at_every_scale() {
    let mut random = Random(61);
    for (name, body) in with_holes() {
        for scale in [1e-6, 1.0, 1e6] {
            let body = body.scaled(scale);
            let points = [points::all_kinds(&body, 400, &mut random), points::uniform(&body, 1.0, 800, &mut random)];
            let count = agree(&body, &points.concat());
            assert!(count > 600, "{name}: {count}");
        }
    }
}

#[test]
fn caps_that_lie_along_the_lattice_and_points_on_them_do_not_matter() {
    // A box without a corner: its caps are in three planes of whole numbers, and so are the points.
    let body = bodies::cells(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 2.0, 3.0], |_, _, _| true);
    let is_corner = |t: usize| body.corners(t).iter().all(|c| c.iter().all(|x| *x >= 2.0));
    let body = body.without(is_corner);
    let points = (0..13usize.pow(3)).map(|e| [e % 13, e / 13 % 13, e / 169].map(|k| k as f64 / 4.0));
    assert!(agree(&body, &points.collect::<Vec<_>>()) > 500);
}

#[test]
fn accelerators_change_no_bit() {
    let mut random = Random(62);
    for (name, body) in with_holes() {
        for sign in [SignMethod::Winding, SignMethod::Ray, SignMethod::Axis] {
            let all = [Accelerator::None, Accelerator::Auto, Accelerator::Compact].map(|a| with(&body, sign, a));
            for p in points::all_kinds(&body, 150, &mut random) {
                let [slow, fast, compact] = all.each_ref().map(|g| g.value(p.into()).to_bits());
                assert!(slow == fast && slow == compact, "{name} {sign:?} at {p:?}");
            }
        }
    }
}

#[test]
fn lattices_have_the_signs_values_and_crossings_of_points_and_edges() {
    let mut random = Random(63);
    for (name, body) in with_holes() {
        println!("{name}");
        for sign in [SignMethod::Winding, SignMethod::Ray, SignMethod::Axis] {
            let g = geometry(&body, sign);
            assert!(compared(&g, &around(&body, [13, 11, 12], 1.2)) > 0);
            compared(&g, &through(&body, 7, &mut random));
            compared(&g.complement().unwrap().translate([0.1, 0.2, 0.3]).unwrap(), &around(&body, [9, 8, 7], 1.7));
        }
    }
}

#[test]
fn no_class_is_a_lie() {
    let mut random = Random(64);
    for (name, body) in with_holes() {
        for scale in [1.0, 1e-6] {
            let body = body.scaled(scale);
            let g = geometry(&body, SignMethod::Winding);
            let known = classes_hold(&body, &g, &mut random);
            assert!(known > 150, "{name}: {known}");
            classes_hold(&body, &g.complement().unwrap(), &mut random);
        }
    }
}

#[test]
fn inside_out_and_kept_so_the_body_is_around_it_where_its_holes_are_small() {
    let mut random = Random(65);
    let kept = |soup: &Soup| {
        let options = SdfOptions { sign: SignMethod::Winding, ..SdfOptions::default() };
        Geometry::from_mesh(&soup.mesh_kept(), &options, &Run::SERIAL).unwrap()
    };
    let (ball, bowl) = (bodies::icosphere(3).without(|t| t == 17), crate::bodies::bowl(3, -0.4));
    let [outward, inward] = [ball.clone(), ball.flipped()].map(|soup| kept(&soup));
    for p in points::all_kinds(&ball, 200, &mut random) {
        let [a, b] = [&outward, &inward].map(|g| g.value(p.into()));
        assert!(a == -b || a.abs() < 1e-12, "{a} {b} at {p:?}");
    }
    let open = kept(&bowl.flipped());
    assert!(points::uniform(&bowl, 2.0, 500, &mut random).into_iter().all(|p| open.value(p.into()) >= 0.0));
    assert!(open.bounds().is_finite());
}
