// SPDX-License-Identifier: MIT OR Apache-2.0
//! Batches over random trees have the bits of single values, and hand batched callbacks their points together.

use super::same;
use super::trees::{Callback, each};
use crate::common::random::Random;
use embound::geometry::{Blend, BlendFunction, CustomBlend, Function, FunctionOptions, Geometry, Kind};
use embound::math::Vec3;
use embound::parallel::{Pool, Run};
use embound::query::{self, FillMode, Lattice, Strided};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, ThreadId};

fn values(g: &Geometry, p: &[f64], run: &Run) -> Vec<f64> {
    let source = Strided::new(p.len() / 3, [p, &p[1..], &p[2..]], 3).unwrap();
    let out = Mutex::new(vec![f64::NAN; p.len() / 3]);
    query::values(g, &source, run, &|first, found| {
        out.lock().unwrap()[first..first + found.len()].copy_from_slice(found);
    })
    .unwrap();
    out.into_inner().unwrap()
}

pub fn fill(g: &Geometry, lattice: &Lattice, mode: FillMode, run: &Run) -> Vec<f64> {
    let n = lattice.n();
    let out = Mutex::new(vec![f64::NAN; n[0] * n[1] * n[2]]);
    query::fill(g, lattice, mode, run, &|at, found| {
        let first = at[0] + n[0] * (at[1] + n[1] * at[2]);
        out.lock().unwrap()[first..first + found.len()].copy_from_slice(found);
    })
    .unwrap();
    out.into_inner().unwrap()
}

#[test]
fn fills_and_batches_of_random_trees_have_the_bits_of_single_values() {
    let pool = Pool::new(2, || ()).unwrap();
    each(31, 200, |k, g, random| {
        let axis = |random: &mut Random, n: usize| {
            (0..n).map(|i| i as f64 * 0.4 - 1.7 + random.unit() * 0.1).collect::<Vec<f64>>()
        };
        let (x, y, z) = (axis(random, 9), axis(random, 8), axis(random, 6));
        let lattice = Lattice::new(&x, &y, &z).unwrap();
        let points: Vec<f64> = (0..9 * 8 * 6).flat_map(|i| [x[i % 9], y[i / 9 % 8], z[i / 72]]).collect();
        let single: Vec<f64> = points.chunks(3).map(|p| g.value(Vec3::from_slice(p))).collect();
        for run in [Run::SERIAL, Run { pool: Some(&pool), progress: None }] {
            let together = values(g, &points, &run);
            assert!(together.iter().zip(&single).all(|(a, b)| same(*a, *b)), "tree {k}");
            let signs = fill(g, &lattice, FillMode::Sign, &run);
            let sign = |v: f64| f64::from(i8::from(v > 0.0) - i8::from(v < 0.0));
            assert!(signs.iter().zip(&single).all(|(s, v)| *s == sign(*v)), "tree {k}");
            if g.kind() != Kind::SignOnly {
                let filled = fill(g, &lattice, FillMode::Exact, &run);
                assert!(filled.iter().zip(&single).all(|(a, b)| same(*a, *b)), "tree {k}");
            }
        }
    });
}

/// Counts the calls and the points; remembers who called.
#[derive(Default)]
struct Watched {
    batches: AtomicUsize,
    points: AtomicUsize,
    singles: AtomicUsize,
    threads: Mutex<Vec<ThreadId>>,
}

impl Watched {
    fn note(&self) {
        let id = thread::current().id();
        let mut seen = self.threads.lock().unwrap();
        if !seen.contains(&id) {
            seen.push(id);
        }
    }

    fn of(p: Vec3) -> f64 {
        Callback { center: Vec3::ZERO, radius: 1.0, wave: 0.1, ranged: false, batched: true }.value(p)
    }
}

impl Function for Watched {
    fn value(&self, p: Vec3) -> f64 {
        self.note();
        self.singles.fetch_add(1, Ordering::Relaxed);
        Watched::of(p)
    }

    fn values(&self, points: &[Vec3], out: &mut [f64]) {
        self.note();
        self.batches.fetch_add(1, Ordering::Relaxed);
        self.points.fetch_add(points.len(), Ordering::Relaxed);
        points.iter().zip(out).for_each(|(p, v)| *v = Watched::of(*p));
    }

