// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rays: never an odd number of faces through a closed mesh, whatever they are aimed at, and the same bits with and
//! without a hierarchy.

mod common;

use common::random::Random;
use common::rays::{Asked, aimed, bits, feature, length, minus, outside};
use common::{Soup, bodies};
use embound::Status;
use embound::geometry::{Accelerator, Geometry, SdfOptions, SignMethod};
use embound::mesh::Mesh;
use embound::parallel::{Pool, Run};
use embound::query::{self, RayHit, Rays};

fn geometry(mesh: &Mesh, accelerator: Accelerator) -> Geometry {
    let options = SdfOptions { accelerator, ..SdfOptions::default() };
    Geometry::from_mesh(mesh, &options, &Run::SERIAL).unwrap()
}

fn solid(soup: &Soup) -> Geometry {
    geometry(&soup.mesh(), Accelerator::Auto)
}

fn baffle(soup: &Soup) -> Geometry {
    let options = SdfOptions { sign: SignMethod::None, ..SdfOptions::default() };
    Geometry::from_mesh(&soup.mesh_kept(), &options, &Run::SERIAL).unwrap()
}

fn closed() -> Vec<Soup> {
    vec![
        bodies::icosphere(2),
        bodies::torus(0.8, 0.3, 24, 12),
        bodies::bracket(),
        bodies::unit_cube(),
        bodies::tetrahedron(),
        bodies::with_flat_triangles(&bodies::icosphere(1)),
        bodies::overlapping_spheres(1),
        bodies::nested_shells(1),
    ]
}

#[test]
fn rays_from_outside_come_out_of_a_closed_mesh_as_often_as_they_go_in() {
    let mut random = Random(71);
    let (mut count, mut met) = (0, 0);
    for scale in [1.0, 1e-6, 1e6] {
        for (number, body) in closed().iter().enumerate() {
            let body = body.scaled(scale);
            let (mesh, mut asked) = (body.mesh(), Asked::default());
            for _ in 0..4200 {
                let (a, b) = (outside(&mut random, body.bounds()), outside(&mut random, body.bounds()));
                asked.push(a, minus(b, a));
                let (origin, direction) = aimed(&mut random, &body, body.bounds());
                if direction != [0.0; 3] {
                    asked.push(origin, direction);
                }
            }
            let g = geometry(&mesh, Accelerator::Auto);
            let (all, first) = (asked.all(&g, &Run::SERIAL), asked.first(&g, &Run::SERIAL));
            for (i, hits) in all.iter().enumerate() {
                let sum: i32 = hits.iter().map(|h| h.side).sum();
                assert!(sum == 0 && hits.len() % 2 == 0, "body {number}, ray {i}: {hits:?}");
                assert_eq!(bits(hits.first().unwrap_or(&RayHit::NONE)), bits(&first[i]), "body {number}, ray {i}");
                assert!(hits.windows(2).all(|w| (w[0].t, w[0].primitive) <= (w[1].t, w[1].primitive)));
                met += hits.len();
            }
            count += all.len();
        }
    }
    assert!(count > 190_000 && met > count / 2, "{count} rays, {met} hits");
}

#[test]
fn a_hierarchy_finds_what_a_look_at_every_face_does() {
    let mut random = Random(72);
    for body in closed().into_iter().chain([bodies::lattice_soup(60), bodies::sheet(6), bodies::moebius_strip(40)]) {
        for scale in [1.0, 1e-6, 1e6] {
            let body = body.scaled(scale);
            let mesh = body.mesh_kept();
            let of = |accelerator| {
                let options = SdfOptions { accelerator, sign: SignMethod::None, ..SdfOptions::default() };
                Geometry::from_mesh(&mesh, &options, &Run::SERIAL).unwrap()
            };
            let mut asked = Asked::default();
            for k in 0..300 {
                let (a, b) = (outside(&mut random, body.bounds()), feature(&mut random, &body));
                asked.push(a, minus(b, a));
                let (origin, direction) = aimed(&mut random, &body, body.bounds());
                // Some from far away, some from within.
                let back = [0.0, 1e9, -60.0][k % 3] * scale / length(direction).max(1e-9 * scale);
                if direction != [0.0; 3] {
                    asked.push([0, 1, 2].map(|k| origin[k] - back * direction[k]), direction);
                }
            }
            for (t_min, t_max) in [(0.0, f64::INFINITY), (f64::NEG_INFINITY, f64::INFINITY), (0.25, 1.0)] {
                let asked = Asked {
                    t_min: vec![t_min],
                    t_max: vec![t_max],
                    ..Asked {
                        ..Asked { origin: asked.origin.clone(), direction: asked.direction.clone(), ..Asked::default() }
                    }
                };
                let brute = asked.all(&of(Accelerator::None), &Run::SERIAL);
                for accelerator in [Accelerator::Auto, Accelerator::Compact] {
                    let (all, first) =
                        (asked.all(&of(accelerator), &Run::SERIAL), asked.first(&of(accelerator), &Run::SERIAL));
                    for ((all, brute), first) in all.iter().zip(&brute).zip(&first) {
                        assert!(all.iter().map(bits).eq(brute.iter().map(bits)));
                        assert_eq!(bits(first), bits(brute.first().unwrap_or(&RayHit::NONE)));
                        assert!(all.iter().all(|h| h.t >= t_min && h.t <= t_max));
                    }
                }
            }
        }
    }
}

