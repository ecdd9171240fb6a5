// SPDX-License-Identifier: MIT OR Apache-2.0
//! The coordinates of one axis of a lattice in rising order, and which of them lie where.

use crate::error::{Result, try_copy, try_with_capacity};
use std::ops::Range;

/// Coordinates in rising order. Indices into it are turned back where the caller's fall.
pub(crate) struct Axis {
    at: Vec<f64>,
    falls: bool,
    /// Buckets of equal width hold the coordinates from one start to the next. The bucket of a number rises with it,
    /// rounding included, so what is looked for lies in its own bucket or at the start of the next.
    start: Vec<u32>,
    low: f64,
    per_width: f64,
}

impl Axis {
    /// Of finite coordinates that rise or fall, repeats allowed; fewer than 2^30.
    pub(super) fn new(given: &[f64]) -> Result<Axis> {
        let falls = given.first() > given.last();
        let mut at = try_copy("axis", given)?;
        if falls {
            at.reverse();
        }
        let (low, high) = (at.first().copied().unwrap_or(0.0), at.last().copied().unwrap_or(0.0));
        let buckets = 2 * at.len();
        let per_width = buckets as f64 / (high - low);
        let per_width = if per_width.is_finite() && (high - low).is_finite() { per_width } else { 0.0 };
        let mut axis = Axis { at, falls, start: Vec::new(), low, per_width };
        let mut start = try_with_capacity("axis", buckets + 2)?;
        start.push(0);
        for (k, c) in axis.at.iter().enumerate() {
            let bucket = axis.bucket(*c, buckets);
            while start.len() <= bucket {
                start.push(k as u32);
            }
        }
        start.resize(buckets + 2, axis.at.len() as u32);
        axis.start = start;
        Ok(axis)
    }

    #[inline(always)]
    fn bucket(&self, x: f64, buckets: usize) -> usize {
        // A conversion to 32 bits costs less than one to 64.
        (((x - self.low) * self.per_width) as i32).clamp(0, buckets as i32) as usize
    }

    pub(crate) fn len(&self) -> usize {
        self.at.len()
    }

    #[inline(always)]
    pub(crate) fn at(&self, k: usize) -> f64 {
        self.at[k]
    }

    /// The caller's index of a coordinate.
    #[inline(always)]
    pub(crate) fn given(&self, k: usize) -> usize {
        if self.falls { self.at.len() - 1 - k } else { k }
    }

    /// The caller's index of the step from coordinate `k` to the next.
    #[inline(always)]
    pub(crate) fn given_step(&self, k: usize) -> usize {
        if self.falls { self.at.len() - 2 - k } else { k }
    }

    #[inline(always)]
    fn first(&self, x: f64, is_before: impl Fn(f64) -> bool) -> usize {
        let bucket = self.bucket(x, self.start.len() - 2);
        let (mut from, to) = (self.start[bucket] as usize, self.start[bucket + 1] as usize);
        if to - from > 8 {
            return from + self.at[from..to].partition_point(|c| is_before(*c));
        }
        while from < to && is_before(self.at[from]) {
            from += 1;
        }
        from
    }

    /// The first coordinate that is at least `x`.
    #[inline(always)]
    pub(crate) fn not_below(&self, x: f64) -> usize {
        self.first(x, |c| c < x)
    }

    /// The first coordinate above `x`.
    #[inline(always)]
    pub(crate) fn above(&self, x: f64) -> usize {
        self.first(x, |c| c <= x)
    }

    /// The coordinates within [low, high].
    #[inline(always)]
    pub(crate) fn within(&self, low: f64, high: f64) -> Range<usize> {
        self.not_below(low)..self.above(high)
    }
}

impl Axis {
    /// A range without what is too low or too high in it.
    #[inline(always)]
    pub(super) fn narrowed(
        &self,
        range: &Range<usize>,
        is_low: impl Fn(f64) -> bool,
        is_high: impl Fn(f64) -> bool,
    ) -> Range<usize> {
        let Range { mut start, mut end } = *range;
        while start < end && is_low(self.at[start]) {
            start += 1;
        }
        while start < end && is_high(self.at[end - 1]) {
            end -= 1;
        }
        start..end
    }
}

/// What two ranges have in common.
#[inline(always)]
pub(super) fn common(a: &Range<usize>, b: &Range<usize>) -> Range<usize> {
    let (start, end) = (a.start.max(b.start), a.end.min(b.end));
    start..end.max(start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_looked_for_is_found_on_even_uneven_and_repeating_axes() {
        let even: Vec<f64> = (0..50).map(|k| 0.1 * f64::from(k) - 2.0).collect();
        let uneven: Vec<f64> = (0..50).map(|k| f64::from(k * k * k)).collect();
        let repeating = vec![1.0, 1.0, 1.0, 2.0, 2.0, 7.0, 7.0];
        let wide = vec![-1e308, -1.0, 0.0, 0.0, 1e-300, 3.0, 1e308];
        let falling: Vec<f64> = even.iter().rev().copied().collect();
        for given in [even, uneven, repeating, wide, falling, vec![], vec![3.0], vec![2.0; 9], vec![0.0, 5e-324]] {
            let axis = Axis::new(&given).unwrap();
            let mut rising = given.clone();
            rising.sort_by(f64::total_cmp);
            let beside = rising.iter().flat_map(|c| [*c, c.next_up(), c.next_down(), c + 0.05, 2.0 * c]);
            for x in beside.chain([-f64::INFINITY, f64::INFINITY, 0.0]) {
                assert_eq!(axis.not_below(x), rising.partition_point(|c| *c < x), "{x}");
                assert_eq!(axis.above(x), rising.partition_point(|c| *c <= x), "{x}");
            }
            for k in 0..given.len() {
                assert_eq!(given[axis.given(k)], axis.at(k));
            }
        }
    }
}
