// SPDX-License-Identifier: MIT OR Apache-2.0
//! A legacy VTK file word by word, and its arrays of numbers, as text or as big-endian bytes.

use crate::error::{Error, Result, try_with_capacity};
use crate::io::number::Number;
use crate::io::text::one_line;
use crate::io::words::Words;

#[derive(Clone)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    words: Words<'a>,
    pub binary: bool,
}

impl<'a> Cursor<'a> {
    pub fn new(bytes: &'a [u8]) -> Cursor<'a> {
        Cursor { bytes, words: Words::from_line(bytes, 1), binary: false }
    }

    /// The next word; empty at the end.
    pub fn word(&mut self) -> &'a [u8] {
        self.words.next()
    }

    /// The word after this one, which stays.
    pub fn peek(&self) -> &'a [u8] {
        self.words.clone().next()
    }

    pub fn rest_of_line(&mut self) -> String {
        self.words.rest_of_line()
    }

    /// The next word as text, its %-escapes resolved.
    pub fn name(&mut self) -> Result<String> {
        let word = self.words.next();
        if word.is_empty() {
            return Err(self.words.unexpected(word, "a name"));
        }
        Ok(unescaped(word))
    }

    /// The next word as a count.
    pub fn count(&mut self) -> Result<usize> {
        let word = self.words.next();
        self.words.parsed(word, "a count")
    }

    /// Where the cursor is, for messages.
    pub fn place(&self) -> String {
        if self.binary { format!("offset {}", self.at()) } else { format!("line {}", self.words.line()) }
    }

    pub fn wrong(&self, what: impl std::fmt::Display) -> Error {
        Error::parse(format!("{}: {what}", self.place()))
    }

    fn at(&self) -> usize {
        self.bytes.len() - self.words.left()
    }

    fn go_to(&mut self, at: usize) {
        self.words = Words::from_line(&self.bytes[at..], self.words.line());
    }

    /// Steps over the end of the line, behind which bytes begin.
    fn end_line(&mut self) {
        self.words.rest_of_line();
        let rest = &self.bytes[self.at()..];
        let ends = if rest.starts_with(b"\r\n") { 2 } else { usize::from(!rest.is_empty()) };
        self.words = Words::from_line(&rest[ends..], self.words.line() + ends.min(1));
    }

    /// So many numbers. Nothing is allocated by the claim alone.
    pub fn numbers(&mut self, count: usize, number: Number) -> Result<Vec<f64>> {
        if !self.binary {
            if count > self.words.left() {
                return Err(self.wrong(format_args!("{} bytes left cannot hold {count} numbers", self.words.left())));
            }
            let mut values = try_with_capacity("values", count)?;
            for _ in 0..count {
                let word = self.words.next();
                values.push(self.words.number_in(word, number)?);
            }
            return Ok(values);
        }
        let bytes = self.raw(count, number.size())?;
        number.decode(bytes, true)
    }

    /// The bytes of so many items behind the end of the line.
    pub fn raw(&mut self, count: usize, size: usize) -> Result<&'a [u8]> {
        self.end_line();
        let at = self.at();
        let needed = count.checked_mul(size).and_then(|n| n.checked_add(at)).filter(|end| *end <= self.bytes.len());
        let Some(end) = needed else {
            let left = self.bytes.len() - at;
            return Err(self.wrong(format_args!("{left} bytes left cannot hold {count} items of {size} bytes")));
        };
        let bytes = &self.bytes[at..end];
        self.go_to(end);
        Ok(bytes)
    }

    /// The next line, without white space around it; none at the end.
    fn line(&mut self) -> Option<String> {
        (self.words.left() > 0).then(|| {
            let line = self.words.rest_of_line();
            self.end_line();
            line
        })
    }

    /// The line of a METADATA block that must be there.
    fn line_of(&mut self, block: &str) -> Result<String> {
        self.line().ok_or_else(|| self.wrong(format_args!("the file ends within {block}")))
    }

    /// Steps over the METADATA of an array of so many components, where they follow: a name of each component, empty
    /// lines for those that have none, and the keys of an INFORMATION. An empty line ends them.
    pub fn skip_metadata(&mut self, components: usize) -> Result<()> {
        let mut ahead = self.words.clone();
        if !ahead.next().eq_ignore_ascii_case(b"METADATA") || !ahead.rest_of_line().is_empty() {
            return Ok(());
        }
        self.words = ahead;
        self.end_line();
        loop {
            let place = self.place();
            let Some(line) = self.line() else { return Ok(()) };
            let words: Vec<&str> = line.split_whitespace().take(3).collect();
            match words[..] {
                [] => return Ok(()),
                [word] if word.eq_ignore_ascii_case("COMPONENT_NAMES") => {
                    for _ in 0..components {
                        self.line_of("COMPONENT_NAMES")?;
                    }
                }
                [word, count] if word.eq_ignore_ascii_case("INFORMATION") && count.parse::<u32>().is_ok() => {
                    for _ in 0..count.parse().unwrap_or(0u32) {
                        self.skip_key()?;
                    }
                }
                _ => return Err(Error::parse(format!("{place}: \"{line:.40}\" is no part of METADATA"))),
            }
        }
    }

    /// Steps over a key of an INFORMATION: its name and its data.
    fn skip_key(&mut self) -> Result<()> {
        let mut place = self.place();
        let mut name = self.line_of("INFORMATION")?;
        while name.is_empty() {
            place = self.place();
            name = self.line_of("INFORMATION")?;
        }
        let data = self.line_of("INFORMATION")?;
        let words: Vec<&str> = data.split_whitespace().take(3).collect();
        if !name.starts_with("NAME ") || words.first() != Some(&"DATA") {
            let what = format!("\"{name:.40}\" and \"{data:.40}\" are no key of INFORMATION");
            return Err(Error::parse(format!("{place}: {what}")));
        }
        // Behind the count of strings each has a line.
        let next = self.words.clone().rest_of_line();
        if let [_, count] = words[..]
            && let Ok(count) = count.parse::<usize>()
            && !next.is_empty()
            && !next.starts_with("NAME ")
        {
            for _ in 0..count {
                self.line_of("INFORMATION")?;
            }
        }
        Ok(())
    }

    /// Goes behind the end of the line, where the strings of an array begin.
    pub fn begin_strings(&mut self) {
        self.end_line();
    }

    /// The next string of an array: a line with %-escapes, or bytes behind their count. The count's first two bits
    /// say that it has 8, 4, 2 bytes or 1.
    pub fn string(&mut self) -> Result<String> {
        if !self.binary {
            let line = self.line_of("an array of strings")?;
            return Ok(unescaped(line.as_bytes()));
        }
        let rest = &self.bytes[self.at()..];
        let size = 8 >> (rest.first().copied().unwrap_or(0) >> 6);
        let mut count = [0; 8];
        let Some(given) = rest.get(..size) else {
            return Err(self.wrong("the file ends within an array of strings"));
        };
        count[8 - size..].copy_from_slice(given);
        if size < 8 {
            count[8 - size] &= 63;
        }
        let (count, left) = (u64::from_be_bytes(count), &rest[size..]);
        let Some(string) = usize::try_from(count).ok().and_then(|n| left.get(..n)) else {
            return Err(self.wrong(format_args!("{} bytes left cannot hold a string of {count}", left.len())));
        };
        self.go_to(self.at() + size + string.len());
        Ok(one_line(&String::from_utf8_lossy(string)))
    }

    /// Steps over so many lines.
    pub fn skip_lines(&mut self, count: usize) {
        for _ in 0..count.min(self.words.left()) {
            self.end_line();
        }
    }
}

