// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices that become one.

use super::*;
use embound::math::{Aabb, length};

#[test]
fn equal_positions_become_one_and_unused_vertices_leave() {
    let mut body = bodies::icosphere(2).unshared();
    body.vertices.insert(0, [9.0; 3]);
    for t in &mut body.triangles {
        *t = t.map(|v| v + 1);
    }
    let mesh = body.mesh();
    assert_eq!(mesh.vertices().len(), 162);
    assert_eq!(mesh.report().hi, mesh.vertices().iter().fold(Vec3::NEG_INFINITY, |m, p| m.max(*p)).to_array());
    assert!(mesh.report().closed);
    // The order is that of the first use of each position.
    let mut seen = Vec::new();
    for p in &body.vertices[1..] {
        if !seen.contains(p) {
            seen.push(*p);
        }
    }
    assert!(seen.iter().zip(mesh.vertices()).all(|(p, q)| *p == q.to_array()));
}

#[test]
fn near_vertices_become_the_lowest_of_them() {
    let exact = bodies::icosphere(3);
    let mut random = Random(1);
    let noisy = exact.unshared().map(|p| p.map(|c| c + random.range(-1e-7, 1e-7)));
    assert!(!noisy.mesh().report().closed);
    let mesh = noisy.mesh_with(&options(|o| o.weld_tolerance = 1e-6));
    assert!(mesh.report().closed && mesh.report().degenerate_faces == 0);
    assert_eq!(mesh.vertices().len(), exact.vertices.len());
    assert_eq!(mesh.vertices()[0].to_array(), noisy.vertices[0]);
    assert!(!noisy.mesh_with(&options(|o| o.weld_tolerance = 1e-9)).report().closed);
}

#[test]
fn welding_by_tolerance_joins_exactly_the_pairs_within_it() {
    let mut random = Random(2);
    let vertices: Vec<[f64; 3]> = (0..600).map(|_| random.point([0.0; 3], [1.0; 3])).collect();
    let triangles = (0..200).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let soup = Soup { vertices, triangles };
    let (lo, hi) = soup.bounds();
    let distance = |p: [f64; 3], q: [f64; 3]| (Vec3::from_array(p) - Vec3::from_array(q)).length();
    for tolerance in [0.003, 0.02, 0.05] {
        let reach = tolerance * distance(lo, hi);
        let mut root: Vec<usize> = (0..600).collect();
        for (a, b) in (0..600).flat_map(|a| (0..a).map(move |b| (b, a))) {
            if distance(soup.vertices[a], soup.vertices[b]) < reach && root[a] != root[b] {
                let (keep, drop) = (root[a].min(root[b]), root[a].max(root[b]));
                root.iter_mut().filter(|r| **r == drop).for_each(|r| *r = keep);
            }
        }
        let mesh = soup.mesh_with(&options(|o| (o.weld_tolerance, o.orient) = (tolerance, Orient::Keep)));
        assert_eq!(mesh.report().vertices, (0..600).filter(|&v| root[v] == v).count());
        for t in mesh.triangles().iter().filter(|t| t.face < 200) {
            let wanted = soup.triangles[t.face as usize].map(|v| soup.vertices[root[v as usize]]);
            assert_eq!(t.corners(mesh.vertices()).map(|p| p.to_array()), wanted);
        }
    }
}

#[test]
fn faces_that_welding_collapses_leave_and_the_rest_stays_closed() {
    // A vertex of the sphere split in two, a sliver between: welding closes the gap again.
    let mut body = bodies::icosphere(1);
    let moved = body.vertices.len() as u32;
    let at = body.triangles[0][0];
    body.vertices.push(body.vertices[at as usize].map(|c| c * (1.0 + 1e-9)));
    let ring: Vec<usize> = (0..80).filter(|&t| body.triangles[t].contains(&at)).collect();
    let first = body.triangles[ring[0]];
    let k = first.iter().position(|v| *v == at).unwrap();
    body.triangles[ring[0]][k] = moved;
    // Two slivers fill the gaps on both sides of the moved triangle.
    body.triangles.insert(0, [moved, at, first[(k + 1) % 3]]);
    body.triangles.push([at, moved, first[(k + 2) % 3]]);
    let exact = body.mesh();
    assert!(exact.report().closed && exact.triangle_count() == 82);
    let mesh = body.mesh_with(&options(|o| o.weld_tolerance = 1e-8));
    assert_eq!((mesh.report().faces, mesh.report().degenerate_faces, mesh.triangle_count()), (82, 2, 80));
    assert!(mesh.report().closed && mesh.report().nonmanifold_edges == 0);
    // Numbers are those of the input.
    assert_eq!(mesh.triangles()[0].face, 1);
    assert_eq!(mesh.triangles()[79].face, 80);
}

#[test]
fn minus_zero_is_zero_whatever_the_shift() {
    for zero in [0.0, -0.0] {
        let mut body = bodies::unit_cube().unshared();
        for p in body.vertices.iter_mut().step_by(2) {
            *p = p.map(|c| if c == 0.0 { -0.0 } else { c });
        }
        let mesh = body.mesh_with(&options(|o| o.shift = [zero; 3]));
        assert!(mesh.report().closed && mesh.vertices().len() == 8);
        assert!(mesh.vertices().iter().all(|p| p.to_array().into_iter().all(|c| c.is_sign_positive())));
    }
}

