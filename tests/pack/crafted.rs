// SPDX-License-Identifier: MIT OR Apache-2.0
//! Blocks whose sums are right and whose content is not: an error, or wrong numbers; never out of bounds, never without
//! end. The sum is written down here a second time.

use super::same::few_answers;
use super::scenes::{meshes, small};
use crate::common::random::Random;
use embound::Status;
use embound::geometry::{Geometry, UnpackCheck};
use embound::parallel::Run;

const FACTOR: u64 = 0xBF58_476D_1CE4_E5B9;

fn of_words(words: impl IntoIterator<Item = u64>) -> u64 {
    words.into_iter().fold(FACTOR, |sum, word| {
        let mixed = (sum ^ word).wrapping_mul(FACTOR);
        mixed ^ (mixed >> 32)
    })
}

fn of_piece(words: &[u64]) -> u64 {
    of_words((0..8).map(|lane| of_words(words.iter().skip(lane).step_by(8).copied())))
}

fn words(bytes: &[u8]) -> Vec<u64> {
    bytes.chunks_exact(8).map(|word| u64::from_ne_bytes(word.try_into().expect("a word"))).collect()
}

fn front(words: &[u64]) -> usize {
    (16 + 3 * words[3] as usize + words[4] as usize).next_multiple_of(8)
}

/// With the sums that belong to it.
fn sealed(words: &mut [u64]) -> Vec<u8> {
    let front = front(words);
    if front <= words.len() {
        words[5] = of_piece(&words[16..front]);
        words[6] = of_words(words[front..].chunks(1 << 17).map(of_piece).collect::<Vec<_>>());
    }
    words[15] = of_words(words[..15].iter().copied());
    words.iter().flat_map(|word| word.to_ne_bytes()).collect()
}

fn unpacked(words: &mut [u64]) -> embound::Result<Geometry> {
    Geometry::unpack(&sealed(words), UnpackCheck::Check, &Run::SERIAL)
}

#[test]
fn the_sums_are_these() {
    for (name, g) in small().into_iter().chain(meshes()) {
        let bytes = g.pack().expect("packed");
        assert!(sealed(&mut words(&bytes)) == bytes, "{name}");
    }
}

/// Something else in the place of a word.
fn changed(word: u64, random: &mut Random) -> u64 {
    let half = |k: u32, x: u32| word & !(0xFFFF_FFFF << (32 * k)) | u64::from(x) << (32 * k);
    let side = random.below(2) as u32;
    match random.below(12) {
        0 => 0,
        1 => u64::MAX,
        2 => word.wrapping_add(1),
        3 => word.wrapping_sub(1),
        4 => f64::NAN.to_bits(),
        5 => f64::INFINITY.to_bits(),
        6 => (-f64::from_bits(word)).to_bits(),
        7 => half(side, u32::MAX),
        8 => half(side, 1 << 31),
        9 => half(side, random.below(64) as u32),
        10 => half(side, (f32::from_bits((word >> (32 * side)) as u32) * 3.0).to_bits()),
        _ => word ^ 1 << random.below(64),
    }
}

#[test]
fn what_is_wrong_in_a_sound_block_never_leads_out_of_it() {
    let mut random = Random(21);
    let (mut refused, mut taken) = (0, 0);
    for (name, g) in small().into_iter().chain(meshes()) {
        let right = words(&g.pack().expect("packed"));
        let front = front(&right);
        for k in 0..80 {
            let mut wrong = right.clone();
            for _ in 0..1 + random.below(3) {
                let at = if k % 2 == 0 { 16 + random.below(front - 16) } else { 16 + random.below(right.len() - 16) };
                wrong[at] = changed(wrong[at], &mut random);
            }
            match unpacked(&mut wrong) {
                Ok(g) => {
                    taken += 1;
                    // Whatever is said, it is said.
                    let answers = few_answers(&g, 20, 5);
                    assert!(!answers.is_empty(), "{name}");
                    g.pack().expect("packed");
                }
                Err(error) => {
                    refused += 1;
                    let known = [Status::Parse, Status::Unsupported, Status::Memory].contains(&error.status());
                    assert!(known && !error.message().contains('\n'), "{name}: {error}");
                }
            }
        }
    }
    assert!(refused > 500 && taken > 200, "{refused} {taken}");
}

#[test]
fn headers_that_promise_too_much_are_refused() {
    let right = words(&small()[0].1.pack().expect("packed"));
    for at in 2..5 {
        for value in [0, 1, 1 << 20, 1 << 40, u64::MAX / 8, u64::MAX] {
            let mut wrong = right.clone();
            if wrong[at] != value {
                wrong[at] = value;
                assert!(unpacked_header(&mut wrong).is_err(), "{at} {value}");
            }
        }
    }
}

/// With the header's own sum alone.
fn unpacked_header(words: &mut [u64]) -> embound::Result<Geometry> {
    words[15] = of_words(words[..15].iter().copied());
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_ne_bytes()).collect();
    Geometry::unpack(&bytes, UnpackCheck::Check, &Run::SERIAL)
}
