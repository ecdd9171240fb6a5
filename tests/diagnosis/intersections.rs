// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pairs of faces that intersect, against all pairs by an exact method in integers.

use super::touching::all_pairs;
use super::*;

#[test]
fn random_triangles_meet_where_all_pairs_say_so() {
    let mut random = Random(31);
    let mut total = 0;
    // From grids so coarse that most corners are shared, flat and repeated triangles among them, to fine ones.
    for (count, points) in [(60, 3), (150, 4), (250, 7), (300, 20), (300, 1000)] {
        for _ in 0..4 {
            let soup = grid_soup(count, points, &mut random);
            let wanted = all_pairs(&soup);
            total += wanted.len();
            assert_eq!(pairs(&soup.mesh_kept()), wanted, "{count} triangles of {points} points");
        }
    }
    assert!(total > 50_000, "{total}");
}

#[test]
fn small_triangles_meet_where_all_pairs_say_so() {
    let mut random = Random(32);
    let mut total = 0;
    for size in [2, 5, 40] {
        let mut soup = grid_soup(400, 60, &mut random);
        for t in 0..400 {
            let first = soup.vertices[3 * t];
            for k in 1..3 {
                soup.vertices[3 * t + k] = first.map(|c| c + random.below(size) as f64);
            }
        }
        let wanted = all_pairs(&soup);
        total += wanted.len();
        assert_eq!(pairs(&soup.mesh_kept()), wanted, "{size}");
    }
    assert!(total > 100, "{total}");
}

#[test]
fn pairs_do_not_depend_on_scale_or_orientation() {
    let mut random = Random(33);
    let soup = grid_soup(200, 9, &mut random);
    let wanted = all_pairs(&soup);
    assert!(wanted.len() > 1000);
    for scale in [2f64.powi(-20), 2f64.powi(20), 2f64.powi(-250), 2f64.powi(300)] {
        assert_eq!(pairs(&soup.scaled(scale).mesh_kept()), wanted, "scale {scale:e}");
    }
    assert_eq!(pairs(&soup.mesh()), wanted);
    assert_eq!(pairs(&soup.flipped().mesh_kept()), wanted);
    assert_eq!(pairs(&soup.flipped_where(|k| k % 3 == 0).mesh()), wanted);
    // Exact also where differences of coordinates are not.
    let apart = soup.scaled(2f64.powi(-30)).translated([1.0, 2.0, -3.0]);
    assert_eq!(pairs(&apart.mesh_kept()), wanted);
}

#[test]
fn clean_bodies_do_not_meet_themselves() {
    for soup in [
        bodies::tetrahedron(),
        bodies::unit_cube(),
        bodies::icosphere(3),
        bodies::torus(1.0, 0.25, 48, 16),
        bodies::torus(1.0, 0.25, 48, 16).map(|p| [p[0], p[1], p[2] * 1e-5]),
        bodies::leaning_pyramid(),
        bodies::bracket(),
        bodies::plate(4, 3, 0.2, 0.45, 6),
        bodies::nested_shells(2),
        bodies::cubes_sharing_an_edge(),
        bodies::sheet(9),
        bodies::moebius_strip(20),
        bodies::book(5),
        drum(300, 1.0, 0.25),
    ] {
        for scale in [1e-6, 1.0, 1e6] {
            assert_eq!(pairs(&soup.scaled(scale).mesh()), [[0u32; 2]; 0]);
        }
    }
}

#[test]
fn copies_meet_what_their_originals_meet_and_not_each_other() {
    let one = bodies::tetrahedron();
    let two = one.and(&one.translated([0.25, 0.25, 0.125]));
    let wanted = all_pairs(&two.scaled(8.0));
    assert!(!wanted.is_empty());
    assert_eq!(pairs(&two.mesh_kept()), wanted);
    let n = two.triangles.len() as u32;
    for copied in [two.duplicated(), two.double_sided()] {
        let mut expected: Vec<[u32; 2]> = wanted
            .iter()
            .flat_map(|&[a, b]| [[a, b], [a, b + n], [b, a + n], [a + n, b + n]])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        expected.sort_unstable();
        assert_eq!(pairs(&copied.mesh()), expected);
    }
    assert_eq!(pairs(&one.duplicated().duplicated().mesh()), [[0u32; 2]; 0]);
}

