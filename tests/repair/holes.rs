// SPDX-License-Identifier: MIT OR Apache-2.0
//! Holes: which are filled, by what, and which stay.

use super::*;

fn holes() -> RepairOptions {
    only(|o| o.holes = true)
}

/// The triangles of a ball whose middles lie within `reach` of a direction.
fn near(ball: &Soup, direction: [f64; 3], reach: f64) -> Vec<usize> {
    let middle = |t: usize| -> [f64; 3] {
        let c = ball.corners(t);
        std::array::from_fn(|k| (c[0][k] + c[1][k] + c[2][k]) / 3.0)
    };
    let far = |p: [f64; 3]| (0..3).map(|k| (p[k] - direction[k]).powi(2)).sum::<f64>().sqrt();
    (0..ball.triangles.len()).filter(|&t| far(middle(t)) < reach).collect()
}

#[test]
fn one_missing_triangle_is_put_back() {
    for scale in [1e-6, 1.0, 1e6] {
        let body = bodies::icosphere(2).scaled(scale);
        for gone in [0, 7, 319] {
            let (mesh, repairs) = repaired(&body.without(|t| t == gone).mesh(), &holes());
            assert_eq!(repairs, Repairs { holes_filled: 1, faces_added: 1, ..Repairs::default() });
            assert_clean(&mesh);
            assert_eq!(mesh.half_edges().input_face(319), 319, "numbered after the faces there were");
            let points = points::all_kinds(&body, 300, &mut Random(3));
            let (found, wanted) = (values(&mesh, &points), values(&body.mesh(), &points));
            for (a, b) in found.iter().zip(&wanted) {
                // The corners of the new triangle may stand in another order.
                assert!((a - b).abs() <= 1e-15 * scale, "{a} {b}");
            }
        }
    }
}

#[test]
fn several_holes_of_many_edges_are_filled_flat() {
    let ball = bodies::icosphere(3);
    let directions = [[0.0, 0.0, 1.0], [0.6, 0.0, -0.8], [-0.8, 0.6, 0.0], [0.0, -1.0, 0.0], [0.8, 0.6, 0.0]];
    let reaches = [0.2, 0.18, 0.15, 0.13, 0.1];
    let gone: Vec<usize> = directions.iter().zip(reaches).flat_map(|(d, r)| near(&ball, *d, r)).collect();
    let soup = ball.without(|t| gone.contains(&t));
    let faulty = soup.mesh();
    assert!(faulty.report().boundary_edges > 40);
    let (mesh, repairs) = repaired(&faulty, &RepairOptions { hole_length: 0.8, ..holes() });
    assert_eq!((repairs.holes_filled, repairs.holes_left), (5, 0));
    assert_eq!(repairs.faces_added + 2 * 5, faulty.report().boundary_edges);
    assert_clean(&mesh);
    // Caps of the ball of the least area: lenses are gone, and the area is less than what was cut away.
    let clean = ball.mesh();
    assert!(mesh.report().volume < clean.report().volume && mesh.report().volume > 0.98 * clean.report().volume);
    assert!(mesh.report().area < clean.report().area);
    let soup = soup_of(&mesh);
    let mut random = Random(8);
    let g = Geometry::from_mesh(&mesh, &SdfOptions::default(), &Run::SERIAL).unwrap();
    for p in points::all_kinds(&soup, 400, &mut random) {
        let (value, winding) = (g.value(Vec3::from_array(p)), winding_number(&soup, p));
        assert!(value.abs() < 1e-12 || (value < 0.0) == (winding > 0.5), "{value} {winding}");
    }
}

#[test]
fn the_open_end_of_a_pipe_and_a_box_without_lid_stay() {
    let pipe = {
        let all = bodies::torus(1.0, 0.3, 24, 12);
        let half = |t: usize| t >= all.triangles.len() / 2;
        all.without(half)
    };
    // Half a torus: its two ends have rims of 0.7 of the diagonal.
    let (mesh, repairs) = repaired(&pipe.mesh(), &RepairOptions::default());
    assert_eq!(repairs, Repairs { holes_left: 2, ..Repairs::default() });
    assert_eq!(mesh.report(), pipe.mesh().report());
    let lid = bodies::unit_cube().without(|t| t < 2);
    assert_eq!(repaired(&lid.mesh(), &holes()).1, Repairs { holes_left: 1, ..Repairs::default() });
    // Asked for, they are closed.
    for open in [pipe, lid] {
        let (mesh, repairs) = repaired(&open.mesh(), &RepairOptions { hole_length: f64::INFINITY, ..holes() });
        assert_eq!(repairs.holes_left, 0);
        assert_clean(&mesh);
    }
}

