// SPDX-License-Identifier: MIT OR Apache-2.0
//! Entry point for AVX-512. Its eight f32 are those of AVX2.

use super::Kernel;
use super::avx2::{Floats, HasAvx2};
use super::float8::Simd;

/// The processor has AVX-512 F, DQ and VL, and AVX2. Made here alone.
#[derive(Clone, Copy)]
pub(crate) struct Avx512(());

#[target_feature(enable = "avx2,bmi1,popcnt,avx512f,avx512dq,avx512vl")]
#[inline(never)]
pub(super) fn run<K: Kernel>(kernel: K) -> K::Output {
    kernel.run(Avx512(()))
}

impl HasAvx2 for Avx512 {}

impl Simd for Avx512 {
    type Float = Floats;

    #[inline(always)]
    fn apart<K: Kernel>(self, kernel: K) -> K::Output {
        // SAFETY: the processor has them.
        unsafe { run(kernel) }
    }
}
