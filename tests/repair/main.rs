// SPDX-License-Identifier: MIT OR Apache-2.0
//! Repair: each fault alone, all of them together, and nothing that was not asked for.

#[path = "../common/mod.rs"]
mod common;

mod data;
mod faces;
mod fans;
mod flat;
mod holes;
mod scales;
mod shells;
mod together;

use common::random::Random;
use common::winding::winding_number;
use common::{Soup, bodies, points};
use embound::Status;
use embound::geometry::{Geometry, SdfOptions};
use embound::math::Vec3;
use embound::mesh::{Mesh, MeshOptions, Orient, RepairOptions, Repairs};
use embound::parallel::Run;

/// One step alone.
fn only(ask: impl FnOnce(&mut RepairOptions)) -> RepairOptions {
    let mut options = RepairOptions::NOTHING;
    ask(&mut options);
    options
}

fn repaired(mesh: &Mesh, options: &RepairOptions) -> (Mesh, Repairs) {
    mesh.repaired(options).expect("the mesh can be repaired")
}

fn values(mesh: &Mesh, points: &[[f64; 3]]) -> Vec<f64> {
    let g = Geometry::from_mesh(mesh, &SdfOptions::default(), &Run::SERIAL).expect("a closed mesh");
    points.iter().map(|p| g.value(Vec3::from_array(*p))).collect()
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|v| v.to_bits()).collect()
}

/// The surface as it stands, for independent checks.
fn soup_of(mesh: &Mesh) -> Soup {
    Soup {
        vertices: mesh.vertices().iter().map(|p| p.to_array()).collect(),
        triangles: mesh.triangles().iter().map(|t| t.vertices).collect(),
    }
}

/// The rings of all faces, by position.
fn rings(mesh: &Mesh) -> Vec<Vec<[u64; 3]>> {
    let topology = mesh.half_edges();
    let position = |v: &u32| mesh.vertices()[*v as usize].to_array().map(f64::to_bits);
    (0..topology.face_count() as u32).map(|f| topology.corners(f).iter().map(position).collect()).collect()
}

/// Whether nothing is wrong with a mesh: its report, its surface, and one fan of faces at each vertex.
#[track_caller]
fn assert_clean(mesh: &Mesh) {
    let report = mesh.report();
    assert!(report.closed && report.consistent && !report.inside_out, "{report:?}");
    let faults = report.nonmanifold_edges + report.degenerate_faces + report.duplicate_faces;
    assert_eq!((faults, mesh.surface().boundary_edges, mesh.surface().unbalanced_edges), (0, 0, 0), "{report:?}");
    assert_eq!(vertices_of_several_fans(mesh), 0);
}

/// At how many vertices not all faces are of one fan, by walking round them.
fn vertices_of_several_fans(mesh: &Mesh) -> usize {
    let topology = mesh.half_edges();
    let more = |v: u32| {
        let outgoing = topology.outgoing(v);
        let longest = outgoing.iter().map(|&h| topology.around_vertex(h).count()).max();
        usize::from(longest != Some(outgoing.len()))
    };
    (0..mesh.vertices().len() as u32).map(more).sum()
}

/// Whether a mesh winds round a few hundred points as often as the body does.
#[track_caller]
fn assert_same_inside(mesh: &Mesh, body: &Soup) {
    let found = soup_of(mesh);
    let (lo, hi) = body.bounds();
    let mut random = Random(11);
    for _ in 0..200 {
        let p = random.point(lo, hi);
        let (a, b) = (winding_number(&found, p), winding_number(body, p));
        assert!((a - b).abs() < 1e-6, "{a} instead of {b} at {p:?}");
    }
}

/// Whether both meshes have the same faces and the same values to the last bit.
#[track_caller]
fn assert_same_bits(mesh: &Mesh, wanted: &Mesh, body: &Soup) {
    assert_eq!(rings(mesh), rings(wanted));
    let points = points::all_kinds(body, 300, &mut Random(3));
    assert_eq!(bits(&values(mesh, &points)), bits(&values(wanted, &points)));
}