#[test]
fn sheets_stay_open_however_small_they_are_beside_others() {
    let ball = bodies::icosphere(3).scaled(1e3);
    let soup = ball
        .and(&bodies::sheet(2))
        .and(&Soup { vertices: vec![[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]], triangles: vec![[0, 1, 2]] });
    let (mesh, repairs) = repaired(&soup.mesh(), &RepairOptions::default());
    assert_eq!(repairs, Repairs { holes_left: 2, ..Repairs::default() });
    assert_eq!(mesh.triangle_count(), soup.triangles.len());
}

#[test]
fn the_number_of_edges_and_the_length_of_a_rim_are_limits() {
    let ball = bodies::icosphere(3);
    let gone = near(&ball, [0.0, 0.0, 1.0], 0.2);
    let mesh = ball.without(|t| gone.contains(&t)).mesh();
    let edges = mesh.report().boundary_edges;
    for (options, filled) in [
        (RepairOptions { hole_length: 0.6, ..holes() }, 1),
        (RepairOptions { hole_length: 0.6, hole_edges: edges, ..holes() }, 1),
        (RepairOptions { hole_length: 0.6, hole_edges: edges - 1, ..holes() }, 0),
        (RepairOptions { hole_length: 0.4, ..holes() }, 0),
        (RepairOptions { hole_length: 0.0, ..holes() }, 0),
    ] {
        let (_, repairs) = repaired(&mesh, &options);
        assert_eq!((repairs.holes_filled, repairs.holes_left), (filled, 1 - filled), "{options:?}");
    }
}

#[test]
fn a_missing_triangle_is_filled_however_coarse_the_mesh() {
    for body in [bodies::unit_cube(), bodies::tetrahedron(), bodies::icosphere(0)] {
        for t in 0..body.triangles.len() {
            let (mesh, repairs) = repaired(&body.without(|k| k == t).mesh(), &RepairOptions::default());
            assert_eq!((repairs.holes_filled, repairs.faces_added), (1, 1));
            assert_clean(&mesh);
            assert_same_inside(&mesh, &body);
        }
    }
}

#[test]
fn vertices_within_the_edges_of_the_other_side_leave_no_crack() {
    // Of an edge of a box one side is cut in the middle, the other is not.
    for scale in [1.0, 2f64.powi(-20), 2f64.powi(20)] {
        let body = bodies::cuboid([-1.0; 3], [1.0, 2.0, 4.0]).scaled(scale);
        for t in 0..body.triangles.len() {
            let mut cracked = body.clone();
            let [a, b, c] = cracked.triangles[t];
            let (p, q) = (body.vertices[a as usize], body.vertices[b as usize]);
            let m = cracked.vertices.len() as u32;
            cracked.vertices.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
            cracked.triangles[t] = [a, m, c];
            cracked.triangles.push([m, b, c]);
            let mesh = cracked.mesh();
            assert_eq!(mesh.report().boundary_edges, 3);
            let (mesh, repairs) = repaired(&mesh, &RepairOptions::default());
            assert_eq!(
                (repairs.holes_filled, repairs.degenerate_faces, repairs.corners_added),
                (1, 1, 1),
                "{repairs:?}"
            );
            assert_clean(&mesh);
            assert_same_inside(&mesh, &body);
        }
    }
}

#[test]
fn holes_that_touch_in_a_vertex_are_two() {
    let ball = bodies::icosphere(3);
    // Two triangles that have one vertex in common, and lie on either side of it.
    let v = ball.triangles[100][0];
    let around: Vec<usize> = (0..ball.triangles.len()).filter(|&t| ball.triangles[t].contains(&v)).collect();
    let shared = |s: usize, t: usize| ball.triangles[s].iter().filter(|v| ball.triangles[t].contains(v)).count();
    let other = around.iter().copied().find(|&t| shared(around[0], t) == 1).expect("a triangle across");
    let faulty = ball.without(|t| t == around[0] || t == other).mesh();
    assert_eq!(vertices_of_several_fans(&faulty), 1);
    let (mesh, repairs) = repaired(&faulty, &RepairOptions::default());
    assert_eq!(repairs, Repairs { holes_filled: 2, faces_added: 2, ..Repairs::default() });
    assert_clean(&mesh);
    assert_same_inside(&mesh, &ball);
}

