// SPDX-License-Identifier: MIT OR Apache-2.0
//! The questions, one a file. Batching, dispatch and threading happen here, once per call; nothing is
//! held between calls.
//!
//! Batched questions hand their results over in pieces, `emit(start, results)`: in no given order, each
//! once, possibly from several threads at once.

mod inputs;

pub use inputs::{Lattice, PointSource, Strided};

use crate::error::Result;
use crate::geometry::Geometry;
use crate::math::{Aabb, Vec3};
use crate::parallel::Run;

/// What a fill writes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FillMode {
    /// The value.
    Exact,
    /// The value where its magnitude is below the band, plus or minus the band elsewhere.
    Band(f64),
    /// -1, 0 or +1.
    Sign,
}

/// The answer to [`closest`].
#[derive(Clone, Copy, Debug)]
pub struct Closest {
    pub value: f64,
    pub point: Vec3,
    pub gradient: Vec3,
    pub barycentric: Vec3,
    pub primitive: i64,
    pub part: i32,
    pub tag: i32,
    pub feature: i32,
}

/// The answer to [`intercepts`].
#[derive(Clone, Copy, Debug)]
pub struct Intercept {
    /// 0 at a, 1 at b; NaN where the ends are on one side.
    pub t: f64,
    pub count: i32,
    /// 0 none, 1 ray, 2 several, 3 bisected.
    pub status: i32,
    pub normal: Vec3,
    pub primitive: i64,
    pub part: i32,
    pub tag: i32,
}

/// How a crossing is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CrossingForm {
    /// The coordinate along the axis.
    Coordinate,
    /// 0 at the lattice point, 1 at its neighbour.
    Fraction,
}

/// The answer to [`crossings`].
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// NaN where the ends are on one side.
    pub at: f64,
    pub count: i32,
    pub tag: i32,
    pub part: i32,
}

/// Values at points.
pub fn values(
    _g: &Geometry,
    _points: &dyn PointSource,
    _run: &Run,
    _emit: &(dyn Fn(usize, &[f64]) + Sync),
) -> Result<()> {
    todo!()
}

pub fn closest(
    _g: &Geometry,
    _points: &dyn PointSource,
    _max_distance: f64,
    _run: &Run,
    _emit: &(dyn Fn(usize, &[Closest]) + Sync),
) -> Result<()> {
    todo!()
}

/// `emit([i, j, k], values)`: values at (i, j, k), (i+1, j, k), ...
pub fn fill(
    _g: &Geometry,
    _lattice: &Lattice,
    _mode: FillMode,
    _run: &Run,
    _emit: &(dyn Fn([usize; 3], &[f64]) + Sync),
) -> Result<()> {
    todo!()
}

/// `emit([i, j, k], crossings)`: of the edges that begin at (i, j, k), (i+1, j, k), ...
pub fn crossings(
    _g: &Geometry,
    _lattice: &Lattice,
    _axis: usize,
    _form: CrossingForm,
    _run: &Run,
    _emit: &(dyn Fn([usize; 3], &[Crossing]) + Sync),
) -> Result<()> {
    todo!()
}

/// Crossings of the segments a[3i..3i+3] to b[3i..3i+3].
pub fn intercepts(
    _g: &Geometry,
    _a: &[f64],
    _b: &[f64],
    _run: &Run,
    _emit: &(dyn Fn(usize, &[Intercept]) + Sync),
) -> Result<()> {
    todo!()
}

/// -1: value < 0 at every double of the closed box; +1: value > 0; 0: mixed, or not known, or the box is not valid.
pub fn classify_box(_g: &Geometry, _b: Aabb) -> i32 {
    todo!()
}

/// [`classify_box`] of the boxes lo[3i..3i+3], hi[3i..3i+3]; NaN or lo > hi is an error naming the box.
pub fn classify_boxes(
    _g: &Geometry,
    _lo: &[f64],
    _hi: &[f64],
    _run: &Run,
    _emit: &(dyn Fn(usize, &[i32]) + Sync),
) -> Result<()> {
    todo!()
}
