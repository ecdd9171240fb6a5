// SPDX-License-Identifier: MIT OR Apache-2.0
//! What closest points cost beside values alone, with data of the surface interpolated there, on one thread:
//!
//!     cargo bench --bench closest -- [mesh ...]      (a bumpy sphere of 81,920 triangles by default)

use embound::geometry::{Closest, Geometry, SdfOptions};
use embound::io::{self, Format};
use embound::math::Vec3;
use embound::mesh::{Field, FieldType, Mesh, MeshOptions};
use embound::parallel::Run;
use embound::query::{self, Strided};
use std::hint::black_box;
use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;

#[path = "../tests/common/mod.rs"]
mod common;
use common::{bodies, random::Random};

const COUNT: usize = 200_000;

/// Microseconds a point: the least of five.
fn cost(mut work: impl FnMut()) -> f64 {
    let once = |work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64() * 1e6 / COUNT as f64
    };
    (0..5).map(|_| once(&mut work)).fold(f64::INFINITY, f64::min)
}

fn measure(name: &str, mesh: &Mesh) {
    let values = mesh.vertices().iter().map(|p| p.length()).collect();
    let field = Field { name: "r".into(), kind: FieldType::F64, components: 1, values };
    let mesh = mesh.with_field(false, field).expect("a value a vertex");
    let g = Geometry::from_mesh(&mesh, &SdfOptions::default(), &Run::SERIAL).expect("a closed mesh");
    let (lo, hi) = (mesh.bounds().lo, mesh.bounds().hi);
    let mut random = Random(1);
    let points: Vec<f64> = (0..COUNT).flat_map(|_| random.point(lo.to_array(), hi.to_array())).collect();
    let source = Strided::new(COUNT, [&points, &points[1..], &points[2..]], 3).expect("points");
    let alone = cost(|| query::values(&g, &source, &Run::SERIAL, &|_, v| _ = black_box(v[0])).expect("values"));
    let found = Mutex::new(vec![Closest::default(); COUNT]);
    let closest = cost(|| {
        let emit =
            |start: usize, c: &[Closest]| found.lock().expect("alone")[start..start + c.len()].copy_from_slice(c);
        query::closest(&g, &source, f64::INFINITY, &Run::SERIAL, &emit).expect("closest points");
    });
    let found = found.into_inner().expect("alone");
    let single = cost(|| {
        for p in points.chunks_exact(3) {
            black_box(g.closest(Vec3::new(p[0], p[1], p[2])).tag);
        }
    });
    let data = cost(|| {
        let mut out = [0.0];
        for c in &found {
            mesh.interpolate(&mesh.vertex_fields()[0], c.primitive, c.piece, c.barycentric, &mut out);
            black_box(out);
        }
    });
    println!(
        "{name}: {} triangles, {:?}: values {alone:.3} us, closest with everything {closest:.3} us ({:.2} times), one by one {single:.3} us, data {data:.3} us",
        mesh.triangle_count(),
        g.properties().sign_method,
        closest / alone
    );
}

fn main() {
    let files: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    for file in &files {
        measure(file, &io::read(Path::new(file), Format::Detect, &MeshOptions::default()).expect(file));
    }
    if files.is_empty() {
        let bumpy = |p: [f64; 3]| p.map(|c| c * (1.0 + 0.05 * libm::sin(9.0 * p[0]) * libm::sin(7.0 * p[1])));
        measure("bumpy sphere", &bodies::icosphere(6).map(bumpy).mesh());
    }
}
