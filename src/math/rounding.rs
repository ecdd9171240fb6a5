// SPDX-License-Identifier: MIT OR Apache-2.0
//! Directed rounding to f32, and the rules for signs of zero and for narrowing results.

/// The largest f32 that is not above `x`.
pub fn f32_below(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) > x { y.next_down() } else { y }
}

/// The smallest f32 that is not below `x`.
pub fn f32_above(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) < x { y.next_up() } else { y }
}

/// `x` as f32 with its sign kept: a nonzero value stays within `[f32::MIN_POSITIVE, f32::MAX]` in
/// magnitude, so an f32 level set never changes a point's side. Infinities and NaN pass through.
pub fn f32_same_sign(x: f64) -> f32 {
    let y = x as f32;
    if x == 0.0 || !x.is_finite() {
        y
    } else if y.abs() < f32::MIN_POSITIVE {
        if x < 0.0 { -f32::MIN_POSITIVE } else { f32::MIN_POSITIVE }
    } else {
        y.clamp(-f32::MAX, f32::MAX)
    }
}

/// `x`, with -0.0 turned into +0.0, and one NaN for all of them.
pub fn positive_zero(x: f64) -> f64 {
    if x.is_nan() { f64::NAN } else { x + 0.0 }
}
