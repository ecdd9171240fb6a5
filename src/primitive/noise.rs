// SPDX-License-Identifier: MIT OR Apache-2.0
//! Gradient noise after Perlin, "Improving Noise" (SIGGRAPH 2002), with its derivative and a seeded table.

use crate::math::Vec3;

/// Bound of |noise|. The weights of the two corners of an axis make the mean distance to them
/// 1/2 - (1/2 - x)(1 - 2 f(x)) <= 1/2, and |g . d| <= |dx| + |dy| + |dz|.
pub(crate) const MAGNITUDE: f64 = 1.5;

/// Bound of |grad noise|. The weighted mean of the gradients is at most sqrt(2) long. The rest along x is
/// f'(x) <= 15/8 times the mean over y and z of |a1| + |a0|, at most (1 - x) + x + 2/2 + 2/2 = 3; likewise
/// y and z: sqrt(2) + sqrt(3) * 45/8 = 11.157.
pub(crate) const LIPSCHITZ: f64 = 11.2;

/// The 12 edges of a cube, four of them twice.
const GRADIENTS: [[f64; 3]; 16] = [
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [-1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, -1.0, 1.0],
    [0.0, 1.0, -1.0],
    [0.0, -1.0, -1.0],
    [1.0, 1.0, 0.0],
    [0.0, -1.0, 1.0],
    [-1.0, 1.0, 0.0],
    [0.0, -1.0, -1.0],
];

/// 0 to 255, shuffled (Fisher & Yates) by SplitMix64 (Steele, Lea & Flood 2014).
pub(crate) fn permutation(seed: u64) -> [u8; 256] {
    let mut table = [0; 256];
    for (k, slot) in table.iter_mut().enumerate() {
        *slot = k as u8;
    }
    let mut state = seed;
    for k in (1..256usize).rev() {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        // The upper half scaled to 0..=k.
        let at = ((z >> 32) * (k as u64 + 1)) >> 32;
        table.swap(k, at as usize);
    }
    table
}

/// The cell, modulo 256, and the place in it; what is not finite counts as 0. Every step is exact.
fn cell(x: f64) -> (usize, f64) {
    if !x.is_finite() {
        return (0, 0.0);
    }
    let whole = x.floor();
    let folded = whole - 256.0 * (whole / 256.0).floor();
    (folded as usize & 255, x - whole)
}

fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

fn fade_slope(t: f64) -> f64 {
    let u = t * (t - 1.0);
    30.0 * (u * u)
}

fn mix(t: f64, a: f64, b: f64) -> f64 {
    a + t * (b - a)
}

/// Noise of period 256 and its gradient; 0 at whole coordinates.
#[inline(always)]
pub(crate) fn noise(table: &[u8; 256], p: Vec3) -> (f64, Vec3) {
    let (cells, at) = ([cell(p.x), cell(p.y), cell(p.z)].map(|c| c.0), [p.x, p.y, p.z].map(|x| cell(x).1));
    let f = at.map(fade);
    let look = |k: usize| usize::from(table[k & 255]);
    let gradient = |c: usize| {
        let [i, j, k] = [c & 1, (c >> 1) & 1, c >> 2];
        &GRADIENTS[look(look(look(cells[0] + i) + cells[1] + j) + cells[2] + k) & 15]
    };
    // Corner c: x in bit 0, y in bit 1, z in bit 2.
    let g: [&[f64; 3]; 8] = std::array::from_fn(gradient);
    let d: [f64; 8] = std::array::from_fn(|c| {
        let [x, y, z] = [at[0] - (c & 1) as f64, at[1] - ((c >> 1) & 1) as f64, at[2] - (c >> 2) as f64];
        g[c][0] * x + g[c][1] * y + g[c][2] * z
    });
    let blend = |a: [f64; 8]| {
        let x = |c: usize| mix(f[0], a[c], a[c + 1]);
        mix(f[2], mix(f[1], x(0), x(2)), mix(f[1], x(4), x(6)))
    };
    let mean = |k: usize| blend(std::array::from_fn(|c| g[c][k]));
    let slope = Vec3::new(
        mix(f[2], mix(f[1], d[1] - d[0], d[3] - d[2]), mix(f[1], d[5] - d[4], d[7] - d[6])),
        mix(f[2], mix(f[0], d[2] - d[0], d[3] - d[1]), mix(f[0], d[6] - d[4], d[7] - d[5])),
        mix(f[1], mix(f[0], d[4] - d[0], d[5] - d[1]), mix(f[0], d[6] - d[2], d[7] - d[3])),
    );
    let steep = Vec3::new(fade_slope(at[0]), fade_slope(at[1]), fade_slope(at[2]));
    (blend(d), Vec3::new(mean(0), mean(1), mean(2)) + steep * slope)
}
