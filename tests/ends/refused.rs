// SPDX-License-Identifier: MIT OR Apache-2.0
//! What cannot be closed is refused, by name.

use crate::common::{Soup, bodies};
use crate::pipes;
use embound::Status;
use embound::geometry::{Geometry, Open, SdfOptions, SignMethod};
use embound::mesh::Mesh;
use embound::parallel::Run;
use std::f64::consts::TAU;

fn refused(mesh: &Mesh, options: &SdfOptions, status: Status, words: &[&str]) {
    let error = Geometry::from_mesh(mesh, options, &Run::SERIAL).err().expect("refused");
    assert_eq!(error.status(), status, "{error}");
    words.iter().for_each(|word| assert!(error.message().contains(word), "{word}: {error}"));
}

fn sweep() -> SdfOptions {
    SdfOptions { open: Open::Sweep, open_hi: [1.0; 3], ..SdfOptions::default() }
}

fn cap() -> SdfOptions {
    SdfOptions { open: Open::Cap, ..SdfOptions::default() }
}

#[test]
fn signs_for_open_meshes_close_none() {
    for soup in [pipes::all().swap_remove(0).open, bodies::unit_cube()] {
        for sign in [SignMethod::None, SignMethod::Axis] {
            let words = ["options.open", "options.sign"];
            refused(&soup.mesh(), &SdfOptions { sign, ..cap() }, Status::InvalidArgument, &words);
            refused(&soup.mesh(), &SdfOptions { sign, ..sweep() }, Status::InvalidArgument, &words);
        }
    }
}

#[test]
fn a_box_has_a_size_along_each_axis() {
    let pipe = pipes::all().swap_remove(0).open.mesh();
    let box_of = |lo: [f64; 3], hi: [f64; 3]| SdfOptions { open_lo: lo, open_hi: hi, ..sweep() };
    for (lo, hi) in [
        ([0.0; 3], [0.0; 3]),
        ([0.0; 3], [1.0, 0.0, 1.0]),
        ([0.0, 0.0, 2.0], [1.0; 3]),
        ([f64::NAN, 0.0, 0.0], [1.0; 3]),
        ([0.0; 3], [1.0, f64::INFINITY, 1.0]),
    ] {
        refused(&pipe, &box_of(lo, hi), Status::InvalidArgument, &["options.open_lo", "options.open_hi"]);
        // Nothing else looks at it.
        assert!(Geometry::from_mesh(&pipe, &SdfOptions { open_lo: lo, open_hi: hi, ..cap() }, &Run::SERIAL).is_ok());
    }
    refused(&pipe, &box_of([-1e100; 3], [1e100; 3]), Status::Topology, &["leads nowhere"]);
    let huge = pipes::all().swap_remove(0).open.scaled(5e99).mesh();
    refused(&huge, &box_of([0.0; 3], [5e99; 3]), Status::InvalidArgument, &["options.open_lo", "1e100"]);
}

#[test]
fn loops_deep_in_the_box_lead_nowhere() {
    let ball = bodies::sphere_at(2, [0.5; 3], 0.3).without(|t| t == 17);
    refused(&ball.mesh(), &sweep(), Status::Topology, &["loop of 3 edges", "leads nowhere", "emb_mesh_repair"]);
    // A sheet afloat.
    let sheet = bodies::sheet(4).scaled(0.15).translated([0.2, 0.2, 0.5]);
    refused(&sheet.mesh(), &sweep(), Status::Topology, &["loop of 16 edges", "leads nowhere"]);
}

#[test]
fn terrain_leads_out_by_several_faces() {
    let wave = |p: [f64; 3]| [p[0], p[1], 0.2 + 0.05 * libm::sin(9.0 * p[0]) * libm::cos(7.0 * p[1])];
    for (size, shift) in [(1.0, 0.0), (1.2, -0.1)] {
        let terrain = bodies::sheet(10).scaled(0.1 * size).translated([shift, shift, 0.0]).map(wave);
        refused(&terrain.mesh(), &sweep(), Status::Topology, &["several faces", "EMB_SIGN_AXIS"]);
        // In a box as flat as it is.
        let flat = SdfOptions { open_lo: [0.0, 0.0, 0.15], open_hi: [1.0, 1.0, 0.25], ..sweep() };
        refused(&terrain.mesh(), &flat, Status::Topology, &["several faces"]);
    }
}

#[test]
fn faces_that_disagree_are_not_a_hole() {
    let twisted = bodies::icosphere(1).flipped_where(|k| k == 3).mesh_kept();
    refused(&twisted, &cap(), Status::Topology, &["3 edges", "the same way", "CAP"]);
    refused(&twisted, &sweep(), Status::Topology, &["3 edges", "the same way", "SWEEP"]);
    refused(&bodies::moebius_strip(12).mesh(), &cap(), Status::Topology, &["the same way"]);
}

#[test]
fn large_loops_that_cross_themselves_are_named() {
    // A cone over a figure of eight.
    let n = 800;
    let mut soup = Soup { vertices: vec![[0.0, 0.0, 2.0]], triangles: vec![] };
    for k in 0..n {
        let a = TAU * (f64::from(k) + 0.3) / f64::from(n);
        let r = if libm::cos(a) > 0.0 { 1.0 } else { 0.8 };
        soup.vertices.push([r * libm::cos(a), r * libm::sin(2.0 * a), 0.01 * libm::sin(a)]);
        soup.triangles.push([0, k + 1, (k + 1) % n + 1]);
    }
    assert_eq!(soup.mesh().surface().boundary_edges, 800);
    // Few enough for the least area.
    assert!(Geometry::from_mesh(&soup.mesh(), &cap(), &Run::SERIAL).is_ok());
    let finer = bodies::quartered(&soup);
    refused(&finer.mesh(), &cap(), Status::Topology, &["loop of 1600 edges", "crosses itself"]);
}
