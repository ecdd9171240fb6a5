// SPDX-License-Identifier: MIT OR Apache-2.0
//! A sum that tells damage. Eight lanes of words, each step of which can be undone, so that whatever happens to one word
//! changes its lane; likewise the lanes, and the pieces, are brought together. Not one against those who mean harm.

use crate::error::{Result, filled};
use crate::parallel::Run;

/// Bytes that make a piece: pieces are summed on all threads.
pub(super) const PIECE: usize = 1 << 20;

/// Odd, so that multiplication can be undone (that of SplitMix64).
const FACTOR: u64 = 0xBF58_476D_1CE4_E5B9;

/// One more word.
#[inline(always)]
fn step(sum: u64, word: u64) -> u64 {
    let mixed = (sum ^ word).wrapping_mul(FACTOR);
    mixed ^ (mixed >> 32)
}

/// Of words, in order.
pub(super) fn of_words(words: impl IntoIterator<Item = u64>) -> u64 {
    words.into_iter().fold(FACTOR, step)
}

/// Of a piece: a multiple of 64 bytes.
pub(super) fn of_piece(bytes: &[u8]) -> u64 {
    let mut lanes = [FACTOR; 8];
    for line in bytes.as_chunks::<64>().0 {
        for (lane, word) in lanes.iter_mut().zip(line.as_chunks::<8>().0) {
            *lane = step(*lane, u64::from_ne_bytes(*word));
        }
    }
    of_words(lanes)
}

/// Of all, a multiple of 64 bytes.
pub(super) fn of_all(bytes: &[u8], run: &Run) -> Result<u64> {
    let mut sums = filled("sums", bytes.len().div_ceil(PIECE), 0)?;
    run.for_each_piece(&mut sums, 1, &|k, sum| {
        sum[0] = of_piece(&bytes[k * PIECE..bytes.len().min((k + 1) * PIECE)]);
        Ok(())
    })?;
    Ok(of_words(sums))
}