#[test]
fn holes_that_touch_in_a_chain_are_filled_each() {
    let n = 16;
    let ring = bodies::torus(1.0, 0.3, n, n);
    let chain = |t: usize| t / 2 / n == t / 2 % n && t / 2 / n < 12;
    let faulty = ring.without(chain).mesh();
    assert_eq!(vertices_of_several_fans(&faulty), 11);
    let (mesh, repairs) = repaired(&faulty, &RepairOptions::default());
    assert_eq!(repairs, Repairs { holes_filled: 12, faces_added: 24, ..Repairs::default() });
    assert_clean(&mesh);
}

#[test]
fn cells_that_touch_in_vertices_alone_are_no_holes_in_each_other() {
    let n = 16;
    let ring = bodies::torus(1.0, 0.3, n, n);
    let cells = ring.without(|t| (t / 2 / n + t / 2 % n).is_multiple_of(2)).mesh();
    let (mesh, repairs) = repaired(&cells, &RepairOptions { split: false, ..RepairOptions::default() });
    assert_eq!(repairs, Repairs { holes_left: n * n / 2, ..Repairs::default() });
    assert_eq!(mesh.report(), cells.report());
}

#[test]
fn a_hole_between_faces_that_disagree_is_filled_with_the_most() {
    let body = bodies::icosphere(3);
    let gone = near(&body, [0.0, 0.0, 1.0], 0.2);
    let open = body.without(|t| gone.contains(&t));
    let wide = RepairOptions { hole_length: 0.8, ..holes() };
    let all_steps = RepairOptions { hole_length: 0.8, ..RepairOptions::default() };
    for faulty in [open.clone(), open.flipped()] {
        let (mesh, _) = repaired(&faulty.mesh_kept(), &wide);
        assert!(mesh.report().closed && mesh.report().consistent);
        assert_eq!(mesh.report().inside_out, faulty != open);
    }
    let (mesh, repairs) = repaired(&open.flipped_where(|t| t % 2 == 0).mesh_kept(), &all_steps);
    assert_eq!(repairs.holes_filled, 1);
    assert_clean(&mesh);
}

#[test]
fn no_edge_gets_more_than_two_faces() {
    // Two triangles with a common edge, of which each side is closed by a roof over the other two: the hole that is
    // left is a square whose one diagonal is an edge already.
    let vertices = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, -1.0]];
    // The square 0 1 2 3 is open; below it are four faces, and 0-2 is the edge of a double wall inside.
    let mut triangles = vec![[1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]];
    let open = Soup { vertices: vertices.clone(), triangles: triangles.clone() };
    triangles.extend([[0, 2, 4], [2, 0, 4]]);
    let walled = Soup { vertices, triangles };
    let all = RepairOptions { hole_length: 10.0, ..holes() };
    for (soup, wanted) in [(open, None), (walled, Some([1, 3]))] {
        let (mesh, repairs) = repaired(&soup.mesh_kept(), &all);
        assert_eq!((repairs.holes_filled, repairs.faces_added), (1, 2));
        let new: Vec<[u32; 3]> = mesh.triangles()[soup.triangles.len()..].iter().map(|t| t.vertices).collect();
        if let Some(diagonal) = wanted {
            assert!(new.iter().all(|t| diagonal.iter().all(|v| t.contains(v))), "{new:?}");
        }
        assert_eq!(mesh.report().boundary_edges, 0);
    }
}

#[test]
fn a_hole_that_cannot_be_filled_stays() {
    // The square of which both diagonals are edges already.
    let vertices =
        vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, -1.0], [0.5, 0.5, 1.0]];
    let triangles = vec![[1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4], [0, 2, 4], [2, 0, 4], [1, 3, 4], [3, 1, 4]];
    let mesh = Soup { vertices, triangles }.mesh_kept();
    let (same, repairs) = repaired(&mesh, &RepairOptions { hole_length: 10.0, ..holes() });
    assert_eq!(repairs, Repairs { holes_left: 1, ..Repairs::default() });
    assert_eq!(rings(&same), rings(&mesh));
}

#[test]
fn rims_that_more_than_two_faces_meet_on_stay() {
    let mesh = bodies::book(5).mesh();
    let (same, repairs) = repaired(&mesh, &RepairOptions { hole_length: f64::INFINITY, ..RepairOptions::default() });
    assert!(repairs.holes_left > 0 && repairs.faces_added == 0);
    assert_eq!(same.report(), mesh.report());
}
