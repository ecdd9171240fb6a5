// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces of more than three corners.

use super::*;

/// A prism over a polygon of the xy plane: caps with all corners, sides of four.
pub(super) fn prism(outline: &[[f64; 2]], height: f64) -> (Vec<f64>, Vec<usize>, Vec<u32>) {
    let n = outline.len();
    let level = |z: f64| outline.iter().flat_map(move |p| [p[0], p[1], z]);
    let xyz = level(0.0).chain(level(height)).collect();
    let mut indices: Vec<u32> = (0..n as u32).rev().chain(n as u32..2 * n as u32).collect();
    let mut offsets = vec![0, n, 2 * n];
    for k in 0..n {
        let (a, b) = (k as u32, ((k + 1) % n) as u32);
        indices.extend([a, b, b + n as u32, a + n as u32]);
        offsets.push(indices.len());
    }
    (xyz, offsets, indices)
}

pub(super) const L_SHAPE: [[f64; 2]; 6] = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];

fn polygons((xyz, offsets, indices): &(Vec<f64>, Vec<usize>, Vec<u32>)) -> embound::Result<Mesh> {
    Mesh::from_polygons(xyz, offsets, indices, None, &MeshOptions::default())
}

#[test]
fn a_prism_keeps_its_faces_and_is_cut_into_triangles() {
    let mesh = polygons(&prism(&L_SHAPE, 2.0)).unwrap();
    let r = mesh.report();
    assert!(r.closed && r.consistent && r.degenerate_faces == 0);
    assert_eq!((r.faces, r.triangles, r.components, r.vertices), (8, 20, 1, 12));
    assert!(close(r.volume, 10.0) && close(r.area, 34.0));
    let h = mesh.half_edges();
    assert_eq!((h.face_count(), h.count()), (8, 36));
    assert_eq!(h.corners(0).len(), 6);
    assert!((0..36).all(|e| h.twin(e).is_some()));
    let of_caps = mesh.triangles().iter().filter(|t| t.face < 2).count();
    assert_eq!(of_caps, 8);
    assert_eq!(mesh.surface().unbalanced_edges, 0);
}

#[test]
fn flipped_and_repeated_polygons_are_oriented() {
    let (xyz, offsets, mut indices) = prism(&L_SHAPE, 2.0);
    let clean = soup_of(&polygons(&(xyz.clone(), offsets.clone(), indices.clone())).unwrap());
    for f in [1, 4, 6] {
        indices[offsets[f]..offsets[f + 1]].reverse();
    }
    // The lower cap again, from another corner.
    let mut cap = indices[..6].to_vec();
    cap.rotate_left(2);
    let mut longer = offsets.clone();
    longer.push(indices.len() + 6);
    indices.extend(cap);
    let mesh = polygons(&(xyz, longer, indices)).unwrap();
    assert_eq!((mesh.report().duplicate_faces, mesh.half_edges().face_count()), (1, 9));
    assert_eq!(mesh.surface().unbalanced_edges, 0);
    assert_same_inside(&mesh, &clean);
}

#[test]
fn polygons_of_the_same_corners_in_another_order_are_not_copies() {
    // A square with its centre: three different rings of the same five points.
    let xyz = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 2.0, 0.0, 0.0, 2.0, 0.0, 1.0, 1.0, 0.0];
    let rings = [[0u32, 1, 2, 3, 4], [0, 4, 1, 2, 3], [2, 1, 0, 4, 3]];
    let mesh = Mesh::from_polygons(&xyz, &[0, 5, 10, 15], &rings.concat(), None, &MeshOptions::default()).unwrap();
    assert_eq!(mesh.report().duplicate_faces, 1);
    assert_eq!(mesh.half_edges().face_count(), 3, "a mesh keeps its copies");
}

#[test]
fn a_hole_bridged_to_the_rim_stays_a_hole() {
    let outline = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [0.0, 3.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
    ];
    let mut xyz: Vec<f64> = outline.iter().flat_map(|p| [p[0], p[1], 0.0]).collect();
    xyz.extend(outline.iter().flat_map(|p| [p[0], p[1], 1.0]));
    let mut indices: Vec<u32> = (0..10).rev().chain(10..20).collect();
    let mut offsets = vec![0, 10, 20];
    for (a, b) in [(0, 1), (1, 2), (2, 3), (3, 0), (5, 6), (6, 7), (7, 8), (8, 5)] {
        indices.extend([a, b, b + 10, a + 10]);
        offsets.push(indices.len());
    }
    let mesh = polygons(&(xyz, offsets, indices)).unwrap();
    let r = mesh.report();
    assert!(r.closed && r.consistent, "{r:?}");
    assert_eq!((r.vertices, r.nonmanifold_edges, r.degenerate_faces), (16, 0, 0));
    assert!(close(r.volume, 8.0) && close(r.area, 16.0 + 12.0 + 4.0));
}

