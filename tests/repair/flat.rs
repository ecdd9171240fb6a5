// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces of zero area inside clean meshes.

use super::*;

/// Dyadic coordinates, so that points on edges are exactly there.
fn body(scale: i32) -> Soup {
    bodies::quartered(&bodies::unit_cube()).scaled(libm::ldexp(1.0, scale))
}

fn between(soup: &mut Soup, a: u32, c: u32, eighths: u32) -> u32 {
    let (p, q) = (soup.vertices[a as usize], soup.vertices[c as usize]);
    soup.vertices.push(std::array::from_fn(|k| p[k] + (q[k] - p[k]) * f64::from(eighths) / 8.0));
    soup.vertices.len() as u32 - 1
}

/// Cuts the edge from `c` to `a` of the face that runs so at the given points, in order from `c`.
fn cut_edge(soup: &mut Soup, c: u32, a: u32, points: &[u32]) {
    let runs = |t: &[u32; 3]| (0..3).find(|&k| t[k] == c && t[(k + 1) % 3] == a);
    let (f, k) = soup.triangles.iter().enumerate().find_map(|(f, t)| Some((f, runs(t)?))).expect("an edge");
    let apex = soup.triangles[f][(k + 2) % 3];
    let chain: Vec<u32> = [c].iter().chain(points).chain(&[a]).copied().collect();
    soup.triangles[f] = [chain[0], chain[1], apex];
    soup.triangles.extend(chain.windows(2).skip(1).map(|w| [w[0], w[1], apex]));
}

/// The clean body with flat faces in it: one, a fan of seven, and two back to back.
fn cases(scale: i32) -> Vec<(&'static str, Soup, usize, usize)> {
    let mut one = body(scale);
    let [a, c, _] = one.triangles[5];
    let m = between(&mut one, a, c, 3);
    cut_edge(&mut one, c, a, &[m]);
    one.triangles.push([c, a, m]);

    let mut fan = body(scale);
    let points: Vec<u32> = (1..8).map(|k| between(&mut fan, a, c, k)).collect();
    let from_c: Vec<u32> = points.iter().rev().copied().collect();
    cut_edge(&mut fan, c, a, &from_c);
    let chain: Vec<u32> = [a].iter().chain(&points).copied().collect();
    fan.triangles.extend(chain.windows(2).map(|w| [c, w[0], w[1]]));

    let mut pair = body(scale);
    let (m, n) = (between(&mut pair, a, c, 2), between(&mut pair, a, c, 5));
    cut_edge(&mut pair, c, a, &[m]);
    cut_edge(&mut pair, a, c, &[n]);
    // The flat faces have the edge between a and c.
    pair.triangles.extend([[c, a, m], [a, c, n]]);
    vec![("one", one, 1, 1), ("a fan", fan, 7, 7), ("two back to back", pair, 2, 2)]
}

#[test]
fn flat_faces_leave_without_a_crack() {
    for scale in [-20, 0, 20] {
        let clean = body(scale);
        for (name, soup, flat, corners) in cases(scale) {
            let faulty = soup.mesh();
            assert!(
                faulty.report().closed && faulty.report().degenerate_faces == flat,
                "{name}: {:?}",
                faulty.report()
            );
            let (mesh, repairs) = repaired(&faulty, &only(|o| o.degenerate = true));
            assert_eq!(
                repairs,
                Repairs { degenerate_faces: flat, corners_added: corners, ..Repairs::default() },
                "{name}"
            );
            assert_clean(&mesh);
            assert_same_inside(&mesh, &clean);
            let size = libm::ldexp(1.0, scale);
            assert!((mesh.report().volume - size * size * size).abs() < 1e-15 * size * size * size);
            let points = points::all_kinds(&clean, 300, &mut Random(5));
            for (a, b) in values(&mesh, &points).iter().zip(values(&clean.mesh(), &points)) {
                assert!((a - b).abs() <= 4e-16 * size, "{name}: {a} {b}");
            }
        }
    }
}