    fn is_batched(&self) -> bool {
        true
    }
}

impl BlendFunction for Watched {
    fn blend(&self, a: f64, b: f64) -> (f64, f64, f64) {
        self.note();
        let h = (0.5 - (b - a)).max(0.0) * 2.0;
        (a - h * h * 0.125, 1.0 - 0.5 * h, 0.5 * h)
    }
}

fn points(count: usize) -> Vec<f64> {
    let mut random = Random(32);
    (0..count).flat_map(|_| random.point([-2.0; 3], [2.0; 3])).collect()
}

#[test]
fn batched_callbacks_under_a_tree_are_called_in_batches() {
    let function = Arc::new(Watched::default());
    let options = FunctionOptions { thread_safe: true, ..FunctionOptions::default() };
    let g = Geometry::function(function.clone(), &options).unwrap();
    let ball = Geometry::sphere([0.5, 0.0, 0.0], 0.7).unwrap();
    let moved = g.rotate([1.0, 0.0, 1.0], 20.0, [0.0; 3]).unwrap().translate([0.1; 3]).unwrap();
    let mapped =
        moved.elongate([0.1, 0.0, 0.0]).unwrap().affine([2.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], [0.0; 3]);
    let shell = mapped.unwrap().offset(0.1).unwrap().annular(0.2).unwrap().part(3).unwrap();
    let both = Geometry::union(&[ball.clone(), shell, ball.translate([1.0; 3]).unwrap()]).unwrap();
    let tree = both.difference(&ball.scale(0.3).unwrap()).unwrap().complement().unwrap();
    let p = points(1000);
    for g in [&g, &tree] {
        function.batches.store(0, Ordering::Relaxed);
        function.points.store(0, Ordering::Relaxed);
        let single: Vec<f64> = p.chunks(3).map(|p| g.value(Vec3::from_slice(p))).collect();
        function.singles.store(0, Ordering::Relaxed);
        let together = values(g, &p, &Run::SERIAL);
        assert!(together.iter().zip(&single).all(|(a, b)| same(*a, *b)));
        assert_eq!(function.singles.load(Ordering::Relaxed), 0);
        assert_eq!(function.points.load(Ordering::Relaxed), 1000);
        assert_eq!(function.batches.load(Ordering::Relaxed), 4);
    }
}

#[test]
fn callbacks_that_are_not_thread_safe_stay_on_the_calling_thread_wherever_they_are() {
    let pool = Pool::new(4, || ()).unwrap();
    let run = Run { pool: Some(&pool), progress: None };
    let ball = Geometry::sphere([0.5, 0.0, 0.0], 0.7).unwrap();
    let function = Arc::new(Watched::default());
    let g = Geometry::function(function.clone(), &FunctionOptions::default()).unwrap();
    let nested =
        Geometry::union(&[ball.clone(), g.rotate([1.0, 0.0, 0.0], 9.0, [0.0; 3]).unwrap().blur(0.1, 0.5).unwrap()]);
    let custom = |thread_safe| {
        Blend::Custom(CustomBlend { function: function.clone(), support: 0.5, depth: 0.5, lipschitz: 1.0, thread_safe })
    };
    let blended = Geometry::smooth_union(&[ball.clone(), ball.translate([0.3; 3]).unwrap()], &custom(false)).unwrap();
    let repeated = blended.repeat([1.0; 3], [2, 1, 2]).unwrap().complement().unwrap();
    assert!(Geometry::smooth_union(&[ball.clone(), ball], &custom(true)).unwrap().is_thread_safe());
    let p = points(20_000);
    for g in [nested.unwrap(), blended, repeated, g.twist(20.0).unwrap()] {
        assert!(!g.is_thread_safe() && g.has_functions() && g.may_fail() && g.fingerprint() == 0);
        function.threads.lock().unwrap().clear();
        values(&g, &p, &run);
        query::intercepts(&g, &p[..6000], &p[6000..12_000], &run, &|_, _| ()).unwrap();
        assert_eq!(*function.threads.lock().unwrap(), [thread::current().id()]);
    }
}
