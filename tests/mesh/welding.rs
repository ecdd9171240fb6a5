// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices that become one.

use super::*;

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
