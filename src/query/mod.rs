// SPDX-License-Identifier: MIT OR Apache-2.0
//! The questions, one a file. Batching, dispatch and threading happen here, once per call; nothing is
//! held between calls.
//!
//! Batched questions hand their results over in pieces, `emit(start, results)`: in no given order, each
//! result once, possibly from several threads at once. Points with a coordinate that is not finite are
//! answered with NaN. Where a user's function fails (NaN at a finite point) a batch is
//! [`Status::Callback`]; a function that is not thread-safe keeps the whole call on the calling thread.

mod bounding;
mod classify;
mod closest;
mod diagnose;
mod faces;
mod fill;
mod inputs;
mod intercept;
mod order;
mod rays;
mod scanned_band;
mod scanned_crossings;
mod scanned_signs;
mod sides;
mod tiles;
mod values;

pub use crate::geometry::{Closest, RayHit};
pub use bounding::{Bounding, bounding_box, bounding_sphere};
pub use classify::{classify_box, classify_boxes};
pub use closest::closest;
pub use diagnose::diagnose;
pub use faces::{faces_overlapping, faces_within};
pub use fill::{FillMode, fill, fill_signs};
pub use inputs::{Lattice, PointSource, Strided};
pub use intercept::{Crossing, CrossingForm, EmitCrossings, Intercept, crossings, intercepts};
pub use rays::{Rays, all_hits, count_hits, first_hits};
pub use values::values;

use crate::error::{Error, Result, Status};
use crate::geometry::Geometry;
use crate::math::Vec3;
use crate::parallel::Run;
use std::ops::Range;

/// Items of a chunk of work.
const CHUNK: usize = 256;

/// `run`, without its pool where the geometry must be asked from one thread.
fn suited<'a>(g: &Geometry, run: &Run<'a>) -> Run<'a> {
    if g.is_thread_safe() { *run } else { run.on_this_thread() }
}

/// An error where a user's function failed.
fn check(g: &Geometry, value: f64, p: Vec3) -> Result<()> {
    if value.is_nan() && g.may_fail() && p.is_finite() {
        return Err(Error::new(
            Status::Callback,
            format!("geometry: a function has no value (NaN) at ({}, {}, {})", p.x, p.y, p.z),
        ));
    }
    Ok(())
}

/// Chunks of up to `CHUNK` items: `work(first, count)`.
fn in_chunks(run: &Run, count: usize, work: &(dyn Fn(usize, usize) -> Result<()> + Sync)) -> Result<()> {
    run.for_each_chunk(count.div_ceil(CHUNK), &|k| work(k * CHUNK, CHUNK.min(count - k * CHUNK)))
}

/// Blocks of a lattice of `n` points or edges, up to `most` along each axis.
fn in_blocks(
    run: &Run,
    n: [usize; 3],
    most: [usize; 3],
    work: &(dyn Fn(&[Range<usize>; 3]) -> Result<()> + Sync),
) -> Result<()> {
    let count = [0, 1, 2].map(|axis| n[axis].div_ceil(most[axis]));
    run.for_each_chunk(count[0] * count[1] * count[2], &|chunk| {
        let at = [chunk % count[0], chunk / count[0] % count[1], chunk / count[0] / count[1]];
        work(&[0, 1, 2].map(|axis| at[axis] * most[axis]..n[axis].min((at[axis] + 1) * most[axis])))
    })
}

/// The same over the points of a source.
fn at_points(run: &Run, points: &dyn PointSource, work: &(dyn Fn(usize, &[Vec3]) -> Result<()> + Sync)) -> Result<()> {
    in_chunks(run, points.count(), &|first, count| {
        let mut p = [Vec3::ZERO; CHUNK];
        points.load(first, &mut p[..count]);
        work(first, &p[..count])
    })
}
