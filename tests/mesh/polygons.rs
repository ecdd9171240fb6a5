// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces of more than three corners.

use super::*;
use embound::primitive::inside::{Inside, contains};

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
fn faces_that_are_not_plane_or_cross_themselves_are_counted_and_cut() {
    let ok = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0];
    let quad = |xyz: &[f64], ring: [u32; 4]| {
        let indices = [[0u32, 1, 2].as_slice(), &ring].concat();
        let mesh = Mesh::from_polygons(xyz, &[0, 3, 7], &indices, None, &options(|o| o.orient = Orient::Keep)).unwrap();
        let cut: Vec<[u32; 3]> = mesh.triangles()[1..].iter().map(|t| t.vertices).collect();
        (mesh.report().warped_faces, cut)
    };
    assert_eq!(quad(&ok, [0, 1, 2, 3]), (0, vec![[0, 1, 2], [0, 2, 3]]));
    let mut bent = ok;
    bent[8] = 0.01;
    assert_eq!(quad(&bent, [0, 1, 2, 3]), (1, vec![[0, 1, 2], [0, 2, 3]]), "from the first corner");
    assert_eq!(quad(&bent, [1, 2, 3, 0]), (1, vec![[1, 2, 3], [1, 3, 0]]));
    bent[8] = 1e-6;
    assert_eq!(quad(&bent, [0, 1, 2, 3]).0, 0);
    // A dart is cut at its inner corner, whichever is first.
    let dart = [0.0, 0.0, 0.0, 2.0, 1.0, 0.3, 0.0, 2.0, 0.0, 0.5, 1.0, 0.0];
    for first in 0..4 {
        let ring = [0, 1, 2, 3].map(|k| (k + first) % 4);
        let (warped, cut) = quad(&dart, ring);
        assert!(warped == 1 && cut.iter().all(|t| t.contains(&3) && t.contains(&1)), "{cut:?}");
    }
    // Bow ties keep their four sides.
    let mut skew = ok;
    (skew[0], skew[10]) = (-1.0, 3.0);
    for xyz in [ok, skew] {
        let (warped, cut) = quad(&xyz, [0, 2, 1, 3]);
        assert_eq!((warped, cut.len()), (1, 2));
        for side in [[0, 2], [2, 1], [1, 3], [3, 0]] {
            let has = |t: &&[u32; 3]| (0..3).any(|k| [t[k], t[(k + 1) % 3]] == side);
            assert_eq!(cut.iter().filter(has).count(), 1, "{side:?} of {cut:?}");
        }
    }
}

