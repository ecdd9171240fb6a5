// SPDX-License-Identifier: MIT OR Apache-2.0
//! What may lie in a block: types whose every byte is a value's, and of which every pattern of bits is a value.

use crate::math::{Interval, Vec3};
use crate::simd::lanes::{F32x8, F64x8};

/// A type that a block may hold.
///
/// # Safety
/// No byte of it is padding, and any bytes are one.
pub(crate) unsafe trait Plain: Copy + Send + Sync + 'static {}

// SAFETY: a number.
unsafe impl Plain for u8 {}
// SAFETY: a number.
unsafe impl Plain for u32 {}
// SAFETY: a number.
unsafe impl Plain for i32 {}
// SAFETY: a number.
unsafe impl Plain for u64 {}
// SAFETY: a number.
unsafe impl Plain for f32 {}
// SAFETY: a number.
unsafe impl Plain for f64 {}
// SAFETY: nothing lies between the elements of an array.
unsafe impl<T: Plain, const N: usize> Plain for [T; N] {}

/// Says of structs that they are [`Plain`]. It holds them to it: all fields are named, each is plain, and together they
/// are as large as the struct, which leaves no padding.
macro_rules! plain {
    ($($type:ident { $($field:ident: $of:ty),+ $(,)? })+) => {$(
        const _: () = {
            const fn size<T: $crate::store::Plain>() -> usize {
                size_of::<T>()
            }
            assert!(size_of::<$type>() == 0 $(+ size::<$of>())+);
            // It is there to be compiled, not to be called.
            #[allow(dead_code)]
            fn has_no_other_fields(all: $type) {
                let $type { $($field),+ } = all;
                $(let _: $of = $field;)+
            }
            // SAFETY: see above.
            unsafe impl $crate::store::Plain for $type {}
        };
    )+};
}
pub(crate) use plain;

plain! {
    Vec3 { x: f64, y: f64, z: f64 }
    Interval { lo: f64, hi: f64 }
}

const _: () = assert!(size_of::<F64x8>() == 64 && size_of::<F32x8>() == 32);
// SAFETY: eight numbers, and as large as they are.
unsafe impl Plain for F64x8 {}
// SAFETY: eight numbers, and as large as they are.
unsafe impl Plain for F32x8 {}