#[test]
fn from_inside_rays_meet_an_odd_number() {
    let mut random = Random(73);
    for body in [bodies::icosphere(2), bodies::torus(0.8, 0.3, 24, 12), bodies::bracket()] {
        let (g, (lo, hi)) = (solid(&body), body.bounds());
        let (mut asked, mut inside) = (Asked::default(), Vec::new());
        while inside.len() < 4000 {
            let (p, to) = (random.point(lo, hi), feature(&mut random, &body));
            let value = g.value(p.into());
            if value.abs() > 1e-9 {
                inside.push(value < 0.0);
                asked.push(p, minus(to, p));
            }
        }
        for (hits, inside) in asked.all(&g, &Run::SERIAL).iter().zip(&inside) {
            assert_eq!(hits.len() % 2 == 1, *inside);
            assert_eq!(hits.iter().map(|h| h.side).sum::<i32>(), i32::from(*inside));
        }
        assert!(inside.iter().any(|i| *i));
    }
}

#[test]
fn a_hit_lies_on_its_face_and_says_what_it_is() {
    let body = bodies::icosphere(2);
    let tags: Vec<i32> = (0..body.triangles.len() as i32).map(|t| 7 * t).collect();
    let mesh = Mesh::from_triangles(&body.xyz(), &body.indices(), Some(&tags), &Default::default()).unwrap();
    let g = geometry(&mesh, Accelerator::Auto);
    let mut random = Random(74);
    let mut asked = Asked::default();
    (0..2000).for_each(|_| {
        let (a, b) = (outside(&mut random, body.bounds()), random.point([-0.5; 3], [0.5; 3]));
        asked.push(a, minus(b, a));
    });
    for (i, hit) in asked.first(&g, &Run::SERIAL).iter().enumerate() {
        let at = [0, 1, 2].map(|k| asked.origin[3 * i + k] + hit.t * asked.direction[3 * i + k]);
        assert!(g.value(at.into()).abs() < 1e-14, "{hit:?}");
        let corner = body.corners(hit.primitive as usize)[0];
        let off = minus(at, corner);
        assert!((hit.normal.x * off[0] + hit.normal.y * off[1] + hit.normal.z * off[2]).abs() < 1e-14);
        assert!((hit.normal.length() - 1.0).abs() < 1e-15);
        assert_eq!((hit.side, hit.tag, hit.part), (-1, 7 * hit.primitive as i32, -1));
    }
}

#[test]
fn both_ends_of_a_range_belong_to_it() {
    let g = solid(&bodies::unit_cube());
    for (t_min, t_max, sides) in [
        (0.0, 1.0, vec![-1]),
        (1.0, 2.0, vec![-1, 1]),
        (2.0, 2.0, vec![1]),
        (0.0, 1.0 - f64::EPSILON, vec![]),
        (1.0 + f64::EPSILON, 2.0, vec![1]),
        (-9.0, -1.0, vec![]),
        (f64::NEG_INFINITY, f64::INFINITY, vec![-1, 1]),
    ] {
        // Along an edge of two triangles, through the middle of a face and through corners.
        for (origin, direction) in [
            ([-1.0, 0.5, 0.5], [1.0, 0.0, 0.0]),
            ([-1.0, 0.25, 0.5], [1.0, 0.0, 0.0]),
            ([-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]),
            ([2.0, 2.0, 2.0], [-1.0, -1.0, -1.0]),
        ] {
            let hits = &Asked::of(origin, direction).within(t_min, t_max).all(&g, &Run::SERIAL)[0];
            assert_eq!(hits.iter().map(|h| h.side).collect::<Vec<_>>(), sides, "{origin:?}, {t_min} to {t_max}");
        }
    }
}

