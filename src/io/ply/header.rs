// SPDX-License-Identifier: MIT OR Apache-2.0
//! The header of a PLY file: which elements follow, how many of each, and what each item holds.

use crate::error::{Error, Result};
use crate::io::number::Number;
use crate::io::text::one_line;
use std::collections::BTreeSet;

/// How the numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// One number an item, or a count and so many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Scalar(Number),
    List { count: Number, item: Number },
}

pub(super) struct Property {
    pub name: String,
    pub shape: Shape,
}

pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
    /// Where it is declared.
    pub line: usize,
}

impl Element {
    /// Whether the element goes by this name, in any case.
    pub fn is(&self, name: &str) -> bool {
        self.name.eq_ignore_ascii_case(name)
    }

    /// The error at its declaration.
    pub fn wrong(&self, what: impl std::fmt::Display) -> Error {
        Error::parse(format!("line {}: element {}: {what}", self.line, shown(&self.name)))
    }

    /// The fewest bytes that an item can take.
    pub fn least_bytes(&self, encoding: Encoding) -> usize {
        let of = |p: &Property| match (encoding, p.shape) {
            // A digit, and the space before the next.
            (Encoding::Ascii, _) => 2,
            (_, Shape::Scalar(t) | Shape::List { count: t, .. }) => t.size(),
        };
        self.properties.iter().map(of).sum()
    }
}

pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    pub tag_names: Vec<(i32, String)>,
    pub vectors: Vec<Vector>,
    /// Where the items begin.
    pub end: usize,
    /// The lines up to there.
    pub lines: usize,
    /// Properties by the number of their element.
    names: BTreeSet<(usize, String)>,
}

/// Properties that are one field of several components, or one whose name holds white space.
pub(super) struct Vector {
    pub on_faces: bool,
    pub components: usize,
    pub name: String,
}

impl Vector {
    /// The name of the property of a component: PLY has no white space in names.
    pub fn property(&self, component: usize) -> String {
        let name: String = self.name.chars().map(|c| if c.is_whitespace() { '_' } else { c }).collect();
        if self.components == 1 { name } else { format!("{name}_{component}") }
    }
}

/// Reads up to `end_header`.
pub(super) fn read(bytes: &[u8]) -> Result<Header> {
    let end = bytes.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(0);
    let alone = bytes.get(end) == Some(&b'\r') && bytes.get(end + 1) != Some(&b'\n');
    let mut lines = Lines { bytes, at: 0, line: 0, alone };
    let mut header = Header {
        encoding: Encoding::Ascii,
        elements: Vec::new(),
        tag_names: Vec::new(),
        vectors: Vec::new(),
        end: 0,
        lines: 0,
        names: BTreeSet::new(),
    };
    let mut encoding = None;
    let first = lines.next()?;
    if !first.trim_start_matches('\u{feff}').trim().eq_ignore_ascii_case("ply") {
        return Err(Error::parse(format!("line 1: \"{}\" is not \"ply\"", shown(&first))));
    }
    loop {
        let text = lines.next()?;
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        let unexpected =
            || Error::parse(format!("line {}: \"{}\" is no line of a PLY header", lines.line, shown(&text)));
        match words[..] {
            [] | ["obj_info", ..] => {}
            ["comment", ..] => {
                header.tag_names.extend(tag_name(&text));
                header.vectors.extend(vector(&text));
            }
            ["format", name, _] if encoding.is_none() => encoding = Some(encoding_of(name).ok_or_else(unexpected)?),
            ["element", name, count] => {
                let count = count.parse().map_err(|_| unexpected())?;
                header.elements.push(Element {
                    name: name.to_owned(),
                    count,
                    properties: Vec::new(),
                    line: lines.line,
                });
            }
            ["property", "list", count, item, name] => {
                let [count, item] = [count, item].map(type_of);
                let (Some(count), Some(item)) = (count, item) else { return Err(unexpected()) };
                if !count.is_integer() {
                    return Err(Error::parse(format!("line {}: the count of a list is no integer", lines.line)));
                }
                header.add(name, Shape::List { count, item }, lines.line)?;
            }
            ["property", kind, name] => {
                header.add(name, Shape::Scalar(type_of(kind).ok_or_else(unexpected)?), lines.line)?;
            }
            ["end_header"] => break,
            _ => return Err(unexpected()),
        }
    }
    header.encoding = encoding.ok_or_else(|| Error::parse(format!("line {}: no format was named", lines.line)))?;
    header.tag_names.sort();
    header.tag_names.dedup_by_key(|(tag, _)| *tag);
    (header.end, header.lines) = (lines.at, lines.line);
    Ok(header)
}

