// SPDX-License-Identifier: MIT OR Apache-2.0
//! Each fault alone, and all of them together, at every scale.

use super::*;
use embound::Status;
use embound::mesh::{Duplicate, InconsistentEdge, MeshOptions, NO_COMPONENT, NonmanifoldVertex, Orient};

const SCALES: [f64; 3] = [1e-6, 1.0, 1e6];

#[test]
fn clean_bodies_have_no_faults() {
    for soup in [bodies::icosphere(2), bodies::bracket(), bodies::torus(1.0, 0.3, 20, 9), drum(80, 1.0, 1.0)] {
        for scale in SCALES {
            let mesh = soup.scaled(scale).mesh();
            let found = diagnosis(&mesh);
            assert_eq!(found.report, *mesh.report());
            assert_eq!(found.surface, mesh.surface());
            assert!(found.nonmanifold_edges.is_empty() && found.nonmanifold_edge_faces.is_empty());
            assert!(found.inconsistent_edges.is_empty() && found.nonmanifold_vertices.is_empty());
            assert!(found.shrunk_faces.is_empty() && found.flat_faces.is_empty() && found.slivers.is_empty());
            assert!(found.duplicates.is_empty() && found.off_plane_faces.is_empty() && found.loops.is_empty());
            assert_eq!((found.components.len(), found.turned_faces), (1, 0));
            let whole = &found.components[0];
            let r = mesh.report();
            assert_eq!((whole.volume, whole.area, whole.lo, whole.hi), (r.volume, r.area, r.lo, r.hi));
            assert_eq!((whole.faces, whole.triangles), (r.faces, r.triangles));
        }
    }
}

#[test]
fn inside_out_and_inconsistent_bodies_are_told_as_read() {
    let sphere = bodies::icosphere(1);
    for scale in SCALES {
        let mesh = sphere.scaled(scale).flipped().mesh();
        let found = diagnosis(&mesh);
        assert!(found.report.inside_out && found.components[0].inside_out);
        assert_eq!((found.turned_faces, found.components[0].turned_faces), (80, 80));
        assert_eq!(found.components[0].volume, mesh.report().volume);
        assert!(found.inconsistent_edges.is_empty());
        // One face the other way: its three edges, whichever way the mesh was turned since.
        let soup = sphere.scaled(scale).flipped_where(|t| t == 17);
        for mesh in [soup.mesh(), soup.mesh_kept()] {
            let found = diagnosis(&mesh);
            assert_eq!(found.inconsistent_edges.len(), 3);
            assert!(found.inconsistent_edges.iter().all(|e| e.faces.contains(&17) && e.vertices[0] < e.vertices[1]));
            assert!(!found.components[0].is_consistent() && !found.components[0].inside_out);
        }
        assert_eq!(diagnosis(&soup.mesh()).turned_faces, 1);
        assert_eq!(diagnosis(&soup.mesh_kept()).turned_faces, 0);
    }
}

#[test]
fn degenerate_faces_are_told_by_kind() {
    let mut body = bodies::icosphere(0);
    let [a, b, c] = body.triangles[4];
    body.triangles.extend([[a, a, b], [c, a, b], [b, a, c], [5, 5, 5]]);
    let n = body.vertices.len() as u32;
    body.vertices.extend([[4.0, 5.0, 6.0], [5.0, 7.0, 9.0], [6.0, 9.0, 12.0]]);
    body.triangles.push([n, n + 1, n + 2]);
    for scale in [2f64.powi(-20), 1.0, 2f64.powi(20)] {
        let found = diagnosis(&body.scaled(scale).mesh());
        assert_eq!((&found.shrunk_faces[..], &found.flat_faces[..]), (&[20, 23][..], &[24][..]));
        assert_eq!(found.report.degenerate_faces, 3);
        let copy = |face, same_way| Duplicate { face, original: 4, same_way };
        assert_eq!(found.duplicates, [copy(21, true), copy(22, false)]);
        assert_eq!(found.component_of_face[20], NO_COMPONENT);
        assert_eq!((found.component_of_face[0], found.component_of_face[24]), (0, 1));
        assert!(found.slivers.is_empty(), "a flat face is no sliver");
    }
}

