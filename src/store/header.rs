// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a block begins with: sixteen words, and then the directory of its arrays.

use super::block::ALIGNMENT;
use super::checksum;
use crate::error::{Error, Result};

/// Bytes.
pub(super) const SIZE: usize = 128;

const WORDS: usize = SIZE / 8;

/// "EMBOUND" and a byte that no text has.
const MAGIC: [u8; 8] = *b"EMBOUND\x1A";

/// Of the layout, and of what stands in it: counts up with every change of either.
const VERSION: u32 = 1;

/// Stands in the order of the machine's bytes.
const ORDER: u32 = 0x0A0B_0C0D;

/// Words of the directory for each array: offset, bytes, bytes of an element.
pub(super) const ENTRY: usize = 3;

/// What stands in the header beside what never changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Header {
    /// Bytes of the whole block: a multiple of 64.
    pub(super) size: u64,
    pub(super) arrays: u64,
    /// Words of the nodes, after the directory.
    pub(super) words: u64,
    /// Of the front: directory and words, up to the first array.
    pub(super) front_sum: u64,
    /// Of the arrays.
    pub(super) array_sum: u64,
}

impl Header {
    pub(super) fn bytes(&self) -> [u8; SIZE] {
        let mut words = [0; WORDS];
        words[0] = u64::from_ne_bytes(MAGIC);
        let [a, b, c, d] = VERSION.to_ne_bytes();
        let [e, f, g, h] = ORDER.to_ne_bytes();
        words[1] = u64::from_ne_bytes([a, b, c, d, e, f, g, h]);
        words[2..7].copy_from_slice(&[self.size, self.arrays, self.words, self.front_sum, self.array_sum]);
        words[WORDS - 1] = checksum::of_words(words[..WORDS - 1].iter().copied());
        let mut bytes = [0; SIZE];
        for (bytes, word) in bytes.as_chunks_mut::<8>().0.iter_mut().zip(words) {
            *bytes = word.to_ne_bytes();
        }
        bytes
    }

    /// From the first bytes of a block of `size`.
    pub(super) fn read(bytes: &[u8], size: usize) -> Result<Header> {
        let Some(bytes) = bytes.first_chunk::<SIZE>() else {
            return Err(Error::parse(format!("block: {size} bytes are too few for one of emb_geom_pack's")));
        };
        if bytes[..8] != MAGIC {
            return Err(Error::parse("block: it does not begin as what emb_geom_pack makes does"));
        }
        let half = |at: usize| u32::from_ne_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        if half(12) == ORDER.swap_bytes() {
            return Err(Error::unsupported("block: it was packed on a machine with the other order of bytes"));
        }
        let mut words = [0; WORDS];
        for (word, bytes) in words.iter_mut().zip(bytes.as_chunks::<8>().0) {
            *word = u64::from_ne_bytes(*bytes);
        }
        if words[WORDS - 1] != checksum::of_words(words[..WORDS - 1].iter().copied()) {
            return Err(Error::parse("block: its header is damaged (its checksum is another)"));
        }
        if half(8) != VERSION || half(12) != ORDER {
            return Err(Error::unsupported(format!(
                "block: it is of version {}, this library reads version {VERSION}: pack it anew",
                half(8)
            )));
        }
        let [size_told, arrays, words, front_sum, array_sum] = [words[2], words[3], words[4], words[5], words[6]];
        if size_told != size as u64 {
            return Err(Error::parse(format!("block: {size} bytes are given, it has {size_told}")));
        }
        let header = Header { size: size_told, arrays, words, front_sum, array_sum };
        match header.front_end() {
            Some(end) if end <= size && size.is_multiple_of(ALIGNMENT) => Ok(header),
            _ => Err(Error::parse(format!("block: {size} bytes do not hold {arrays} arrays and {words} words"))),
        }
    }

    /// Where the words of the nodes begin.
    pub(super) fn words_at(&self) -> Option<usize> {
        let entries = usize::try_from(self.arrays).ok()?.checked_mul(8 * ENTRY)?;
        entries.checked_add(SIZE)
    }

    /// Where the first array begins.
    pub(super) fn front_end(&self) -> Option<usize> {
        let words = usize::try_from(self.words).ok()?.checked_mul(8)?;
        self.words_at()?.checked_add(words)?.checked_next_multiple_of(ALIGNMENT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Status;

    /// A header as another build would make it.
    fn with(word: usize, value: u64) -> Vec<u8> {
        let mut bytes = Header { size: SIZE as u64, ..Header::default() }.bytes().to_vec();
        bytes[8 * word..8 * word + 8].copy_from_slice(&value.to_ne_bytes());
        let words: Vec<u64> = bytes.as_chunks::<8>().0.iter().map(|b| u64::from_ne_bytes(*b)).collect();
        let sum = checksum::of_words(words[..WORDS - 1].iter().copied());
        bytes[SIZE - 8..].copy_from_slice(&sum.to_ne_bytes());
        bytes
    }

    #[test]
    fn foreign_headers_are_told_apart() {
        let status = |bytes: &[u8]| Header::read(bytes, SIZE).map_err(|e| e.status());
        let own = Header { size: SIZE as u64, ..Header::default() };
        assert_eq!(status(&own.bytes()), Ok(own));
        let halves = |version: u32, order: u32| {
            let bytes = [version.to_ne_bytes(), order.to_ne_bytes()].concat();
            u64::from_ne_bytes([0, 1, 2, 3, 4, 5, 6, 7].map(|k| bytes[k]))
        };
        assert_eq!(status(&with(1, halves(VERSION + 1, ORDER))), Err(Status::Unsupported));
        let swapped: Vec<u8> = own.bytes().as_chunks::<8>().0.iter().flat_map(|w| w.iter().rev().copied()).collect();
        assert_eq!(status(&swapped), Err(Status::Parse), "the magic is bytes, not a word");
        assert_eq!(status(&with(1, halves(VERSION.swap_bytes(), ORDER.swap_bytes()))), Err(Status::Unsupported));
        assert_eq!(status(&with(0, 0)), Err(Status::Parse));
        assert_eq!(status(&with(3, u64::MAX)), Err(Status::Parse));
        assert_eq!(status(&with(4, u64::MAX / 8)), Err(Status::Parse));
        assert_eq!(status(&with(2, 64)), Err(Status::Parse));
        assert_eq!(status(&own.bytes()[..100]), Err(Status::Parse));
        for bit in 0..8 * SIZE {
            let mut bytes = own.bytes();
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert!(status(&bytes).is_err(), "{bit}");
        }
    }
}