/// %20 and the like become what they stand for.
fn unescaped(word: &[u8]) -> String {
    let mut out = Vec::new();
    let mut k = 0;
    while let Some(&b) = word.get(k) {
        let code = word.get(k + 1..k + 3).and_then(|hex| std::str::from_utf8(hex).ok());
        match code.and_then(|hex| u8::from_str_radix(hex, 16).ok()).filter(|_| b == b'%') {
            Some(byte) => {
                out.push(byte);
                k += 3;
            }
            None => {
                out.push(b);
                k += 1;
            }
        }
    }
    one_line(&String::from_utf8_lossy(&out))
}

/// White space, quotes and percent signs as %20 and the like. VTK takes every name that begins with METADATA for a
/// block of metadata.
pub(super) fn escaped(name: &str) -> String {
    let mut out = String::new();
    let metadata = name.get(..8).is_some_and(|begin| begin.eq_ignore_ascii_case("METADATA"));
    for (k, b) in name.bytes().enumerate() {
        if b.is_ascii_graphic() && b != b'%' && b != b'"' && !(metadata && k == 0) {
            out.push(b as char);
        } else {
            out += &format!("%{b:02X}");
        }
    }
    out
}

/// The type of numbers that a word names.
pub(super) fn type_of(word: &[u8]) -> Option<Number> {
    Some(match &word.to_ascii_lowercase()[..] {
        b"char" | b"signed_char" | b"vtktypeint8" => Number::I8,
        b"unsigned_char" | b"vtktypeuint8" => Number::U8,
        b"short" | b"vtktypeint16" => Number::I16,
        b"unsigned_short" | b"vtktypeuint16" => Number::U16,
        // VTK writes its type of indices as int, however many bytes one has in memory.
        b"int" | b"vtktypeint32" | b"vtkidtype" => Number::I32,
        b"unsigned_int" | b"vtktypeuint32" => Number::U32,
        b"long" | b"long_long" | b"vtktypeint64" => Number::I64,
        b"unsigned_long" | b"unsigned_long_long" | b"vtktypeuint64" => Number::U64,
        b"float" => Number::F32,
        b"double" => Number::F64,
        _ => return None,
    })
}
