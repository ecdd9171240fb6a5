// SPDX-License-Identifier: MIT OR Apache-2.0
//! The bytes of an array: a size and the bytes, or the sizes of blocks and the blocks, each compressed by zlib
//! (Deutsch & Gailly 1996).

use super::base64::Base64;
use super::xml::{Tag, shortened, wrong};
use crate::error::{Error, Result, try_with_capacity};
use miniz_oxide::inflate::decompress_slice_iter_to_slice;
use std::borrow::Cow;

/// Deflate makes no more than this of a byte (a match of 258 bytes takes two bits).
const EXPANSION: usize = 1032;

/// How a file holds binary data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Encoding {
    pub big_endian: bool,
    /// Sizes have 8 bytes, not 4.
    pub wide: bool,
    pub zlib: bool,
}

impl Encoding {
    /// What the first tag says.
    pub fn of(root: &Tag) -> Result<Encoding> {
        let either = |name: &str, values: [&str; 2]| {
            let value = root.attribute(name)?.unwrap_or(values[0].into());
            let at = values.iter().position(|v| *v == value);
            let [first, second] = values;
            let neither = || format!("{name}: \"{}\" is neither {first} nor {second}", shortened(&value));
            at.map(|k| k == 1).ok_or_else(|| root.wrong(neither()))
        };
        let compressor = root.attribute("compressor")?.unwrap_or_default();
        if !["", "vtkZLibDataCompressor"].contains(&&*compressor) {
            let what = format!("offset {}: <VTKFile>: compressor: {} is not zlib", root.at, shortened(&compressor));
            return Err(Error::unsupported(what));
        }
        Ok(Encoding {
            big_endian: either("byte_order", ["LittleEndian", "BigEndian"])?,
            wide: either("header_type", ["UInt32", "UInt64"])?,
            zlib: !compressor.is_empty(),
        })
    }

    fn size_of_sizes(self) -> usize {
        if self.wide { 8 } else { 4 }
    }

    /// The next sizes. There are bytes for them, or it is an error.
    fn sizes(self, source: &mut Source, count: usize) -> Result<Vec<usize>> {
        let size = self.size_of_sizes();
        let bytes = source.take(count.saturating_mul(size))?;
        let mut sizes = try_with_capacity("sizes", count)?;
        for part in bytes.chunks_exact(size) {
            let mut le = [0; 8];
            le[..size].copy_from_slice(part);
            if self.big_endian {
                le[..size].reverse();
            }
            // What usize does not hold is more than there can be.
            sizes.push(usize::try_from(u64::from_le_bytes(le)).unwrap_or(usize::MAX));
        }
        Ok(sizes)
    }

    /// The bytes of the array that begins here: as many as wanted, where that is known.
    pub fn read<'a>(self, source: &mut Source<'a>, wanted: Option<usize>) -> Result<Cow<'a, [u8]>> {
        let at = source.offset();
        let check = |there: usize| match wanted {
            Some(n) if n != there => Err(wrong(at, format_args!("{there} bytes, not {n}"))),
            _ => Ok(()),
        };
        let first = self.sizes(source, 1)?[0];
        if !self.zlib {
            check(first)?;
            return source.take(first);
        }
        if first == 0 {
            check(0)?;
            return Ok(Cow::Borrowed(&[]));
        }
        let [block, last] = self.sizes(source, 2)?[..] else { return Err(wrong(at, "no sizes of blocks")) };
        let last = if last == 0 { block } else { last };
        let total = (first - 1).checked_mul(block).and_then(|n| n.checked_add(last)).unwrap_or(usize::MAX);
        check(total)?;
        let packed = self.sizes(source, first)?;
        let sum = packed.iter().fold(0usize, |sum, n| sum.saturating_add(*n));
        if sum > source.at_most() || total / EXPANSION > sum {
            return Err(wrong(
                at,
                format_args!("{total} bytes in {sum} of zlib, of which {} can be there", source.at_most()),
            ));
        }
        inflate(source, &packed, [block, last], total).map(Cow::Owned)
    }
}

/// Blocks of the sizes `packed`: all of `sizes[0]` bytes but the last, of `sizes[1]`.
fn inflate(source: &mut Source, packed: &[usize], sizes: [usize; 2], total: usize) -> Result<Vec<u8>> {
    let mut out = try_with_capacity("bytes", total)?;
    out.resize(total, 0);
    let mut rest = &mut out[..];
    for (k, n) in packed.iter().enumerate() {
        let at = source.offset();
        let size = sizes[usize::from(k + 1 == packed.len())];
        let bytes = source.take(*n)?;
        let (block, after) = rest.split_at_mut(size);
        rest = after;
        match decompress_slice_iter_to_slice(block, std::iter::once(&*bytes), true, false) {
            Ok(n) if n == size => {}
            Ok(n) => return Err(wrong(at, format_args!("block {k}: zlib gives {n} bytes, not {size}"))),
            Err(status) => return Err(wrong(at, format_args!("block {k}: zlib gives no {size} bytes: {status:?}"))),
        }
    }
    Ok(out)
}

/// Bytes to be taken one part after another.
pub(super) enum Source<'a> {
    /// Bytes as they are, and where they are in the file.
    Raw(&'a [u8], usize),
    Base64(Base64<'a>),
}

impl<'a> Source<'a> {
    /// Where the next part is in the file.
    pub fn offset(&self) -> usize {
        match self {
            Source::Raw(_, at) => *at,
            Source::Base64(text) => text.offset(),
        }
    }

    /// No more bytes are left than this.
    fn at_most(&self) -> usize {
        match self {
            Source::Raw(bytes, _) => bytes.len(),
            Source::Base64(text) => text.at_most(),
        }
    }

    /// The next bytes.
    fn take(&mut self, count: usize) -> Result<Cow<'a, [u8]>> {
        if count > self.at_most() {
            return Err(wrong(self.offset(), format_args!("{count} bytes, of which {} can be there", self.at_most())));
        }
        match self {
            Source::Raw(bytes, at) => {
                let (first, rest) = bytes.split_at(count);
                *bytes = rest;
                *at += count;
                Ok(Cow::Borrowed(first))
            }
            Source::Base64(text) => text.take(count).map(Cow::Owned),
        }
    }
}
