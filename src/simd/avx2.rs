// SPDX-License-Identifier: MIT OR Apache-2.0
//! Entry point for AVX2, and its vectors of eight f32.

use super::Kernel;
use super::float8::{Float8, Keys8, LANE, Simd};
use super::lanes::WIDTH;
use std::arch::x86_64::*;

/// The processor has AVX2, BMI1 and POPCNT. Made here alone.
#[derive(Clone, Copy)]
pub(crate) struct Avx2(());

#[target_feature(enable = "avx2,bmi1,popcnt")]
#[inline(never)]
pub(super) fn run<K: Kernel>(kernel: K) -> K::Output {
    kernel.run(Avx2(()))
}

/// A level that has AVX2.
pub(super) trait HasAvx2: Copy {}

impl HasAvx2 for Avx2 {}

impl Simd for Avx2 {
    type Float = Floats;

    #[inline(always)]
    fn apart<K: Kernel>(self, kernel: K) -> K::Output {
        // SAFETY: the processor has AVX2.
        unsafe { run(kernel) }
    }
}

/// Eight f32; there are none without a level that has AVX2.
#[derive(Clone, Copy)]
pub(crate) struct Floats(__m256);

/// Eight i32.
#[derive(Clone, Copy)]
pub(crate) struct Keys(__m256i);

// Throughout, the instructions are there: who has an operand had such a level to make it.
impl<S: HasAvx2> Float8<S> for Floats {
    type Keys = Keys;

    #[inline(always)]
    fn load(_: S, lanes: &[f32; WIDTH]) -> Floats {
        // SAFETY: eight lanes; see above.
        Floats(unsafe { _mm256_loadu_ps(lanes.as_ptr()) })
    }

    #[inline(always)]
    fn splat(_: S, x: f32) -> Floats {
        // SAFETY: see above.
        Floats(unsafe { _mm256_set1_ps(x) })
    }