#[test]
fn the_count_goes_to_the_limit_and_the_search_no_further() {
    let mut random = Random(34);
    let soup = grid_soup(250, 5, &mut random);
    let mesh = soup.mesh_kept();
    let wanted = pairs(&mesh);
    let with_limit = |limit: usize| {
        let options = DiagnosisOptions { intersection_limit: limit, ..DiagnosisOptions::default() };
        diagnosis_with(&mesh, &options).intersections
    };
    assert_eq!(with_limit(0), None);
    for limit in [1, 10, wanted.len() - 1] {
        let found = with_limit(limit).expect("looked for");
        assert!(!found.complete && found.pairs.len() == limit && found.count > limit as u64, "{limit}");
        assert!(found.pairs.windows(2).all(|w| w[0] < w[1]), "{limit}");
        assert!(found.pairs.iter().all(|p| wanted.binary_search(p).is_ok()), "{limit}");
    }
    for limit in [wanted.len(), usize::MAX] {
        let found = with_limit(limit).expect("looked for");
        assert!(found.complete && found.count == wanted.len() as u64 && found.pairs == wanted, "{limit}");
    }
}

#[test]
fn copies_are_counted_beyond_the_limit() {
    let two = bodies::tetrahedron().and(&bodies::tetrahedron().translated([0.25, 0.25, 0.125]));
    let single = pairs(&two.mesh_kept()).len() as u64;
    let many = Soup { triangles: vec![two.triangles.clone(); 100].concat(), ..two };
    let options = DiagnosisOptions { intersection_limit: 50, ..DiagnosisOptions::default() };
    let found = diagnosis_with(&many.mesh_kept(), &options).intersections.expect("looked for");
    assert!(found.complete && found.count == single * 100 * 100 && found.pairs.len() == 50);
}

#[test]
fn polygons_meet_as_the_triangles_they_are_cut_into() {
    // Boxes of six squares through each other, corner to corner, and face on face.
    let cube = |lo: [f64; 3], size: f64| {
        let at = |k: usize| [0, 1, 2].map(|d| lo[d] + if k >> d & 1 == 1 { size } else { 0.0 });
        (0..8).map(at).collect::<Vec<[f64; 3]>>()
    };
    let squares: [[u32; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    for (lo, size) in [([2.0, 2.0, 2.0], 4.0), ([4.0, 4.0, 4.0], 4.0), ([4.0, 1.0, 1.0], 2.0), ([5.0, 0.0, 0.0], 4.0)] {
        let vertices = [cube([0.0; 3], 4.0), cube(lo, size)].concat();
        let indices: Vec<u32> = (0..2).flat_map(|b| squares.concat().into_iter().map(move |v| v + 8 * b)).collect();
        let offsets: Vec<usize> = (0..=12).map(|f| 4 * f).collect();
        let mesh = Mesh::from_polygons(&vertices.concat(), &offsets, &indices, None, &Default::default()).unwrap();
        let pieces = Soup {
            vertices: mesh.vertices().iter().map(|p| p.to_array()).collect(),
            triangles: mesh.triangles().iter().map(|t| t.vertices).collect(),
        };
        let face = |t: u32| mesh.triangles()[t as usize].face;
        let mut wanted: Vec<[u32; 2]> =
            all_pairs(&pieces).into_iter().map(|[s, t]| [face(s), face(t)]).filter(|[f, g]| f != g).collect();
        wanted.sort_unstable();
        wanted.dedup();
        assert_eq!(pairs(&mesh), wanted, "{lo:?}");
        // One vertex in common is not enough.
        assert_eq!(wanted.is_empty(), lo[0] == 5.0 || lo == [4.0; 3], "{lo:?}");
    }
}

#[test]
fn a_fin_folded_onto_its_neighbour_is_found() {
    // A flat strip whose last triangle lies back on the one before.
    let soup = Soup {
        vertices: vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2], [2, 1, 3]],
    };
    assert_eq!(pairs(&soup.mesh_kept()), [[0, 1]]);
    // Lifted off the plane it touches nothing but the edge.
    let lifted = soup.map(|p| if p == [1.0, 1.0, 0.0] { [1.0, 1.0, 1e-12] } else { p });
    assert_eq!(pairs(&lifted.mesh_kept()), [[0u32; 2]; 0]);
}
