// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices and edges of many faces, against all pairs, and in sizes that would take hours pair by pair.

use super::touching::all_pairs;
use super::*;
use embound::geometry::{Geometry, SdfOptions, SignMethod};

/// Triangles at one vertex, over points of a grid.
fn star(count: usize, points: usize, random: &mut Random) -> Soup {
    let mut soup = grid_soup(count, points, random);
    let hub = [0, 1, 2].map(|_| (points / 2) as f64);
    (0..count).for_each(|t| soup.vertices[3 * t + t % 3] = hub);
    soup
}

/// Triangles at one edge.
fn book(count: usize, points: usize, random: &mut Random) -> Soup {
    let mut soup = star(count, points, random);
    let other = [(points / 2 + 1) as f64, (points / 2 + 2) as f64, (points / 2 + 3) as f64];
    (0..count).for_each(|t| soup.vertices[3 * t + (t + 1) % 3] = other);
    soup
}

#[test]
fn faces_at_one_vertex_meet_where_all_pairs_say_so() {
    let mut random = Random(41);
    let mut total = 0;
    for (count, points) in [(40, 5), (150, 6), (300, 12), (300, 200)] {
        let soup = star(count, points, &mut random);
        let wanted = all_pairs(&soup);
        total += wanted.len();
        assert_eq!(pairs(&soup.mesh_kept()), wanted, "{count} faces, {points} points");
    }
    assert!(total > 2000, "{total}");
}

#[test]
fn faces_at_one_edge_meet_where_all_pairs_say_so() {
    let mut random = Random(42);
    let mut total = 0;
    for (count, points) in [(100, 7), (200, 9), (300, 16)] {
        for reversed in [false, true] {
            // The lowest vertex is now one end of the edge, now the other.
            let mut soup = book(count, points, &mut random);
            if reversed {
                soup = soup.map(|p| p.map(|c| 32.0 - c));
                soup.triangles.iter_mut().for_each(|t| t.rotate_left(1));
            }
            let wanted = all_pairs(&soup);
            total += wanted.len();
            assert_eq!(pairs(&soup.mesh_kept()), wanted, "{count} faces, {points} points");
        }
    }
    assert!(total > 100, "{total}");
}

#[test]
fn several_hubs_and_edges_of_many_faces_at_once() {
    let mut random = Random(43);
    let soup = star(120, 8, &mut random)
        .and(&book(100, 9, &mut random))
        .and(&star(100, 9, &mut random).translated([1.0, 0.0, 2.0]))
        .and(&grid_soup(80, 9, &mut random));
    let wanted = all_pairs(&soup);
    assert!(wanted.len() > 2000);
    assert_eq!(pairs(&soup.mesh_kept()), wanted);
}

/// A disc of triangles round the origin, its rim at integer points of a plane through `map`.
fn disc(count: usize, size: usize, random: &mut Random, map: impl Fn(f64, f64) -> [f64; 3]) -> Soup {
    let coordinate = |random: &mut Random| random.below(2 * size + 1) as f64 - size as f64;
    let mut rim: Vec<[f64; 2]> = (0..count).map(|_| [coordinate(random), coordinate(random)]).collect();
    rim.retain(|p| p[0].abs() + p[1].abs() > 0.0);
    rim.sort_by(|p, q| libm::atan2(p[1], p[0]).total_cmp(&libm::atan2(q[1], q[0])));
    let mut out = Soup { vertices: vec![map(0.0, 0.0)], triangles: Vec::new() };
    out.vertices.extend(rim.iter().map(|p| map(p[0], p[1])));
    out.triangles.extend((0..rim.len() as u32).map(|k| [0, k + 1, (k + 1) % rim.len() as u32 + 1]));
    out
}

#[test]
fn plane_fans_beside_on_and_through_each_other_meet_where_all_pairs_say_so() {
    let mut random = Random(46);
    let tilted = |lift: f64| move |x: f64, y: f64| [x, y, x + 2.0 * y + lift];
    let mut counts = Vec::new();
    for (lift, steep) in [(1.0, 1.0), (0.0, 1.0), (40.0, 3.0)] {
        let soup = disc(150, 30, &mut random, tilted(0.0))
            .and(&disc(130, 30, &mut random, tilted(lift)))
            .and(&disc(110, 30, &mut random, move |x, y| [x + 1.0, y, steep * x + 2.0 * y]))
            .and(&grid_soup(60, 40, &mut random));
        let wanted = all_pairs(&soup);
        counts.push(wanted.iter().filter(|p| p[1] < 275).count());
        assert_eq!(pairs(&soup.mesh_kept()), wanted, "lifted by {lift}");
    }
    // Beside each other two discs do not meet; on each other they meet all over.
    assert!(counts[0] < 50 && counts[1] > 200, "{counts:?}");
}

#[test]
fn the_caps_of_a_thin_tilted_cylinder_are_told_apart() {
    let turned = |x: f64, y: f64| [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y];
    let coin = drum(20_000, 1.0, 0.01).map(|[x, y, z]| {
        let [x, z] = turned(x, z);
        let [y, z] = turned(y, z);
        [x, y, z]
    });
    assert_eq!(pairs(&coin.mesh()), [[0u32; 2]; 0]);
    let g = Geometry::from_mesh(&coin.mesh(), &SdfOptions::default(), &Run::SERIAL).expect("a closed mesh");
    assert_eq!(g.properties().sign_method, SignMethod::Pseudonormal);
}

