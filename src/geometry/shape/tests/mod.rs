// SPDX-License-Identifier: MIT OR Apache-2.0
//! Every shape in several frames against a plain predicate of its inside, itself in another frame, and its facts.

mod arguments;
mod cases;
mod ellipsoid;
mod extremes;
mod noise;

use super::{Crossings, Shape};
use crate::math::{Mat3, Vec3, length};
use cases::{Case, cases};

/// SplitMix64 (Steele, Lea & Flood 2014).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In [-1, 1).
    pub(super) fn number(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub(super) fn vector(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }
}

/// Where a case stands: a point q of it is at `turn * q * scale + shift`.
pub(super) struct Frame {
    pub(super) turn: Mat3,
    pub(super) shift: Vec3,
    pub(super) scale: f64,
}

impl Frame {
    pub(super) const HOME: Frame = Frame { turn: Mat3::IDENTITY, shift: Vec3::ZERO, scale: 1.0 };

    fn new(quaternion: [f64; 4], shift: [f64; 3], scale: f64) -> Frame {
        let norm = quaternion.iter().map(|c| c * c).sum::<f64>().sqrt();
        let [w, x, y, z] = quaternion.map(|c| c / norm);
        let rows = [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ];
        let turn = Mat3::from_cols_array(&rows.concat().try_into().unwrap()).transpose();
        Frame { turn, shift: Vec3::from_array(shift), scale }
    }

    pub(super) fn out(&self, q: Vec3) -> Vec3 {
        self.turn * q * self.scale + self.shift
    }

    fn home(&self, p: Vec3) -> Vec3 {
        self.turn.transpose() * (p - self.shift) / self.scale
    }
}

fn frames() -> [Frame; 7] {
    [
        Frame::HOME,
        Frame::new([0.0, 1.0, 0.0, 0.0], [0.5, -3.0, 2.0], 1.0),
        Frame::new([1.0, 1.0, 0.0, 0.0], [0.0; 3], 1.0),
        Frame::new([1.0, -2.0, 3.0, 0.7], [1e3, -2e3, 0.5e3], 1.0),
        Frame::new([0.3, 0.2, -0.9, 0.7], [1e-6, 3e-6, 0.0], 1e-6),
        Frame::new([-0.3, 0.8, 0.1, 0.2], [-3e6, 1e3, 5e6], 1e6),
        Frame::new([1.0, 1e-9, 0.0, 0.0], [0.0; 3], 1.0),
    ]
}

/// Points in and around a case, in its own frame: anywhere, near the surface, on the axes.
fn points(case: &Case, count: usize, random: &mut Random) -> Vec<Vec3> {
    let home = &case.home;
    let mut all = Vec::new();
    for k in 0..count {
        let p = random.vector() * 2.5;
        all.push(match k % 5 {
            0 | 1 => p,
            2 => p - home.gradient(p) * home.value(p) + random.vector() * 1e-3,
            3 => p - home.gradient(p) * home.value(p) + random.vector() * 1e-9,
            _ => Vec3::new(0.0, p.y * ((k / 5 % 2) as f64), (p.z * 4.0).round() / 4.0),
        });
    }
    all
}

fn each(mut test: impl FnMut(&Case, &Frame, &mut Random)) {
    for (number, frame) in frames().iter().enumerate() {
        for case in cases(frame) {
            test(&case, frame, &mut Random(number as u64 + 7));
        }
    }
}

#[test]
fn shape_values_have_the_sign_of_the_inside() {
    each(|case, frame, random| {
        for q in points(case, 2000, random) {
            let p = frame.out(q);
            let value = case.shape.value(p) / frame.scale;
            let unsure = 1e-12 + 1e-14 * length(frame.shift) / frame.scale;
            if value.abs() > unsure {
                assert_eq!(value < 0.0, (case.inside)(frame.home(p)), "{} at {p}: {value}", case.name);
            }
        }
    });
}

