// SPDX-License-Identifier: MIT OR Apache-2.0
//! A geometry whose vertices moved is the one that is made of such a mesh anew, to the bit; what moved must fit.

mod common;

use common::{Soup, bodies, points, random::Random};
use embound::Status;
use embound::geometry::{Accelerator, Geometry, RefitCheck, SdfOptions, SignMethod};
use embound::math::Vec3;
use embound::mesh::{Mesh, MeshOptions, Orient};
use embound::parallel::{Pool, Run};

/// Every vertex for itself, and faces as they run: the topology stays whatever the positions are.
fn kept() -> MeshOptions {
    MeshOptions { orient: Orient::Keep, weld_tolerance: -1.0, ..MeshOptions::default() }
}

fn mesh(soup: &Soup) -> Mesh {
    let tags: Vec<i32> = (0..soup.triangles.len() as i32).map(|t| t % 5).collect();
    Mesh::from_triangles(&soup.xyz(), &soup.indices(), Some(&tags), &kept()).expect("a mesh")
}

fn geometry(soup: &Soup, options: &SdfOptions) -> embound::Result<Geometry> {
    Geometry::from_mesh(&mesh(soup), options, &Run::SERIAL)
}

fn with_sign(sign: SignMethod) -> SdfOptions {
    SdfOptions { sign, ..SdfOptions::default() }
}

/// Everything that a question may return.
fn answers(g: &Geometry, at: &[[f64; 3]]) -> Vec<u64> {
    let answer = |p: &[f64; 3]| {
        let c = g.closest(Vec3::from_array(*p));
        let numbers = [c.point, c.gradient, c.barycentric].map(|v| v.to_array()).concat();
        let ids = [c.primitive as u64, c.piece as u64, c.tag as u64, c.feature as u64];
        let value = g.value(Vec3::from_array(*p)).to_bits();
        numbers.into_iter().map(f64::to_bits).chain(ids).chain([value]).collect::<Vec<u64>>()
    };
    at.iter().flat_map(answer).collect()
}

/// Motions from the harmless to those that make the surface meet itself, fold flat or fall apart.
fn moved(soup: &Soup, kind: usize, random: &mut Random) -> Soup {
    let (lo, hi) = soup.bounds();
    let size = (0..3).map(|k| hi[k] - lo[k]).fold(0.0, f64::max);
    let phase = random.range(0.0, 6.0);
    let bend = |a: f64| {
        move |[x, y, z]: [f64; 3]| {
            [x + a * size * libm::sin(3.0 * y / size + phase), y + a * size * libm::sin(4.0 * z / size), z * (1.0 + a)]
        }
    };
    match kind {
        0 => soup.map(bend(0.1)),
        1 => soup.map(bend(0.8)),
        2 | 3 => {
            let reach = size * if kind == 2 { 1e-3 } else { 0.05 };
            soup.map(|p| p.map(|c| c + random.range(-reach, reach)))
        }
        4 => soup.scaled(1e-7).translated([1e-6, 0.0, -3e-7]),
        5 => soup.scaled(1e7).translated([1e9, -1e8, 0.0]),
        6 => {
            // Corners come to lie on others, and a triangle has no area.
            let mut all = soup.clone();
            let few: Vec<_> = (0..4).map(|_| soup.triangles[random.below(soup.triangles.len())]).collect();
            few.iter().for_each(|t| all.vertices[t[0] as usize] = all.vertices[t[1] as usize]);
            let [a, b, c] = few[0].map(|v| v as usize);
            all.vertices[c] = [0, 1, 2].map(|k| 0.5 * (all.vertices[a][k] + all.vertices[b][k]));
            all
        }
        _ => soup.map(|[x, y, z]| [-0.0 * x, y, z + 0.3 * y]),
    }
}

fn all_bodies() -> Vec<Soup> {
    let ball = bodies::icosphere(3);
    vec![
        ball.clone(),
        bodies::torus(1.0, 0.3, 30, 16),
        bodies::unit_cube(),
        bodies::bracket(),
        bodies::nested_shells(2),
        bodies::overlapping_spheres(2),
        bodies::with_flat_triangles(&ball),
        ball.and(&ball.translated([3.0, 0.0, 0.0])).and(&bodies::cuboid([5.0; 3], [6.0, 7.0, 5.5])),
        ball.duplicated(),
        bodies::cubes_sharing_an_edge(),
    ]
}

