// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files made wrong.

use crate::common::random::Random;

/// Numbers at the ends of what types hold, and words that are read as numbers.
const NUMBERS: [&str; 28] = [
    "0",
    "-1",
    "1",
    "2",
    "3",
    "-0",
    "127",
    "255",
    "256",
    "32768",
    "65535",
    "65536",
    "2147483647",
    "-2147483648",
    "4294967294",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "1e308",
    "-1e308",
    "1e-320",
    "nan",
    "inf",
    "0.1",
    "1e100",
    "99999999",
    "1000000",
];

const WORDS: [u64; 14] = [
    0,
    1,
    2,
    0x7f,
    0xff,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    1 << 32,
    u64::MAX,
    1 << 62,
    0x7ff0_0000_0000_0000,
    0x7ff8_0000_0000_0000,
];

/// A file of the corpus with one to eight things wrong.
pub fn mutated(corpus: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut bytes = corpus[random.below(corpus.len())].clone();
    for _ in 0..1 + random.below(8) {
        if bytes.is_empty() {
            break;
        }
        let at = random.below(bytes.len());
        let span = |random: &mut Random, longest: usize| random.below(longest).min(bytes.len() - at);
        match random.below(12) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = random.bits() as u8,
            2 => bytes.truncate(at),
            3 => {
                let n = span(random, 60);
                bytes.drain(at..at + n);
            }
            4 => {
                let n = span(random, 200);
                let copy = bytes[at..at + n].repeat(1 + random.below(4));
                let to = random.below(bytes.len());
                bytes.splice(to..to, copy);
            }
            5 => {
                let number = NUMBERS[random.below(NUMBERS.len())].as_bytes();
                let spaced = [b" ", number, b" "].concat();
                bytes.splice(at..at, spaced);
            }
            6 => overwrite(&mut bytes, at, random),
            7 => splice(&mut bytes, &corpus[random.below(corpus.len())], random),
            8 => insert_word(&mut bytes, &corpus[random.below(corpus.len())], random),
            9 => swap_lines(&mut bytes, random),
            _ => replace_number(&mut bytes, random),
        }
    }
    bytes
}

/// A number of four or eight bytes, in either byte order.
fn overwrite(bytes: &mut [u8], at: usize, random: &mut Random) {
    let word = WORDS[random.below(WORDS.len())];
    let eight = match random.below(4) {
        0 => word.to_le_bytes(),
        1 => word.to_be_bytes(),
        2 => [(word as u32).to_le_bytes(), (word as u32).to_le_bytes()].concat().try_into().unwrap(),
        _ => [(word as u32).to_be_bytes(), (word as u32).to_be_bytes()].concat().try_into().unwrap(),
    };
    let n = [1, 2, 4, 8][random.below(4)].min(bytes.len() - at);
    bytes[at..at + n].copy_from_slice(&eight[..n]);
}

/// The beginning of one file and the end of another.
fn splice(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    let (cut, from) = (random.below(bytes.len()), random.below(other.len()));
    bytes.truncate(cut);
    bytes.extend_from_slice(&other[from..]);
}

/// Where words begin, and where they end.
fn words(bytes: &[u8], is_word: impl Fn(u8) -> bool) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut start = None;
    for (k, &b) in bytes.iter().chain(b" ").enumerate() {
        match start {
            None if is_word(b) => start = Some(k),
            Some(s) if !is_word(b) => {
                found.push((s, k));
                start = None;
            }
            _ => {}
        }
    }
    found
}

fn insert_word(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    let all = words(other, |b| b.is_ascii_graphic());
    let own = words(bytes, |b| b.is_ascii_graphic());
    if all.is_empty() || own.is_empty() {
        return;
    }
    let (start, end) = all[random.below(all.len())];
    let at = own[random.below(own.len())].0;
    let word = [&other[start..end], b" "].concat();
    bytes.splice(at..at, word);
}

fn swap_lines(bytes: &mut Vec<u8>, random: &mut Random) {
    let mut lines: Vec<Vec<u8>> = bytes.split_inclusive(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
    let (a, b) = (random.below(lines.len()), random.below(lines.len()));
    lines.swap(a, b);
    *bytes = lines.concat();
}

/// A decimal number of the text becomes another.
fn replace_number(bytes: &mut Vec<u8>, random: &mut Random) {
    let digits = words(bytes, |b| b.is_ascii_digit() || b == b'.' || b == b'-');
    if digits.is_empty() {
        return;
    }
    let (start, end) = digits[random.below(digits.len())];
    bytes.splice(start..end, NUMBERS[random.below(NUMBERS.len())].bytes());
}