/// With the right sign and a slope of at most 1 the magnitude is at most the distance; a surface at that
/// distance makes it the distance.
#[test]
fn shape_values_are_the_distance() {
    each(|case, frame, random| {
        let (shape, tiny) = (&case.shape, 1e-7);
        for q in points(case, 400, random) {
            let p = frame.out(q);
            let (value, gradient) = (shape.value(p), shape.gradient(p));
            assert!((length(gradient) - 1.0).abs() < 1e-15 * 4.0, "{} at {p}: {gradient}", case.name);
            let foot = p - gradient * value;
            let facts = shape.facts();
            let rounding = facts.rounding.0 * (p.abs().max_element() + value.abs()) + facts.rounding.1;
            assert!(shape.value(foot).abs() <= 2.0 * rounding, "{} at {p}: {}", case.name, shape.value(foot));
            let near = frame.home(foot);
            let mut seen = [false; 2];
            for _ in 0..4000 {
                let around = near + random.vector() * tiny;
                seen[usize::from((case.inside)(around))] = true;
                if seen == [true; 2] {
                    break;
                }
            }
            assert_eq!(seen, [true; 2], "{}: no surface at {foot}, {value} from {p}", case.name);
        }
    });
}

#[test]
fn shape_values_change_no_faster_than_places() {
    each(|case, frame, random| {
        let facts = case.shape.facts();
        assert!(facts.exact && facts.lipschitz == 1.0 && facts.spread == 1.0, "{}", case.name);
        let all = points(case, 2000, random);
        for pair in all.windows(2) {
            for step in [pair[1] - pair[0], random.vector() * 0.1, random.vector() * 1e-5] {
                let (a, b) = (frame.out(pair[0]), frame.out(pair[0] + step));
                let rounding = facts.rounding.0 * a.abs().max(b.abs()).max_element() + facts.rounding.1;
                let change = (case.shape.value(a) - case.shape.value(b)).abs();
                assert!(change <= length(a - b) + 2.0 * rounding, "{}: {a} to {b}: {change}", case.name);
            }
        }
    });
}

#[test]
fn shape_gradients_are_those_of_the_values() {
    each(|case, frame, random| {
        let step = 1e-5 * frame.scale.max(1e-6 * length(frame.shift));
        let mut compared = 0;
        for q in points(case, 500, random) {
            let p = frame.out(q);
            let gradient = case.shape.gradient(p);
            let axes = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| axis * step);
            let bent = |d: &Vec3| {
                let ends = [case.shape.gradient(p + *d), case.shape.gradient(p - *d)];
                ends.iter().any(|g| length(*g - gradient) > 1e-3)
            };
            if axes.iter().any(bent) {
                continue;
            }
            compared += 1;
            for d in axes {
                let slope = (case.shape.value(p + d) - case.shape.value(p - d)) / (2.0 * step);
                let wrong = (slope - gradient.dot(d) / step).abs();
                assert!(wrong < 2e-3, "{} at {p}: {slope} along {d} for {gradient}", case.name);
            }
        }
        assert!(compared > 150, "{}: {compared}", case.name);
    });
}

#[test]
fn shape_bounds_hold_all_that_is_not_outside() {
    each(|case, frame, random| {
        let facts = case.shape.facts();
        let probe = |p: Vec3| {
            let value = case.shape.value(p);
            assert!(value > 0.0 || facts.bounds.contains(p), "{}: {p} off {:?}", case.name, facts.bounds);
            assert!(value < 0.0 || facts.rest.contains(p), "{}: {p} off {:?}", case.name, facts.rest);
        };
        for q in points(case, 1000, random) {
            let p = frame.out(q);
            probe(p);
            let foot = p - case.shape.gradient(p) * case.shape.value(p);
            probe(foot);
            let jitter = |x: f64| if x > 0.0 { foot.map(f64::next_up) } else { foot.map(f64::next_down) };
            [1.0, -1.0].into_iter().for_each(|x| probe(jitter(x)));
        }
        // The surface's points farthest along each axis.
        for axis in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z] {
            let p = frame.shift + axis * (10.0 * frame.scale);
            probe(p - case.shape.gradient(p) * case.shape.value(p));
        }
        let size = facts.bounds.diagonal();
        assert!(!size.is_finite() || size < 9.0 * frame.scale, "{}: {:?}", case.name, facts.bounds);
    });
}

