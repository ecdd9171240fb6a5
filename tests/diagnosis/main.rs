// SPDX-License-Identifier: MIT OR Apache-2.0
//! Diagnoses of meshes: each fault alone and all together, against plain twins of what finds them.

#[path = "../common/mod.rs"]
mod common;

mod faults;
mod hubs;
mod intersections;
mod loops;
mod text;
mod touching;
mod twins;

use common::random::Random;
use common::{Soup, bodies};
use embound::math::Vec3;
use embound::mesh::{Diagnosis, DiagnosisOptions, Mesh, MeshOptions, RepairOptions};
use embound::parallel::{Pool, Run};
use embound::query::diagnose;

/// The diagnosis with default options, which must be the same on three threads.
fn diagnosis(mesh: &Mesh) -> Diagnosis {
    diagnosis_with(mesh, &DiagnosisOptions::default())
}

fn diagnosis_with(mesh: &Mesh, options: &DiagnosisOptions) -> Diagnosis {
    let alone = diagnose(mesh, options, &Run::SERIAL).expect("a diagnosis");
    let pool = Pool::new(3, || ()).expect("threads");
    let pooled = diagnose(mesh, options, &Run { pool: Some(&pool), progress: None }).expect("a diagnosis");
    assert_eq!(alone, pooled, "the diagnosis depends on the threads");
    alone
}

/// The pairs, which must be all there are.
fn pairs(mesh: &Mesh) -> Vec<[u32; 2]> {
    let found = diagnosis(mesh).intersections.expect("looked for");
    assert!(found.complete && found.count == found.pairs.len() as u64);
    assert!(found.pairs.windows(2).all(|w| w[0] < w[1]) && found.pairs.iter().all(|p| p[0] < p[1]));
    found.pairs
}

/// Triangles that share vertices where `random` has it: `count` of them over the points of a grid.
fn grid_soup(count: usize, points: usize, random: &mut Random) -> Soup {
    let coordinate = |random: &mut Random| random.below(points) as f64;
    let vertices = (0..3 * count).map(|_| [coordinate(random), coordinate(random), coordinate(random)]).collect();
    let triangles = (0..count as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Soup { vertices, triangles }
}

/// A cylinder around the z axis whose caps are fans around their middles.
fn drum(sides: usize, radius: f64, height: f64) -> Soup {
    let mut out = Soup { vertices: vec![[0.0, 0.0, 0.0], [0.0, 0.0, height]], triangles: Vec::new() };
    for k in 0..sides {
        let a = std::f64::consts::TAU * k as f64 / sides as f64;
        let (x, y) = (radius * libm::cos(a), radius * libm::sin(a));
        out.vertices.extend([[x, y, 0.0], [x, y, height]]);
        let (low, next) = (2 + 2 * k as u32, 2 + 2 * ((k + 1) % sides) as u32);
        out.triangles.extend([[0, next, low], [1, low + 1, next + 1], [low, next, next + 1], [low, next + 1, low + 1]]);
    }
    out
}
