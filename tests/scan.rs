// SPDX-License-Identifier: MIT OR Apache-2.0
//! Signs and crossings of whole lattices come from scans of their lines, and values within a band from leaves and the
//! points around them: the bits of single points and edges, wherever the lattice passes through the surface.

mod common;

use common::edges::crossings;
use common::lattices::{around, banded, compared, even, signs, through};
use common::random::Random;
use common::{Soup, bodies};
use embound::geometry::{Accelerator, Geometry, SdfOptions, SignMethod};
use embound::parallel::{Pool, Run};
use embound::query::{self, CrossingForm, Lattice};

fn geometry(body: &Soup, sign: SignMethod) -> Geometry {
    let options = SdfOptions { sign, ..SdfOptions::default() };
    Geometry::from_mesh(&body.mesh_kept(), &options, &Run::SERIAL).unwrap()
}

const SIGNS: [SignMethod; 3] = [SignMethod::Auto, SignMethod::Ray, SignMethod::None];

fn all_bodies() -> Vec<(&'static str, Soup)> {
    let flat = bodies::with_flat_triangles(&bodies::icosphere(2));
    vec![
        ("ball", bodies::icosphere(3)),
        ("ball inside out", bodies::icosphere(2).flipped()),
        ("cube", bodies::unit_cube()),
        ("bracket", bodies::bracket()),
        ("torus", bodies::torus(1.0, 0.3, 24, 12)),
        ("shells", bodies::nested_shells(2)),
        ("overlapping", bodies::overlapping_spheres(2)),
        (
            "overlapping, one inside out",
            bodies::icosphere(2).and(&bodies::sphere_at(2, [0.5, 0.1, 0.0], 0.6).flipped()),
        ),
        ("cubes with an edge in common", bodies::cubes_sharing_an_edge()),
        ("flat triangles", flat),
        ("pyramid", bodies::leaning_pyramid()),
        ("thin", bodies::cuboid([0.0; 3], [1.0, 1.0, 1e-13])),
        ("needle", bodies::cuboid([0.0; 3], [1.0, 1e-9, 1e-9]).map(|p| [p[0] + p[1], p[1] + p[0], p[2] - p[0]])),
    ]
}

#[test]
fn lattices_off_the_surface_have_the_signs_and_crossings_of_points_and_edges() {
    for (name, body) in all_bodies() {
        for sign in SIGNS {
            let g = geometry(&body, sign);
            for (n, factor) in [([20, 17, 23], 1.23), ([9, 9, 9], 0.31), ([5, 40, 6], 3.1)] {
                let met = compared(&g, &around(&body, n, factor));
                assert!(met > 0 || n[0] != 20 || name == "thin" || name == "needle", "{name}: {met}");
            }
        }
    }
}

#[test]
fn lattices_through_vertices_edges_and_faces_have_them_too() {
    let mut random = Random(77);
    for (_, body) in all_bodies() {
        for sign in SIGNS {
            let g = geometry(&body, sign);
            for _ in 0..3 {
                assert!(compared(&g, &through(&body, 9, &mut random)) > 0);
            }
            assert!(compared(&g, &around(&body, [9, 9, 9], 1.0)) > 0);
        }
    }
}

#[test]
fn every_point_on_the_surface_is_zero_and_ends_its_edges() {
    let g = geometry(&bodies::unit_cube(), SignMethod::Auto);
    let at = even(9, -0.5, 1.5);
    let axes = [at.clone(), at.clone(), at];
    let zeros = signs(&g, &axes, &Run::SERIAL).iter().filter(|s| **s == 0).count();
    assert_eq!(zeros, 5 * 5 * 5 - 3 * 3 * 3);
    assert!(compared(&g, &axes) > 0);
}

#[test]
fn soups_without_an_inside_are_touched_alike() {
    let mut random = Random(5);
    for body in [bodies::sheet(4), bodies::lattice_soup(120), bodies::moebius_strip(30), bodies::book(5)] {
        let g = geometry(&body, SignMethod::None);
        compared(&g, &around(&body, [14, 15, 16], 1.1));
        compared(&g, &through(&body, 8, &mut random));
        compared(&g.complement().unwrap(), &around(&body, [9, 9, 9], 1.0));
    }
}

