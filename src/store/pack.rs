// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writing a block: first what is to stand in it is collected, words as they come and arrays by reference; then its size
//! is known, and any part of it can be made.

use super::block::ALIGNMENT;
use super::header::{self, ENTRY, Header};
use super::plain::Plain;
use super::{Array, checksum};
use crate::error::{Error, Result, filled, try_with_capacity};
use crate::math::Vec3;
use crate::parallel::Run;
use std::collections::HashMap;
use std::io::{self, Write};
use std::slice;

/// An array of the block, as bytes.
struct Entry<'a> {
    bytes: &'a [u8],
    element: usize,
}

/// What is to stand in a block.
#[derive(Default)]
pub(crate) struct Packer<'a> {
    words: Vec<u64>,
    arrays: Vec<Entry<'a>>,
    /// By where they are: one that is shared stands there once.
    seen: HashMap<(usize, usize), u64>,
    /// Whether memory ran out.
    failed: bool,
}

impl<'a> Packer<'a> {
    pub(crate) fn word(&mut self, word: u64) {
        match self.words.try_reserve(1) {
            Ok(()) => self.words.push(word),
            Err(_) => self.failed = true,
        }
    }

    pub(crate) fn number(&mut self, x: f64) {
        self.word(x.to_bits());
    }

    pub(crate) fn numbers(&mut self, all: impl IntoIterator<Item = f64>) {
        all.into_iter().for_each(|x| self.number(x));
    }

    pub(crate) fn vector(&mut self, v: Vec3) {
        self.numbers(v.to_array());
    }

    /// An array: its number, from 1 on; 0 where it is empty.
    pub(crate) fn array<T: Plain>(&mut self, array: &'a Array<T>) {
        let size = size_of_val(&array[..]);
        if size == 0 {
            return self.word(0);
        }
        // SAFETY: plain types are made of bytes that all have a value.
        let bytes = unsafe { slice::from_raw_parts(array.as_ptr().cast::<u8>(), size) };
        let next = self.arrays.len() as u64 + 1;
        if self.arrays.try_reserve(1).is_err() || self.seen.try_reserve(1).is_err() {
            self.failed = true;
            return;
        }
        let number = *self.seen.entry((array.as_ptr().addr(), size)).or_insert(next);
        if number == next {
            self.arrays.push(Entry { bytes, element: size_of::<T>() });
        }
        self.word(number);
    }

    /// The block, of which nothing is made yet.
    pub(crate) fn packed(self) -> Result<Packed<'a>> {
        let Packer { words, arrays, failed, .. } = self;
        if failed {
            return Err(Error::memory("words", words.len() + 1));
        }
        let too_large = || Error::unsupported("g: it is too large for one block");
        let header = Header { arrays: arrays.len() as u64, words: words.len() as u64, ..Header::default() };
        let front_end = header.front_end().ok_or_else(too_large)?;
        let mut front = try_with_capacity("words", front_end / 8)?;
        front.resize(header::SIZE / 8, 0);
        let (mut at, mut placed) = (front_end, try_with_capacity("arrays", arrays.len())?);
        for Entry { bytes, element } in arrays {
            front.extend([at as u64, bytes.len() as u64, element as u64]);
            placed.push((at, bytes));
            at = at
                .checked_add(bytes.len())
                .and_then(|end| end.checked_next_multiple_of(ALIGNMENT))
                .ok_or_else(too_large)?;
        }
        debug_assert_eq!(front.len(), header::SIZE / 8 + ENTRY * placed.len());
        front.extend(words);
        front.resize(front_end / 8, 0);
        Ok(Packed { front, words: header.words, arrays: placed, size: at })
    }
}

/// A block to be written.
pub(crate) struct Packed<'a> {
    /// Header, directory and words.
    front: Vec<u64>,
    /// How many of them are words of nodes.
    words: u64,
    /// Where each begins.
    arrays: Vec<(usize, &'a [u8])>,
    size: usize,
}

impl<'a> Packed<'a> {
    /// Bytes.
    pub(crate) fn size(&self) -> usize {
        self.size
    }

    fn front_end(&self) -> usize {
        8 * self.front.len()
    }

    /// The bytes of the arrays from `from` on.
    fn fill(&self, from: usize, out: &mut [u8]) {
        out.fill(0);
        let to = from + out.len();
        let first = self.arrays.partition_point(|(at, bytes)| at + bytes.len() <= from);
        for (at, bytes) in self.arrays[first..].iter().take_while(|(at, _)| *at < to) {
            let (begin, end) = (from.max(*at), to.min(at + bytes.len()));
            out[begin - from..end - from].copy_from_slice(&bytes[begin - at..end - at]);
        }
    }

    /// The bytes up to the first array, where the sum of the arrays is this.
    fn finish(&self, array_sum: u64) -> Result<Vec<u8>> {
        let mut bytes = try_with_capacity("bytes", self.front_end())?;
        bytes.extend(self.front.iter().flat_map(|word| word.to_ne_bytes()));
        let header = Header {
            size: self.size as u64,
            arrays: self.arrays.len() as u64,
            words: self.words,
            front_sum: checksum::of_piece(&bytes[header::SIZE..]),
            array_sum,
        };
        bytes[..header::SIZE].copy_from_slice(&header.bytes());
        Ok(bytes)
    }

    /// Writes all of it to where it has room.
    pub(crate) fn write(&self, out: &mut [u8], run: &Run) -> Result<()> {
        let (front, arrays) = out[..self.size].split_at_mut(self.front_end());
        run.for_each_piece(arrays, checksum::PIECE, &|from, piece| {
            self.fill(self.front_end() + from, piece);
            Ok(())
        })?;
        let sum = checksum::of_all(arrays, run)?;
        front.copy_from_slice(&self.finish(sum)?);
        Ok(())
    }

    /// The sum of the arrays, before any of it is written.
    fn sum(&self, run: &Run) -> Result<u64> {
        let size = self.size - self.front_end();
        let mut sums = filled("sums", size.div_ceil(checksum::PIECE), 0)?;
        run.for_each_piece(&mut sums, 1, &|k, sum| {
            let from = k * checksum::PIECE;
            let mut piece = filled("bytes", checksum::PIECE.min(size - from), 0)?;
            self.fill(self.front_end() + from, &mut piece);
            sum[0] = checksum::of_piece(&piece);
            Ok(())
        })?;
        Ok(checksum::of_words(sums))
    }

    /// What can be written in order.
    pub(crate) fn sealed(self, run: &Run) -> Result<Sealed<'a>> {
        let sum = self.sum(run)?;
        Ok(Sealed { front: self.finish(sum)?, packed: self })
    }
}

/// A block whose sums are known.
pub(crate) struct Sealed<'a> {
    front: Vec<u8>,
    packed: Packed<'a>,
}

impl Sealed<'_> {
    pub(crate) fn write_to(&self, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(&self.front)?;
        let mut piece = vec![0; checksum::PIECE];
        for from in (self.front.len()..self.packed.size).step_by(checksum::PIECE) {
            let piece = &mut piece[..checksum::PIECE.min(self.packed.size - from)];
            self.packed.fill(from, piece);
            out.write_all(piece)?;
        }
        Ok(())
    }
}