#[test]
fn flat_faces_leave_whichever_way_they_run() {
    for (name, soup, flat, _) in cases(0) {
        let first = soup.triangles.len() - flat;
        let (mesh, repairs) = repaired(&soup.flipped_where(|t| t >= first).mesh_kept(), &only(|o| o.degenerate = true));
        assert_eq!(repairs.degenerate_faces, flat, "{name}");
        assert_clean(&mesh);
    }
}

#[test]
fn every_edge_of_a_body_may_have_a_flat_face() {
    let clean = body(0);
    let mut soup = clean.clone();
    let mut edges: Vec<(u32, u32)> =
        clean.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).filter(|(a, b)| a < b).collect();
    edges.sort_unstable();
    for &(a, c) in &edges {
        let m = between(&mut soup, a, c, 3);
        cut_edge(&mut soup, c, a, &[m]);
        soup.triangles.push([c, a, m]);
    }
    let (mesh, repairs) = repaired(&soup.mesh(), &only(|o| o.degenerate = true));
    assert_eq!((repairs.degenerate_faces, repairs.corners_added), (edges.len(), edges.len()));
    assert_clean(&mesh);
    assert_same_inside(&mesh, &clean);
    assert!((mesh.report().area - 6.0).abs() < 1e-14);
}

#[test]
fn a_flat_face_at_a_border_leaves_and_the_border_stays() {
    let mut soup = bodies::sheet(2);
    // The border edge from 0 to 1 gets a flat face outside.
    let m = between(&mut soup, 0, 1, 4);
    soup.triangles.push([1, 0, m]);
    let (mesh, repairs) = repaired(&soup.mesh_kept(), &only(|o| o.degenerate = true));
    assert_eq!((repairs.degenerate_faces, repairs.corners_added), (1, 1));
    // The face behind it got the corner that the outer edges had.
    assert_eq!((mesh.report().boundary_edges, mesh.report().area), (9, 4.0));
    let fan = Soup { vertices: soup.vertices.clone(), triangles: soup.triangles.clone() };
    let mut far = fan.clone();
    // A flat face with the long edge outside: its short ones are cut nowhere.
    far.triangles.truncate(8);
    cut_edge(&mut far, 0, 1, &[m]);
    far.triangles.push([1, m, 0]);
    let (mesh, repairs) = repaired(&far.mesh_kept(), &only(|o| o.degenerate = true));
    assert_eq!((repairs.degenerate_faces, repairs.corners_added), (1, 0));
    assert_eq!((mesh.report().boundary_edges, mesh.report().area), (9, 4.0));
}

#[test]
fn flat_polygons_leave_too() {
    // A cube of quads, one edge of which carries a flat quad of four points on a line.
    let mut xyz = Vec::new();
    for k in 0..8u32 {
        xyz.extend([f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)]);
    }
    xyz.extend([0.25, 0.0, 0.0, 0.75, 0.0, 0.0]);
    let faces: [&[u32]; 7] =
        [&[0, 2, 3, 1], &[4, 5, 7, 6], &[0, 8, 9, 1, 5, 4], &[2, 6, 7, 3], &[0, 4, 6, 2], &[1, 3, 7, 5], &[0, 1, 9, 8]];
    let mut offsets = vec![0];
    faces.iter().for_each(|f| offsets.push(offsets[offsets.len() - 1] + f.len()));
    let mesh = Mesh::from_polygons(&xyz, &offsets, &faces.concat(), None, &MeshOptions::default()).unwrap();
    assert!(mesh.report().closed && mesh.report().degenerate_faces == 1);
    let (mesh, repairs) = repaired(&mesh, &RepairOptions::default());
    assert_eq!(repairs, Repairs { degenerate_faces: 1, corners_added: 2, ..Repairs::default() });
    assert_clean(&mesh);
    assert_eq!((mesh.report().volume, mesh.report().area), (1.0, 6.0));
}
