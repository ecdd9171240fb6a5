// SPDX-License-Identifier: MIT OR Apache-2.0
//! Least and greatest sample in boxes of a tensor grid, through a pyramid of blocks (Williams 1983).

use crate::error::{Result, try_with_capacity};
use crate::math::Interval;
use crate::store::{Array, Packer, Unpacker, wrong};

/// Blocks on an edge of a block of the level above.
const SIDE: usize = 4;

/// A box of samples: from the first index to the last, both of them in it.
pub(super) type Span = [(usize, usize); 3];

/// The range of every block of every level; the samples themselves stay with their owner.
pub(super) struct Pyramid {
    /// Level 0: blocks of samples. The last level is one block.
    levels: Vec<Level>,
    /// How many samples, along each axis.
    n: [usize; 3],
}

struct Level {
    n: [usize; 3],
    ranges: Array<Interval>,
}

/// Where a box of a tensor grid is in its array, x fastest.
fn at(n: [usize; 3], i: [usize; 3]) -> usize {
    (i[2] * n[1] + i[1]) * n[0] + i[0]
}

/// Around no number: for hulls to begin with.
const NONE: Interval = Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY };

fn grown(range: Interval, x: f64) -> Interval {
    range.hull(Interval { lo: x, hi: x })
}

/// Calls `visit` for every index in the span, x fastest.
pub(super) fn each(span: Span, mut visit: impl FnMut([usize; 3])) {
    let [x, y, z] = span;
    for k in z.0..z.1 + 1 {
        for j in y.0..y.1 + 1 {
            for i in x.0..x.1 + 1 {
                visit([i, j, k]);
            }
        }
    }
}

/// The boxes of the level below that make up block `i`.
fn inside(i: [usize; 3], below: [usize; 3]) -> Span {
    std::array::from_fn(|k| (i[k] * SIDE, (i[k] * SIDE + SIDE).min(below[k]) - 1))
}

impl Pyramid {
    /// Of `n[0] * n[1] * n[2]` samples, x fastest. O(samples).
    pub(super) fn new(n: [usize; 3], samples: &[f64]) -> Result<Pyramid> {
        let mut levels: Vec<Level> = Vec::new();
        loop {
            let below = levels.last().map_or(n, |level| level.n);
            let blocks = below.map(|n| n.div_ceil(SIDE));
            let mut ranges = try_with_capacity("ranges", blocks.iter().product())?;
            each(blocks.map(|n| (0, n - 1)), |block| {
                let mut range = NONE;
                each(inside(block, below), |i| match levels.last() {
                    None => range = grown(range, samples[at(n, i)]),
                    Some(level) => range = range.hull(level.ranges[at(below, i)]),
                });
                ranges.push(range);
            });
            levels.push(Level { n: blocks, ranges: ranges.into() });
            if blocks == [1; 3] {
                return Ok(Pyramid { levels, n });
            }
        }
    }

    pub(super) fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        self.levels.iter().for_each(|level| out.array(&level.ranges));
    }

    /// Samples, of which there are at least two along some axis, and what was found of them.
    pub(super) fn unpack(from: &mut Unpacker, n: [usize; 3]) -> Result<(Array<f64>, Pyramid)> {
        let count = n.iter().try_fold(1usize, |count, &n| count.checked_mul(n));
        let samples = from.array_of::<f64>("samples", count.ok_or_else(|| wrong("a grid is too large"))?)?;
        let mut pyramid = Pyramid { levels: Vec::new(), n };
        while pyramid.levels.last().is_none_or(|level| level.n != [1; 3]) {
            let blocks = pyramid.levels.last().map_or(n, |level| level.n).map(|n| n.div_ceil(SIDE));
            let ranges = from.array_of("ranges", blocks.iter().product())?;
            pyramid.levels.push(Level { n: blocks, ranges });
        }
        if from.checks() {
            let anew = Pyramid::new(n, &samples)?;
            let mut pairs = anew.levels.iter().zip(&pyramid.levels);
            if !samples.iter().all(|x| x.is_finite()) || !pairs.all(|(a, b)| a.ranges[..] == b.ranges[..]) {
                return Err(wrong("a grid holds what is no number, or ranges of others"));
            }
        }
        Ok((samples, pyramid))
    }

    /// The least and the greatest of all samples.
    pub(super) fn all(&self) -> Interval {
        self.levels.last().map_or(NONE, |top| top.ranges[0])
    }

    /// The least and the greatest sample in the span, `NONE` joined with `known`. Blocks across the span's
    /// border are opened only where they can add something: O(border) at worst, O(log n) as a rule.
    pub(super) fn range(&self, samples: &[f64], span: Span, known: Interval) -> Interval {
        let mut found = known;
        self.descend(samples, span, self.levels.len() - 1, [0; 3], &mut found);
        found
    }

    /// Recurses once a level: 32 deep at most.
    fn descend(&self, samples: &[f64], span: Span, level: usize, block: [usize; 3], found: &mut Interval) {
        let range = self.levels[level].ranges[at(self.levels[level].n, block)];
        if range.lo >= found.lo && range.hi <= found.hi {
            return;
        }
        let size = SIDE.pow(level as u32 + 1);
        let covers = (0..3).all(|k| {
            let first = block[k] * size;
            span[k].0 <= first && (first + size).min(self.n[k]) - 1 <= span[k].1
        });
        if covers {
            *found = found.hull(range);
            return;
        }
        let below = if level == 0 { self.n } else { self.levels[level - 1].n };
        let parts = inside(block, below);
        // Only the parts that meet the span.
        let unit = size / SIDE;
        let parts: Span = std::array::from_fn(|k| (parts[k].0.max(span[k].0 / unit), parts[k].1.min(span[k].1 / unit)));
        each(parts, |i| match level {
            0 => *found = grown(*found, samples[at(self.n, i)]),
            _ => self.descend(samples, span, level - 1, i, found),
        });
    }

    /// Memory on the heap.
    pub(super) fn bytes(&self) -> usize {
        self.levels.iter().map(|level| size_of_val(&level.ranges[..])).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_range_is_that_of_every_sample(n in [1usize..40, 1usize..20, 1usize..7], seed in any::<u64>()) {
            let mut state = seed | 1;
            let mut random = || {
                state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                (state >> 33) as usize
            };
            let samples: Vec<f64> = (0..n.iter().product()).map(|_| random() as f64).collect();
            let pyramid = Pyramid::new(n, &samples).unwrap();
            for _ in 0..30 {
                let span = n.map(|n| { let (a, b) = (random() % n, random() % n); (a.min(b), a.max(b)) });
                let mut plain = NONE;
                each(span, |i| plain = grown(plain, samples[at(n, i)]));
                prop_assert_eq!(pyramid.range(&samples, span, NONE), plain);
            }
            prop_assert_eq!(pyramid.range(&samples, n.map(|n| (0, n - 1)), NONE), pyramid.all());
        }
    }
}
