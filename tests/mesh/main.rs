// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes from arrays: what is refused, welding, the report, repair, orientation, topology, pseudonormals and
//! polygons.

#[path = "../common/mod.rs"]
mod common;

mod arguments;
mod assembly;
mod data;
mod elements;
mod normals;
mod orientation;
mod polygon_lobes;
mod polygon_points;
mod polygons;
mod report;
mod topology;
mod welding;

use common::random::Random;
use common::winding::winding_number;
use common::{Soup, bodies};
use embound::Status;
use embound::math::Vec3;
use embound::mesh::{HalfEdges, Mesh, MeshOptions, Orient};
use proptest::prelude::*;

const _: fn() = || {
    fn any_thread_may_read<T: Send + Sync>() {}
    any_thread_may_read::<Mesh>();
};

const ORIENTATIONS: [Orient; 3] = [Orient::Auto, Orient::Keep, Orient::Flip];

fn options(change: impl FnOnce(&mut MeshOptions)) -> MeshOptions {
    let mut options = MeshOptions::default();
    change(&mut options);
    options
}

fn refused(outcome: embound::Result<Mesh>) -> String {
    let error = outcome.expect_err("the input is not valid");
    assert_eq!(error.status(), Status::InvalidArgument, "{error}");
    error.message().to_string()
}

/// The surface as it stands, for independent checks.
fn soup_of(mesh: &Mesh) -> Soup {
    Soup {
        vertices: mesh.vertices().iter().map(|p| p.to_array()).collect(),
        triangles: mesh.triangles().iter().map(|t| t.vertices).collect(),
    }
}

/// Whether both surfaces, one of each set of copies, wind equally often around a few hundred points.
fn assert_same_inside(mesh: &Mesh, wanted: &Soup) {
    let mut found = soup_of(mesh);
    found.triangles.sort_unstable_by_key(|t| sorted(*t));
    found.triangles.dedup_by_key(|t| sorted(*t));
    let (lo, hi) = wanted.bounds();
    let mut random = Random(7);
    for _ in 0..300 {
        let p = random.point(lo, hi);
        let (a, b) = (winding_number(&found, p), winding_number(wanted, p));
        assert!((a - b).abs() < 1e-6, "{a} instead of {b} at {p:?}");
    }
}

fn sorted(mut t: [u32; 3]) -> [u32; 3] {
    t.sort_unstable();
    t
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs()
}
