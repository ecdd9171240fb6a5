// SPDX-License-Identifier: MIT OR Apache-2.0
//! Text formats word by word: any white space, LF, CRLF or CR, and the line for the message.

use super::number::Number;
use super::text::one_line;
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::mesh::LARGEST_COORDINATE;
use std::str::FromStr;

/// The words of a text, and the line they are in.
#[derive(Clone)]
pub(super) struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl<'a> Words<'a> {
    /// The words of a file, after its byte order mark.
    pub fn new(bytes: &'a [u8]) -> Words<'a> {
        Words { bytes: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), at: 0, line: 1 }
    }

    /// The words of a piece of text that begins in this line.
    pub fn from_line(bytes: &'a [u8], line: usize) -> Words<'a> {
        Words { bytes, at: 0, line }
    }

    /// Bytes not read yet.
    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The line of the last word, from 1.
    pub fn line(&self) -> usize {
        self.line
    }

    /// The next word; empty at the end.
    pub fn next(&mut self) -> &'a [u8] {
        while let Some(&b) = self.bytes.get(self.at) {
            if !is_space(b) {
                break;
            }
            self.pass(b);
        }
        let start = self.at;
        while self.bytes.get(self.at).is_some_and(|&b| !is_space(b)) {
            self.at += 1;
        }
        &self.bytes[start..self.at]
    }

    /// The next word of the line; empty at its end. A backslash at the end of a line joins the next one to it.
    pub fn next_on_line(&mut self) -> &'a [u8] {
        while let Some(&b) = self.bytes.get(self.at) {
            if self.joins_lines() {
                self.join();
            } else if is_space(b) && b != b'\n' && b != b'\r' {
                self.at += 1;
            } else {
                break;
            }
        }
        let start = self.at;
        while self.bytes.get(self.at).is_some_and(|&b| !is_space(b)) && !self.joins_lines() {
            self.at += 1;
        }
        &self.bytes[start..self.at]
    }

    /// Goes to the next line, over what is left of this one and of those that backslashes join to it; false
    /// at the end.
    pub fn next_line(&mut self) -> bool {
        while let Some(&b) = self.bytes.get(self.at) {
            if self.joins_lines() {
                self.join();
            } else if b == b'\n' || b == b'\r' {
                self.pass(b);
                // Else the line feed of CRLF would be an empty line.
                if b == b'\r' && self.bytes.get(self.at) == Some(&b'\n') {
                    self.pass(b'\n');
                }
                return true;
            } else {
                self.at += 1;
            }
        }
        false
    }

    /// At a backslash that ends a line or the file.
    fn joins_lines(&self) -> bool {
        self.bytes[self.at] == b'\\' && matches!(self.bytes.get(self.at + 1), None | Some(b'\n' | b'\r'))
    }

    /// Steps over such a backslash and the end of the line.
    fn join(&mut self) {
        self.at += 1;
        for end in [b'\r', b'\n'] {
            if self.bytes.get(self.at) == Some(&end) {
                self.pass(end);
            }
        }
    }

    /// What is left of the line, without white space around it and control characters; not UTF-8 becomes U+FFFD.
    pub fn rest_of_line(&mut self) -> String {
        let start = self.at;
        while let Some(&b) = self.bytes.get(self.at)
            && b != b'\n'
            && b != b'\r'
        {
            self.at += 1;
        }
        one_line(&String::from_utf8_lossy(&self.bytes[start..self.at]))
    }

    /// Steps over white space. CRLF counts once.
    fn pass(&mut self, b: u8) {
        let ends_line = b == b'\n' || (b == b'\r' && self.bytes.get(self.at + 1) != Some(&b'\n'));
        self.line += usize::from(ends_line);
        self.at += 1;
    }

    /// Three coordinates.
    pub fn position(&mut self) -> Result<Vec3> {
        Ok(Vec3::new(self.coordinate()?, self.coordinate()?, self.coordinate()?))
    }

    /// A finite coordinate.
    pub fn coordinate(&mut self) -> Result<f64> {
        let word = self.next();
        self.coordinate_in(word)
    }

    /// The finite coordinate that a word is.
    pub fn coordinate_in(&self, word: &[u8]) -> Result<f64> {
        let x = self.parsed::<f64>(word, "a number")?;
        if !x.is_finite() || x.abs() > LARGEST_COORDINATE {
            return Err(self.unexpected(word, "a finite coordinate"));
        }
        Ok(x)
    }

    /// The value of a word, or an error that says what was wanted.
    pub fn parsed<T: FromStr>(&self, word: &[u8], wanted: &str) -> Result<T> {
        let value = std::str::from_utf8(word).ok().and_then(|w| w.parse().ok());
        value.ok_or_else(|| self.unexpected(word, wanted))
    }

    /// The number of a type that a word is.
    pub fn number_in(&self, word: &[u8], number: Number) -> Result<f64> {
        number.parsed(word).ok_or_else(|| match Number::F64.parsed(word) {
            Some(_) => self.unexpected(word, &format!("a number of the type {}", number.name())),
            None => self.unexpected(word, "a number"),
        })
    }

    /// Nothing where the word is the wanted one, in any case.
    pub fn require(&self, word: &[u8], wanted: &str) -> Result<()> {
        if word.eq_ignore_ascii_case(wanted.as_bytes()) { Ok(()) } else { Err(self.unexpected(word, wanted)) }
    }

    /// The error at a word that should have been something else.
    pub fn unexpected(&self, word: &[u8], wanted: &str) -> Error {
        if word.is_empty() {
            return Error::parse(format!("line {}: the file ends where {wanted} should be", self.line));
        }
        let shown = String::from_utf8_lossy(&word[..word.len().min(40)]);
        Error::parse(format!("line {}: \"{shown}\" is not {wanted}", self.line))
    }
}

fn is_space(b: u8) -> bool {
    b == b' ' || (b'\t'..=b'\r').contains(&b)
}