/// Where vertex k of a cloud went, for each: faces of a vertex each and two far ones that stay apart.
fn welded_cloud(cloud: &[Vec3], far: [Vec3; 2], tolerance: f64) -> Vec<Vec3> {
    let xyz: Vec<f64> = cloud.iter().chain(&far).flat_map(|p| p.to_array()).collect();
    let n = cloud.len() as u32;
    let indices: Vec<u32> = (0..n).flat_map(|k| [k, n, n + 1]).collect();
    let weld = options(|o| (o.weld_tolerance, o.orient) = (tolerance, Orient::Keep));
    let mesh = Mesh::from_triangles(&xyz, &indices, None, &weld).unwrap();
    assert_eq!(mesh.triangle_count(), cloud.len(), "the far ones are far");
    mesh.triangles().iter().map(|t| mesh.vertices()[t.vertices[0] as usize]).collect()
}

/// What a look at each pair joins; how many pairs are exactly at the distance.
fn closure(cloud: &[Vec3], reach: f64) -> (Vec<Vec3>, usize) {
    let n = cloud.len();
    let (mut root, mut ties): (Vec<usize>, usize) = ((0..n).collect(), 0);
    for (a, b) in (0..n).flat_map(|b| (0..b).map(move |a| (a, b))) {
        let distance = length(cloud[a] - cloud[b]);
        ties += usize::from(distance == reach);
        if distance < reach && root[a] != root[b] {
            let (keep, drop) = (root[a].min(root[b]), root[a].max(root[b]));
            root.iter_mut().filter(|r| **r == drop).for_each(|r| *r = keep);
        }
    }
    (root.iter().map(|&r| cloud[r]).collect(), ties)
}

const TOLERANCE: f64 = 0.0625;

/// Far corners, whose box has the diagonal 7: the tolerance is 7/16.
const FAR: [Vec3; 2] = [Vec3::ZERO, Vec3::new(2.0, 3.0, 6.0)];
const REACH: f64 = 7.0 * TOLERANCE;
const CENTER: Vec3 = Vec3::new(1.0, 1.5, 3.0);

fn direction(random: &mut Random) -> Vec3 {
    Vec3::from_array(random.point([-1.0; 3], [1.0; 3])).normalize()
}

/// Two balls whose surfaces are `gap` tolerances apart.
fn balls(random: &mut Random, n: usize, size: f64, gap: f64) -> Vec<Vec3> {
    let away = direction(random) * (REACH * gap + 2.0 * size);
    (0..2 * n).map(|k| CENTER + direction(random) * size + away * (k % 2) as f64).collect()
}

/// Two plates `gap` tolerances apart, seldom along the axes.
fn plates(random: &mut Random, n: usize, size: f64, gap: f64) -> Vec<Vec3> {
    let away = direction(random);
    let (u, w) = away.any_orthonormal_pair();
    let at = |random: &mut Random| (u * random.unit() + w * random.unit()) * size;
    (0..2 * n).map(|k| CENTER + at(random) + away * (REACH * gap * (k % 2) as f64)).collect()
}

/// Two lattices with steps of a sixteenth of the tolerance, thinned, whose nearest layers are `gap` tolerances apart.
fn lattices(random: &mut Random, n: usize, gap: f64) -> Vec<Vec3> {
    let at = |random: &mut Random| (random.below(9) as f64 - 4.0) * REACH / 16.0;
    let away = |k: usize| Vec3::X * (REACH * (0.5 + gap) * (k % 2) as f64);
    (0..2 * n).map(|k| CENTER + Vec3::new(at(random), at(random), at(random)) + away(k)).collect()
}

#[test]
fn dense_spots_are_joined_as_a_look_at_each_pair_joins_them() {
    let mut random = Random(12);
    let (mut joined, mut apart, mut ties) = (0, 0, 0);
    for round in 0..400 {
        let random = &mut random;
        let n = 1 + random.below(150);
        let size = REACH * [0.1, 0.2, 0.4][random.below(3)];
        let cloud = match round % 4 {
            0 => balls(random, n, 0.5 * size, gap_of(round, 0.01)),
            1 => plates(random, n, size, gap_of(round, 0.001)),
            2 => lattices(random, n, if round % 8 == 2 { 1.0 } else { 0.9375 }),
            _ => (0..n).map(|_| CENTER + direction(random) * (2.0 * REACH * random.unit())).collect(),
        };
        let scale = [1e-6, 1e-3, 1.0, 1e3, 1e6][round % 5];
        let (cloud, far) = (cloud.iter().map(|p| *p * scale).collect::<Vec<_>>(), FAR.map(|p| p * scale));
        let reach = TOLERANCE * Aabb::of(cloud.iter().copied().chain(far)).diagonal();
        let (wanted, at_reach) = closure(&cloud, reach);
        assert_eq!(welded_cloud(&cloud, far, TOLERANCE), wanted, "round {round}");
        let whole = wanted.iter().all(|p| *p == wanted[0]);
        (joined, apart, ties) = (joined + usize::from(whole), apart + usize::from(!whole), ties + at_reach);
    }
    assert!(joined > 80 && apart > 80 && ties > 80, "{joined} {apart} {ties}");
}

/// About 1, by turns below and above.
fn gap_of(round: usize, by: f64) -> f64 {
    1.0 + by * ((round / 4 % 5) as f64 - 2.0)
}

#[test]
fn dense_spots_out_of_reach_of_each_other_take_no_look_at_each_pair() {
    // That would take minutes: ten thousand million pairs a time.
    let mut random = Random(13);
    let n = 100_000;
    for gap in [0.99, 1.000_001] {
        for cloud in [balls(&mut random, n, 0.1 * REACH, gap), plates(&mut random, n, 0.2 * REACH, gap)] {
            let places = welded_cloud(&cloud, FAR, TOLERANCE);
            let wanted = |k: usize| if gap < 1.0 { cloud[0] } else { cloud[k % 2] };
            assert!((0..2 * n).all(|k| places[k] == wanted(k)));
        }
    }
}