fn clean_bodies() -> Vec<Soup> {
    vec![
        bodies::tetrahedron(),
        bodies::icosphere(2),
        bodies::torus(1.0, 0.25, 24, 9),
        bodies::leaning_pyramid(),
        bodies::bracket(),
        bodies::plate(2, 2, 0.2, 0.4, 3),
        bodies::nested_shells(1),
    ]
}

#[test]
fn a_clean_mesh_comes_back_as_it_was() {
    for body in clean_bodies() {
        for scale in [1e-6, 1.0, 1e6] {
            let mesh = body.scaled(scale).mesh();
            for options in [RepairOptions::default(), RepairOptions::NOTHING] {
                let (same, repairs) = repaired(&mesh, &options);
                assert_eq!(repairs, Repairs::default());
                assert_eq!((same.vertices(), same.triangles()), (mesh.vertices(), mesh.triangles()));
                assert_eq!((same.report(), same.face_count()), (mesh.report(), mesh.face_count()));
                assert_same_bits(&same, &mesh, &body.scaled(scale));
            }
        }
    }
}

#[test]
fn nothing_is_done_that_is_not_asked_for() {
    let ball = bodies::icosphere(2);
    let faulty = ball.without(|t| t == 3).and(&Soup { triangles: vec![ball.triangles[5]], ..ball.clone() });
    let mesh = faulty.flipped_where(|t| t % 3 == 0).mesh_kept();
    let (same, repairs) = repaired(&mesh, &RepairOptions::NOTHING);
    assert_eq!(repairs, Repairs::default());
    assert_eq!((rings(&same), same.report()), (rings(&mesh), mesh.report()));
    let (filled, repairs) = repaired(&mesh, &only(|o| o.holes = true));
    assert_eq!(repairs, Repairs { holes_filled: 1, faces_added: 1, ..Repairs::default() });
    assert_eq!(rings(&filled)[..rings(&mesh).len()], rings(&mesh));
    assert_eq!(filled.report().duplicate_faces, 1);
    assert!(!filled.report().consistent);
}

#[test]
fn options_out_of_range_are_refused() {
    let mesh = bodies::tetrahedron().mesh();
    for (options, name) in [
        (only(|o| o.weld_tolerance = 0.6), "options.weld_tolerance: 0.6"),
        (only(|o| o.weld_tolerance = f64::NAN), "options.weld_tolerance: NaN"),
        (only(|o| o.weld_tolerance = -1.0), "options.weld_tolerance: -1"),
        (only(|o| o.hole_edges = 2049), "options.hole_edges: 2049"),
        (only(|o| o.hole_length = -0.5), "options.hole_length: -0.5"),
        (only(|o| o.hole_length = f64::NAN), "options.hole_length: NaN"),
    ] {
        let error = mesh.repaired(&options).expect_err(name);
        assert_eq!(error.status(), Status::InvalidArgument);
        assert!(error.message().starts_with(name), "{error}");
    }
}

#[test]
fn progress_rises_and_stops_the_repair() {
    use std::sync::Mutex;
    let mesh = bodies::icosphere(2).without(|t| t % 40 == 0).mesh();
    let told = Mutex::new(Vec::new());
    let count = |fraction: f64| {
        told.lock().unwrap().push(fraction);
        false
    };
    mesh.repaired_with(&RepairOptions::default(), &Run { pool: None, progress: Some(&count) }).unwrap();
    let told = told.into_inner().unwrap();
    assert!(told.windows(2).all(|w| w[0] <= w[1]) && told[0] == 0.0 && told[told.len() - 1] == 1.0, "{told:?}");
    for stop in 0..told.len() {
        let left = Mutex::new(stop);
        let progress = |_: f64| {
            let mut left = left.lock().unwrap();
            let now = *left == 0;
            *left = left.saturating_sub(1);
            now
        };
        let error = mesh.repaired_with(&RepairOptions::default(), &Run { pool: None, progress: Some(&progress) });
        assert_eq!(error.expect_err("stopped").status(), Status::Cancelled);
    }
}