impl Header {
    fn add(&mut self, name: &str, shape: Shape, line: usize) -> Result<()> {
        let fresh = self.names.insert((self.elements.len(), name.to_owned()));
        let Some(element) = self.elements.last_mut() else {
            return Err(Error::parse(format!("line {line}: the property \"{}\" has no element", shown(name))));
        };
        if !fresh {
            return Err(Error::parse(format!("line {line}: the property \"{}\" is there already", shown(name))));
        }
        element.properties.push(Property { name: name.to_owned(), shape });
        Ok(())
    }
}

fn encoding_of(name: &str) -> Option<Encoding> {
    match name {
        "ascii" => Some(Encoding::Ascii),
        "binary_little_endian" => Some(Encoding::LittleEndian),
        "binary_big_endian" => Some(Encoding::BigEndian),
        _ => None,
    }
}

/// Both families of names.
fn type_of(name: &str) -> Option<Number> {
    Some(match name {
        "char" | "int8" => Number::I8,
        "uchar" | "uint8" => Number::U8,
        "short" | "int16" => Number::I16,
        "ushort" | "uint16" => Number::U16,
        "int" | "int32" => Number::I32,
        "uint" | "uint32" => Number::U32,
        "int64" | "long" => Number::I64,
        "uint64" | "ulong" => Number::U64,
        "float" | "float32" => Number::F32,
        "double" | "float64" => Number::F64,
        _ => return None,
    })
}

/// `comment tag NUMBER NAME`: the name of a tag, as this library writes it.
fn tag_name(line: &str) -> Option<(i32, String)> {
    let rest = line.trim_start().strip_prefix("comment")?.trim_start().strip_prefix("tag ")?;
    let (number, name) = rest.trim().split_once(' ')?;
    let name = one_line(name);
    if name.is_empty() { None } else { Some((number.parse().ok()?, name)) }
}

/// `comment field vertex|face COMPONENTS NAME`, as this library writes it.
fn vector(line: &str) -> Option<Vector> {
    let rest = line.trim_start().strip_prefix("comment")?.trim_start().strip_prefix("field ")?;
    let (on, rest) = rest.split_once(' ')?;
    let (components, name) = rest.split_once(' ')?;
    let (components, name) = (components.parse().ok().filter(|n| *n > 0)?, one_line(name));
    let known = matches!(on, "vertex" | "face") && !name.is_empty();
    known.then_some(Vector { on_faces: on == "face", components, name })
}

fn shown(text: &str) -> String {
    text.chars().take(40).collect()
}

struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    /// Whether CR alone ends lines, so that a LF behind one belongs to what follows.
    alone: bool,
}

impl Lines<'_> {
    /// The next line, without its end: LF, CRLF or CR.
    fn next(&mut self) -> Result<String> {
        self.line += 1;
        let rest = &self.bytes[self.at..];
        let Some(length) = rest.iter().position(|b| matches!(b, b'\n' | b'\r')) else {
            return Err(Error::parse(format!("line {}: the file ends within the PLY header", self.line)));
        };
        let ends = if !self.alone && rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
        self.at += length + ends;
        Ok(String::from_utf8_lossy(&rest[..length]).into_owned())
    }
}
