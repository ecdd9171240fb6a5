// SPDX-License-Identifier: MIT OR Apache-2.0
//! The numbers of a PLY file one after another, in any of its encodings.

use super::header::Encoding;
use crate::error::{Error, Result};
use crate::io::number::Number;
use crate::io::words::Words;

pub(super) enum Numbers<'a> {
    Text { words: Words<'a>, size: usize },
    Binary { bytes: &'a [u8], at: usize, big_endian: bool },
}

impl<'a> Numbers<'a> {
    /// Those from `start` on; `line` is that of the last line before it.
    pub fn new(bytes: &'a [u8], start: usize, line: usize, encoding: Encoding) -> Numbers<'a> {
        match encoding {
            Encoding::Ascii => Numbers::Text { words: Words::from_line(&bytes[start..], line + 1), size: bytes.len() },
            _ => Numbers::Binary { bytes, at: start, big_endian: encoding == Encoding::BigEndian },
        }
    }

    /// Bytes not read yet.
    pub fn left(&self) -> usize {
        match self {
            Numbers::Text { words, .. } => words.left(),
            Numbers::Binary { bytes, at, .. } => bytes.len() - at,
        }
    }

    /// Bytes of the file.
    pub fn size(&self) -> usize {
        match self {
            Numbers::Text { size, .. } => *size,
            Numbers::Binary { bytes, .. } => bytes.len(),
        }
    }

    /// Where the last number was, for messages.
    pub fn place(&self) -> String {
        match self {
            Numbers::Text { words, .. } => format!("line {}", words.line()),
            Numbers::Binary { at, .. } => format!("offset {at}"),
        }
    }

    /// The next number.
    pub fn next(&mut self, t: Number) -> Result<f64> {
        match self {
            Numbers::Text { words, .. } => {
                let word = words.next();
                words.number_in(word, t)
            }
            Numbers::Binary { bytes, at, big_endian } => {
                let n = t.size();
                let Some(raw) = bytes.get(*at..*at + n) else {
                    return Err(Error::parse(format!("offset {}: the file ends within a number", bytes.len())));
                };
                *at += n;
                let mut own = [0; 8];
                own[..n].copy_from_slice(raw);
                if *big_endian {
                    own[..n].reverse();
                }
                Ok(value(own, t))
            }
        }
    }
}

/// The number in the first bytes, which are little-endian.
fn value(b: [u8; 8], t: Number) -> f64 {
    match t {
        Number::I8 => f64::from(b[0] as i8),
        Number::U8 => f64::from(b[0]),
        Number::I16 => f64::from(i16::from_le_bytes([b[0], b[1]])),
        Number::U16 => f64::from(u16::from_le_bytes([b[0], b[1]])),
        Number::I32 => f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        Number::U32 => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        Number::F32 => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        Number::I64 => i64::from_le_bytes(b) as f64,
        Number::U64 => u64::from_le_bytes(b) as f64,
        Number::F64 => f64::from_le_bytes(b),
    }
}
