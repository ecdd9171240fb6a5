// SPDX-License-Identifier: MIT OR Apache-2.0
//! Perlin noise: bounds, derivative, seeds, bits.

use super::super::{Perlin, Shape};
use super::Random;
use crate::math::{Aabb, Vec3, length};

fn perlin(octaves: u32, seed: u64) -> Perlin {
    Perlin::new(0.5, [1.0, 2.0, 0.5], 0.5, octaves, seed).unwrap()
}

#[test]
fn shape_noise_keeps_its_bounds() {
    let mut random = Random(1);
    for octaves in [1, 4] {
        let noise = perlin(octaves, 9);
        let (facts, range) = (noise.facts(), noise.range(Aabb::ALL));
        let (mut steepest, mut most) = (0.0f64, 0.0f64);
        for _ in 0..200_000 {
            let a = random.vector() * 100.0;
            let b = a + random.vector() * if random.word() & 1 == 0 { 0.5 } else { 1e-4 };
            let (f, g) = (noise.value(a), noise.value(b));
            assert!((f - g).abs() <= facts.lipschitz * length(a - b), "{a} to {b}");
            assert!(range.lo <= f && f <= range.hi, "{a}: {f}");
            steepest = steepest.max(length(noise.gradient(a)));
            most = most.max(f.abs());
        }
        assert!(steepest <= facts.lipschitz && steepest > 0.1 * facts.lipschitz, "{steepest}");
        assert!(most > 0.4 * range.hi, "{most}");
    }
}

#[test]
fn shape_noise_gradient_is_that_of_the_value() {
    let (mut random, noise, step) = (Random(2), perlin(3, 1), 1e-6);
    for _ in 0..5000 {
        let p = random.vector() * 10.0;
        let gradient = noise.gradient(p);
        for (k, axis) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
            let slope = (noise.value(p + axis * step) - noise.value(p - axis * step)) / (2.0 * step);
            assert!((slope - gradient[k]).abs() < 1e-4, "{p}: {slope} for {gradient}");
        }
    }
}

#[test]
fn shape_noise_depends_on_the_seed_and_repeats() {
    let p = Vec3::new(0.3, 0.4, 0.7);
    let mut all: Vec<u64> = (0..50).map(|seed| perlin(2, seed).value(p).to_bits()).collect();
    all.sort_unstable();
    all.dedup();
    assert!(all.len() > 45, "{}", all.len());
    let noise = perlin(1, 3);
    assert_eq!(noise.value(Vec3::new(0.25, 0.375, 0.5)), noise.value(Vec3::new(256.25, -127.625, 512.5)));
}

#[test]
fn shape_noise_far_away_is_a_number() {
    let noise = perlin(16, 3);
    for x in [1e15, -1e15, 1e18, -1e150, f64::MAX, 4503599627370497.5] {
        let p = Vec3::new(x, 0.3, -x);
        assert!(noise.value(p).is_finite() && noise.gradient(p).is_finite(), "{x}");
    }
    assert_eq!(noise.value(Vec3::splat(1e17)), 0.0);
}

/// As first computed: a change of them is a change of every geometry made with noise.
#[test]
fn shape_noise_bits_are_pinned() {
    let at = [Vec3::new(0.3, 0.4, 0.7), Vec3::new(-17.1, 3.3, 1e6 + 0.1), Vec3::new(1e15 + 0.5, 0.1, 2.6)];
    let bits = at.map(|p| perlin(4, 42).value(p).to_bits());
    assert_eq!(bits, PINNED, "{bits:#x?}");
}

const PINNED: [u64; 3] = [0xbf93_ab78_41ae_b7e2, 0xbfd0_1fb1_895d_45bd, 0xbfd4_e08c_503a_94fa];
