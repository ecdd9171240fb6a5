// SPDX-License-Identifier: MIT OR Apache-2.0
//! The peers that crates.io has, on one case:
//!
//!     rust-peers parry|bvh CASE_DIRECTORY
//!
//! Not here: obvhs 0.4, which answers rays and boxes but no closest point, in f32.

mod boxes;
mod surface;

use case::{Case, SETS, peer, row, seconds, version};
use std::path::Path;
use std::process::ExitCode;

const LOCK: &str = include_str!("../../Cargo.lock");

/// What f64 peers must reach, in diagonals.
const TOLERANCE: f64 = 1e-9;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [which, directory] = &arguments[..] else {
        eprintln!("usage: rust-peers parry|bvh CASE_DIRECTORY");
        return ExitCode::FAILURE;
    };
    let case = match Case::read(Path::new(directory)) {
        Ok(case) => case,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    match which.as_str() {
        "parry" => {
            peer("parry3d-f64", version(LOCK, "parry3d-f64"), "f64, signed, crates.io");
            let (time, mesh) = seconds(|| surface::build(&case));
            ask(&case, "parry3d-f64", true, time, |p| surface::signed_distance(&mesh, p))
        }
        "bvh" => {
            peer("bvh", version(LOCK, "bvh"), "f64, unsigned, crates.io; a plain triangle distance is given to it");
            let (time, tree) = seconds(|| boxes::build(&case));
            ask(&case, "bvh", false, time, |p| tree.distance(p))
        }
        other => {
            eprintln!("{other}: not a peer; there are parry and bvh");
            ExitCode::FAILURE
        }
    }
}

/// Times every set, one point after the other, and holds the answers against the exact ones.
fn ask(case: &Case, name: &str, signed: bool, built: f64, distance: impl Fn([f64; 3]) -> f64) -> ExitCode {
    row(&case.name, "build", name, built, "s", None);
    for set in SETS {
        let points = match case.set(set) {
            Ok(points) => points,
            Err(error) => {
                eprintln!("{error}");
                return ExitCode::FAILURE;
            }
        };
        std::hint::black_box(points.warm_up().map(|p| distance(*p)).sum::<f64>());
        let mut answers = vec![f64::NAN; points.points.len()];
        let (time, ()) = seconds(|| answers.iter_mut().zip(&points.points).for_each(|(a, p)| *a = distance(*p)));
        let verdict = points.judge(case, &answers, signed, TOLERANCE);
        row(&case.name, set, name, time * 1e9 / answers.len() as f64, "ns", Some(verdict));
    }
    ExitCode::SUCCESS
}
