// SPDX-License-Identifier: MIT OR Apache-2.0
//! Entry point for AVX-512. Its eight f32 are those of AVX2.

use super::Kernel;
use super::avx2::Avx2;

#[target_feature(enable = "avx2,avx512f,avx512dq,avx512vl")]
pub(super) fn run<K: Kernel>(kernel: K) -> K::Output {
    // SAFETY: this function is called where AVX2 is there, too.
    kernel.run(unsafe { Avx2::assumed() })
}
