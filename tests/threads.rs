// SPDX-License-Identifier: MIT OR Apache-2.0
//! No thread is started that nobody asked for: a call without a pool, or from a thread that is none of a
//! pool's, must not wake rayon's global pool. The only test of this file, because it counts the
//! process's threads.

#![cfg(target_os = "linux")]

mod common;

use embound::geometry::{Geometry, SdfOptions};
use embound::parallel::{Pool, Run};
use embound::query::{self, FillMode, Lattice};
use std::time::Duration;
use std::{fs, thread};

fn threads() -> usize {
    let status = fs::read_to_string("/proc/self/status").expect("/proc/self/status");
    let line = status.lines().find_map(|line| line.strip_prefix("Threads:")).expect("a count of threads");
    line.trim().parse().expect("a number")
}

/// A thread that has ended may still be counted for a moment.
fn settle_at(wanted: usize) {
    for _ in 0..200 {
        if threads() == wanted {
            return;
        }
        thread::sleep(Duration::from_millis(10));
    }
    panic!("{} threads, not {wanted}", threads());
}

fn fill(run: &Run) -> Geometry {
    let mesh = common::bodies::icosphere(3).mesh();
    let g = Geometry::from_mesh(&mesh, &SdfOptions::default(), run).expect("a geometry");
    let axis: Vec<f64> = (0..24).map(|i| -1.2 + 0.1 * f64::from(i)).collect();
    let lattice = Lattice::new(&axis, &axis, &axis).expect("a lattice");
    query::fill(&g, &lattice, FillMode::Exact, run, &|_, _| {}).expect("a fill");
    g
}

#[test]
fn no_thread_is_started_that_nobody_asked_for() {
    let before = threads();
    fill(&Run::SERIAL);
    assert_eq!(threads(), before);
    let pool = Pool::new(3, || {}).expect("a pool");
    settle_at(before + 2);
    let run = Run { pool: Some(&pool), progress: None };
    fill(&run);
    assert_eq!(threads(), before + 2);
    drop(pool);
    settle_at(before);
}
