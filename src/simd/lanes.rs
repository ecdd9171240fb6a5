// SPDX-License-Identifier: MIT OR Apache-2.0
//! One f64, or four or eight side by side, behind one set of operations: kernels are written once, and the
//! scalar one is the brute-force twin of the vector one. Plain loops over arrays, which the compiler
//! turns into vector instructions of the level it compiles for.

use std::ops::{Add, Div, Mul, Sub};

/// Values that kernels compute with. A comparison with NaN is false.
pub(crate) trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    type Mask: Copy;
    fn splat(x: f64) -> Self;
    /// `self < other`.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`.
    fn le(self, other: Self) -> Self::Mask;
    /// Both masks.
    fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// `yes` where the mask holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
}

impl Lanes for f64 {
    type Mask = bool;

    #[inline(always)]
    fn splat(x: f64) -> f64 {
        x
    }

    #[inline(always)]
    fn lt(self, other: f64) -> bool {
        self < other
    }

    #[inline(always)]
    fn le(self, other: f64) -> bool {
        self <= other
    }

    #[inline(always)]
    fn and(a: bool, b: bool) -> bool {
        a & b
    }

    #[inline(always)]
    fn select(mask: bool, yes: f64, no: f64) -> f64 {
        if mask { yes } else { no }
    }
}

/// Lanes side by side.
pub(crate) const WIDTH: usize = 8;

/// Several f64.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct F64s<const N: usize>(pub(crate) [f64; N]);

/// Eight f64.
pub(crate) type F64x8 = F64s<WIDTH>;

/// All bits set where a comparison holds.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
pub(crate) struct Mask<const N: usize>([u64; N]);

macro_rules! lanewise {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl<const N: usize> $trait for F64s<N> {
            type Output = F64s<N>;

            #[inline(always)]
            fn $function(self, other: F64s<N>) -> F64s<N> {
                let mut out = [0.0; N];
                for (k, x) in out.iter_mut().enumerate() {
                    *x = self.0[k] $operator other.0[k];
                }
                F64s(out)
            }
        }
    };
}

lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);
lanewise!(Div, div, /);

impl<const N: usize> F64s<N> {
    /// Square roots, correctly rounded.
    #[inline(always)]
    pub(crate) fn sqrt(self) -> F64s<N> {
        let mut out = [0.0; N];
        for (k, x) in out.iter_mut().enumerate() {
            *x = self.0[k].sqrt();
        }
        F64s(out)
    }

    /// A bit for each lane that is at most `limit`.
    #[inline(always)]
    pub(crate) fn at_most(self, limit: f64) -> u32 {
        let mut bits = [0; N];
        for k in 0..N {
            bits[k] = if self.0[k] <= limit { 1 << k } else { 0 };
        }
        bits.iter().fold(0, |all, bit| all | bit)
    }

    #[inline(always)]
    fn compare(self, other: F64s<N>, holds: impl Fn(f64, f64) -> bool) -> Mask<N> {
        let mut out = [0; N];
        for (k, m) in out.iter_mut().enumerate() {
            *m = if holds(self.0[k], other.0[k]) { !0 } else { 0 };
        }
        Mask(out)
    }
}

impl<const N: usize> Lanes for F64s<N> {
    type Mask = Mask<N>;

    #[inline(always)]
    fn splat(x: f64) -> F64s<N> {
        F64s([x; N])
    }

    #[inline(always)]
    fn lt(self, other: F64s<N>) -> Mask<N> {
        self.compare(other, |a, b| a < b)
    }

    #[inline(always)]
    fn le(self, other: F64s<N>) -> Mask<N> {
        self.compare(other, |a, b| a <= b)
    }

    #[inline(always)]
    fn and(a: Mask<N>, b: Mask<N>) -> Mask<N> {
        let mut out = [0; N];
        for (k, m) in out.iter_mut().enumerate() {
            *m = a.0[k] & b.0[k];
        }
        Mask(out)
    }

    #[inline(always)]
    fn select(mask: Mask<N>, yes: F64s<N>, no: F64s<N>) -> F64s<N> {
        let mut out = [0.0; N];
        for (k, x) in out.iter_mut().enumerate() {
            *x = f64::from_bits((mask.0[k] & yes.0[k].to_bits()) | (!mask.0[k] & no.0[k].to_bits()));
        }
        F64s(out)
    }
}

/// Eight f32, for filters: each operation a loop of its own, which becomes one instruction. (Not
/// `array::from_fn`: where it is not inlined it is compiled for the baseline.)
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct F32x8(pub(crate) [f32; WIDTH]);

/// Eight i32.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct I32x8(pub(crate) [i32; WIDTH]);

impl F32x8 {
    #[inline(always)]
    pub(super) fn zip(self, other: F32x8, f: impl Fn(f32, f32) -> f32) -> F32x8 {
        let mut out = [0.0; WIDTH];
        for k in 0..WIDTH {
            out[k] = f(self.0[k], other.0[k]);
        }
        F32x8(out)
    }
}