#[test]
fn slivers_are_told_by_their_height_over_their_longest_edge() {
    // Smallest height over longest edge: 0.5 h / 2 over 2 and so on, for each corner the first.
    let needle = |h: f64| Soup {
        vertices: vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.7, h, 0.0]],
        triangles: vec![[0, 1, 2], [1, 2, 0], [2, 0, 1]],
    };
    for (h, thin) in [(1.0, false), (0.0021, false), (0.0019, true), (1e-9, true)] {
        for scale in SCALES {
            let found = diagnosis(&needle(h).scaled(scale).unshared().translated([0.0; 3]).mesh_kept());
            // Copies are slivers, too.
            assert_eq!(found.slivers.len(), if thin { 3 } else { 0 }, "{h}");
            for sliver in &found.slivers {
                assert!((sliver.ratio / (h / 2.0) - 1.0).abs() < 1e-9, "{} {h}", sliver.ratio);
            }
        }
    }
    let options = |sliver_ratio| DiagnosisOptions { sliver_ratio, ..DiagnosisOptions::default() };
    let mesh = bodies::unit_cube().mesh();
    // Half a square: 1 / sqrt 2 over sqrt 2.
    assert_eq!(diagnosis_with(&mesh, &options(0.499)).slivers.len(), 0);
    assert_eq!(diagnosis_with(&mesh, &options(0.501)).slivers.len(), 12);
    assert_eq!(diagnosis_with(&needle(1e-9).mesh(), &options(0.0)).slivers.len(), 0);
}

#[test]
fn polygons_are_slivers_as_wholes_and_off_a_plane_by_their_corners() {
    // A strip of 1000 by 1, with corners along its sides: its triangles are narrower than it is.
    let mut ring: Vec<[f64; 3]> = (0..=50).map(|k| [20.0 * f64::from(k), 0.0, 0.0]).collect();
    ring.extend((0..=50).rev().map(|k| [20.0 * f64::from(k), 1.0, 0.0]));
    let polygon = |ring: &[[f64; 3]]| {
        let indices: Vec<u32> = (0..ring.len() as u32).collect();
        let options = MeshOptions { orient: Orient::Keep, ..MeshOptions::default() };
        Mesh::from_polygons(&ring.concat(), &[0, ring.len()], &indices, None, &options).expect("a plane polygon")
    };
    let options = |sliver_ratio, off_plane_ratio| DiagnosisOptions {
        sliver_ratio,
        off_plane_ratio,
        ..DiagnosisOptions::default()
    };
    assert!(diagnosis_with(&polygon(&ring), &options(1e-3, 0.0)).slivers.is_empty());
    let found = diagnosis_with(&polygon(&ring), &options(3e-3, 0.0));
    assert_eq!(found.slivers.len(), 1);
    assert!((found.slivers[0].ratio - 2e-3).abs() < 1e-8, "{}", found.slivers[0].ratio);
    // A square with two corners lifted by 2e-6 of its diagonal: as far off a plane as half of that.
    for scale in SCALES {
        let lift = 2e-6 * 2f64.sqrt();
        let bent = [[0.0, 0.0, lift], [1.0, 0.0, 0.0], [1.0, 1.0, lift], [0.0, 1.0, 0.0]].map(|p| p.map(|c| c * scale));
        let mesh = polygon(&bent);
        assert!(diagnosis(&mesh).off_plane_faces.is_empty(), "not looked for");
        let found = diagnosis_with(&mesh, &options(1e-3, 0.9e-6));
        assert_eq!(found.off_plane_faces.len(), 1);
        assert!((found.off_plane_faces[0].ratio / 1e-6 - 1.0).abs() < 1e-5, "{}", found.off_plane_faces[0].ratio);
        assert!(diagnosis_with(&mesh, &options(1e-3, 1.1e-6)).off_plane_faces.is_empty());
    }
}

