// SPDX-License-Identifier: MIT OR Apache-2.0
//! Signs against an independent test: the winding number as a sum of solid angles.

mod common;

use common::random::Random;
use common::winding::winding_number;
use common::{Soup, bodies, points};
use embound::Status;
use embound::geometry::{Geometry, SdfOptions, SignMethod};
use embound::math::Vec3;
use embound::mesh::{MeshOptions, Orient};
use embound::parallel::Run;

fn build(soup: &Soup, sign: SignMethod) -> embound::Result<Geometry> {
    let options = SdfOptions { sign, ..SdfOptions::default() };
    Geometry::from_mesh(&soup.mesh(), &options, &Run::SERIAL)
}

fn diagonal(soup: &Soup) -> f64 {
    let (lo, hi) = soup.bounds();
    (0..3).map(|d| (hi[d] - lo[d]).powi(2)).sum::<f64>().sqrt()
}

/// Wherever the winding number is clearly 0 or at least 1, and rounding is far, the sign agrees.
/// Returns how many points were compared.
fn assert_signs(soup: &Soup, g: &Geometry, points: &[[f64; 3]]) -> usize {
    let rounding = 1e-12 * (diagonal(soup) + soup.bounds().1.iter().fold(0.0, |m: f64, c| m.max(c.abs())));
    let mut compared = 0;
    for p in points {
        let value = g.value(Vec3::from_array(*p));
        let winding = winding_number(soup, *p);
        if value.abs() <= rounding || (winding - winding.round()).abs() > 1e-3 {
            continue;
        }
        compared += 1;
        assert_eq!(value < 0.0, winding.round() >= 1.0, "value {value}, winding number {winding} at {p:?}");
    }
    compared
}

fn clean_bodies() -> Vec<Soup> {
    vec![
        bodies::tetrahedron(),
        bodies::unit_cube(),
        bodies::icosphere(2),
        bodies::torus(1.0, 0.25, 32, 12),
        bodies::leaning_pyramid(),
        bodies::bracket(),
        bodies::plate(3, 2, 0.2, 0.45, 5),
        bodies::nested_shells(1),
    ]
}

#[test]
fn clean_bodies_have_the_right_sign_at_every_scale() {
    let mut random = Random(21);
    for soup in clean_bodies() {
        for scale in [1e-6, 1.0, 1e6] {
            let body = soup.scaled(scale);
            let g = build(&body, SignMethod::Auto).unwrap();
            assert_eq!(g.properties().sign_method, SignMethod::Pseudonormal);
            let points = points::all_kinds(&body, 150, &mut random);
            assert!(assert_signs(&body, &g, &points) > 250);
        }
    }
}

#[test]
fn the_slab_with_a_leaning_pyramid_has_the_right_sign_by_its_overhanging_edges() {
    let mut random = Random(22);
    let body = bodies::leaning_pyramid();
    let g = build(&body, SignMethod::Pseudonormal).unwrap();
    let points: Vec<[f64; 3]> = (0..4000).map(|_| random.point([-0.5, -0.6, -0.1], [2.4, 0.6, 1.0])).collect();
    assert!(assert_signs(&body, &g, &points) > 3900);
}

#[test]
fn every_method_agrees_off_the_surface_of_a_clean_body() {
    let mut random = Random(23);
    for soup in clean_bodies() {
        let by_normal = build(&soup, SignMethod::Pseudonormal).unwrap();
        let by_ray = build(&soup, SignMethod::Ray).unwrap();
        assert_eq!(by_ray.properties().sign_method, SignMethod::Ray);
        let by_winding = build(&soup, SignMethod::Winding).unwrap();
        assert_eq!(by_winding.properties().sign_method, SignMethod::Winding);
        for p in points::all_kinds(&soup, 400, &mut random) {
            let p = Vec3::from_array(p);
            let (a, b) = (by_normal.value(p), by_ray.value(p));
            assert_eq!(a.to_bits(), by_winding.value(p).to_bits());
            assert_eq!(a.abs().to_bits(), b.abs().to_bits());
            assert!(a.to_bits() == b.to_bits() || a.abs() < 1e-14, "{a} {b} at {p}");
        }
    }
}

#[test]
fn a_surface_through_itself_is_found_and_signed_by_crossings() {
    let mut random = Random(24);
    let soup = bodies::overlapping_spheres(2);
    let g = build(&soup, SignMethod::Auto).unwrap();
    assert_eq!(g.properties().sign_method, SignMethod::Ray);
    let points = points::all_kinds(&soup, 400, &mut random);
    assert!(assert_signs(&soup, &g, &points) > 1000);
    let refused = build(&soup, SignMethod::Pseudonormal).err().expect("refused");
    assert_eq!(refused.status(), Status::Topology);
}

