// SPDX-License-Identifier: MIT OR Apache-2.0
//! Entry point for AVX2.

use super::Kernel;

#[target_feature(enable = "avx2")]
pub(super) fn run<K: Kernel>(kernel: K) -> K::Output {
    kernel.run()
}