    #[inline(always)]
    fn add(self, other: Floats) -> Floats {
        // SAFETY: see above.
        Floats(unsafe { _mm256_add_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn sub(self, other: Floats) -> Floats {
        // SAFETY: see above.
        Floats(unsafe { _mm256_sub_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn mul(self, other: Floats) -> Floats {
        // SAFETY: see above.
        Floats(unsafe { _mm256_mul_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn max(self, other: Floats) -> Floats {
        // SAFETY: see above.
        Floats(unsafe { _mm256_max_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Floats) -> Floats {
        // SAFETY: see above.
        Floats(unsafe { _mm256_min_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn sqrt(self) -> Floats {
        // SAFETY: see above.
        Floats(unsafe { _mm256_sqrt_ps(self.0) })
    }

    #[inline(always)]
    fn abs(self) -> Floats {
        // SAFETY: see above.
        Floats(unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0) })
    }

    #[inline(always)]
    fn zero_where_positive(self, other: Floats) -> Floats {
        // SAFETY: see above.
        Floats(unsafe { _mm256_andnot_ps(_mm256_cmp_ps::<_CMP_GT_OQ>(other.0, _mm256_setzero_ps()), self.0) })
    }

    #[inline(always)]
    fn least(self) -> f32 {
        // SAFETY: see above.
        unsafe {
            let half = _mm_min_ps(_mm256_castps256_ps128(self.0), _mm256_extractf128_ps::<1>(self.0));
            let pair = _mm_min_ps(half, _mm_movehl_ps(half, half));
            _mm_cvtss_f32(_mm_min_ss(pair, _mm_movehdup_ps(pair)))
        }
    }

    #[inline(always)]
    fn not_above(self, limit: f32) -> u32 {
        // SAFETY: see above.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_NGT_UQ>(self.0, _mm256_set1_ps(limit))) as u32 }
    }

    #[inline(always)]
    fn lanes(self) -> [f32; WIDTH] {
        let mut lanes = [0.0; WIDTH];
        // SAFETY: room for eight; see above.
        unsafe { _mm256_storeu_ps(lanes.as_mut_ptr(), self.0) };
        lanes
    }

    #[inline(always)]
    fn swapped(self) -> Floats {
        // SAFETY: see above.
        Floats(unsafe { _mm256_permute2f128_ps::<1>(self.0, self.0) })
    }

    #[inline(always)]
    fn bins(self, last: i32) -> [i32; WIDTH / 2] {
        let mut bins = [0; WIDTH / 2];
        // SAFETY: room for four; see above.
        unsafe {
            let sums = _mm_add_ps(_mm256_castps256_ps128(self.0), _mm256_extractf128_ps::<1>(self.0));
            let whole = _mm_max_epi32(_mm_cvttps_epi32(sums), _mm_setzero_si128());
            _mm_storeu_si128(bins.as_mut_ptr().cast(), _mm_min_epi32(whole, _mm_set1_epi32(last)));
        }
        bins
    }

    #[inline(always)]
    fn keys(self, child: &[u32; WIDTH]) -> Keys {
        // SAFETY: see above.
        keyed(unsafe { _mm256_castps_si256(self.0) }, child)
    }

    #[inline(always)]
    fn signed_keys(self, below: Floats, child: &[u32; WIDTH]) -> Keys {
        // SAFETY: see above.
        let keys = unsafe {
            let below = _mm256_castps_si256(below.0);
            let none = _mm256_cmpeq_epi32(below, _mm256_setzero_si256());
            let turned = _mm256_xor_si256(below, _mm256_set1_epi32(-1));
            _mm256_blendv_epi8(turned, _mm256_castps_si256(self.0), none)
        };
        keyed(keys, child)
    }
}

#[inline(always)]
fn keyed(keys: __m256i, child: &[u32; WIDTH]) -> Keys {
    // SAFETY: eight children; the operand is there.
    Keys(unsafe {
        let lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        let keys = _mm256_or_si256(_mm256_and_si256(keys, _mm256_set1_epi32(!LANE)), lanes);
        let child = _mm256_loadu_si256(child.as_ptr().cast());
        let unused = _mm256_cmpeq_epi32(child, _mm256_set1_epi32(-1));
        _mm256_blendv_epi8(keys, _mm256_set1_epi32(i32::MAX), unused)
    })
}

impl Keys8 for Keys {
    #[inline(always)]
    fn at_most(self, limit: i32) -> u32 {
        // SAFETY: the operand is there.
        unsafe {
            let above = _mm256_cmpgt_epi32(self.0, _mm256_set1_epi32(limit));
            !_mm256_movemask_ps(_mm256_castsi256_ps(above)) as u32 & 0xFF
        }
    }

    #[inline(always)]
    fn least(self) -> i32 {
        // SAFETY: the operand is there.
        unsafe {
            let half = _mm_min_epi32(_mm256_castsi256_si128(self.0), _mm256_extracti128_si256::<1>(self.0));
            let pair = _mm_min_epi32(half, _mm_shuffle_epi32::<0b00_00_11_10>(half));
            _mm_cvtsi128_si32(_mm_min_epi32(pair, _mm_shuffle_epi32::<0b00_00_00_01>(pair)))
        }
    }

    #[inline(always)]
    fn others(self, lanes: u32, child: &[u32; WIDTH], keys: &mut [i32; WIDTH], children: &mut [u32; WIDTH]) -> usize {
        let count = lanes.count_ones() as i32 - 1;
        // SAFETY: room for eight; the operand is there.
        unsafe {
            // Rising; then the second comes to the place before `count`, and so on.
            let rising = sorted(self.0);
            let places = _mm256_sub_epi32(_mm256_set1_epi32(count), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
            let falling = _mm256_permutevar8x32_epi32(rising, places);
            // The last bits of a key say whose it is; a permutation looks at no others.
            let child = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(child.as_ptr().cast()), falling);
            _mm256_storeu_si256(keys.as_mut_ptr().cast(), falling);
            _mm256_storeu_si256(children.as_mut_ptr().cast(), child);
        }
        count as usize
    }
}

/// Rising, by Batcher's network.
///
/// # Safety
/// The processor has AVX2.
#[inline(always)]
unsafe fn sorted(keys: __m256i) -> __m256i {
    macro_rules! step {
        ($keys:expr, $other:expr, $greater:literal) => {{
            let (keys, other) = ($keys, $other);
            _mm256_blend_epi32::<$greater>(_mm256_min_epi32(keys, other), _mm256_max_epi32(keys, other))
        }};
    }
    // SAFETY: the caller's promise.
    unsafe {
        let keys = step!(keys, _mm256_shuffle_epi32::<0b10_11_00_01>(keys), 0b1010_1010);
        let keys = step!(keys, _mm256_shuffle_epi32::<0b00_01_10_11>(keys), 0b1100_1100);
        let keys = step!(keys, _mm256_shuffle_epi32::<0b10_11_00_01>(keys), 0b1010_1010);
        let turned = _mm256_permute4x64_epi64::<0b01_00_11_10>(_mm256_shuffle_epi32::<0b00_01_10_11>(keys));
        let keys = step!(keys, turned, 0b1111_0000);
        let keys = step!(keys, _mm256_shuffle_epi32::<0b01_00_11_10>(keys), 0b1100_1100);
        step!(keys, _mm256_shuffle_epi32::<0b10_11_00_01>(keys), 0b1010_1010)
    }
}
