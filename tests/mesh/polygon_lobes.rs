// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces that come to a vertex again, or cross themselves, with few corners and with many.

use super::*;

/// Faces over these vertices as they run.
fn mesh(xyz: &[Vec3], face: &[u32]) -> Mesh {
    let xyz: Vec<f64> = xyz.iter().flat_map(|p| p.to_array()).collect();
    Mesh::from_polygons(&xyz, &[0, face.len()], face, None, &options(|o| o.orient = Orient::Keep)).unwrap()
}

/// The triangles keep the sides of the face, others cancel; how many have a vertex twice, and the area of all.
fn cut(mesh: &Mesh, face: &[u32]) -> (usize, f64) {
    assert_eq!(mesh.triangle_count(), face.len() - 2);
    let around = |ring: &[u32]| (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()])).collect::<Vec<_>>();
    let mut sides: Vec<(u32, u32)> = mesh.triangles().iter().flat_map(|t| around(&t.vertices)).collect();
    sides.extend(around(face).iter().map(|(a, b)| (*b, *a)));
    let (mut there, mut back) = (sides.clone(), sides.iter().map(|(a, b)| (*b, *a)).collect::<Vec<_>>());
    there.sort_unstable();
    back.sort_unstable();
    assert_eq!(there, back);
    let twice = |t: &[u32; 3]| t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    let all = mesh.triangles().iter().map(|t| t.vertices);
    let area = |t: [u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.vertices()[v as usize]);
        0.5 * (b - a).cross(c - a).length()
    };
    (all.clone().filter(twice).count(), all.map(area).sum())
}

/// A regular polygon round (center, 0, 0) that begins at the origin and runs either way.
fn lobe(n: usize, center: f64, clockwise: bool) -> Vec<Vec3> {
    let turn = std::f64::consts::TAU / n as f64 * if clockwise { -1.0 } else { 1.0 };
    let at =
        |k: usize| Vec3::new(center - center * libm::cos(turn * k as f64), -center * libm::sin(turn * k as f64), 0.0);
    (1..n).map(at).collect()
}

#[test]
fn lobes_that_meet_in_a_vertex_are_covered_and_nothing_else_is() {
    // With few corners by the least area, with many lobe by lobe; alike and opposite, in one plane and in two.
    for n in [3usize, 4, 12, 100, 140, 1000, 4000] {
        for (clockwise, tilt) in [(false, 0.0), (true, 0.0), (true, 1.0), (false, 0.5)] {
            let first = lobe(n, 1.0, false);
            let mut second = lobe(n, -1.0, clockwise);
            for p in &mut second {
                // Sheared: no side of one lobe is in line with a side of the other.
                (p.y, p.z) = (p.y + 0.1 * p.x, tilt * p.x);
            }
            let xyz = [vec![Vec3::ZERO], first, second].concat();
            let m = n as u32;
            let mut face: Vec<u32> = (0..m).chain([0]).chain(m..2 * m - 1).collect();
            for shift in [0, 1, n + 1] {
                face.rotate_left(shift);
                let mesh = mesh(&xyz, &face);
                let one = 0.5 * n as f64 * libm::sin(std::f64::consts::TAU / n as f64);
                let wanted = one * (1.0 + (1.0 + tilt * tilt).sqrt());
                let (twice, area) = cut(&mesh, &face);
                assert!((area / wanted - 1.0).abs() < 1e-9, "{n} {clockwise} {tilt}: {area} instead of {wanted}");
                // As many triangles as a face has corners but two: these fill up.
                assert_eq!((twice, mesh.report().warped_faces), (2, 1));
            }
        }
    }
}