#[test]
fn warped_faces_are_those_the_report_counts() {
    // A square, one with a corner lifted by a tenth, a bow tie in a plane.
    let vertices = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        [[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [6.0, 1.0, 0.1], [5.0, 1.0, 0.0]],
        [[9.0, 0.0, 0.0], [10.0, 1.0, 0.0], [10.0, 0.0, 0.0], [9.0, 1.5, 0.0]],
    ]
    .concat();
    let indices: Vec<u32> = (0..12).collect();
    let mesh =
        Mesh::from_polygons(&vertices.concat(), &[0, 4, 8, 12], &indices, None, &MeshOptions::default()).unwrap();
    assert_eq!(mesh.report().warped_faces, 2);
    let found = diagnosis(&mesh);
    let faces: Vec<u32> = found.warped_faces.iter().map(|w| w.face).collect();
    assert_eq!(faces, [1, 2]);
    // Half of a twentieth above and below, but for the slope of the plane; the diagonal is the root of 2.
    assert!((found.warped_faces[0].ratio - 0.025 / 2f64.sqrt()).abs() < 1e-3, "{}", found.warped_faces[0].ratio);
    assert_eq!(found.warped_faces[1].ratio, 0.0);
    assert!(
        found.text().contains("warped faces: 2: faces 1 off a plane by 0.018 at (5.5, 0.5, 0.05), 2 off a plane by 0")
    );
}

#[test]
fn edges_and_vertices_that_are_not_manifold_are_told() {
    for scale in SCALES {
        let found = diagnosis(&bodies::book(5).scaled(scale).mesh());
        assert_eq!(found.nonmanifold_edges, [[0, 1]]);
        assert_eq!(found.nonmanifold_edge_faces.get(0), Some(&[0, 1, 2, 3, 4][..]));
        assert_eq!(found.nonmanifold_edge_faces.get(1), None);
        let fans = |vertex, fans| NonmanifoldVertex { vertex, fans };
        assert_eq!(found.nonmanifold_vertices, [fans(0, 5), fans(1, 5)]);
        // Two tetrahedra that share a vertex.
        let pair = bodies::tetrahedron().and(&bodies::tetrahedron().scaled(-1.0).flipped()).scaled(scale);
        let found = diagnosis(&pair.mesh());
        assert!(found.nonmanifold_edges.is_empty());
        assert_eq!(found.nonmanifold_vertices, [fans(0, 2)]);
        assert_eq!(pairs(&pair.mesh()), [[0u32; 2]; 0], "they share the vertex");
        // Unwelded they touch in a point, each face with each.
        let options = MeshOptions { weld_tolerance: -1.0, ..MeshOptions::default() };
        assert_eq!(pairs(&pair.mesh_with(&options)).len(), 9);
    }
}

#[test]
fn the_two_faces_of_an_inconsistent_edge_are_named() {
    let soup = Soup {
        vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2], [1, 2, 3]],
    };
    let edge = InconsistentEdge { vertices: [1, 2], faces: [0, 1] };
    assert_eq!(diagnosis(&soup.mesh_kept()).inconsistent_edges, [edge]);
    assert_eq!(diagnosis(&soup.mesh()).inconsistent_edges, [edge]);
}