#[test]
fn a_closed_mesh_of_warped_faces_is_closed_in_triangles() {
    // A ball of quads, none of which is plane, and its twelve sided ends.
    let (rings, around) = (6, 12);
    let mut xyz = Vec::new();
    for i in 0..rings {
        for j in 0..around {
            let (a, b) =
                (0.4 + 2.2 * i as f64 / (rings - 1) as f64, (j as f64 + 0.3 * i as f64) * std::f64::consts::TAU / 12.0);
            let r = 1.0 + 0.05 * ((i * 7 + j * 5) % 4) as f64;
            xyz.extend([r * libm::sin(a) * libm::cos(b), r * libm::sin(a) * libm::sin(b), r * libm::cos(a)]);
        }
    }
    let at = |i: u32, j: u32| i * 12 + j % 12;
    let mut faces: Vec<Vec<u32>> = vec![(0..12).collect(), (0..12).rev().map(|j| at(5, j)).collect()];
    for i in 0..5 {
        faces.extend((0..12).map(|j| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    }
    let offsets: Vec<usize> = std::iter::once(0)
        .chain(faces.iter().scan(0, |n, f| {
            *n += f.len();
            Some(*n)
        }))
        .collect();
    let mesh = Mesh::from_polygons(&xyz, &offsets, &faces.concat(), None, &MeshOptions::default()).unwrap();
    assert!(mesh.report().closed && mesh.report().consistent && mesh.report().warped_faces > 40, "{:?}", mesh.report());
    let triangles = soup_of(&mesh).mesh();
    assert!(triangles.report().closed && triangles.report().consistent);
    assert_eq!(triangles.report().volume, mesh.report().volume);
    assert_same_values(&mesh, &triangles);
}

fn assert_same_values(a: &Mesh, b: &Mesh) {
    use embound::geometry::{Geometry, SdfOptions};
    let of = |m: &Mesh| Geometry::from_mesh(m, &SdfOptions::default(), &embound::parallel::Run::default()).unwrap();
    let (g, h) = (of(a), of(b));
    let mut random = Random(2);
    for _ in 0..500 {
        let p = Vec3::from_array(random.point([-2.0; 3], [2.0; 3]));
        assert_eq!(g.value(p).to_bits(), h.value(p).to_bits(), "{p}");
    }
}

#[test]
fn a_dodecahedron_of_pentagons_has_the_values_of_its_triangles() {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let mut corners: Vec<Vec3> =
        (0..8).map(|k| Vec3::from_array([1, 2, 4].map(|b| if k & b == 0 { -1.0 } else { 1.0 }))).collect();
    for (s, t) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
        corners.extend([Vec3::new(0.0, s / g, t * g), Vec3::new(s / g, t * g, 0.0), Vec3::new(t * g, 0.0, s / g)]);
    }
    // The five corners farthest out along each of the twelve face normals, sorted round it.
    let mut faces: Vec<u32> = Vec::new();
    for (s, t) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
        for n in [Vec3::new(0.0, s * g, t), Vec3::new(s * g, t, 0.0), Vec3::new(t, 0.0, s * g)] {
            let mut ring: Vec<u32> = (0..20).collect();
            ring.sort_by(|a, b| corners[*b as usize].dot(n).total_cmp(&corners[*a as usize].dot(n)));
            ring.truncate(5);
            let (u, v) = (n.any_orthonormal_vector(), n.normalize().cross(n.any_orthonormal_vector()));
            let angle = |k: &u32| libm::atan2(corners[*k as usize].dot(v), corners[*k as usize].dot(u));
            ring.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
            faces.extend(ring);
        }
    }
    let xyz: Vec<f64> = corners.iter().flat_map(|c| c.to_array()).collect();
    let offsets: Vec<usize> = (0..=12).map(|k| 5 * k).collect();
    let mesh = Mesh::from_polygons(&xyz, &offsets, &faces, None, &MeshOptions::default()).unwrap();
    let r = mesh.report();
    assert_eq!((r.faces, r.triangles, r.vertices, r.closed, r.warped_faces), (12, 36, 20, true, 0));
    // The volume of a dodecahedron of edge 2 / g.
    let edge = 2.0 / g;
    assert!(close(r.volume, (15.0 + 7.0 * 5f64.sqrt()) / 4.0 * edge * edge * edge), "{}", r.volume);
    assert_same_values(&mesh, &soup_of(&mesh).mesh());
    for f in 0..12 {
        let centre = mesh.measure(embound::mesh::Element::Face(f)).centroid;
        for how in [Inside::Crossing, Inside::Winding, Inside::Angle] {
            assert!(
                mesh.face_contains(f, centre * 1.1, how)
                    && !mesh.face_contains(f, centre * 1.1 + 5.0 * centre.any_orthonormal_vector(), how)
            );
        }
    }
}

