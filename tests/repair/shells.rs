// SPDX-License-Identifier: MIT OR Apache-2.0
//! Orientation: neighbours that agree, shells that face outward and inward by turns.

use super::*;

fn orient() -> RepairOptions {
    only(|o| o.orient = true)
}

#[test]
fn flipped_faces_are_turned_back() {
    for body in clean_bodies() {
        for scale in [1e-6, 1.0, 1e6] {
            let body = body.scaled(scale);
            let clean = body.mesh_kept();
            let faulty = body.flipped_where(|t| t % 2 == 1).mesh_kept();
            let (mesh, repairs) = repaired(&faulty, &orient());
            assert!(repairs.faces_turned > 0);
            assert_clean(&mesh);
            assert_same_inside(&mesh, &body);
            let points = points::all_kinds(&body, 200, &mut Random(3));
            assert_eq!(bits(&values(&mesh, &points)).len(), bits(&values(&clean, &points)).len());
            for (a, b) in values(&mesh, &points).iter().zip(values(&clean, &points)) {
                assert!((a - b).abs() <= 1e-15 * scale * 20.0, "{a} {b}");
            }
        }
    }
}

#[test]
fn nested_shells_flipped_any_way_face_outward_and_inward_by_turns() {
    let shells = [4.0, 3.0, 2.0, 1.0].map(|r| bodies::sphere_at(1, [0.0; 3], r));
    let per_shell = shells[0].triangles.len();
    let whole = shells.iter().cloned().reduce(|all, next| all.and(&next)).unwrap_or_default();
    let wanted = whole.flipped_where(|t| (t / per_shell) % 2 == 1);
    for flips in 0..16usize {
        let given = whole.flipped_where(|t| flips >> (t / per_shell) & 1 == 1);
        let (mesh, repairs) = repaired(&given.mesh_kept(), &orient());
        let turned = (0..4).filter(|k| (flips >> k & 1 == 1) != (k % 2 == 1)).count();
        assert_eq!((repairs.faces_turned, repairs.components_turned), (turned * per_shell, turned), "{flips:b}");
        assert_clean(&mesh);
        assert_same_inside(&mesh, &wanted);
    }
}

#[test]
fn shells_beside_each_other_and_within_face_as_their_depth_says() {
    let parts = [
        bodies::sphere_at(1, [0.0; 3], 5.0),
        bodies::sphere_at(1, [-2.0, 0.0, 0.0], 1.0),
        bodies::sphere_at(1, [2.0, 0.0, 0.0], 1.5),
        bodies::sphere_at(1, [2.0, 0.0, 0.0], 0.5),
        bodies::sphere_at(1, [20.0, 0.0, 0.0], 1.0),
    ];
    let n = parts[0].triangles.len();
    let depth = [0, 1, 1, 2, 0];
    let whole = parts.iter().cloned().reduce(|all, next| all.and(&next)).unwrap_or_default();
    let wanted = whole.flipped_where(|t| depth[t / n] % 2 == 1);
    // Every third face of two of them flipped besides.
    let given = whole.flipped_where(|t| t / n < 2 && t % 3 == 0);
    let (mesh, _) = repaired(&given.mesh(), &RepairOptions::default());
    assert_clean(&mesh);
    assert_same_inside(&mesh, &wanted);
}

#[test]
fn an_inside_out_mesh_that_was_turned_when_read_is_reported_outward() {
    let body = bodies::icosphere(2);
    let mesh = body.flipped().mesh();
    assert!(mesh.report().inside_out);
    let (mesh, repairs) = repaired(&mesh, &orient());
    assert_eq!(repairs, Repairs::default());
    assert!(!mesh.report().inside_out && mesh.report().volume > 0.0);
    assert_same_bits(&mesh, &body.flipped().mesh(), &body);
}

#[test]
fn open_and_one_sided_sheets_are_left_what_they_are() {
    let sheet = bodies::sheet(4);
    let (mesh, repairs) = repaired(&sheet.flipped_where(|t| t < 5).mesh_kept(), &orient());
    assert_eq!((repairs.faces_turned, repairs.components_turned), (5, 0));
    assert_eq!(rings(&mesh).len(), 32);
    assert!(mesh.report().consistent);
    let strip = bodies::moebius_strip(12).mesh_kept();
    assert_eq!(repaired(&strip, &orient()).1, Repairs::default());
}

#[test]
fn the_two_sides_of_a_wall_are_turned_with_their_bodies() {
    let pair = bodies::cuboid([0.0; 3], [1.0; 3]).and(&bodies::cuboid([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]));
    let (mesh, repairs) = repaired(&pair.flipped().mesh_kept(), &RepairOptions::default());
    assert_eq!((repairs.duplicate_faces, repairs.faces_turned), (0, 24));
    assert_same_inside(&mesh, &pair);
}
