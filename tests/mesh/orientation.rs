// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which faces are turned over.

use super::*;

fn faces_kept(mesh: &Mesh, given: &Soup) -> Vec<bool> {
    let kept = |t: &embound::mesh::Triangle| {
        let corners = given.corners(t.face as usize).map(Vec3::from_array);
        let own = t.corners(mesh.vertices());
        (0..3).any(|k| (0..3).all(|j| own[j] == corners[(j + k) % 3]))
    };
    mesh.triangles().iter().map(kept).collect()
}

#[test]
fn keep_keeps_and_flip_flips_every_face() {
    let body = bodies::icosphere(1).flipped_where(|t| t % 3 == 0);
    assert!(faces_kept(&body.mesh_kept(), &body).into_iter().all(|k| k));
    let flipped = body.mesh_with(&options(|o| o.orient = Orient::Flip));
    assert!(faces_kept(&flipped, &body).into_iter().all(|k| !k));
    let clean = bodies::icosphere(1).mesh_with(&options(|o| o.orient = Orient::Flip));
    assert!(clean.surface().volume < 0.0 && clean.report().volume > 0.0);
}

#[test]
fn an_outward_body_stays_as_given() {
    for body in [bodies::torus(2.0, 0.5, 12, 8), bodies::nested_shells(1), bodies::overlapping_spheres(1)] {
        assert!(faces_kept(&body.mesh(), &body).into_iter().all(|k| k));
    }
}

fn assert_copies_run_alike(mesh: &Mesh) {
    let rotated = |t: [u32; 3]| {
        let least = (0..3).min_by_key(|&k| t[k]).unwrap();
        [t[least], t[(least + 1) % 3], t[(least + 2) % 3]]
    };
    let mut seen = std::collections::HashMap::new();
    for t in mesh.triangles() {
        assert_eq!(*seen.entry(sorted(t.vertices)).or_insert(rotated(t.vertices)), rotated(t.vertices));
    }
}

#[test]
fn flips_and_copies_in_any_mixture_become_closed_consistent_and_outward() {
    for body in [bodies::icosphere(2), bodies::plate(2, 2, 0.2, 0.4, 2), bodies::leaning_pyramid(), bodies::bracket()] {
        for dirty in [
            body.flipped(),
            body.flipped_where(|t| t % 2 == 1),
            body.duplicated(),
            body.duplicated().flipped_where(|t| t % 2 == 1),
            body.double_sided(),
            body.duplicated().duplicated().flipped_where(|t| t % 3 == 0).unshared(),
        ] {
            let mesh = dirty.mesh();
            assert_eq!(mesh.surface().unbalanced_edges + mesh.surface().nonmanifold_edges, 0);
            assert_eq!(mesh.triangle_count(), dirty.triangles.len(), "nothing is left out");
            assert_copies_run_alike(&mesh);
            assert!(close(mesh.surface().volume, body.mesh().surface().volume));
            assert_same_inside(&mesh, &body);
        }
    }
}

#[test]
fn an_inside_out_part_is_turned_with_its_cavities() {
    let body = bodies::nested_shells(2);
    assert_same_inside(&body.flipped().mesh(), &body);
    assert!(body.flipped().mesh().report().inside_out);
}

#[test]
fn inconsistent_shells_face_outward_and_inward_in_turn() {
    let body = bodies::nested_shells(2);
    for dirty in
        [body.flipped_where(|t| t % 2 == 0), body.flipped_where(|t| t % 5 == 0), body.flipped_where(|t| t % 5 != 0)]
    {
        assert_same_inside(&dirty.mesh(), &body);
    }
    // Only the cavity is spoiled: the shells around it and in it stay as they are.
    let n = body.triangles.len() / 3;
    let spoiled = body.flipped_where(|t| (n..2 * n).contains(&t) && t % 7 != 0);
    assert_same_inside(&spoiled.mesh(), &body);
}

#[test]
fn a_shell_within_another_keeps_its_relation_to_it() {
    // Twice outward: the winding number is 2 within both, as given.
    let twice = bodies::sphere_at(2, [0.0; 3], 2.0).and(&bodies::sphere_at(1, [0.1, 0.2, 0.3], 1.0));
    assert!(faces_kept(&twice.mesh(), &twice).into_iter().all(|k| k));
    assert!(faces_kept(&twice.flipped().mesh(), &twice.flipped()).into_iter().all(|k| !k));
}

#[test]
fn separate_bodies_are_turned_one_by_one() {
    let at = |x: f64| bodies::sphere_at(1, [x, 0.0, 0.0], 0.4);
    let row = at(0.0).and(&at(1.0)).and(&at(2.0)).and(&at(3.0));
    let n = row.triangles.len() / 4;
    let dirty = row.flipped_where(|t| (n..2 * n).contains(&t) || (t >= 3 * n && t % 2 == 0));
    assert_same_inside(&dirty.mesh(), &row);
}