#[test]
fn what_moved_is_what_is_made_anew_to_the_bit() {
    let pool = Pool::new(3, || {}).expect("a pool");
    let pooled = Run { pool: Some(&pool), progress: None };
    let mut random = Random(41);
    let (mut compared, mut methods) = (0, [0; 6]);
    for (b, soup) in all_bodies().iter().enumerate() {
        for kind in 0..8 {
            let new = moved(soup, kind, &mut random);
            for sign in [SignMethod::Auto, SignMethod::Ray, SignMethod::None] {
                let accelerator = [Accelerator::Auto, Accelerator::None, Accelerator::Compact][kind % 3];
                let options = SdfOptions { accelerator, ..with_sign(sign) };
                let before = geometry(soup, &options).expect("a geometry");
                let anew = geometry(&new, &options).expect("a geometry");
                let (serial, parallel) = (
                    before.refit(&new.xyz(), RefitCheck::Check, &Run::SERIAL),
                    before.refit(&new.xyz(), RefitCheck::Check, &pooled),
                );
                let [serial, parallel] = match [serial, parallel] {
                    [Ok(serial), Ok(parallel)] => [serial, parallel],
                    [serial, parallel] => {
                        // Turned inside out: nothing else is refused, and not where there is no inside.
                        let messages = [serial, parallel].map(|r| r.err().expect("both refuse").to_string());
                        assert!(messages.iter().all(|m| m.contains("inside out")), "{b} {kind}: {messages:?}");
                        assert_ne!(sign, SignMethod::None);
                        assert_eq!(anew.value(Vec3::splat(2e10)) < 0.0, before.value(Vec3::splat(2e10)) >= 0.0);
                        continue;
                    }
                };
                assert_eq!(anew.fingerprint(), serial.fingerprint(), "{b} {kind} {sign:?}");
                assert_eq!(anew.fingerprint(), parallel.fingerprint(), "{b} {kind} {sign:?}");
                assert_eq!(anew.properties().sign_method, serial.properties().sign_method);
                let at = points::all_kinds(&new, 40, &mut random);
                let expected = answers(&anew, &at);
                assert_eq!(expected, answers(&serial, &at), "{b} {kind} {sign:?}");
                assert_eq!(expected, answers(&parallel, &at), "{b} {kind} {sign:?}");
                (compared, methods[serial.properties().sign_method as usize]) =
                    (compared + 1, methods[serial.properties().sign_method as usize] + 1);
            }
        }
    }
    let seen = [SignMethod::Pseudonormal, SignMethod::Ray, SignMethod::None].map(|m| methods[m as usize]);
    assert!(compared > 200 && seen.iter().all(|n| *n > 10), "{compared} {methods:?}");
}

#[test]
fn steps_of_a_long_motion_stay_what_is_made_anew() {
    let ball = bodies::icosphere(4);
    let options = SdfOptions::default();
    let mut g = geometry(&ball, &options).expect("a geometry");
    let mut random = Random(5);
    for step in 1..=20 {
        let a = 0.05 * f64::from(step);
        let new = ball.map(|[x, y, z]| [x + a * libm::sin(5.0 * z), y, z * (1.0 + 2.0 * a)]);
        let next = g.refit(&new.xyz(), RefitCheck::Check, &Run::SERIAL).expect("a step");
        let trusted = g.refit(&new.xyz(), RefitCheck::Trust, &Run::SERIAL).expect("a step");
        let anew = geometry(&new, &options).expect("a geometry");
        assert_eq!(next.properties().sign_method, SignMethod::Pseudonormal);
        assert_eq!((anew.fingerprint(), anew.fingerprint()), (next.fingerprint(), trusted.fingerprint()));
        let at = points::all_kinds(&new, 100, &mut random);
        let expected = answers(&anew, &at);
        assert!(expected == answers(&next, &at) && expected == answers(&trusted, &at), "step {step}");
        g = next;
    }
}

#[test]
fn polygons_move_with_the_triangles_they_were_cut_into() {
    let mut random = Random(9);
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { 1.0 } else { 0.0 });
    let xyz: Vec<f64> = (0..8).flat_map(corner).collect();
    let indices = [0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5];
    let offsets: Vec<usize> = (0..=6).map(|f| 4 * f).collect();
    let polygons = Mesh::from_polygons(&xyz, &offsets, &indices, None, &MeshOptions::default()).expect("a cube");
    let g = Geometry::from_mesh(&polygons, &SdfOptions::default(), &Run::SERIAL).expect("a geometry");
    let new: Vec<f64> =
        polygons.vertices().iter().flat_map(|p| p.to_array()).map(|c| c + random.range(-0.2, 0.2)).collect();
    let triangles: Vec<u32> = polygons.triangles().iter().flat_map(|t| t.vertices).collect();
    let pieces = Mesh::from_triangles(&new, &triangles, None, &kept()).expect("its triangles");
    let anew = Geometry::from_mesh(&pieces, &SdfOptions::default(), &Run::SERIAL).expect("a geometry");
    let moved = g.refit(&new, RefitCheck::Check, &Run::SERIAL).expect("moved");
    for _ in 0..2000 {
        let p = Vec3::from_array(random.point([-0.5; 3], [1.5; 3]));
        assert_eq!(anew.value(p).to_bits(), moved.value(p).to_bits());
        let (a, b) = (anew.closest(p), moved.closest(p));
        assert_eq!((a.primitive / 2, a.primitive % 2), (b.primitive, b.piece.into()), "pieces of squares");
    }
}

