// SPDX-License-Identifier: MIT OR Apache-2.0
//! Batches: the bits of single values, whatever the threads; modes, progress, failure.

mod common;

use common::random::Random;
use common::{bodies, points};
use embound::Status;
use embound::geometry::{Function, FunctionOptions, Geometry, SdfOptions};
use embound::math::Vec3;
use embound::parallel::{Executor, Pool, Run};
use embound::query::{self, FillMode, Lattice, Strided};
use std::sync::Arc;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::ThreadId;

fn scene() -> Geometry {
    let part = Geometry::from_mesh(&bodies::torus(1.0, 0.3, 24, 12).mesh(), &SdfOptions::default(), &Run::SERIAL);
    Geometry::union(&[part.unwrap(), Geometry::sphere([0.2, 0.1, 0.9], 0.4).unwrap()]).unwrap()
}

fn values(g: &Geometry, p: &[f64], run: &Run) -> embound::Result<Vec<f64>> {
    let source = Strided::new(p.len() / 3, [p, &p[1..], &p[2..]], 3)?;
    let out = Mutex::new(vec![f64::NAN; p.len() / 3]);
    query::values(g, &source, run, &|first, found| {
        out.lock().unwrap()[first..first + found.len()].copy_from_slice(found);
    })?;
    Ok(out.into_inner().unwrap())
}

fn fill(g: &Geometry, lattice: &Lattice, mode: FillMode, run: &Run) -> embound::Result<Vec<f64>> {
    let n = lattice.n();
    let out = Mutex::new(vec![f64::NAN; n[0] * n[1] * n[2]]);
    query::fill(g, lattice, mode, run, &|at, found| {
        let first = at[0] + n[0] * (at[1] + n[1] * at[2]);
        out.lock().unwrap()[first..first + found.len()].copy_from_slice(found);
    })?;
    Ok(out.into_inner().unwrap())
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|v| v.to_bits()).collect()
}

/// Runs its tasks backwards on this thread, the first one twice.
struct Backwards;

impl Executor for Backwards {
    fn run(&self, tasks: usize, task: &(dyn Fn(usize) + Sync)) {
        (0..tasks).rev().for_each(task);
        task(0);
    }
}

/// Runs nothing at all.
struct Idle;

impl Executor for Idle {
    fn run(&self, _: usize, _: &(dyn Fn(usize) + Sync)) {}
}

#[test]
fn any_pool_gives_the_bits_of_single_values() {
    let g = scene();
    let mut random = Random(31);
    let p = points::uniform(&bodies::torus(1.0, 0.3, 24, 12), 1.5, 5000, &mut random).concat();
    let single: Vec<f64> = p.chunks(3).map(|p| g.value(Vec3::from_slice(p))).collect();
    let pools = [
        Pool::new(1, || ()).unwrap(),
        Pool::new(2, || ()).unwrap(),
        Pool::new(5, || ()).unwrap(),
        Pool::from_executor(3, Box::new(Backwards)).unwrap(),
        Pool::from_executor(3, Box::new(Idle)).unwrap(),
    ];
    assert_eq!(bits(&values(&g, &p, &Run::SERIAL).unwrap()), bits(&single));
    for pool in &pools {
        let run = Run { pool: Some(pool), progress: None };
        assert_eq!(bits(&values(&g, &p, &run).unwrap()), bits(&single));
    }
}

#[test]
fn a_fill_has_the_bits_of_values_on_any_lattice() {
    let g = scene();
    // Unequal cells, a falling axis, a repeat, and a plane.
    let x: Vec<f64> = (0..300).map(|i| -1.5 + 0.01 * i as f64).collect();
    let y = [1.4, 0.3, 0.3, -0.2, -1.25];
    let z = [0.0, 0.45];
    let pool = Pool::new(2, || ()).unwrap();
    for z in [&z[..], &z[..1]] {
        let lattice = Lattice::new(&x, &y, z).unwrap();
        for run in [Run::SERIAL, Run { pool: Some(&pool), progress: None }] {
            let exact = fill(&g, &lattice, FillMode::Exact, &run).unwrap();
            let band = fill(&g, &lattice, FillMode::Band(0.2), &run).unwrap();
            let sign = fill(&g, &lattice, FillMode::Sign, &run).unwrap();
            for (k, value) in exact.iter().enumerate() {
                let p = Vec3::new(x[k % 300], y[k / 300 % 5], z[k / 1500]);
                assert_eq!(value.to_bits(), g.value(p).to_bits());
                assert_eq!(band[k], if value.abs() < 0.2 { *value } else { 0.2f64.copysign(*value) });
                assert_eq!(sign[k], f64::from(i8::from(*value > 0.0) - i8::from(*value < 0.0)));
            }
        }
    }
    let empty = Lattice::new(&x, &[], &z).unwrap();
    assert!(fill(&g, &empty, FillMode::Exact, &Run::SERIAL).unwrap().is_empty());
}