/// The three ways agree off the boundary where a polygon covers nothing twice, and with the brute sum over triangles.
#[test]
fn points_in_polygons_are_told_three_ways() {
    let ways = [Inside::Crossing, Inside::Winding, Inside::Angle];
    let told = |polygon: &[[f64; 2]], p: [f64; 2]| ways.map(|how| contains(polygon.iter().copied(), p, how));
    let mut random = Random(31);
    for flip in [false, true] {
        let mut l = L_SHAPE.to_vec();
        if flip {
            l.reverse();
        }
        for _ in 0..2000 {
            let [x, y, _] = random.point([-1.0; 3], [4.0; 3]);
            let wanted = x > 0.0 && y > 0.0 && ((x < 3.0 && y < 1.0) || (x < 1.0 && y < 3.0));
            assert_eq!(told(&l, [x, y]), [wanted; 3], "{x} {y}");
        }
    }
    // A pentagram: its middle is wound around twice.
    let star: Vec<[f64; 2]> =
        (0..5).map(|k| k as f64 * 0.8 * std::f64::consts::PI).map(|a| [libm::cos(a), libm::sin(a)]).collect();
    assert_eq!(told(&star, [0.01, 0.02]), [false, true, true]);
    assert_eq!(told(&star, [0.7, 0.01]), [true; 3]);
    assert_eq!(told(&star, [-0.9, 0.3]), [false; 3]);
    assert_eq!(told(&star[..2], [0.0, 0.0]), [false; 3]);
    // Of squares that tile the plane each point, on whatever side or corner, lies in exactly one.
    for how in [Inside::Crossing, Inside::Winding] {
        for p in [[1.0, 0.5], [0.5, 1.0], [1.0, 1.0], [0.0, 0.0], [0.3, 0.3]] {
            let square =
                |i: i32, j: i32| [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[x, y]| [f64::from(x + i), f64::from(y + j)]);
            let holding = (-1..3)
                .flat_map(|i| (-1..3).map(move |j| square(i, j)))
                .filter(|s| contains(s.iter().copied(), p, how));
            assert_eq!(holding.count(), 1, "{p:?}");
        }
    }
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

/// A band wound a hundred times, a comb, and a corner of straight sides: the triangles keep the sides, run as they do
/// and have the area of the face. A look at every corner for each ear would take minutes here.
#[test]
fn faces_of_many_corners_are_cut_into_triangles_of_their_area() {
    const N: usize = 20_000;
    let part = |k: usize| k as f64 / N as f64;
    let wound = |k: usize, r: f64| {
        let a = 100.0 * part(k) * std::f64::consts::TAU;
        let r = 100.0 * part(k) + r;
        [r * libm::cos(a), r * libm::sin(a)]
    };
    let spiral: Vec<[f64; 2]> = (0..N).map(|k| wound(k, 1.0)).chain((0..N).rev().map(|k| wound(k, 0.5))).collect();
    let teeth = (0..N).rev().flat_map(|k| [[k as f64 + 1.0, 5.0], [k as f64 + 0.5, 1.0]]);
    let comb = [[0.0, 0.0], [N as f64, 0.0]].into_iter().chain(teeth).chain([[0.0, 5.0]]).collect();
    let between = |p: [f64; 2], q: [f64; 2], k: usize| [0, 1].map(|c| p[c] * (N - k) as f64 + q[c] * k as f64);
    let sides = (0..6).flat_map(|s| (0..N).map(move |k| between(L_SHAPE[s], L_SHAPE[(s + 1) % 6], k))).collect();
    for outline in [spiral, comb, sides] {
        let n = outline.len();
        let xyz: Vec<f64> = outline.iter().flat_map(|p| [p[0], p[1], 2.0 * p[0]]).collect();
        let ring: Vec<u32> = (0..n as u32).collect();
        let keep = options(|o| o.orient = Orient::Keep);
        let mesh = Mesh::from_polygons(&xyz, &[0, n], &ring, None, &keep).unwrap();
        let at = |v: u32| outline[v as usize];
        let twice =
            |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        let wanted: f64 = (1..n - 1).map(|k| twice(outline[0], outline[k], outline[k + 1])).sum();
        let areas = mesh.triangles().iter().map(|t| twice(at(t.vertices[0]), at(t.vertices[1]), at(t.vertices[2])));
        assert!(areas.clone().all(|a| a > 0.0));
        assert!((areas.sum::<f64>() / wanted - 1.0).abs() < 1e-9);
        let sides = mesh.triangles().iter().flat_map(|t| (0..3).map(|k| (t.vertices[k], t.vertices[(k + 1) % 3])));
        assert_eq!(sides.filter(|(a, b)| (a + 1) % n as u32 == *b).count(), n);
        assert_eq!((mesh.triangle_count(), mesh.report().warped_faces), (n - 2, 0));
    }
}
