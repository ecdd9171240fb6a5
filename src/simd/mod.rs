// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lanes, run-time detection of the instruction set, one entry point per instruction set behind one
//! dispatcher, and the floating-point environment every result is computed in.
//!
//! A kernel is written once over [`lanes`] and compiled once per level. Rust never contracts a*b+c, so
//! every level gives the same bits.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
pub(crate) mod environment;
pub(crate) mod float8;
pub(crate) mod lanes;

use float8::{Plain, Simd};
use std::sync::OnceLock;

/// An instruction set that kernels are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// Work to compile for each level. `run` and all it calls must be `#[inline(always)]`: what is not
/// inlined is compiled for the baseline.
pub(crate) trait Kernel {
    type Output;
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

/// Runs the kernel at the level of this process.
pub(crate) fn dispatch<K: Kernel>(kernel: K) -> K::Output {
    match level() {
        Level::Baseline => kernel.run(Plain),
        // SAFETY: `level` is at most what the processor was found to have.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => unsafe { avx2::run(kernel) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => unsafe { avx512::run(kernel) },
    }
}

/// Asks for the memory of `place`, which will be read soon. Changes no result.
#[inline(always)]
pub(crate) fn prefetch<T>(place: &T) {
    #[cfg(target_arch = "x86_64")]
    for line in 0..size_of::<T>().div_ceil(64) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: a prefetch of any address is harmless, and SSE is part of the baseline.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(place).cast::<i8>().wrapping_add(64 * line)) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = place;
}

/// The instruction set this process uses: "scalar", "avx2", "avx512" or "neon". The environment
/// variable `EMBOUND_ISA`, read at the first use, caps it.
pub fn isa() -> &'static str {
    match level() {
        Level::Baseline if cfg!(target_arch = "aarch64") => "neon",
        Level::Baseline => "scalar",
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => "avx2",
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => "avx512",
    }
}

fn level() -> Level {
    static LEVEL: OnceLock<Level> = OnceLock::new();
    *LEVEL.get_or_init(detect)
}

#[cfg(target_arch = "x86_64")]
fn detect() -> Level {
    let has_avx2 =
        is_x86_feature_detected!("avx2") && is_x86_feature_detected!("bmi1") && is_x86_feature_detected!("popcnt");
    let present = if has_avx2
        && is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl")
    {
        Level::Avx512
    } else if has_avx2 {
        Level::Avx2
    } else {
        Level::Baseline
    };
    let cap = match std::env::var("EMBOUND_ISA").as_deref() {
        Ok("scalar") => Level::Baseline,
        Ok("avx2") => Level::Avx2,
        _ => Level::Avx512,
    };
    present.min(cap)
}

#[cfg(not(target_arch = "x86_64"))]
fn detect() -> Level {
    Level::Baseline
}