#[test]
fn lattices_and_modes_that_make_no_sense_are_refused() {
    for (x, text) in [(vec![0.0, f64::NAN], "lattice.x[1]: NaN"), (vec![0.0, 1.0, 0.5], "lattice.x[2]: 0.5 after 1")] {
        let error = Lattice::new(&x, &[0.0], &[0.0]).err().expect("refused");
        assert!(error.message().contains(text), "{error}");
    }
    let lattice = Lattice::new(&[0.0], &[0.0], &[0.0]).unwrap();
    for band in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = fill(&scene(), &lattice, FillMode::Band(band), &Run::SERIAL).unwrap_err();
        assert!(error.status() == Status::InvalidArgument && error.message().starts_with("band: "));
    }
    let sign_only = Geometry::function(Arc::new(Flaky(usize::MAX.into())), &FunctionOptions::default()).unwrap();
    assert_eq!(fill(&sign_only, &lattice, FillMode::Exact, &Run::SERIAL).unwrap_err().status(), Status::Unsupported);
    assert_eq!(fill(&sign_only, &lattice, FillMode::Sign, &Run::SERIAL).unwrap(), [1.0]);
}

/// Answers 1 so many times, then fails.
struct Flaky(AtomicUsize);

impl Function for Flaky {
    fn value(&self, _: Vec3) -> f64 {
        let left = self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |n| n.checked_sub(1));
        if left.is_ok() { 1.0 } else { f64::NAN }
    }
}

#[test]
fn a_function_that_fails_fails_the_batch() {
    let pool = Pool::new(2, || ()).unwrap();
    for run in [Run::SERIAL, Run { pool: Some(&pool), progress: None }] {
        let options = FunctionOptions { thread_safe: true, ..FunctionOptions::default() };
        let g = Geometry::function(Arc::new(Flaky(1000.into())), &options).unwrap();
        let error = values(&g, &vec![0.5; 3 * 3000], &run).unwrap_err();
        assert_eq!(error.status(), Status::Callback);
        assert!(error.message().contains("0.5"), "{error}");
    }
}

/// Remembers who called it.
struct Callers(Mutex<Vec<ThreadId>>);

impl Function for Callers {
    fn value(&self, p: Vec3) -> f64 {
        let mut seen = self.0.lock().unwrap();
        let id = std::thread::current().id();
        if !seen.contains(&id) {
            seen.push(id);
        }
        p.x
    }
}

#[test]
fn a_function_that_is_not_thread_safe_stays_on_the_calling_thread() {
    let pool = Pool::new(4, || ()).unwrap();
    let callers = Arc::new(Callers(Mutex::default()));
    let g = Geometry::function(callers.clone(), &FunctionOptions::default()).unwrap();
    let g = Geometry::union(&[g, scene()]).unwrap();
    values(&g, &vec![0.5; 3 * 20_000], &Run { pool: Some(&pool), progress: None }).unwrap();
    assert_eq!(*callers.0.lock().unwrap(), [std::thread::current().id()]);
}

#[test]
fn progress_stays_on_the_calling_thread_and_can_stop() {
    let g = scene();
    let pool = Pool::new(3, || ()).unwrap();
    let here = std::thread::current().id();
    let told = Mutex::new(Vec::new());
    let listen = |fraction: f64| {
        assert_eq!(std::thread::current().id(), here);
        told.lock().unwrap().push(fraction);
        false
    };
    let p = vec![0.25; 3 * 50_000];
    values(&g, &p, &Run { pool: Some(&pool), progress: Some(&listen) }).unwrap();
    let told = told.into_inner().unwrap();
    assert!(told.windows(2).all(|w| w[0] < w[1]) && told.last() == Some(&1.0), "{told:?}");
    let stop = |fraction: f64| fraction > 0.25;
    let error = values(&g, &p, &Run { pool: Some(&pool), progress: Some(&stop) }).unwrap_err();
    assert_eq!(error.status(), Status::Cancelled);
}

#[test]
fn calls_from_within_a_pools_own_tasks_do_not_deadlock() {
    let g = scene();
    let pool = Pool::new(2, || ()).unwrap();
    let run = Run { pool: Some(&pool), progress: None };
    let p = vec![0.25; 3 * 2000];
    let expected = bits(&values(&g, &p, &Run::SERIAL).unwrap());
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                run.for_each_chunk(8, &|_| {
                    assert_eq!(bits(&values(&g, &p, &run)?), expected);
                    Ok(())
                })
                .unwrap();
            });
        }
    });
}
