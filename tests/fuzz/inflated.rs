// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the compressed parts of a file inflate to, wherever they are.

use miniz_oxide::inflate::{TINFLStatus, decompress_to_vec_zlib_with_limit};

/// No part inflates to more.
const LIMIT: usize = 1 << 30;

/// Bytes that all zlib streams of a file inflate to, as they are or in base64.
pub fn size(bytes: &[u8]) -> usize {
    let letters = |b: &u8| b.is_ascii_alphanumeric() || b"+/=".contains(b);
    let runs = bytes.split(|b| !letters(b)).filter(|run| run.len() > 15).map(|run| streams(&decoded(run)));
    streams(bytes) + runs.sum::<usize>()
}

/// The bytes of a run of base64, padding within it included.
fn decoded(run: &[u8]) -> Vec<u8> {
    let value = |b: &u8| match b {
        b'A'..=b'Z' => b - b'A',
        b'a'..=b'z' => b - b'a' + 26,
        b'0'..=b'9' => b - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => 0,
    };
    let mut out = Vec::new();
    for group in run.chunks_exact(4) {
        let word = group.iter().fold(0u32, |word, b| word << 6 | u32::from(value(b)));
        let padding = group.iter().filter(|b| **b == b'=').count();
        out.extend(&word.to_be_bytes()[1..4 - padding.min(2)]);
    }
    out
}

/// The sizes of what begins as a zlib stream does.
fn streams(bytes: &[u8]) -> usize {
    let begins = |w: &[u8]| w[0] & 15 == 8 && (u32::from(w[0]) << 8 | u32::from(w[1])).is_multiple_of(31);
    let starts = bytes.windows(2).enumerate().filter(|(_, w)| begins(w));
    let sizes = starts.map(|(at, _)| match decompress_to_vec_zlib_with_limit(&bytes[at..], LIMIT) {
        Ok(all) => all.len(),
        // A stream that breaks off was inflated up to there.
        Err(e) if e.status != TINFLStatus::HasMoreOutput => e.output.len(),
        Err(_) => 0,
    });
    sizes.sum()
}
