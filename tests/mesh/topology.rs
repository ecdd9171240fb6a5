// SPDX-License-Identifier: MIT OR Apache-2.0
//! Half-edges.

use super::*;

/// What must hold of any half-edges whatsoever.
fn assert_sound(mesh: &Mesh) {
    let h = mesh.half_edges();
    let vertices = mesh.vertices().len() as u32;
    let mut seen = 0;
    for f in 0..h.face_count() as u32 {
        let ring: Vec<u32> = h.around_face(f).collect();
        assert_eq!(h.corners(f), ring.iter().map(|&e| h.origin(e)).collect::<Vec<u32>>());
        assert!(ring.len() > 2 && f == 0 || h.input_face(f) > h.input_face(f - 1));
        seen += ring.len();
        for &e in &ring {
            assert!(h.face(e) == f && h.previous(h.next(e)) == e && h.next(h.previous(e)) == e);
            assert!(h.origin(e) < vertices && h.origin(e) != h.target(e));
            if let Some(t) = h.twin(e) {
                assert!(h.twin(t) == Some(e) && t != e);
                assert_eq!((h.origin(t), h.target(t)), (h.target(e), h.origin(e)));
            }
            let fan: Vec<u32> = h.around_vertex(e).collect();
            assert!(fan.iter().all(|&g| h.origin(g) == h.origin(e)));
            assert!(fan.len() <= h.outgoing(h.origin(e)).len());
        }
    }
    assert_eq!(seen, h.count());
    let outgoing: usize = (0..vertices).map(|v| h.outgoing(v).len()).sum();
    assert_eq!(outgoing, h.count());
    for v in 0..vertices {
        assert!(!h.outgoing(v).is_empty() && h.outgoing(v).iter().all(|&e| h.origin(e) == v));
        assert!(h.outgoing(v).is_sorted());
    }
    assert!(mesh.triangles().iter().all(|t| t.vertices.iter().all(|&v| v < vertices)));
    assert!(mesh.triangles().is_sorted_by_key(|t| t.face));
}

fn twins(h: &HalfEdges) -> usize {
    (0..h.count() as u32).filter(|&e| h.twin(e).is_some()).count()
}

#[test]
fn every_half_edge_of_a_closed_body_has_a_twin() {
    for body in
        [bodies::plate(2, 1, 0.2, 0.3, 2), bodies::nested_shells(1), bodies::icosphere(2).flipped_where(|t| t % 2 == 0)]
    {
        let mesh = body.mesh();
        assert_sound(&mesh);
        assert_eq!(twins(mesh.half_edges()), mesh.half_edges().count());
    }
}

#[test]
fn vertices_are_gone_round_counter_clockwise() {
    let mesh = bodies::icosphere(2).mesh();
    let h = mesh.half_edges();
    for v in 0..mesh.vertices().len() as u32 {
        let fan: Vec<u32> = h.around_vertex(h.outgoing(v)[0]).collect();
        let mut sorted = fan.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, h.outgoing(v));
        let out = mesh.vertices()[v as usize];
        let spoke = |e: u32| mesh.vertices()[h.target(e) as usize] - out;
        assert!(fan.windows(2).all(|w| spoke(w[0]).cross(spoke(w[1])).dot(out) > 0.0));
    }
}

#[test]
fn boundary_crowded_and_inconsistent_edges_have_no_twins() {
    let mesh = bodies::sheet(3).mesh();
    assert_sound(&mesh);
    assert_eq!(mesh.half_edges().count() - twins(mesh.half_edges()), 12);
    let mesh = bodies::cubes_sharing_an_edge().mesh();
    assert_sound(&mesh);
    assert_eq!(mesh.half_edges().count() - twins(mesh.half_edges()), 4);
    let mesh = bodies::icosphere(1).flipped_where(|t| t == 9).mesh_kept();
    assert_sound(&mesh);
    assert_eq!(mesh.half_edges().count() - twins(mesh.half_edges()), 6);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_triangles_over_a_few_points_give_a_sound_mesh_or_an_error(
        indices in proptest::collection::vec(0u32..9, 1..60),
        which in 0usize..3,
        tolerance in prop_oneof![Just(0.0), 0.01..0.5f64],
    ) {
        // Seven points of a lattice, two of them twice, so planes, lines and positions coincide.
        let xyz: Vec<f64> = (0..9u32).flat_map(|k| [(k % 7) & 1, ((k % 7) >> 1) & 1, (k % 7) >> 2]).map(f64::from).collect();
        let n = indices.len() / 3 * 3;
        let o = options(|o| (o.orient, o.weld_tolerance) = (ORIENTATIONS[which], tolerance));
        match Mesh::from_triangles(&xyz, &indices[..n], None, &o) {
            Ok(mesh) => {
                assert_sound(&mesh);
                mesh.pseudonormals().unwrap();
                let all = mesh.report();
                prop_assert!(mesh.triangle_count() <= all.triangles);
                prop_assert_eq!(all.closed, all.boundary_edges == 0);
            }
            Err(e) => prop_assert_eq!(e.status(), Status::InvalidArgument),
        }
    }

    #[test]
    fn any_polygons_over_a_few_points_give_a_sound_mesh_or_an_error(
        faces in proptest::collection::vec(proptest::collection::vec(0u32..12, 3..8), 1..8),
        which in 0usize..3,
    ) {
        let xyz: Vec<f64> = (0..12u32).flat_map(|k| [k % 4, k / 4, u32::from(k == 5)]).map(f64::from).collect();
        let offsets: Vec<usize> =
            std::iter::once(0).chain(faces.iter().scan(0, |n, f| { *n += f.len(); Some(*n) })).collect();
        let o = options(|o| o.orient = ORIENTATIONS[which]);
        match Mesh::from_polygons(&xyz, &offsets, &faces.concat(), None, &o) {
            Ok(mesh) => {
                assert_sound(&mesh);
                mesh.pseudonormals().unwrap();
            }
            Err(e) => prop_assert_eq!(e.status(), Status::InvalidArgument),
        }
    }
}