#[test]
fn what_does_not_fit_is_refused_and_named() {
    let ball = bodies::icosphere(2);
    let g = geometry(&ball, &SdfOptions::default()).expect("a geometry");
    let refused = |g: &Geometry, xyz: &[f64]| {
        let errors = [RefitCheck::Check, RefitCheck::Trust]
            .map(|check| g.refit(xyz, check, &Run::SERIAL).err().expect("refused"));
        assert_eq!(errors[0].to_string(), errors[1].to_string());
        (errors[0].status(), errors[0].to_string())
    };
    let is = |(status, message): (Status, String), wanted: Status, word: &str| {
        assert!(status == wanted && message.contains(word), "{status:?} {message}");
    };
    let xyz = ball.xyz();
    is(refused(&g, &xyz[3..]), Status::InvalidArgument, "xyz");
    for (bad, word) in [(f64::NAN, "vertex 7"), (f64::INFINITY, "vertex 7"), (-2e100, "vertex 7")] {
        let mut xyz = xyz.clone();
        (xyz[22], xyz[40]) = (bad, bad);
        is(refused(&g, &xyz), Status::InvalidArgument, word);
    }
    is(refused(&g, &vec![0.5; xyz.len()]), Status::InvalidArgument, "diagonal");
    is(refused(&g, &ball.map(|[x, y, z]| [-x, y, z]).xyz()), Status::Topology, "inside out");
    let unsigned = geometry(&ball, &with_sign(SignMethod::None)).expect("a geometry");
    assert!(unsigned.refit(&ball.map(|[x, y, z]| [-x, y, z]).xyz(), RefitCheck::Check, &Run::SERIAL).is_ok());
    let turn = [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    for (other, word) in [
        (g.part(3).unwrap(), "labelled"),
        (g.translate([1.0, 0.0, 0.0]).unwrap(), "moved"),
        (g.place(turn, [0.0; 3]).unwrap(), "moved"),
        (g.complement().unwrap(), "complement"),
        (Geometry::union(&[g.clone(), Geometry::sphere([0.0; 3], 1.0).unwrap()]).unwrap(), "union"),
        (Geometry::sphere([0.0; 3], 1.0).unwrap(), "shape"),
    ] {
        is(refused(&other, &xyz), Status::Unsupported, word);
        assert!(other.vertices_to_move().is_err());
    }
    assert_eq!(g.vertices_to_move().unwrap(), ball.vertices.len());
    let stop = |_: f64| true;
    let run = Run { pool: None, progress: Some(&stop) };
    let cancelled = g.refit(&xyz, RefitCheck::Trust, &run).err().expect("cancelled");
    assert_eq!(cancelled.status(), Status::Cancelled);
    let cancelled = g.refit(&xyz, RefitCheck::Check, &run).err().expect("cancelled");
    assert_eq!(cancelled.status(), Status::Cancelled);
}

#[test]
fn the_check_finds_what_trust_overlooks() {
    let ball = bodies::icosphere(3);
    let mut spiked = ball.clone();
    spiked.vertices[0] = ball.vertices[0].map(|c| -1.5 * c);
    for sign in [SignMethod::Auto, SignMethod::Pseudonormal] {
        let g = geometry(&ball, &with_sign(sign)).expect("a geometry");
        let before = g.fingerprint();
        let trusted = g.refit(&spiked.xyz(), RefitCheck::Trust, &Run::SERIAL).expect("taken at its word");
        assert_eq!(trusted.properties().sign_method, SignMethod::Pseudonormal);
        let checked = g.refit(&spiked.xyz(), RefitCheck::Check, &Run::SERIAL);
        match sign {
            SignMethod::Auto => {
                let checked = checked.expect("crossings take over");
                assert_eq!(checked.properties().sign_method, SignMethod::Ray);
                // And give it back when the surface is sound again.
                let back = checked.refit(&ball.xyz(), RefitCheck::Check, &Run::SERIAL).expect("a geometry");
                assert_eq!(back.fingerprint(), before);
                assert_eq!(back.properties().sign_method, SignMethod::Pseudonormal);
            }
            _ => {
                let error = checked.err().expect("refused");
                assert!(error.status() == Status::Topology && error.to_string().contains("PSEUDONORMAL"), "{error}");
            }
        }
        assert_eq!(g.fingerprint(), before);
    }
}

#[test]
fn vertices_and_geometries_may_go_in_any_order() {
    let ball = bodies::icosphere(3);
    let g = geometry(&ball, &SdfOptions::default()).expect("a geometry");
    let grown = ball.scaled(2.0);
    let h = g.refit(&grown.xyz(), RefitCheck::Check, &Run::SERIAL).expect("a geometry");
    let (before, mine) = (g.value(Vec3::ZERO), h.value(Vec3::ZERO));
    assert_eq!(2.0 * before, mine);
    drop(g);
    assert_eq!(h.value(Vec3::ZERO), mine);
}
