// SPDX-License-Identifier: MIT OR Apache-2.0
//! One array of a VTK XML file: what its tag says, and its values.

use super::base64::Base64;
use super::blocks::Source;
use super::document::{Document, Section};
use super::xml::{Tag, shortened, wrong};
use crate::error::{Error, Result, try_with_capacity};
use crate::io::number::Number;
use crate::io::text::one_line;
use crate::io::words::Words;
use std::borrow::Cow;

/// An array, not decoded yet.
pub(super) struct Array<'a> {
    pub tag: Tag<'a>,
    /// The text after the tag, and where it is in the file.
    pub body: &'a [u8],
    pub body_at: usize,
    pub section: Section,
}

/// Where the values are.
enum Form<'a> {
    Text,
    Bytes(Source<'a>),
}

impl<'a> Array<'a> {
    /// Its name; empty where it has none.
    pub fn name(&self) -> Result<String> {
        Ok(one_line(&self.tag.attribute("Name")?.unwrap_or_default()))
    }

    /// Numbers an item.
    pub fn components(&self) -> Result<usize> {
        match self.tag.attribute("NumberOfComponents")? {
            None => Ok(1),
            Some(_) => match self.tag.count("NumberOfComponents")? {
                0 => Err(self.tag.wrong("NumberOfComponents: 0 is not at least 1")),
                n => Ok(n),
            },
        }
    }

    /// Whether it holds numbers of whole bytes: neither strings nor bits.
    pub fn is_numeric(&self) -> Result<bool> {
        let kind = self.tag.attribute("type")?.unwrap_or_default();
        Ok(!matches!(&*kind, "String" | "Bit"))
    }

    /// The type of its numbers.
    pub fn number(&self) -> Result<Number> {
        let kind = self.tag.attribute("type")?.unwrap_or_default();
        let unknown = || self.wrong(format_args!("type: \"{}\" is no type of numbers", shortened(&kind)));
        Number::named(&kind).ok_or_else(unknown)
    }

    /// The numbers of so many items.
    pub fn values(&self, document: &Document<'a>, items: usize) -> Result<Vec<f64>> {
        let (components, number) = (self.components()?, self.number()?);
        let too_many = || self.wrong(format_args!("{components} numbers for each of {items} items are too many"));
        let count = items.checked_mul(components).ok_or_else(too_many)?;
        let bytes = count.checked_mul(number.size()).ok_or_else(too_many)?;
        if count == 0 {
            return Ok(Vec::new());
        }
        match self.form(document)? {
            Form::Text => self.numbers_of_text(document, count, number),
            Form::Bytes(mut source) => {
                let bytes = self.bytes(document, &mut source, Some(bytes))?;
                number.decode(&bytes, document.encoding.big_endian)
            }
        }
    }

    /// The strings of an array of them; each ends with a zero.
    pub fn strings(&self, document: &Document<'a>) -> Result<Vec<String>> {
        let bytes = match self.form(document)? {
            Form::Bytes(mut source) => self.bytes(document, &mut source, None)?.into_owned(),
            Form::Text => {
                let count = self.body.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty()).count();
                // VTK writes them as signed numbers.
                let bytes = self.numbers_of_text(document, count, Number::I16)?;
                if let Some(x) = bytes.iter().find(|x| !(-128.0..256.0).contains(*x)) {
                    return Err(self.wrong(format_args!("{x} is not a byte of a string")));
                }
                bytes.into_iter().map(|x| x as i16 as u8).collect()
            }
        };
        let ended = bytes.strip_suffix(b"\0").unwrap_or(&bytes);
        Ok(ended.split(|b| *b == 0).map(|name| one_line(&String::from_utf8_lossy(name))).collect())
    }

    /// Its bytes, decompressed. All arrays together may take as many of the file as there are, or few could be read
    /// again and again.
    fn bytes<'s>(&self, document: &Document, source: &mut Source<'s>, wanted: Option<usize>) -> Result<Cow<'s, [u8]>> {
        let before = source.offset();
        let bytes = document.encoding.read(source, wanted).map_err(|e| self.named(&e))?;
        let taken = document.taken.get().saturating_add(source.offset() - before);
        if taken > document.bytes.len() {
            let size = document.bytes.len();
            let what = format!("offset {}: {}data are shared: {taken} bytes of {size}", self.tag.at, self.label());
            return Err(Error::unsupported(what));
        }
        document.taken.set(taken);
        if document.encoding.zlib {
            document.decompressed.set(document.decompressed.get().saturating_add(bytes.len()));
        }
        Ok(bytes)
    }

    /// The error at this array.
    pub fn wrong(&self, what: impl std::fmt::Display) -> Error {
        wrong(self.tag.at, format_args!("{}{what}", self.label()))
    }

    fn label(&self) -> String {
        let name = self.name().unwrap_or_default();
        if name.is_empty() { String::new() } else { format!("array \"{}\": ", shortened(&name)) }
    }

    /// The error at a place of its data, with the name of the array.
    fn named(&self, error: &Error) -> Error {
        let (place, what) = error.message().split_once(": ").unwrap_or(("", error.message()));
        Error::new(error.status(), format!("{place}: {}{what}", self.label()))
    }

    fn form(&self, document: &Document<'a>) -> Result<Form<'a>> {
        let format = self.tag.attribute("format")?.unwrap_or("ascii".into());
        Ok(match &*format {
            "ascii" => Form::Text,
            "binary" => Form::Bytes(Source::Base64(Base64::new(self.body, self.body_at))),
            "appended" => {
                let offset = self.tag.count("offset")?;
                let none = || self.wrong(format_args!("offset: {offset} is beyond the appended data"));
                let appended = document.appended.ok_or_else(none)?;
                let data = appended.data.get(offset..).ok_or_else(none)?;
                let at = appended.at + offset;
                Form::Bytes(if appended.base64 { Source::Base64(Base64::new(data, at)) } else { Source::Raw(data, at) })
            }
            other => {
                let other = shortened(other);
                return Err(self.wrong(format_args!("format: \"{other}\" is none of ascii, binary, appended")));
            }
        })
    }

    fn numbers_of_text(&self, document: &Document<'a>, count: usize, number: Number) -> Result<Vec<f64>> {
        // Two characters a number are the least.
        let mut values = try_with_capacity("values", count.min(self.body.len() / 2 + 1))?;
        let mut words = Words::new(self.body);
        for _ in 0..count {
            let word = words.next();
            match number.parsed(word) {
                Some(x) => values.push(x),
                None if word.is_empty() => {
                    let there = values.len();
                    return Err(self.at_word(document, &words, format_args!("{there} numbers, not {count}")));
                }
                None => {
                    let of = Number::F64.parsed(word).map(|_| format!(" of the type {}", number.name()));
                    let (word, of) = (shortened(&String::from_utf8_lossy(word)), of.unwrap_or_default());
                    return Err(self.at_word(document, &words, format_args!("\"{word}\" is not a number{of}")));
                }
            }
        }
        match words.next() {
            b"" => Ok(values),
            _ => Err(self.at_word(document, &words, format_args!("more than {count} numbers"))),
        }
    }

    fn at_word(&self, document: &Document<'a>, words: &Words, what: std::fmt::Arguments) -> Error {
        let before = document.bytes[..self.body_at].iter().filter(|b| **b == b'\n').count();
        Error::parse(format!("line {}: {}{what}", before + words.line(), self.label()))
    }
}