#[test]
fn all_faults_together_are_told_apart() {
    let sphere = bodies::icosphere(2);
    let soup = sphere
        .without(|t| t == 100)
        .and(&bodies::icosphere(1).translated([10.0, 0.0, 0.0]).flipped())
        .and(&bodies::book(3).translated([20.0, 0.0, 0.0]))
        .and(&bodies::overlapping_spheres(1).translated([30.0, 0.0, 0.0]))
        .and(&bodies::tetrahedron().duplicated().translated([40.0, 0.0, 0.0]))
        .and(&bodies::sheet(3).flipped_where(|t| t == 7).translated([50.0, 0.0, 0.0]))
        .and(&Soup {
            vertices: vec![[60.0, 0.0, 0.0], [64.0, 0.0, 0.0], [61.0, 1e-4, 0.0], [62.0, 0.0, 0.0]],
            triangles: vec![[0, 1, 2], [0, 0, 2], [0, 1, 3]],
        });
    let alone = pairs(&bodies::overlapping_spheres(1).mesh()).len();
    for scale in SCALES {
        let found = diagnosis(&soup.scaled(scale).mesh());
        let states: Vec<_> =
            found.components.iter().map(|c| (c.faces, c.is_closed(), c.is_consistent(), c.inside_out)).collect();
        assert_eq!(
            states,
            [
                (319, false, true, false),
                (80, true, true, true),
                (3, false, true, false),
                (80, true, true, false),
                (80, true, true, false),
                (8, true, true, false),
                (18, false, false, false),
                (2, false, false, false),
            ]
        );
        assert_eq!(found.components[1].turned_faces, 80);
        // The edges of the tetrahedron have four faces each; the spine of the book has three.
        assert_eq!((found.nonmanifold_edges.len(), found.nonmanifold_vertices.len()), (7, 6));
        assert_eq!((found.duplicates.len(), found.slivers.len()), (4, 1));
        assert_eq!((found.shrunk_faces.len(), found.flat_faces.len()), (1, 1));
        // Two of the face turned over in the sheet, at whose rim it is, and that of the needle's two faces.
        assert_eq!(found.inconsistent_edges.len(), 3);
        // One hole; a loop and a chain of the book; the sheet's rim; the needle with the flat face along it.
        assert_eq!((found.loops.len(), found.loops.iter().filter(|l| !l.closed).count()), (5, 1));
        assert_eq!(found.intersections.as_ref().map(|i| i.count), Some(alone as u64));
        assert!(found.text().lines().count() < 40);
    }
}

#[test]
fn options_out_of_range_are_refused() {
    let mesh = bodies::tetrahedron().mesh();
    let good = DiagnosisOptions::default();
    for bad in [-1e-9, 1.5, f64::NAN, f64::INFINITY] {
        for (name, options) in [
            ("sliver_ratio", DiagnosisOptions { sliver_ratio: bad, ..good.clone() }),
            ("off_plane_ratio", DiagnosisOptions { off_plane_ratio: bad, ..good.clone() }),
        ] {
            let error = diagnose(&mesh, &options, &Run::SERIAL).expect_err("out of range");
            assert_eq!(error.status(), Status::InvalidArgument);
            assert!(error.message().contains(name) && error.message().contains(&bad.to_string()), "{error}");
        }
    }
}

#[test]
fn a_diagnosis_can_be_stopped() {
    let mesh = bodies::icosphere(5).mesh();
    for after in [0usize, 1, 2] {
        let told = std::sync::atomic::AtomicUsize::new(0);
        let stop = |_: f64| told.fetch_add(1, std::sync::atomic::Ordering::Relaxed) == after;
        let run = Run { pool: None, progress: Some(&stop) };
        let error = diagnose(&mesh, &DiagnosisOptions::default(), &run).expect_err("stopped");
        assert_eq!(error.status(), Status::Cancelled);
        assert_eq!(told.into_inner(), after + 1);
    }
    let last = std::sync::Mutex::new(-1.0);
    let rises = |fraction: f64| {
        let mut last = last.lock().unwrap();
        assert!(fraction >= *last && fraction <= 1.0);
        *last = fraction;
        false
    };
    let run = Run { pool: None, progress: Some(&rises) };
    diagnose(&mesh, &DiagnosisOptions::default(), &run).expect("a diagnosis");
    assert_eq!(*last.lock().unwrap(), 1.0);
}