#[test]
fn triangles_of_whole_numbers_are_scanned_alike_whatever_their_shape() {
    // Tetrahedra either way out, some of them flat: what lies in a plane, in a line, or edge on edge is among it.
    let mut random = Random(19);
    let mut body = Soup::default();
    for t in 0..40 {
        let first = body.vertices.len();
        while body.vertices.len() < first + 4 {
            let v = [0; 3].map(|_| random.below(9) as f64 - 4.0);
            if !body.vertices[first..].contains(&v) {
                body.vertices.push(v);
            }
        }
        body.triangles.extend([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(|c| c.map(|k| 4 * t + k)));
    }
    let g = geometry(&body, SignMethod::Ray);
    let whole = even(9, -4.0, 4.0);
    let halves = even(17, -4.0, 4.0);
    compared(&g, &[whole.clone(), whole.clone(), whole.clone()]);
    compared(&g, &[halves, whole.clone(), whole]);
}

#[test]
fn thin_uneven_falling_and_repeating_lattices_are_scanned_alike() {
    let body = bodies::torus(1.0, 0.3, 24, 12);
    let g = geometry(&body, SignMethod::Auto);
    for n in [[1, 1, 1], [1, 9, 4], [5, 1, 17], [40, 3, 1], [2, 2, 2], [300, 2, 2], [2, 2, 300], [2, 300, 2]] {
        compared(&g, &around(&body, n, 1.1));
    }
    let [x, y, z] = around(&body, [14, 15, 16], 1.2);
    let falling: Vec<f64> = x.iter().rev().copied().collect();
    let squared: Vec<f64> = y.iter().map(|c| c * c.abs()).collect();
    let repeating: Vec<f64> = z.iter().flat_map(|c| [*c, *c]).collect();
    for axes in [
        [falling.clone(), squared.clone(), repeating.clone()],
        [squared.clone(), repeating.clone(), falling.clone()],
        [repeating, falling, squared],
    ] {
        assert!(compared(&g, &axes) > 0);
    }
    // Beside coordinates so small predicates underflow: such a lattice is not scanned.
    let tiny = [-1.0, -5e-324, 0.0, 5e-324, 1.0].to_vec();
    compared(&geometry(&bodies::icosphere(2), SignMethod::Auto), &[tiny.clone(), tiny.clone(), tiny]);
    let far = [-1e200, -1e6, -0.9, 0.05, 0.9, 1e5, 1e9, 1e150].to_vec();
    assert!(compared(&g, &[far.clone(), far.clone(), far]) > 0);
    let none = Lattice::new(&[], &[1.0], &[1.0]).unwrap();
    query::fill_signs(&g, &none, &Run::SERIAL, &|_, _| panic!("there are no points")).unwrap();
    for axis in 0..3 {
        assert!(crossings(&g, &none, axis, CrossingForm::Fraction, &Run::SERIAL).is_empty());
    }
}

#[test]
fn scale_and_place_change_nothing_of_that() {
    let mut random = Random(3);
    for (scale, away) in [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e3), (1e-3, 1e3), (1.0, 1e9), (1e-80, 0.0), (1e80, 0.0)] {
        let place = [away, -2.0 * away, 0.7 * away];
        for body in [bodies::bracket(), bodies::overlapping_spheres(2), bodies::icosphere(2)] {
            let body = body.scaled(scale).translated(place);
            let g = geometry(&body, SignMethod::Auto);
            compared(&g, &around(&body, [12, 13, 14], 1.1));
            compared(&g, &through(&body, 6, &mut random));
        }
    }
}

#[test]
fn complements_translations_and_parts_are_scanned_with_their_body() {
    for (body, sign) in [
        (bodies::torus(1.0, 0.3, 24, 12), SignMethod::Auto),
        (bodies::unit_cube(), SignMethod::Auto),
        (bodies::sheet(3), SignMethod::None),
    ] {
        let g = geometry(&body, sign);
        let axes = around(&body, [13, 12, 11], 1.3);
        let labelled = g.part(7).unwrap().translate([0.1, -0.2, 0.3]).unwrap().complement().unwrap().part(9).unwrap();
        compared(&labelled, &axes);
        // Shifts that round coordinates onto each other.
        compared(
            &g.translate([1e16, 0.0, -3e15]).unwrap(),
            &axes.clone().map(|a| a.iter().map(|c| c + 1e16).collect()),
        );
        compared(&g.complement().unwrap(), &around(&body, [9, 9, 9], 1.0));
    }
}

#[test]
fn any_number_of_threads_gives_the_same() {
    let body = bodies::overlapping_spheres(3);
    let g = geometry(&body, SignMethod::Auto);
    let axes = around(&body, [50, 70, 60], 1.2);
    let lattice = Lattice::new(&axes[0], &axes[1], &axes[2]).unwrap();
    let pool = Pool::new(4, || ()).unwrap();
    let pooled = Run { pool: Some(&pool), progress: None };
    assert_eq!(signs(&g, &axes, &Run::SERIAL), signs(&g, &axes, &pooled));
    assert_eq!(banded(&g, &axes, 0.1, &Run::SERIAL), banded(&g, &axes, 0.1, &pooled));
    for axis in 0..3 {
        let [a, b] = [Run::SERIAL, pooled].map(|run| crossings(&g, &lattice, axis, CrossingForm::Coordinate, &run));
        let bits = |c: &query::Crossing| (c.at.to_bits(), c.count, c.tag, c.part);
        assert!(a.iter().map(bits).eq(b.iter().map(bits)));
    }
}

#[test]
fn a_scan_gives_the_signs_of_brute_force() {
    let body = bodies::overlapping_spheres(2);
    let brute = SdfOptions { accelerator: Accelerator::None, ..SdfOptions::default() };
    let brute = Geometry::from_mesh(&body.mesh_kept(), &brute, &Run::SERIAL).unwrap();
    let axes = around(&body, [16, 17, 18], 1.0);
    assert_eq!(signs(&geometry(&body, SignMethod::Auto), &axes, &Run::SERIAL), signs(&brute, &axes, &Run::SERIAL));
}
