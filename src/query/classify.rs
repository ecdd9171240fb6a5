// SPDX-License-Identifier: MIT OR Apache-2.0
//! Boxes wholly inside, wholly outside, or neither.

use super::{in_chunks, suited};
use crate::error::{Error, Result};
use crate::geometry::Geometry;
use crate::math::{Aabb, Vec3};
use crate::parallel::Run;

/// -1: the value is < 0 at every double of the closed box, rounding included; +1: > 0; 0: mixed, or not
/// known, or not a box (NaN, lo > hi). `lo == hi` is legal.
pub fn classify_box(g: &Geometry, b: Aabb) -> i32 {
    g.classify(b)
}

/// [`classify_box`] of many boxes: corner d of box i is `lo[3 * i + d]`, `hi[3 * i + d]`. NaN or lo > hi is
/// an error that names the box.
pub fn classify_boxes(
    g: &Geometry,
    lo: &[f64],
    hi: &[f64],
    run: &Run,
    emit: &(dyn Fn(usize, &[i32]) + Sync),
) -> Result<()> {
    if lo.len() != hi.len() || !lo.len().is_multiple_of(3) {
        return Err(Error::invalid(format!("lo, hi: {} and {} numbers are not three a box", lo.len(), hi.len())));
    }
    if let Some(at) = lo.iter().zip(hi).position(|(a, b)| a > b || a.is_nan() || b.is_nan()) {
        return Err(Error::invalid(format!("box {}: lo {} to hi {} is no range", at / 3, lo[at], hi[at])));
    }
    in_chunks(&suited(g, run), lo.len() / 3, &|first, count| {
        let corner = |x: &[f64], i: usize| Vec3::from_slice(&x[3 * i..3 * i + 3]);
        let classes: Vec<i32> =
            (first..first + count).map(|i| g.classify(Aabb::new(corner(lo, i), corner(hi, i)))).collect();
        emit(first, &classes);
        Ok(())
    })
}
