// SPDX-License-Identifier: MIT OR Apache-2.0
//! Ears against those that a look at every corner finds.

use super::*;
use crate::primitive::polygon;

/// SplitMix64 (Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn circle(turn: f64, r: f64) -> [f64; 2] {
    let a = std::f64::consts::TAU * turn;
    [r * libm::cos(a), r * libm::sin(a)]
}

/// Whether both ways cut the polygon, which they do alike.
fn both(points: &[[f64; 2]]) -> bool {
    let n = points.len();
    let (mut ring, mut plain, mut found) = (vec![0; n], vec![[0; 3]; n - 2], vec![[0; 3]; n - 2]);
    let whole = polygon::clip_ears(points, &mut ring, &mut plain);
    assert_eq!(clip_ears(points, &mut found).unwrap(), whole, "{points:?}");
    assert_eq!(found, plain, "{points:?}");
    whole
}

#[test]
fn the_ears_of_simple_polygons_are_those_of_a_plain_search() {
    let mut random = Random(1);
    for n in (3..200).chain([301, 512, 1000]) {
        let near = |k: usize| k as f64 / n as f64;
        assert!(both(&(0..n).map(|k| circle(near(k), 1.0)).collect::<Vec<_>>()));
        assert!(both(&(0..n).map(|k| circle(near(k), 0.1 + random.unit())).collect::<Vec<_>>()));
        // A band wound three times, comb and saw, and sides full of corners.
        let outer = (0..n).map(|k| circle(3.0 * near(k), 1.0 + 3.0 * near(k)));
        let inner = (0..n).rev().map(|k| circle(3.0 * near(k), 0.5 + 3.0 * near(k)));
        // Few corners cut across it.
        assert!(both(&outer.chain(inner).collect::<Vec<_>>()) || n < 12);
        let teeth = (0..n).rev().flat_map(|k| [[k as f64 + 1.0, 5.0], [k as f64 + 0.5, 1.0]]);
        assert!(both(&[[0.0, 0.0], [n as f64, 0.0]].into_iter().chain(teeth).chain([[0.0, 5.0]]).collect::<Vec<_>>()));
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let side =
            |s: usize, k: usize| [0, 1].map(|c| square[s][c] * (1.0 - near(k)) + square[(s + 1) % 4][c] * near(k));
        assert!(both(&(0..4 * n).map(|k| side(k / n, k % n)).collect::<Vec<_>>()));
    }
}

#[test]
fn so_are_those_of_polygons_that_touch_cross_and_repeat_themselves() {
    let mut random = Random(2);
    let (mut whole, mut crossed) = (0, 0);
    for round in 0..6000 {
        let n = 3 + random.below(if round % 10 == 0 { 200 } else { 30 }) as usize;
        let size = 2 + random.below(12);
        let mut at = [0i64; 2];
        let mut points: Vec<[f64; 2]> = match round % 3 {
            // Anywhere on a grid.
            0 => (0..n).map(|_| [random.below(size) as f64, random.below(size) as f64]).collect(),
            // A walk along the lines of a grid.
            1 => (0..n)
                .map(|_| {
                    let k = random.below(4);
                    at[k as usize % 2] += 1 - (k / 2) as i64 * 2;
                    at.map(|c| c as f64)
                })
                .collect(),
            // Around a point, nearly on rays from it, now and then back.
            _ => (0..n)
                .map(|k| circle((k as f64 + 3.0 * random.unit()) / n as f64, 1.0 + random.below(3) as f64))
                .collect(),
        };
        if round % 7 == 0 {
            points.extend(points.clone());
        }
        if both(&points) {
            whole += 1;
        } else {
            crossed += 1;
        }
    }
    assert!(whole > 500 && crossed > 500, "{whole} {crossed}");
}