#[test]
fn shells_that_touch_the_one_around_them_are_still_inside() {
    // Each inner box shares part of a face, an edge or corners with the outer one, or its vertices lie on it.
    let outer = bodies::cuboid([0.0; 3], [4.0; 3]);
    let octahedron = Soup {
        vertices: vec![
            [4.0, 2.0, 2.0],
            [0.0, 2.0, 2.0],
            [2.0, 4.0, 2.0],
            [2.0, 0.0, 2.0],
            [2.0, 2.0, 4.0],
            [2.0, 2.0, 0.0],
        ],
        triangles: vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]],
    };
    for inner in [
        bodies::cuboid([1.0, 1.0, 0.0], [2.0, 2.0, 1.0]),
        bodies::cuboid([3.0, 1.0, 1.0], [4.0, 2.0, 2.0]),
        bodies::cuboid([1.0, 3.0, 1.0], [2.0, 4.0, 2.0]),
        bodies::cuboid([3.0, 3.0, 1.0], [4.0, 4.0, 2.0]),
        bodies::cuboid([2.0, 2.0, 2.0], [4.0, 4.0, 4.0]),
        octahedron,
    ] {
        let body = outer.and(&inner.flipped());
        assert_same_inside(&body.flipped().mesh(), &body);
        assert_same_inside(&body.flipped_where(|t| t >= 12 && t % 2 == 0).mesh(), &body);
    }
    // Beside it, sharing a side of the box around a body that is not convex.
    let bracket = bodies::bracket();
    let beside = bodies::cuboid([0.5, 0.2, 0.1], [1.0, 0.8, 1.5]);
    let body = bracket.and(&beside);
    let n = bracket.triangles.len();
    assert_same_inside(&body.flipped_where(|t| t >= n).mesh(), &body);
}

#[test]
fn open_sheets_become_consistent_and_keep_what_the_larger_area_had() {
    let sheet = bodies::sheet(6);
    let mesh = sheet.flipped_where(|t| t % 3 == 0).mesh();
    assert!(faces_kept(&mesh, &sheet).into_iter().all(|k| k));
    let mesh = sheet.flipped_where(|t| t % 3 != 0).mesh();
    assert!(faces_kept(&mesh, &sheet).into_iter().all(|k| !k));
    let cap = bodies::icosphere(2).flipped().without(|t| t < 30);
    assert!(faces_kept(&cap.mesh(), &cap).into_iter().all(|k| k), "open shells have no outside");
}

#[test]
fn one_sided_surfaces_stay_as_given() {
    let strip = bodies::moebius_strip(21);
    let mesh = strip.mesh();
    assert!(faces_kept(&mesh, &strip).into_iter().all(|k| k));
    assert_eq!((mesh.report().inconsistent_edges, mesh.surface().boundary_edges), (1, 42));
    assert!(mesh.surface().unbalanced_edges > 42);
}

#[test]
fn bodies_that_share_an_edge_are_turned_one_by_one() {
    let body = bodies::cubes_sharing_an_edge();
    for dirty in [body.flipped_where(|t| t < 12), body.flipped(), body.flipped_where(|t| t % 2 == 0)] {
        let mesh = dirty.mesh();
        assert_eq!(mesh.surface().unbalanced_edges, 0);
        assert_same_inside(&mesh, &body);
    }
}

#[test]
fn a_box_with_a_wall_in_it_keeps_the_balance_it_has() {
    // Two chambers outward, the wall between them once: as given the edges of the wall are not balanced.
    let chambers = bodies::cells(&[0.0, 1.0, 2.0], &[0.0, 1.0], &[0.0, 1.0], |_, _, _| true);
    let mut walled = chambers.clone();
    let at = |p: [f64; 3]| walled.vertices.iter().position(|q| *q == p).unwrap() as u32;
    let [a, b, c, d] = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0]].map(at);
    walled.triangles.extend([[a, b, c], [a, c, d]]);
    let mesh = walled.mesh();
    assert_eq!((mesh.surface().nonmanifold_edges, mesh.surface().unbalanced_edges), (4, 4));
    assert!(faces_kept(&mesh, &walled).into_iter().all(|k| k));
    assert!(faces_kept(&walled.flipped().mesh(), &walled.flipped()).into_iter().all(|k| k), "it has no one outside");
    // Without the wall it is one shell; turned over it comes out right.
    assert_same_inside(&chambers.flipped().mesh(), &chambers);
}

#[test]
fn a_grid_of_many_shells_is_settled_in_the_time_of_a_test() {
    let mut body = bodies::cuboid([-1.0; 3], [40.0; 3]);
    for k in 0..3000 {
        let p = [k % 15, k / 15 % 15, k / 225].map(|c| 2.5 * f64::from(c));
        let n = body.vertices.len() as u32;
        let shell = bodies::tetrahedron().flipped().translated(p);
        body.vertices.extend(shell.vertices);
        body.triangles.extend(shell.triangles.iter().map(|t| t.map(|v| v + n)));
    }
    let mesh = body.flipped().mesh();
    assert_eq!(mesh.report().components, 3001);
    assert!(close(mesh.surface().volume, 41f64.powi(3) - 500.0));
}
