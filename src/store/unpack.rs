// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reading a block: arrays as views into it, words one after another. Nothing of it is believed that could lead out of
//! it; what numbers may be is for those to say who know what they mean.

use super::block::Block;
use super::header::{ENTRY, Header};
use super::plain::Plain;
use super::{Array, checksum};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::parallel::Run;
use std::sync::Arc;

/// A block that is being read.
pub(crate) struct Unpacker {
    block: Arc<Block>,
    header: Header,
    /// Where in the block the next word stands, and where the last one ends.
    at: usize,
    end: usize,
    /// Whether what stands in the arrays is to be looked at.
    checks: bool,
}

/// An error of what stands in a block.
pub(crate) fn wrong(what: &str) -> Error {
    Error::parse(format!("block: {what}"))
}

impl Unpacker {
    /// Looks at header, directory and words, and, where it `checks`, at the sum of the arrays, which reads all of them.
    pub(crate) fn new(block: Arc<Block>, checks: bool, run: &Run) -> Result<Unpacker> {
        let bytes = block.bytes();
        let header = Header::read(bytes, bytes.len())?;
        let (Some(at), Some(front_end)) = (header.words_at(), header.front_end()) else {
            return Err(wrong("its header is damaged"));
        };
        if checksum::of_piece(&bytes[super::header::SIZE..front_end]) != header.front_sum {
            return Err(wrong("its front is damaged (its checksum is another)"));
        }
        if checks && checksum::of_all(&bytes[front_end..], run)? != header.array_sum {
            return Err(wrong("its arrays are damaged (their checksum is another)"));
        }
        let end = at + 8 * header.words as usize;
        Ok(Unpacker { header, at, end, checks, block: block.clone() })
    }

    /// Whether what stands in the arrays is to be looked at.
    pub(crate) fn checks(&self) -> bool {
        self.checks
    }

    /// The block.
    pub(crate) fn block(&self) -> Arc<Block> {
        self.block.clone()
    }

    /// Words to come.
    pub(crate) fn left(&self) -> usize {
        (self.end - self.at) / 8
    }

    /// The word at a byte, where there is one.
    fn word_at(&self, at: usize) -> Option<u64> {
        self.block.bytes().get(at..)?.first_chunk().map(|bytes| u64::from_ne_bytes(*bytes))
    }

    pub(crate) fn word(&mut self) -> Result<u64> {
        let word = if self.left() > 0 { self.word_at(self.at) } else { None };
        self.at += 8;
        word.ok_or_else(|| wrong("it ends within a node"))
    }

    /// A word below `end`.
    pub(crate) fn index(&mut self, end: usize, what: &str) -> Result<usize> {
        let word = self.word()?;
        match usize::try_from(word) {
            Ok(k) if k < end => Ok(k),
            _ => Err(wrong(&format!("{what} {word} of {end}"))),
        }
    }

    /// How many things of `each` words follow: not more than there are words for.
    pub(crate) fn count(&mut self, each: usize, what: &str) -> Result<usize> {
        let most = self.left().saturating_sub(1) / each;
        self.index(most + 1, what)
    }

    pub(crate) fn flag(&mut self) -> Result<bool> {
        Ok(self.index(2, "flag")? == 1)
    }

    /// A number that may be infinite.
    pub(crate) fn number(&mut self) -> Result<f64> {
        let x = f64::from_bits(self.word()?);
        if x.is_nan() { Err(wrong("a number is NaN")) } else { Ok(x) }
    }

    pub(crate) fn finite(&mut self) -> Result<f64> {
        let x = self.number()?;
        if x.is_finite() { Ok(x) } else { Err(wrong("a number is not finite")) }
    }

    /// Several finite numbers.
    pub(crate) fn numbers<const N: usize>(&mut self) -> Result<[f64; N]> {
        let mut all = [0.0; N];
        for x in &mut all {
            *x = self.finite()?;
        }
        Ok(all)
    }

    /// A finite vector.
    pub(crate) fn vector(&mut self) -> Result<Vec3> {
        self.numbers().map(Vec3::from_array)
    }

    /// An array, as a view.
    pub(crate) fn array<T: Plain>(&mut self, what: &str) -> Result<Array<T>> {
        let arrays = self.header.arrays as usize;
        let Some(k) = self.index(arrays + 1, what)?.checked_sub(1) else { return Ok(Array::default()) };
        let entry = super::header::SIZE + 8 * ENTRY * k;
        let of = |j: usize| self.word_at(entry + 8 * j).and_then(|word| usize::try_from(word).ok());
        let (Some(at), Some(bytes), Some(element)) = (of(0), of(1), of(2)) else {
            return Err(wrong(&format!("{what}: its place is damaged")));
        };
        let fits = element == size_of::<T>() && bytes.is_multiple_of(element);
        let view = if fits { Array::within(&self.block, at, bytes / element) } else { None };
        view.ok_or_else(|| wrong(&format!("{what}: {bytes} bytes in elements of {element} do not lie there")))
    }

    /// An array of so many elements.
    pub(crate) fn array_of<T: Plain>(&mut self, what: &str, count: usize) -> Result<Array<T>> {
        let array = self.array::<T>(what)?;
        match array.len() == count {
            true => Ok(array),
            false => Err(wrong(&format!("{what}: {} elements where {count} are needed", array.len()))),
        }
    }
}