#[test]
fn a_hundred_thousand_faces_at_a_vertex_or_an_edge_are_answered() {
    // A ragged disc, and a triangle through it.
    let mut random = Random(44);
    let count = 100_000;
    let mut disc = Soup { vertices: vec![[0.0; 3]], triangles: Vec::new() };
    for k in 0..count {
        let a = std::f64::consts::TAU * k as f64 / count as f64;
        let r = random.range(0.2, 1.0);
        let (x, y) = (r * libm::cos(a), r * libm::sin(a));
        disc.vertices.push([x, 0.6 * y, 0.8 * y]);
        disc.triangles.push([0, k as u32 + 1, ((k + 1) % count) as u32 + 1]);
    }
    assert_eq!(pairs(&disc.mesh_kept()), [[0u32; 2]; 0]);
    let needle =
        Soup { vertices: vec![[0.05, 0.01, -0.5], [0.05, 0.01, 0.5], [0.05, 0.011, 0.5]], triangles: vec![[0, 1, 2]] };
    let found = pairs(&disc.and(&needle).mesh_kept());
    assert!(!found.is_empty() && found.len() < 1000 && found.iter().all(|p| p[1] == count as u32), "{}", found.len());
    let book = bodies::book(count);
    assert_eq!(pairs(&book.mesh_kept()), [[0u32; 2]; 0]);
    // Two discs round one vertex, close to each other but for it.
    let n = disc.vertices.len() as u32;
    let mut cones =
        disc.map(|p| [p[0], p[1], p[2] + 1e-3 * (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt()]).and(&disc);
    cones.triangles.iter_mut().for_each(|t| t.iter_mut().filter(|v| **v == n).for_each(|v| *v = 0));
    assert_eq!(pairs(&cones.mesh_kept()), [[0u32; 2]; 0]);
}

#[test]
fn ten_thousand_triangles_on_each_other_end_at_the_limit() {
    let mut soup = Soup::default();
    for k in 0..10_000 {
        let z = k as f64 * 1e-6;
        soup.vertices.extend([[0.0, z, 0.0], [1.0, 0.0, z], [z, 1.0, 0.5]]);
        soup.triangles.push([3 * k, 3 * k + 1, 3 * k + 2]);
    }
    let options = DiagnosisOptions { intersection_limit: 10_000, ..DiagnosisOptions::default() };
    let found = diagnosis_with(&soup.mesh_kept(), &options).intersections.expect("looked for");
    assert!(!found.complete && found.pairs.len() == 10_000 && found.count == 10_001);
}

/// A cone of height 1 with its apex at the origin, its cap a fan.
fn cone(sides: usize, radius: f64, lean: f64) -> Soup {
    let mut out = Soup { vertices: vec![[0.0; 3], [lean, 0.0, 1.0]], triangles: Vec::new() };
    for k in 0..sides {
        let a = std::f64::consts::TAU * k as f64 / sides as f64;
        out.vertices.push([radius * libm::cos(a) + lean, radius * libm::sin(a), 1.0]);
        let (here, next) = (k as u32 + 2, ((k + 1) % sides) as u32 + 2);
        out.triangles.extend([[0, next, here], [1, here, next]]);
    }
    out
}

#[test]
fn signs_know_whether_cones_of_one_apex_pass_through_each_other() {
    // A hollow cone: the inner one is a cavity that reaches the apex.
    for (inner, lean, method) in [
        (cone(50, 0.3, 0.0).scaled(0.5).flipped(), 0.0, SignMethod::Pseudonormal),
        (cone(50, 0.3, 0.5).scaled(0.5).flipped(), 0.5, SignMethod::Ray),
        // Apart by less than rounding.
        (cone(50, 0.6, 0.0).map(|p| [p[0], p[1], p[2] * (1.0 - 1e-16)]).scaled(0.5).flipped(), 0.0, SignMethod::Ray),
    ] {
        let soup = cone(50, 0.6, 0.0).and(&inner);
        let options = embound::mesh::MeshOptions { orient: embound::mesh::Orient::Keep, ..Default::default() };
        let mesh = soup.mesh_with(&options);
        let g = Geometry::from_mesh(&mesh, &SdfOptions::default(), &Run::SERIAL).expect("balanced");
        assert_eq!(g.properties().sign_method, method, "leaning by {lean}");
        let mut random = Random(45);
        let mut inside = 0;
        for _ in 0..500 {
            let p = random.point([-0.7, -0.7, -0.1], [0.7, 0.7, 1.1]);
            let winding = common::winding::winding_number(&soup, p);
            let value = g.value(Vec3::from_array(p));
            if (winding - winding.round()).abs() < 1e-3 && value.abs() > 1e-9 {
                assert_eq!(value < 0.0, winding.round() >= 1.0, "{p:?}");
                inside += usize::from(value < 0.0);
            }
        }
        assert!(inside > 50);
    }
}