#[test]
fn open_meshes_are_met_once_and_flat_triangles_never() {
    let (lo, hi) = bodies::sheet(4).bounds();
    let middle = [0, 1].map(|k| 0.45 * lo[k] + 0.55 * hi[k]);
    let down = Asked::of([middle[0], middle[1], 9.0], [0.0, 0.0, -1.0]);
    assert_eq!(down.all(&baffle(&bodies::sheet(4)), &Run::SERIAL)[0].len(), 1);
    let flat = Soup {
        vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2], [0, 1, 3]],
    };
    let across = Asked::of([0.25, 0.0, 1.0], [0.0, 0.0, -1.0]);
    assert!(across.all(&baffle(&flat), &Run::SERIAL)[0].iter().all(|h| h.primitive == 1));
    // Within the plane of the one with an area.
    assert!(Asked::of([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0]).all(&baffle(&flat), &Run::SERIAL)[0].is_empty());
}

#[test]
fn rays_follow_bodies_that_are_moved_and_turned_over() {
    let body = bodies::icosphere(2);
    let plain = solid(&body);
    let turn = [0.36, 0.48, -0.8, -0.8, 0.60, 0.0, 0.48, 0.64, 0.60];
    let moved = plain.part(3).unwrap().place(turn, [4.0, 0.0, 0.0]).unwrap().translate([0.0, 5.0, 0.0]).unwrap();
    let row = Geometry::union(&[plain.clone(), moved.clone().part(9).unwrap()]).unwrap();
    let (a, to) = ([-8.0, -10.0, 0.3], [12.0, 15.0, -0.4]);
    let asked = Asked::of(a, to);
    let hits = &asked.all(&row, &Run::SERIAL)[0];
    // Each ball is crossed, and the innermost label counts.
    assert_eq!(hits.iter().map(|h| (h.side, h.part)).collect::<Vec<_>>(), [(-1, -1), (1, -1), (-1, 3), (1, 3)]);
    for hit in hits {
        let at = [0, 1, 2].map(|k| a[k] + hit.t * to[k]);
        assert!(row.value(at.into()).abs() < 1e-13, "{hit:?}");
        let outward = hit.normal.x * to[0] + hit.normal.y * to[1] + hit.normal.z * to[2];
        assert_eq!(outward > 0.0, hit.side > 0);
    }
    let turned = &asked.all(&plain.difference(&moved).unwrap(), &Run::SERIAL)[0];
    for (hit, turned) in hits.iter().zip(turned) {
        let way = if hit.part == 3 { -1.0 } else { 1.0 };
        assert_eq!((turned.t, turned.normal, turned.side), (hit.t, hit.normal * way, hit.side * way as i32));
    }
    // A scale changes no place along the ray.
    let large = Asked::of(a.map(|c| 1e6 * c), to.map(|c| 1e6 * c)).all(&plain.scale(1e6).unwrap(), &Run::SERIAL);
    assert!((large[0][0].t - hits[0].t).abs() < 1e-15);
}

#[test]
fn threads_change_nothing() {
    let body = bodies::torus(0.8, 0.3, 24, 12);
    let (g, mut random, mut asked) = (solid(&body), Random(75), Asked::default());
    for _ in 0..2000 {
        let (origin, direction) = aimed(&mut random, &body, body.bounds());
        if direction != [0.0; 3] {
            asked.push(origin, direction);
        }
    }
    let pool = Pool::new(3, || ()).unwrap();
    let run = Run { pool: Some(&pool), progress: None };
    assert!(asked.first(&g, &Run::SERIAL).iter().map(bits).eq(asked.first(&g, &run).iter().map(bits)));
    let (one, three) = (asked.all(&g, &Run::SERIAL), asked.all(&g, &run));
    assert!(one.iter().flatten().map(bits).eq(three.iter().flatten().map(bits)));
}