#[test]
fn lobes_within_lobes_are_covered() {
    // A chain of 200 clockwise squares, each begun at the far corner of the one before and ended after it.
    let count = 200u32;
    let square = |k: u32| {
        let at = f64::from(k);
        [Vec3::new(at, at, 0.0), Vec3::new(at + 1.0, at, 0.0), Vec3::new(at, at + 1.0, 0.0)]
    };
    let mut xyz: Vec<Vec3> = (0..count).flat_map(square).collect();
    xyz.push(Vec3::new(f64::from(count), f64::from(count), 0.0));
    let up = (0..count).flat_map(|k| [3 * k, 3 * k + if k % 2 == 0 { 1 } else { 2 }]);
    let down = (0..count).rev().map(|k| 3 * k + if k % 2 == 0 { 2 } else { 1 });
    let back = (1..count).rev().map(|k| 3 * k);
    let back = down.zip(back.map(Some).chain([None])).flat_map(|(c, v)| [Some(c), v]).flatten();
    let face: Vec<u32> = up.chain([3 * count]).chain(back).collect();
    assert_eq!(face.len(), 4 * count as usize);
    let mesh = mesh(&xyz, &face);
    let (twice, area) = cut(&mesh, &face);
    assert_eq!(twice, 2 * (count as usize - 1));
    assert!(close(area, f64::from(count)), "{area}");
}

#[test]
fn large_faces_that_cross_themselves_keep_their_sides() {
    for n in [250usize, 251, 2000] {
        let turn = |k: usize| (k as f64 + 0.5) / n as f64 * std::f64::consts::TAU;
        let at = |k: usize| Vec3::new(libm::sin(2.0 * turn(k)), libm::sin(turn(k)) + 0.1 * libm::cos(turn(k)), 0.0);
        let xyz: Vec<Vec3> = (0..n).map(at).collect();
        // From a corner far from the crossing.
        let face: Vec<u32> = (0..n as u32).map(|k| (k + n as u32 / 8) % n as u32).collect();
        let mesh = mesh(&xyz, &face);
        assert_eq!(mesh.report().warped_faces, 1);
        let (twice, area) = cut(&mesh, &face);
        assert_eq!(twice, 0);
        // Least area over either loop up to 250 corners, a fan beyond.
        assert_eq!(area < 4.0, n <= 250, "{area}");
    }
}

#[test]
fn faces_on_a_line_have_no_vertex_twice_in_a_triangle_where_one_comes_once() {
    let xyz: Vec<Vec3> = (0..5).map(|k| Vec3::new(f64::from(k), 2.0 * f64::from(k), 0.0)).chain([Vec3::Y]).collect();
    let corners: Vec<f64> = xyz.iter().flat_map(|p| p.to_array()).collect();
    for face in [&[0u32, 1, 2, 0, 3, 4][..], &[1, 0, 2, 1, 4, 2, 3], &[0, 1, 2, 3]] {
        let indices = [&[0u32, 1, 5], face].concat();
        let keep = options(|o| o.orient = Orient::Keep);
        let mesh = Mesh::from_polygons(&corners, &[0, 3, indices.len()], &indices, None, &keep).unwrap();
        assert_eq!(mesh.triangle_count(), face.len() - 1);
        for t in &mesh.triangles()[1..] {
            let [a, b, c] = t.vertices;
            assert!(a != b && b != c && c != a, "{t:?} of {face:?}");
        }
    }
}

/// Petals that turn either way round one vertex; corners at one point do not slow down the search for ears.
#[test]
fn a_flower_of_many_petals_is_covered_and_nothing_else_is() {
    let petals = 50_000u32;
    let at = |k: u32| {
        let a = std::f64::consts::TAU * f64::from(k) / f64::from(2 * petals);
        Vec3::new(libm::cos(a), libm::sin(a), 0.0)
    };
    let xyz: Vec<Vec3> = std::iter::once(Vec3::ZERO).chain((0..2 * petals).map(at)).collect();
    let petal = |k: u32| if k.is_multiple_of(2) { [0, 2 * k + 1, 2 * k + 2] } else { [0, 2 * k + 2, 2 * k + 1] };
    let face: Vec<u32> = (0..petals).flat_map(petal).collect();
    let mesh = mesh(&xyz, &face);
    let (twice, area) = cut(&mesh, &face);
    assert_eq!(twice, 2 * (petals as usize - 1));
    let wanted = 0.5 * f64::from(petals) * libm::sin(std::f64::consts::TAU / f64::from(2 * petals));
    assert!((area / wanted - 1.0).abs() < 1e-9, "{area} instead of {wanted}");
}
