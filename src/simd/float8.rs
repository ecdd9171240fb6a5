// SPDX-License-Identifier: MIT OR Apache-2.0
//! Eight f32 as a processor's own vectors, for filters: what the compiler makes of loops over arrays is not to be
//! relied on where lanes come together. Nothing of it reaches an answer, so levels need not agree to the bit, though
//! they do.

use super::Kernel;
use super::lanes::{F32x8, I32x8, WIDTH};

/// A rounding of an f32, relative.
const ROUNDING: f64 = f32::EPSILON as f64 / 2.0;

/// How far rounding to f32 moves two points from each other, one of them with coordinates up to `largest`, the other
/// up to one: at most the root of three times their sum, here with room for the rounding of f64 beside it.
pub(crate) fn slack(largest: f64) -> f32 {
    (2.5 * ROUNDING * (1.0 + largest)) as f32
}

/// What a level can do. A value of the type is the proof that the processor can.
pub(crate) trait Simd: Copy {
    type Float: Float8<Self>;
    /// Runs a kernel in a function of its own of this level. What is large or in several places goes here: inlined
    /// again and again it would grow beyond what a compiler takes in its stride.
    fn apart<K: Kernel>(self, kernel: K) -> K::Output;
}

/// Eight f32.
pub(crate) trait Float8<S>: Copy {
    type Keys: Keys8;
    fn load(simd: S, lanes: &[f32; WIDTH]) -> Self;
    fn splat(simd: S, x: f32) -> Self;
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    /// The greater; the second where one is NaN.
    fn max(self, other: Self) -> Self;
    /// The lesser; the second where one is NaN.
    fn min(self, other: Self) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// Zero in the lanes where `other` is positive.
    fn zero_where_positive(self, other: Self) -> Self;
    /// The least lane; NaN where there is one at an unlucky place.
    fn least(self) -> f32;
    /// A bit for each lane that is not greater than `limit`, NaN included.
    fn not_above(self, limit: f32) -> u32;
    fn lanes(self) -> [f32; WIDTH];
    /// The upper four lanes first.
    fn swapped(self) -> Self;
    /// The sums of lanes four apart, without what is behind the point, and none below zero or above `last`.
    fn bins(self, last: i32) -> [i32; WIDTH / 2];
    /// Positive numbers, as integers in their order with the lane in the last three bits; the greatest where there is no
    /// child.
    fn keys(self, child: &[u32; WIDTH]) -> Self::Keys;
    /// The same, but minus one minus the bits of `below` where that is positive.
    fn signed_keys(self, below: Self, child: &[u32; WIDTH]) -> Self::Keys;
}

/// Eight i32 to be ordered.
pub(crate) trait Keys8: Copy {
    fn at_most(self, limit: i32) -> u32;
    fn least(self) -> i32;
    /// Of keys, as [`Float8::keys`] makes them, those in `lanes`, of which there is one at least, but for the least: writes
    /// them in falling order, with their children; how many. The rest of `keys` and `children` is left in any state.
    fn others(self, lanes: u32, child: &[u32; WIDTH], keys: &mut [i32; WIDTH], children: &mut [u32; WIDTH]) -> usize;
}

/// The last bits of a key, which hold the lane.
pub(crate) const LANE: i32 = WIDTH as i32 - 1;

/// Of no level: loops over arrays.
#[derive(Clone, Copy)]
pub(crate) struct Plain;

impl Simd for Plain {
    type Float = F32x8;

    #[inline(never)]
    fn apart<K: Kernel>(self, kernel: K) -> K::Output {
        kernel.run(self)
    }
}

impl Float8<Plain> for F32x8 {
    type Keys = I32x8;

    #[inline(always)]
    fn load(_: Plain, lanes: &[f32; WIDTH]) -> F32x8 {
        F32x8(*lanes)
    }

    #[inline(always)]
    fn splat(_: Plain, x: f32) -> F32x8 {
        F32x8([x; WIDTH])
    }