/// Bodies of which some triangles meet others, or some parts are turned the wrong way, and the rest is sound.
fn partly_sound() -> Vec<Soup> {
    let ball = bodies::icosphere(3);
    let mut spiked = ball.clone();
    spiked.vertices[0] = ball.vertices[0].map(|c| -1.5 * c);
    let mut dented = bodies::torus(1.0, 0.3, 40, 20);
    for v in dented.vertices.iter_mut().filter(|v| v[0] > 1.0 && v[1].abs() < 0.2) {
        v[0] -= 0.7;
    }
    // A cube in the ball turned the wrong way, and one that hangs on one of its corners, inside out.
    let inner = bodies::cuboid([-0.2; 3], [0.2; 3]);
    let mut hanging = ball.and(&bodies::tetrahedron().scaled(0.3).flipped());
    let shift = [0, 1, 2].map(|k| ball.vertices[5][k] - hanging.vertices[ball.vertices.len()][k]);
    for v in &mut hanging.vertices[ball.vertices.len()..] {
        *v = [0, 1, 2].map(|k| v[k] + shift[k]);
    }
    hanging.vertices[ball.vertices.len()] = ball.vertices[5];
    vec![
        spiked.and(&ball.scaled(0.5).translated([3.0, 0.0, 0.0])),
        dented,
        ball.and(&inner),
        ball.and(&inner.flipped()),
        ball.and(&ball.flipped().scaled(0.8).translated([2.5, 0.0, 0.0])),
        hanging,
        bodies::with_flat_triangles(&ball).and(&ball.translated([1.9, 0.1, 0.2])),
    ]
}

#[test]
fn normals_decide_only_where_crossings_say_the_same() {
    let mut random = Random(29);
    for (k, soup) in partly_sound().into_iter().enumerate() {
        for scale in [1e-6, 1.0, 1e6] {
            let body = soup.map(|[x, y, z]| [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, z + 0.1 * x].map(|c| c * scale));
            let kept = |sign| {
                let options = SdfOptions { sign, ..SdfOptions::default() };
                Geometry::from_mesh(&body.mesh_with(&kept_and_welded()), &options, &Run::SERIAL).unwrap()
            };
            let (g, by_ray) = (kept(SignMethod::Auto), kept(SignMethod::Ray));
            let points = points::all_kinds(&body, 400, &mut random);
            for &p in &points {
                let (a, b) = (g.value(Vec3::from_array(p)), by_ray.value(Vec3::from_array(p)));
                assert!(a == b || a.abs().max(b.abs()) < 1e-13 * scale, "body {k}: {a} {b} at {p:?}");
            }
            assert!(assert_signs(&body, &g, &points) > 700, "body {k}");
        }
    }
}

fn kept_and_welded() -> MeshOptions {
    MeshOptions { orient: Orient::Keep, ..MeshOptions::default() }
}

#[test]
fn a_triangle_without_area_poisons_nothing() {
    // The edge 0-1 of a tetrahedron with a vertex in its middle on one side only: a flat triangle closes it.
    let mut body = bodies::tetrahedron();
    let [a, b, c] = body.triangles[0];
    let (p, q) = (body.vertices[a as usize], body.vertices[b as usize]);
    let middle = body.vertices.len() as u32;
    body.vertices.push([0, 1, 2].map(|d| (p[d] + q[d]) / 2.0));
    body.triangles[0] = [a, middle, c];
    body.triangles.push([middle, b, c]);
    body.triangles.push([a, b, middle]);
    let g = build(&body, SignMethod::Auto).unwrap();
    let mut random = Random(25);
    let points = points::all_kinds(&body, 1000, &mut random);
    assert!(assert_signs(&body, &g, &points) > 2000);
}

#[test]
fn dirt_that_reading_mends_does_not_reach_the_sign() {
    let mut random = Random(26);
    let clean = bodies::torus(1.0, 0.25, 24, 10);
    let points = points::all_kinds(&clean, 200, &mut random);
    let dirty = [
        clean.duplicated(),
        clean.flipped(),
        clean.flipped_where(|k| k % 2 == 0),
        clean.duplicated().flipped_where(|k| k % 3 == 0),
        clean.unshared(),
    ];
    for soup in dirty {
        let g = build(&soup, SignMethod::Auto).unwrap();
        assert!(assert_signs(&clean, &g, &points) > 400);
    }
}

#[test]
fn an_inside_out_body_is_turned_unless_it_is_kept() {
    let soup = bodies::icosphere(2).flipped();
    let options = |orient| MeshOptions { orient, ..MeshOptions::default() };
    let value = |orient, p: [f64; 3]| {
        let mesh = soup.mesh_with(&options(orient));
        assert!(mesh.report().inside_out);
        Geometry::from_mesh(&mesh, &SdfOptions::default(), &Run::SERIAL).unwrap().value(Vec3::from_array(p))
    };
    for p in [[0.1, 0.2, 0.3], [2.0, 0.1, 0.2], [50.0, 50.0, -50.0], [0.7, 0.7, 0.1]] {
        assert_eq!(value(Orient::Auto, p), value(Orient::Flip, p));
        assert_eq!(value(Orient::Auto, p), -value(Orient::Keep, p));
    }
    let kept = Geometry::from_mesh(&soup.mesh_kept(), &SdfOptions::default(), &Run::SERIAL).unwrap();
    assert!(!kept.bounds().is_finite() && kept.complement().unwrap().bounds().is_finite());
}

