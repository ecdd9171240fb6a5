// SPDX-License-Identifier: MIT OR Apache-2.0
//! All faults at once.

use super::*;

/// A cube with dyadic coordinates of which one edge carries a flat face, a hollow ball with a hole in its outer shell,
/// two tetrahedra that share a vertex; every second face flipped, some doubled, none sharing vertices.
fn ruin(size: f64) -> (Soup, Soup) {
    let mut cube = bodies::quartered(&bodies::unit_cube());
    let clean_cube = cube.clone();
    let [a, c, _] = cube.triangles[5];
    let (p, q) = (cube.vertices[a as usize], cube.vertices[c as usize]);
    cube.vertices.push(std::array::from_fn(|k| 0.5 * (p[k] + q[k])));
    let m = cube.vertices.len() as u32 - 1;
    let other = cube.triangles.iter().position(|t| (0..3).any(|k| t[k] == c && t[(k + 1) % 3] == a)).expect("a face");
    let apex = *cube.triangles[other].iter().find(|v| **v != a && **v != c).expect("an apex");
    cube.triangles[other] = [c, m, apex];
    cube.triangles.extend([[m, a, apex], [c, a, m]]);

    let outer = bodies::sphere_at(2, [8.0, 0.0, 0.0], 2.0);
    let inner = bodies::sphere_at(2, [8.0, 0.0, 0.0], 1.0);
    let pair = bodies::tetrahedron().translated([0.0, 8.0, 0.0]);
    let pair = pair.and(&bodies::tetrahedron().map(|p| p.map(|c| -c)).flipped().translated([0.0, 8.0, 0.0]));

    let wanted = clean_cube.and(&outer).and(&inner.flipped()).and(&pair);
    let whole = cube.and(&outer.without(|t| t == 17)).and(&inner).and(&pair);
    let ruined = whole.flipped_where(|t| t % 2 == 0);
    let doubled = Soup { triangles: ruined.triangles.iter().step_by(5).copied().collect(), ..ruined.clone() };
    let size = |soup: Soup| soup.scaled(size);
    (size(ruined.and(&doubled.flipped_where(|t| t % 3 == 0)).unshared()), size(wanted))
}

#[test]
fn all_faults_together_are_repaired() {
    for power in [-20, 0, 20] {
        let (faulty, wanted) = ruin(libm::ldexp(1.0, power));
        let raw =
            faulty.mesh_with(&MeshOptions { weld_tolerance: -1.0, orient: Orient::Keep, ..MeshOptions::default() });
        for given in [raw, faulty.mesh_kept(), faulty.mesh()] {
            let (mesh, repairs) = repaired(&given, &RepairOptions::default());
            assert_eq!((repairs.holes_filled, repairs.faces_added, repairs.holes_left), (1, 1, 0), "{repairs:?}");
            assert_eq!((repairs.vertices_split, repairs.faces_collapsed), (1, 0), "{repairs:?}");
            assert!(repairs.degenerate_faces > 0 && repairs.duplicate_faces > 100, "{repairs:?}");
            assert_clean(&mesh);
            assert_eq!(mesh.report().components, 5);
            assert_same_inside(&mesh, &wanted);
            let points = points::all_kinds(&wanted, 300, &mut Random(9));
            let scale = libm::ldexp(1.0, power);
            for (a, b) in values(&mesh, &points).iter().zip(values(&wanted.mesh_kept(), &points)) {
                assert!((a - b).abs() <= 1e-14 * scale, "{a} {b}");
            }
        }
    }
}

#[test]
fn a_second_repair_finds_nothing() {
    let (faulty, _) = ruin(1.0);
    let all = RepairOptions { weld: false, ..RepairOptions::default() };
    let (once, _) = repaired(&faulty.mesh(), &RepairOptions::default());
    let (twice, repairs) = repaired(&once, &all);
    assert_eq!(repairs, Repairs::default());
    assert_eq!((rings(&twice), twice.report()), (rings(&once), once.report()));
    // Vertices that were split are joined by welding, and split again.
    let (again, repairs) = repaired(&once, &RepairOptions::default());
    assert_eq!(repairs, Repairs { vertices_welded: 1, vertices_split: 1, ..Repairs::default() });
    assert_eq!((rings(&again), again.report()), (rings(&once), once.report()));
}

#[test]
fn the_same_bits_come_out_every_time() {
    let (faulty, _) = ruin(1.0);
    let first = repaired(&faulty.mesh(), &RepairOptions::default());
    for _ in 0..3 {
        let (mesh, repairs) = repaired(&faulty.mesh(), &RepairOptions::default());
        assert_eq!((rings(&mesh), repairs), (rings(&first.0), first.1));
        assert_eq!(mesh.triangles(), first.0.triangles());
    }
}

/// A body with faults of each kind picked at random is repaired or keeps what cannot be, and never fails.
#[test]
fn random_ruins_are_never_made_worse() {
    let mut random = Random(77);
    for round in 0..60 {
        let body = bodies::torus(1.0, 0.4, 8, 6).and(&bodies::sphere_at(1, [0.0; 3], 0.4));
        let mut soup = body.clone();
        for _ in 0..random.below(12) {
            let t = random.below(soup.triangles.len());
            match random.below(4) {
                0 => drop(soup.triangles.swap_remove(t)),
                1 => soup.triangles[t].swap(0, 1),
                2 => soup.triangles.push(soup.triangles[t]),
                _ => soup.triangles[t][0] = random.below(soup.vertices.len()) as u32,
            }
        }
        let faulty = soup.mesh_kept();
        let (mesh, repairs) = repaired(&faulty, &RepairOptions::default());
        let (before, after) = (faulty.surface(), mesh.report());
        assert!(after.boundary_edges <= before.boundary_edges, "{round}: {before:?} {after:?} {repairs:?}");
        assert!(after.nonmanifold_edges <= before.nonmanifold_edges, "{round}: {before:?} {after:?} {repairs:?}");
        assert_eq!(after.duplicate_faces, 0, "{round}: {repairs:?}");
        assert_eq!(after.closed, repairs.holes_left == 0, "{round}: {repairs:?} {after:?}");
        let manifold = after.nonmanifold_edges == 0 && after.consistent;
        assert!(!manifold || vertices_of_several_fans(&mesh) == 0, "{round}");
    }
}