/// A number of all the bits of all answers about many rays.
fn hash_of_answers() -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325u64;
    let mut add = |hit: &RayHit| {
        let (numbers, primitive, rest) = bits(hit);
        for word in numbers.into_iter().chain([primitive as u64]).chain(rest.map(|n| n as u64)) {
            hash = (hash ^ word).wrapping_mul(0x100_0000_01b3);
        }
    };
    let mut random = Random(76);
    for body in [bodies::icosphere(3), bodies::torus(0.8, 0.3, 48, 24), bodies::bracket()] {
        let mut asked = Asked::default();
        for _ in 0..2000 {
            let (a, b) = (outside(&mut random, body.bounds()), outside(&mut random, body.bounds()));
            asked.push(a, minus(b, a));
            let (origin, direction) = aimed(&mut random, &body, body.bounds());
            if direction != [0.0; 3] {
                asked.push(origin, direction);
            }
        }
        for accelerator in [Accelerator::Auto, Accelerator::Compact] {
            let g = geometry(&body.mesh(), accelerator);
            asked.first(&g, &Run::SERIAL).iter().for_each(&mut add);
            asked.all(&g, &Run::SERIAL).iter().flatten().for_each(&mut add);
        }
    }
    hash
}

/// Set in the process that is to print its hash alone.
const ALONE: &str = "EMBOUND_TEST_RAYS_HASH";

#[test]
fn the_instruction_set_changes_nothing() {
    if std::env::var_os(ALONE).is_some() {
        println!("hash {} {:x}", embound::isa(), hash_of_answers());
        return;
    }
    // A process has one instruction set.
    let mut hashes = Vec::new();
    for cap in ["scalar", "avx2", "avx512"] {
        let program = std::env::current_exe().unwrap();
        let mut command = std::process::Command::new(program);
        command.args(["--exact", "the_instruction_set_changes_nothing", "--nocapture"]);
        let output = command.env("EMBOUND_ISA", cap).env(ALONE, "1").output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout);
        let at = text.find("hash ").unwrap_or_else(|| panic!("{text}"));
        let words: Vec<String> = text[at..].split_whitespace().skip(1).take(2).map(str::to_owned).collect();
        hashes.push((words[0].clone(), words[1].clone()));
    }
    assert!(hashes[0].0 == "scalar" || hashes[0].0 == "neon");
    assert!(hashes.iter().all(|(_, hash)| *hash == hashes[0].1), "{hashes:?}");
}

#[test]
fn what_is_no_ray_and_what_has_no_faces_is_an_error() {
    let of = |origin: [f64; 3], direction: [f64; 3], t_min: f64| {
        Rays::new(&[[0.0; 3], origin].concat(), &[[1.0; 3], direction].concat(), &[t_min], &[1.0])
            .map(|_| ())
            .unwrap_err()
    };
    for (error, words) in [
        (of([0.0; 3], [0.0, -0.0, 0.0], 0.0), "direction: ray 1"),
        (of([0.0; 3], [0.0, f64::INFINITY, 0.0], 0.0), "direction: ray 1"),
        (of([f64::NAN; 3], [1.0; 3], 0.0), "origin: ray 1"),
        (of([0.0; 3], [1.0; 3], f64::NAN), "t_min, t_max: ray 0"),
        (of([0.0; 3], [1.0; 3], 1.5), "t_min, t_max: ray 0"),
    ] {
        assert_eq!(error.status(), Status::InvalidArgument);
        assert!(error.message().contains(words), "{}", error.message());
    }
    let ball = Geometry::sphere([0.0; 3], 1.0).unwrap();
    let mesh = solid(&bodies::icosphere(1));
    let asked = Asked::of([-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    for (g, words) in [
        (ball.clone(), "a shape"),
        (Geometry::union(&[mesh.clone(), ball]).unwrap(), "a shape"),
        (mesh.offset(0.1).unwrap(), "offset"),
    ] {
        let error = query::first_hits(&g, &asked.rays(), &Run::SERIAL, &|_, _| {}).unwrap_err();
        assert_eq!(error.status(), Status::Unsupported);
        assert!(error.message().contains(words), "{}", error.message());
    }
    for offsets in [vec![0, 1], vec![0, 9], vec![1, 3], vec![0]] {
        let error = query::all_hits(&mesh, &asked.rays(), &offsets, &Run::SERIAL, &|_, _| {}).unwrap_err();
        assert!(error.message().contains("offsets"), "{}", error.message());
    }
}