#[test]
fn shape_values_stay_when_all_is_turned_moved_and_scaled() {
    each(|case, frame, random| {
        let facts = case.shape.facts();
        for q in points(case, 2000, random) {
            let p = frame.out(q);
            let bound = facts.rounding.0 * p.abs().max_element() + facts.rounding.1;
            let wrong = (case.shape.value(p) - case.home.value(q) * frame.scale).abs();
            assert!(wrong <= 0.5 * bound, "{} at {p}: {wrong} > {bound} / 2", case.name);
        }
        let home = case.home.facts();
        for (a, b) in [(home.reach_outward, facts.reach_outward), (home.reach_inward, facts.reach_inward)] {
            assert!(a * frame.scale == b || (a * frame.scale - b).abs() <= 1e-9 * b, "{}: {a}, {b}", case.name);
        }
    });
}

#[test]
fn shape_crossings_are_where_the_value_is_zero() {
    let mut known = 0;
    each(|case, frame, random| {
        for _ in 0..300 {
            let (from, to) = (frame.out(random.vector() * 2.5), frame.out(random.vector() * 2.5));
            let facts = case.shape.facts();
            let bound = facts.rounding.0 * from.abs().max(to.abs()).max_element() + facts.rounding.1;
            let at = |t: f64| from + (to - from) * t;
            match case.shape.crossings(from, to) {
                Crossings::Unknown => return,
                Crossings::Misses => {
                    let least = (0..=50).map(|k| case.shape.value(at(f64::from(k) / 50.0))).fold(1e300, f64::min);
                    assert!(least >= -bound, "{}: {least} between {from} and {to}", case.name);
                }
                Crossings::Between((enter, n), (leave, m)) => {
                    known += 1;
                    assert!(case.shape.value(at(0.5 * (enter + leave))) <= bound, "{}", case.name);
                    for (t, normal) in [(enter, n), (leave, m)] {
                        // The line may be far longer than the segment.
                        let bound = bound * (2.0 + 2.0 * t.abs());
                        assert!(case.shape.value(at(t)).abs() <= bound, "{} at {t}", case.name);
                        assert!((length(normal) - 1.0).abs() < 1e-14, "{}: {normal}", case.name);
                        let depth = 1e-7 * frame.scale.max(1e-6 * length(frame.shift));
                        let outside = case.shape.value(at(t) + normal * depth);
                        assert!((outside - depth).abs() <= 1e-3 * depth + bound, "{} at {t}: {outside}", case.name);
                    }
                }
            }
        }
    });
    assert!(known > 1000, "{known}");
}

#[test]
fn shape_values_far_away_are_numbers() {
    for case in cases(&Frame::HOME) {
        for p in [Vec3::splat(1e150), Vec3::new(-1e150, 1e-300, 0.0), Vec3::new(1e-320, 0.0, -1e150), Vec3::ZERO] {
            let (value, gradient) = (case.shape.value(p), case.shape.gradient(p));
            assert!(value.is_finite(), "{} at {p}: {value}", case.name);
            assert!((length(gradient) - 1.0).abs() < 1e-14, "{} at {p}: {gradient}", case.name);
        }
    }
}

#[test]
fn shape_words_tell_shapes_apart() {
    let words = |shape: &dyn Shape| {
        let mut all = Vec::new();
        shape.words(&mut |word| all.push(word));
        all
    };
    let all: Vec<Vec<u64>> = cases(&Frame::HOME).iter().map(|case| words(&*case.shape)).collect();
    for (k, a) in all.iter().enumerate() {
        assert!(!all[..k].contains(a) && !a.contains(&(-0.0f64).to_bits()));
    }
    assert!(cases(&Frame::HOME).iter().all(|case| case.shape.bytes() > 16));
}
