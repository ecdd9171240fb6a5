// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces given several times, and vertices given several times.

use super::*;

/// Not welded: every triangle has vertices of its own.
fn unwelded(soup: &Soup) -> Mesh {
    soup.unshared().mesh_with(&MeshOptions { weld_tolerance: -1.0, orient: Orient::Keep, ..MeshOptions::default() })
}

#[test]
fn copies_leave_whichever_way_they_run() {
    for body in clean_bodies() {
        for scale in [1e-6, 1.0, 1e6] {
            let body = body.scaled(scale);
            let clean = body.mesh();
            for (soup, count) in [
                (body.duplicated(), body.triangles.len()),
                (body.double_sided(), body.triangles.len()),
                (body.duplicated().double_sided(), 3 * body.triangles.len()),
            ] {
                let (mesh, repairs) = repaired(&soup.mesh_kept(), &only(|o| o.duplicates = true));
                assert_eq!(repairs, Repairs { duplicate_faces: count, ..Repairs::default() });
                assert_clean(&mesh);
                assert_same_bits(&mesh, &clean, &body);
                assert_eq!(mesh.face_count(), soup.triangles.len(), "numbers are those of the input");
            }
        }
    }
}

#[test]
fn copies_of_an_open_mesh_leave_before_its_holes_are_filled() {
    let body = bodies::icosphere(2);
    let soup = body.without(|t| t == 7).double_sided();
    let (mesh, repairs) = repaired(&soup.mesh(), &RepairOptions::default());
    assert_eq!((repairs.duplicate_faces, repairs.holes_filled, repairs.faces_added), (319, 1, 1));
    assert_clean(&mesh);
    assert_same_inside(&mesh, &body);
}

/// Boxes side by side, each with walls of its own.
fn stacked(boxes: &[[f64; 3]]) -> Soup {
    let each = |lo: &[f64; 3]| bodies::cuboid(*lo, lo.map(|c| c + 1.0));
    boxes.iter().map(each).reduce(|all, next| all.and(&next)).unwrap_or_default()
}

#[test]
fn the_wall_between_bodies_in_contact_stays() {
    for (boxes, name) in [
        (vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], "two"),
        (vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], "an angle"),
        (vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], "four"),
    ] {
        let soup = stacked(&boxes);
        let mesh = soup.mesh();
        let (same, repairs) = repaired(&mesh, &RepairOptions::default());
        assert_eq!(repairs, Repairs::default(), "{name}");
        assert_eq!(rings(&same), rings(&mesh));
    }
}

#[test]
fn the_wall_stays_where_another_body_has_a_hole_and_its_own_copies_leave() {
    let walled = stacked(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]);
    let ball = bodies::sphere_at(2, [5.0, 0.0, 0.0], 1.0);
    let soup = walled.duplicated().and(&ball.without(|t| t == 9));
    let (mesh, repairs) = repaired(&soup.mesh(), &RepairOptions::default());
    assert_eq!((repairs.duplicate_faces, repairs.holes_filled, repairs.holes_left), (24, 1, 0));
    let report = mesh.report();
    assert!(report.closed && report.volume > 2.0 && report.duplicate_faces == 2, "{report:?}");
    assert_eq!(mesh.surface().unbalanced_edges, 0);
    assert_same_inside(&mesh, &walled.and(&ball));
}

#[test]
fn copies_of_a_part_of_a_body_are_no_wall() {
    let body = bodies::icosphere(2);
    let patch = Soup { triangles: body.triangles[..40].to_vec(), ..body.clone() };
    let (mesh, repairs) = repaired(&body.and(&patch.flipped()).mesh(), &RepairOptions::default());
    assert_eq!(repairs, Repairs { duplicate_faces: 40, ..Repairs::default() });
    assert_same_bits(&mesh, &body.mesh(), &body);
}

#[test]
fn a_double_sided_sheet_becomes_one() {
    let sheet = bodies::sheet(4);
    let (mesh, repairs) = repaired(&sheet.double_sided().mesh(), &RepairOptions::default());
    assert_eq!((repairs.duplicate_faces, repairs.holes_filled, repairs.holes_left), (32, 0, 1));
    assert_eq!(mesh.triangle_count(), 32);
}

#[test]
fn equal_positions_are_welded_as_when_reading() {
    for body in clean_bodies() {
        let mesh = unwelded(&body);
        assert_eq!(mesh.report().boundary_edges, 3 * body.triangles.len());
        let (mesh, repairs) = repaired(&mesh, &only(|o| o.weld = true));
        let clean = body.mesh_kept();
        assert_eq!(repairs.vertices_welded, 3 * body.triangles.len() - clean.vertices().len());
        assert_same_bits(&mesh, &clean, &body);
    }
}

#[test]
fn near_vertices_are_welded_within_the_tolerance_and_faces_that_collapse_leave() {
    for scale in [1e-6, 1.0, 1e6] {
        let mut random = Random(5);
        let body = bodies::icosphere(2).scaled(scale);
        let noise = 1e-7 * scale;
        let soup = body.unshared().map(|p| p.map(|c| c + random.range(-noise, noise)));
        // A triangle that is smaller than the tolerance.
        let [a, b, _] = body.corners(0);
        let tiny = Soup { vertices: vec![a, [a[0] + noise, a[1], a[2]], b], triangles: vec![[0, 1, 2]] };
        let mesh = soup.and(&tiny).mesh();
        assert!(!mesh.report().closed);
        let (mesh, repairs) = repaired(&mesh, &RepairOptions { weld_tolerance: 1e-6, ..RepairOptions::default() });
        assert_eq!((repairs.faces_collapsed, mesh.vertices().len()), (1, 162));
        assert_clean(&mesh);
        assert_same_inside(&mesh, &body);
    }
}

#[test]
fn nothing_is_left_of_a_mesh_of_faces_without_area() {
    let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let mesh = Soup { vertices, triangles: vec![[0, 1, 2]] }.mesh();
    let error = mesh.repaired(&RepairOptions::default()).expect_err("nothing is left");
    assert_eq!((error.status(), error.message()), (Status::Topology, "mesh: none of 1 faces has an area"));
}