#[test]
fn polygons_in_any_plane_and_at_any_scale_are_cut_alike() {
    let star: Vec<[f64; 2]> = (0..40)
        .map(|k| {
            let (r, a) = (if k % 2 == 0 { 2.0 } else { 0.7 }, f64::from(k) * std::f64::consts::TAU / 40.0);
            [r * libm::cos(a), r * libm::sin(a)]
        })
        .collect();
    let input = prism(&star, 0.5);
    let wanted = polygons(&input).unwrap().report().volume;
    let (c, s) = (0.8, 0.6);
    let tilt = [c, -s, 0.0, s * s, c * s, -c, s * c, c * c, s];
    for scale in [1e-6, 1.0, 1e6] {
        let o = options(|o| (o.rotation, o.scale, o.shift) = (tilt, scale, [7.0 * scale, -3.0 * scale, scale]));
        let mesh = Mesh::from_polygons(&input.0, &input.1, &input.2, None, &o).unwrap();
        let volume = mesh.report().volume / (scale * scale * scale);
        assert!((volume / wanted - 1.0).abs() < 1e-12, "{volume} instead of {wanted}");
        assert_eq!(mesh.surface().unbalanced_edges, 0);
        // Rounding to f32 leaves faces plane enough.
        let coarse: Vec<f64> = mesh.vertices().iter().flat_map(|p| p.to_array()).map(|c| f64::from(c as f32)).collect();
        let h = mesh.half_edges();
        let indices: Vec<u32> = (0..h.face_count() as u32).flat_map(|f| h.corners(f).to_vec()).collect();
        polygons(&(coarse, input.1.clone(), indices)).unwrap();
    }
}

#[test]
fn faces_that_are_not_plane_or_cross_themselves_are_named() {
    let ok = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0];
    let quad = |xyz: &[f64], ring: [u32; 4]| {
        let indices = [[0u32, 1, 2].as_slice(), &ring].concat();
        Mesh::from_polygons(xyz, &[0, 3, 7], &indices, None, &MeshOptions::default())
    };
    assert_eq!(quad(&ok, [0, 1, 2, 3]).unwrap().triangle_count(), 3);
    let mut bent = ok;
    bent[8] = 0.01;
    assert!(refused(quad(&bent, [0, 1, 2, 3])).starts_with("face 1: its corners are 2.4"));
    bent[8] = 1e-6;
    assert_eq!(quad(&bent, [0, 1, 2, 3]).unwrap().triangle_count(), 3);
    assert!(refused(quad(&ok, [0, 2, 1, 3])).contains("face 1: its 4 corners enclose no area"));
    let mut skew = ok;
    (skew[0], skew[10]) = (-1.0, 3.0);
    assert_eq!(refused(quad(&skew, [0, 2, 1, 3])), "face 1: its 4 corners cross themselves");
}

#[test]
fn corners_that_welding_joins_leave_their_face() {
    // A quadrilateral with a side of length zero, and one that is a spike.
    let xyz = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 5.0, 5.0, 5.0];
    let mesh = Mesh::from_polygons(&xyz, &[0, 4, 8], &[0, 1, 2, 3, 0, 1, 4, 2], None, &MeshOptions::default()).unwrap();
    let r = mesh.report();
    assert_eq!((r.faces, r.triangles, r.degenerate_faces, r.vertices), (2, 4, 2, 4));
    assert_eq!((mesh.triangle_count(), mesh.vertices().len()), (1, 3));
    assert_eq!(r.boundary_edges, 3);
    assert_eq!(r.hi, [5.0; 3], "as read");
}

#[test]
fn points_on_a_straight_side_are_kept_and_flat_polygons_stay() {
    let xyz = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 3.0, 0.0];
    let rings = [&[0u32, 1, 2, 3, 4][..], &[3, 2, 1, 0]];
    let mesh = Mesh::from_polygons(&xyz, &[0, 5, 9], &rings.concat(), None, &MeshOptions::default()).unwrap();
    let r = mesh.report();
    assert_eq!((r.degenerate_faces, r.boundary_edges, mesh.triangle_count()), (1, 3, 5));
    assert!(close(r.area, 4.5));
}
