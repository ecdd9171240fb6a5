// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a VTK XML file consists of: its pieces, their arrays, and the data appended to them.

use super::array::Array;
use super::blocks::Encoding;
use super::xml::{Markup, Tag, Xml, shortened, wrong};
use crate::error::{Error, Result};
use crate::io::text::way_out;
use std::cell::Cell;

/// Elements do not nest deeper than this.
const DEPTH: usize = 32;

/// The element that an array is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Section {
    FieldData,
    PointData,
    CellData,
    Points,
    Verts,
    Lines,
    Strips,
    Polys,
}

impl Section {
    fn named(name: &[u8]) -> Option<Section> {
        Some(match name {
            b"FieldData" => Section::FieldData,
            b"PointData" => Section::PointData,
            b"CellData" => Section::CellData,
            b"Points" => Section::Points,
            b"Verts" => Section::Verts,
            b"Lines" => Section::Lines,
            b"Strips" => Section::Strips,
            b"Polys" => Section::Polys,
            _ => return None,
        })
    }
}

/// A piece of the surface.
#[derive(Clone, Copy)]
pub(super) struct Piece<'a> {
    pub tag: Tag<'a>,
    /// Its first array.
    first: usize,
}

/// The data after the tags.
#[derive(Clone, Copy)]
pub(super) struct Appended<'a> {
    pub base64: bool,
    /// From behind the underscore.
    pub data: &'a [u8],
    /// Where that is in the file.
    pub at: usize,
}

/// A file, with nothing decoded yet.
pub(super) struct Document<'a> {
    pub bytes: &'a [u8],
    pub encoding: Encoding,
    pub pieces: Vec<Piece<'a>>,
    /// Those outside pieces, then those of each piece.
    arrays: Vec<Array<'a>>,
    pub appended: Option<Appended<'a>>,
    /// Bytes that compressed data had so far, and bytes of the file that were read for data.
    pub decompressed: Cell<usize>,
    pub taken: Cell<usize>,
}

impl<'a> Document<'a> {
    /// Finds the parts of a file of PolyData.
    pub fn read(bytes: &'a [u8]) -> Result<Document<'a>> {
        let mut xml = Xml::new(bytes);
        let root = match xml.next()? {
            Markup::Open(tag) if tag.name == b"VTKFile" => tag,
            _ => return Err(wrong(0, "the first tag is not <VTKFile>")),
        };
        let encoding = Encoding::of(&root)?;
        let kind = root.attribute("type")?.unwrap_or_default();
        if kind != "PolyData" {
            let what = format!("offset {}: <VTKFile>: type: \"{}\" is not PolyData", root.at, shortened(&kind));
            return Err(Error::unsupported(what + way_out(kind.as_bytes())));
        }
        let (pieces, arrays) = (Vec::new(), Vec::new());
        let mut document = Document {
            bytes,
            encoding,
            pieces,
            arrays,
            appended: None,
            decompressed: Cell::new(0),
            taken: Cell::new(0),
        };
        document.elements(&mut xml)?;
        Ok(document)
    }

    /// Bytes of the file once it is decompressed.
    pub fn size(&self) -> usize {
        self.bytes.len().saturating_add(self.decompressed.get())
    }

    /// The arrays outside pieces.
    pub fn field_data(&self) -> impl Iterator<Item = &Array<'a>> {
        self.arrays.iter().filter(|a| a.section == Section::FieldData)
    }

    /// The arrays of one section of a piece.
    pub fn arrays(&self, piece: usize, section: Section) -> impl Iterator<Item = &Array<'a>> + Clone {
        let end = self.pieces.get(piece + 1).map_or(self.arrays.len(), |next| next.first);
        self.arrays[self.pieces[piece].first..end].iter().filter(move |a| a.section == section)
    }

    fn elements(&mut self, xml: &mut Xml<'a>) -> Result<()> {
        let mut open: Vec<&[u8]> = vec![b"VTKFile"];
        loop {
            match xml.next()? {
                Markup::Open(tag) if tag.name == b"AppendedData" && open.len() == 1 => {
                    self.appended = Some(self.appended_data(&tag, xml.offset())?);
                    return Ok(());
                }
                Markup::Open(tag) => {
                    self.element(&tag, &open, xml)?;
                    open.push(tag.name);
                    if open.len() > DEPTH {
                        return Err(tag.wrong(format_args!("elements nest deeper than {DEPTH}")));
                    }
                }
                Markup::Empty(tag) => self.element(&tag, &open, &mut Xml::new(b""))?,
                Markup::Close(name) => {
                    if open.pop() != Some(name) {
                        let name = String::from_utf8_lossy(&name[..name.len().min(40)]);
                        return Err(wrong(xml.offset(), format_args!("</{name}> closes another element")));
                    }
                    if open.is_empty() {
                        return Ok(());
                    }
                }
                Markup::End => {
                    let name = String::from_utf8_lossy(open[open.len() - 1]);
                    return Err(wrong(xml.offset(), format_args!("the file ends within <{name}>")));
                }
            }
        }
    }

    /// Notes an element that counts. Its text is what `xml` comes to next.
    fn element(&mut self, tag: &Tag<'a>, open: &[&'a [u8]], xml: &mut Xml<'a>) -> Result<()> {
        if open.len() == 2 && open[1] == b"PolyData" && tag.name == b"Piece" {
            self.pieces.try_reserve(1).map_err(|_| Error::memory("pieces", self.pieces.len() + 1))?;
            self.pieces.push(Piece { tag: *tag, first: self.arrays.len() });
        }
        if !matches!(tag.name, b"DataArray" | b"Array") {
            return Ok(());
        }
        let section = match open {
            [_, b"PolyData", b"Piece", section] => Section::named(section).filter(|s| *s != Section::FieldData),
            [_, b"PolyData", b"FieldData"] if self.pieces.is_empty() => Some(Section::FieldData),
            _ => None,
        };
        if let Some(section) = section {
            let body_at = xml.offset();
            self.arrays.try_reserve(1).map_err(|_| Error::memory("arrays", self.arrays.len() + 1))?;
            self.arrays.push(Array { tag: *tag, body: xml.text(), body_at, section });
        }
        Ok(())
    }

    fn appended_data(&self, tag: &Tag<'a>, at: usize) -> Result<Appended<'a>> {
        let encoding = tag.attribute("encoding")?.unwrap_or("base64".into());
        let base64 = match &*encoding {
            "base64" => true,
            "raw" => false,
            other => {
                return Err(tag.wrong(format_args!("encoding: \"{}\" is neither base64 nor raw", shortened(other))));
            }
        };
        let rest = &self.bytes[at..];
        let blank = rest.len() - rest.trim_ascii_start().len();
        let Some(data) = rest[blank..].strip_prefix(b"_") else {
            return Err(wrong(at + blank, "no underscore where the appended data should begin"));
        };
        let end = if base64 { data.iter().position(|b| *b == b'<') } else { None };
        Ok(Appended { base64, data: &data[..end.unwrap_or(data.len())], at: at + blank + 1 })
    }
}