#[test]
fn open_and_inconsistent_surfaces_are_refused_with_the_counts() {
    let hole = bodies::icosphere(1).without(|k| k < 7);
    let error = build(&hole, SignMethod::Auto).err().expect("refused");
    assert_eq!(error.status(), Status::Topology);
    assert!(error.message().contains("11 boundary edges"), "{error}");
    let strip = build(&bodies::moebius_strip(12), SignMethod::Auto).err().expect("refused");
    assert_eq!(strip.status(), Status::Topology);
    let twisted = bodies::tetrahedron().flipped_where(|k| k == 3).mesh_kept();
    let error = Geometry::from_mesh(&twisted, &SdfOptions::default(), &Run::SERIAL).err().expect("refused");
    assert!(error.message().contains("3 inconsistent edges"), "{error}");
    let unsigned = build(&hole, SignMethod::None).unwrap();
    assert!(unsigned.value(Vec3::ZERO) > 0.7 && unsigned.value(Vec3::splat(3.0)) > 0.0);
}

#[test]
fn cubes_that_share_an_edge_are_signed_by_crossings() {
    let mut random = Random(27);
    let soup = bodies::cubes_sharing_an_edge();
    let g = build(&soup, SignMethod::Auto).unwrap();
    assert_eq!(g.properties().sign_method, SignMethod::Ray);
    let points = points::all_kinds(&soup, 300, &mut random);
    assert!(assert_signs(&soup, &g, &points) > 500);
}

#[test]
fn bodies_in_contact_keep_the_wall_between_them() {
    let mut random = Random(28);
    let soup = bodies::unit_cube().and(&bodies::unit_cube().translated([1.0, 0.0, 0.0]));
    let g = build(&soup, SignMethod::Auto).unwrap();
    assert_eq!(g.properties().primitives, 24);
    assert!(assert_signs(&soup, &g, &points::all_kinds(&soup, 300, &mut random)) > 500);
}

#[test]
fn a_fin_thinner_than_rounding_does_not_lend_its_far_side() {
    let soup = bodies::cells(&[0.0, 1.0, 3.0], &[0.0, 1.0], &[-1.0, 0.0, 1e-17, 1.0], |i, _, k| i == 0 || k == 1);
    let g = build(&soup, SignMethod::Auto).unwrap();
    assert_eq!(g.properties().sign_method, SignMethod::Ray);
    let mut random = Random(11);
    for _ in 0..2000 {
        let p = random.point([1.2, 0.1, -0.9], [2.8, 0.9, 0.9]);
        assert!(g.value(Vec3::from_array(p)) > 0.0, "{p:?}");
    }
}

#[test]
fn thin_plates_have_right_pseudonormals() {
    for thickness in [1e-3, 1e-5, 1e-7, 1e-10] {
        let mut plate = bodies::cuboid([0.0; 3], [1.0, 1.0, thickness]);
        plate.triangles.reverse();
        let g = build(&plate, SignMethod::Pseudonormal).unwrap();
        assert!(g.value(Vec3::new(0.3, 0.4, 0.5 * thickness)) < 0.0);
        assert!(g.value(Vec3::new(0.3, 0.4, 1.5 * thickness)) > 0.0);
    }
}

#[test]
fn knife_edges_far_from_the_origin_have_the_sign_of_exact_crossings() {
    for (far, angle) in [(1e3, 1e-3), (1e6, 1e-1), (1e6, 1e-3)] {
        let knife = Soup {
            vertices: [0.0, angle, -angle]
                .iter()
                .flat_map(|&z: &f64| [0.0, 1.0].map(|y| [f64::from(u8::from(z != 0.0)), y, z]))
                .collect(),
            triangles: vec![[0, 2, 3], [0, 3, 1], [0, 1, 5], [0, 5, 4], [2, 4, 5], [2, 5, 3], [0, 4, 2], [1, 3, 5]],
        };
        let turned = knife.map(|[x, y, z]| [0.8 * x - 0.6 * z + 0.28 * y, 0.96 * y - 0.1 * x, 0.6 * x + 0.8 * z]);
        let soup = turned.translated([far, 0.7 * far, -0.3 * far]);
        let (g, exact) = (build(&soup, SignMethod::Pseudonormal).unwrap(), build(&soup, SignMethod::Ray).unwrap());
        let mut random = Random(3);
        for k in 0..20_000 {
            let (t, reach) = (random.unit(), far * f64::EPSILON * [2.0, 10.0, 100.0, 1000.0][k % 4]);
            let off = random.point([-reach; 3], [reach; 3]);
            let (a, b) = (soup.vertices[0], soup.vertices[1]);
            let p = Vec3::from_array([0, 1, 2].map(|d| a[d] + (b[d] - a[d]) * t + off[d]));
            assert_eq!(g.value(p) <= 0.0, exact.value(p) <= 0.0, "{far} {angle} {p}");
        }
    }
}
