// SPDX-License-Identifier: MIT OR Apache-2.0
//! The part of XML that VTK's files use: tags with attributes, text, comments and processing instructions. No
//! tree is built and nothing is expanded, so reading takes no memory.

use crate::error::{Error, Result};
use std::borrow::Cow;

/// The error at an offset.
pub(super) fn wrong(at: usize, what: impl std::fmt::Display) -> Error {
    Error::parse(format!("offset {at}: {what}"))
}

/// Tags, one after another.
pub(super) struct Xml<'a> {
    bytes: &'a [u8],
    at: usize,
}

/// An opening tag.
#[derive(Clone, Copy)]
pub(super) struct Tag<'a> {
    pub name: &'a [u8],
    attributes: &'a [u8],
    /// Where it begins in the file.
    pub at: usize,
}

/// What comes next.
pub(super) enum Markup<'a> {
    /// An element begins.
    Open(Tag<'a>),
    /// An element without content.
    Empty(Tag<'a>),
    /// An element of this name ends.
    Close(&'a [u8]),
    /// The file ends.
    End,
}

impl<'a> Xml<'a> {
    /// From the beginning of a file.
    pub fn new(bytes: &'a [u8]) -> Xml<'a> {
        Xml { bytes, at: 0 }
    }

    /// How far it has come.
    pub fn offset(&self) -> usize {
        self.at
    }

    /// The text up to the next tag, or the end.
    pub fn text(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let text = &rest[..rest.iter().position(|b| *b == b'<').unwrap_or(rest.len())];
        self.at += text.len();
        text
    }

    /// The next tag; text, comments and processing instructions before it are passed over.
    pub fn next(&mut self) -> Result<Markup<'a>> {
        loop {
            self.text();
            let rest = &self.bytes[self.at..];
            if rest.is_empty() {
                return Ok(Markup::End);
            } else if rest.starts_with(b"<!--") {
                self.pass(b"-->")?;
            } else if rest.starts_with(b"<?") {
                self.pass(b"?>")?;
            } else if rest.starts_with(b"<!") {
                let shown = String::from_utf8_lossy(&rest[..rest.len().min(9)]);
                return Err(wrong(self.at, format_args!("\"{shown}\" is not a tag of VTK")));
            } else {
                return self.tag();
            }
        }
    }

    /// Steps over what ends with `end`.
    fn pass(&mut self, end: &[u8]) -> Result<()> {
        let rest = &self.bytes[self.at..];
        let Some(length) = rest.windows(end.len()).position(|w| w == end) else {
            return Err(wrong(self.at, format_args!("no \"{}\" ends this", String::from_utf8_lossy(end))));
        };
        self.at += length + end.len();
        Ok(())
    }

    fn tag(&mut self) -> Result<Markup<'a>> {
        let at = self.at;
        let body = &self.bytes[at + 1..];
        let mut quote = None;
        let end = body.iter().position(|&b| {
            match quote {
                Some(q) if b == q => quote = None,
                None if b == b'"' || b == b'\'' => quote = Some(b),
                _ => {}
            }
            quote.is_none() && b == b'>'
        });
        let Some(end) = end else { return Err(wrong(at, "the file ends within this tag")) };
        self.at += 1 + end + 1;
        let body = &body[..end];
        if let Some(name) = body.strip_prefix(b"/") {
            return Ok(Markup::Close(name.trim_ascii_end()));
        }
        let (body, empty) = body.strip_suffix(b"/").map_or((body, false), |b| (b, true));
        let (name, attributes) = body.split_at(body.iter().position(u8::is_ascii_whitespace).unwrap_or(body.len()));
        if name.is_empty() {
            return Err(wrong(at, "a tag has no name"));
        }
        let tag = Tag { name, attributes, at };
        Ok(if empty { Markup::Empty(tag) } else { Markup::Open(tag) })
    }
}

impl<'a> Tag<'a> {
    /// The value of an attribute, where there is one.
    pub fn attribute(&self, name: &str) -> Result<Option<Cow<'a, str>>> {
        let mut rest = self.attributes.trim_ascii_start();
        while !rest.is_empty() {
            let (key, value, after) = self.first(rest)?;
            if key == name.as_bytes() {
                let value = String::from_utf8_lossy(value);
                return Ok(Some(if value.contains('&') { expanded(&value).into() } else { value }));
            }
            rest = after.trim_ascii_start();
        }
        Ok(None)
    }

    /// The count that an attribute is; 0 where there is none.
    pub fn count(&self, name: &str) -> Result<usize> {
        let Some(value) = self.attribute(name)? else { return Ok(0) };
        let count = value.trim().parse();
        count.map_err(|_| self.wrong(format_args!("{name}: \"{}\" is not a count", shortened(&value))))
    }

    /// The error at this tag.
    pub fn wrong(&self, what: impl std::fmt::Display) -> Error {
        wrong(self.at, format_args!("<{}>: {what}", String::from_utf8_lossy(&self.name[..self.name.len().min(40)])))
    }

    /// The first attribute of a text: its name, its value, and what follows.
    fn first(&self, text: &'a [u8]) -> Result<(&'a [u8], &'a [u8], &'a [u8])> {
        let parts = || {
            let (key, rest) = text.split_at(text.iter().position(|b| *b == b'=')?);
            let rest = rest[1..].trim_ascii_start();
            let (&quote, rest) = rest.split_first().filter(|(q, _)| matches!(q, b'"' | b'\''))?;
            let (value, rest) = rest.split_at(rest.iter().position(|b| *b == quote)?);
            Some((key.trim_ascii_end(), value, &rest[1..]))
        };
        let shown = || String::from_utf8_lossy(&text[..text.len().min(40)]);
        parts().ok_or_else(|| self.wrong(format_args!("\"{}\" is not an attribute", shown())))
    }
}

/// A value with its references replaced by what they stand for. VTK writes `&` for itself in names, so what is no
/// reference stays.
fn expanded(value: &str) -> String {
    let mut out = String::new();
    let mut rest = value;
    while let Some((before, after)) = rest.split_once('&') {
        out.push_str(before);
        let reference = after.split_once(';').and_then(|(name, after)| Some((referred(name)?, after)));
        let (character, after) = reference.unwrap_or(('&', after));
        out.push(character);
        rest = after;
    }
    out + rest
}

/// The character that a reference stands for.
fn referred(name: &str) -> Option<char> {
    match name {
        "lt" => Some('<'),
        "gt" => Some('>'),
        "amp" => Some('&'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => {
            let digits = name.strip_prefix('#')?;
            let number = match digits.strip_prefix('x') {
                Some(digits) => u32::from_str_radix(digits, 16),
                None => digits.parse(),
            };
            number.ok().and_then(char::from_u32)
        }
    }
}

/// As much of a text as fits in a message.
pub(super) fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}