    #[inline(always)]
    fn add(self, other: F32x8) -> F32x8 {
        self.zip(other, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(self, other: F32x8) -> F32x8 {
        self.zip(other, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(self, other: F32x8) -> F32x8 {
        self.zip(other, |a, b| a * b)
    }

    #[inline(always)]
    fn max(self, other: F32x8) -> F32x8 {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn min(self, other: F32x8) -> F32x8 {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn sqrt(self) -> F32x8 {
        self.zip(self, |a, _| a.sqrt())
    }

    #[inline(always)]
    fn abs(self) -> F32x8 {
        self.zip(self, |a, _| a.abs())
    }

    #[inline(always)]
    fn zero_where_positive(self, other: F32x8) -> F32x8 {
        self.zip(other, |a, b| if b > 0.0 { 0.0 } else { a })
    }

    #[inline(always)]
    fn least(self) -> f32 {
        let min = |a: f32, b: f32| if a < b { a } else { b };
        let half: [f32; WIDTH / 2] = [0, 1, 2, 3].map(|k| min(self.0[k], self.0[k + WIDTH / 2]));
        min(min(half[0], half[2]), min(half[1], half[3]))
    }

    #[inline(always)]
    fn not_above(self, limit: f32) -> u32 {
        let mut bits = 0;
        for k in 0..WIDTH {
            let is_above = self.0[k] > limit;
            bits |= u32::from(!is_above) << k;
        }
        bits
    }

    #[inline(always)]
    fn lanes(self) -> [f32; WIDTH] {
        self.0
    }

    #[inline(always)]
    fn swapped(self) -> F32x8 {
        let mut lanes = self.0;
        lanes.rotate_left(WIDTH / 2);
        F32x8(lanes)
    }

    #[inline(always)]
    fn bins(self, last: i32) -> [i32; WIDTH / 2] {
        let mut bins = [0; WIDTH / 2];
        for k in 0..WIDTH / 2 {
            bins[k] = ((self.0[k] + self.0[k + WIDTH / 2]) as i32).clamp(0, last);
        }
        bins
    }

    #[inline(always)]
    fn keys(self, child: &[u32; WIDTH]) -> I32x8 {
        self.signed_keys(F32x8([0.0; WIDTH]), child)
    }

    #[inline(always)]
    fn signed_keys(self, below: F32x8, child: &[u32; WIDTH]) -> I32x8 {
        let mut keys = [0; WIDTH];
        for k in 0..WIDTH {
            let (above, below) = (self.0[k].to_bits() as i32, below.0[k].to_bits() as i32);
            let key = if below != 0 { !below } else { above };
            keys[k] = if child[k] == u32::MAX { i32::MAX } else { (key & !LANE) | k as i32 };
        }
        I32x8(keys)
    }
}

impl Keys8 for I32x8 {
    #[inline(always)]
    fn at_most(self, limit: i32) -> u32 {
        let mut bits = 0;
        for k in 0..WIDTH {
            bits |= u32::from(self.0[k] <= limit) << k;
        }
        bits
    }

    #[inline(always)]
    fn least(self) -> i32 {
        self.0.into_iter().fold(i32::MAX, i32::min)
    }

    #[inline(always)]
    fn others(self, lanes: u32, child: &[u32; WIDTH], keys: &mut [i32; WIDTH], children: &mut [u32; WIDTH]) -> usize {
        let (mut count, least) = (0, self.least());
        for (k, &key) in self.0.iter().enumerate().filter(|(k, key)| lanes >> k & 1 == 1 && **key != least) {
            let mut i = count;
            while i > 0 && keys[i - 1] < key {
                (keys[i], children[i]) = (keys[i - 1], children[i - 1]);
                i -= 1;
            }
            (keys[i], children[i]) = (key, child[k]);
            count += 1;
        }
        count
    }
}
