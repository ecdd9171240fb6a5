// SPDX-License-Identifier: MIT OR Apache-2.0
//! Entry point for AVX-512.

use super::Kernel;

#[target_feature(enable = "avx512f,avx512dq,avx512vl")]
pub(super) fn run<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}
