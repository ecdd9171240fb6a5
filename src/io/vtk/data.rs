// SPDX-License-Identifier: MIT OR Apache-2.0
//! Data of points and cells in legacy VTK: attributes and fields.

use super::cursor::{Cursor, type_of};
use crate::error::{Error, Result};
use crate::io::number::Number;
use crate::io::vtp::read::{TAG_NAMES, TAG_NUMBERS, named_tags};
use crate::mesh::{Field, FieldType};

/// The named data of points or of cells.
#[derive(Default)]
pub(super) struct Data {
    fields: Vec<Field>,
    /// What the file says that there are of points or cells.
    count: Option<usize>,
    /// Where the file last spoke of them.
    place: String,
}

impl Data {
    /// Reads what a keyword begins.
    pub fn read(&mut self, word: &[u8], count: usize, cursor: &mut Cursor) -> Result<()> {
        self.count = Some(count);
        self.place = cursor.place();
        match word {
            b"SCALARS" => self.scalars(count, cursor),
            b"COLOR_SCALARS" => {
                let (name, components) = (cursor.name()?, cursor.count()?);
                let kind = Kind::Numbers(if cursor.binary { Number::U8 } else { Number::F32 });
                let field = Array { name, components, tuples: count, kind }.read(cursor)?;
                self.push(field.map(in_bytes));
                Ok(())
            }
            b"VECTORS" | b"NORMALS" => self.named(count, 3, cursor),
            b"TENSORS" => self.named(count, 9, cursor),
            b"TENSORS6" => self.named(count, 6, cursor),
            b"GLOBAL_IDS" | b"PEDIGREE_IDS" | b"EDGE_FLAGS" => self.named(count, 1, cursor),
            b"TEXTURE_COORDINATES" => {
                let (name, components) = (cursor.name()?, cursor.count()?);
                let kind = kind(cursor)?;
                self.add(name, components, count, kind, cursor)
            }
            b"LOOKUP_TABLE" => {
                let (_, size) = (cursor.name()?, cursor.count()?);
                let numbers = size.checked_mul(4).ok_or_else(|| cursor.wrong("a LOOKUP_TABLE without end"))?;
                cursor.numbers(numbers, if cursor.binary { Number::U8 } else { Number::F32 }).map(|_| ())
            }
            b"FIELD" => {
                for _ in 0..arrays(cursor)? {
                    let field = Array::head(cursor)?.read(cursor)?;
                    self.push(field.filter(|f| count.checked_mul(f.components) == Some(f.values.len())));
                }
                Ok(())
            }
            _ => Err(cursor.wrong(format_args!("\"{:.40}\" is no kind of data", String::from_utf8_lossy(word)))),
        }
    }

    fn scalars(&mut self, count: usize, cursor: &mut Cursor) -> Result<()> {
        let (name, kind) = (cursor.name()?, kind(cursor)?);
        let line = cursor.rest_of_line();
        let components = if line.is_empty() { Some(1) } else { line.parse().ok() };
        let Some(components) = components.filter(|n| *n > 0) else {
            return Err(cursor.wrong(format_args!("SCALARS of \"{line:.40}\" components, not at least 1")));
        };
        if cursor.peek().eq_ignore_ascii_case(b"LOOKUP_TABLE") {
            cursor.word();
            cursor.name()?;
        }
        self.add(name, components, count, kind, cursor)
    }

    fn named(&mut self, count: usize, components: usize, cursor: &mut Cursor) -> Result<()> {
        let (name, kind) = (cursor.name()?, kind(cursor)?);
        self.add(name, components, count, kind, cursor)
    }

    fn add(&mut self, name: String, components: usize, count: usize, kind: Kind, cursor: &mut Cursor) -> Result<()> {
        let field = Array { name, components, tuples: count, kind }.read(cursor)?;
        self.push(field);
        Ok(())
    }

    /// Of several of one name the first stays.
    fn push(&mut self, field: Option<Field>) {
        let fresh = |f: &Field| f.components > 0 && !f.name.is_empty() && self.fields.iter().all(|g| g.name != f.name);
        self.fields.extend(field.filter(fresh));
    }

    /// Numbers an item, of all fields.
    pub fn components(&self) -> usize {
        self.fields.iter().fold(0, |sum: usize, f| sum.saturating_add(f.components))
    }

    /// The fields, if there are as many items as the mesh has.
    pub fn finish(self, what: &str, items: usize) -> Result<Vec<Field>> {
        // A file may have several sections, each with a count of its own.
        let wrong = self.fields.iter().find(|f| items.checked_mul(f.components) != Some(f.values.len()));
        match (self.count.filter(|count| *count != items), wrong) {
            (Some(count), _) => Err(Error::parse(format!("{}: {what}: {count} items for {items}", self.place))),
            (_, Some(f)) => {
                let count = f.values.len() / f.components;
                Err(Error::parse(format!("{}: {what}: \"{}\" has {count} items for {items}", self.place, f.name)))
            }
            _ => Ok(self.fields),
        }
    }
}

/// The names of tags among the field data of a file.
pub(super) fn names(cursor: &mut Cursor) -> Result<Vec<(i32, String)>> {
    let (mut numbers, mut names) = (None, None);
    for _ in 0..arrays(cursor)? {
        let array = Array::head(cursor)?;
        if array.name == TAG_NAMES && array.kind == Kind::Strings {
            names = Some((array.total(cursor)?, cursor.clone()));
        }
        let is_numbers = array.name == TAG_NUMBERS;
        let field = array.read(cursor)?;
        if is_numbers {
            numbers = field;
        }
    }
    let (Some(numbers), Some((count, mut strings))) = (numbers, names) else { return Ok(Vec::new()) };
    if numbers.values.len() != count {
        return Err(strings.wrong(format_args!("{count} names of {} tags", numbers.values.len())));
    }
    strings.begin_strings();
    let place = strings.place();
    named_tags(numbers.values, || strings.string(), |what| Error::parse(format!("{place}: {what}")))
}

/// How many arrays come behind FIELD.
fn arrays(cursor: &mut Cursor) -> Result<usize> {
    let _ = cursor.name()?;
    cursor.count()
}

/// What an array holds.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Numbers(Number),
    Bits,
    Strings,
}

fn kind(cursor: &mut Cursor) -> Result<Kind> {
    let word = cursor.word();
    match &word.to_ascii_lowercase()[..] {
        b"bit" => Ok(Kind::Bits),
        b"string" | b"utf8_string" => Ok(Kind::Strings),
        _ => type_of(word).map(Kind::Numbers).ok_or_else(|| {
            cursor.wrong(format_args!("\"{:.40}\" is no type of numbers", String::from_utf8_lossy(word)))
        }),
    }
}

/// An array whose values come next.
struct Array {
    name: String,
    components: usize,
    tuples: usize,
    kind: Kind,
}

impl Array {
    /// What stands before the values of one of the arrays behind FIELD.
    fn head(cursor: &mut Cursor) -> Result<Array> {
        let (name, components, tuples) = (cursor.name()?, cursor.count()?, cursor.count()?);
        Ok(Array { name, components, tuples, kind: kind(cursor)? })
    }

    /// The values; none where they are no numbers.
    fn read(self, cursor: &mut Cursor) -> Result<Option<Field>> {
        let total = self.total(cursor)?;
        let field = match self.kind {
            Kind::Numbers(number) => {
                let values = cursor.numbers(total, number)?;
                let (name, kind) = (self.name, number.field_type(&values));
                Some(Field { name, kind, components: self.components, values })
            }
            Kind::Bits => {
                if cursor.binary {
                    cursor.raw(total.div_ceil(8), 1)?;
                } else {
                    cursor.numbers(total, Number::I8)?;
                }
                None
            }
            Kind::Strings => {
                cursor.begin_strings();
                for _ in 0..total {
                    cursor.string()?;
                }
                None
            }
        };
        cursor.skip_metadata(self.components)?;
        Ok(field)
    }

    fn total(&self, cursor: &Cursor) -> Result<usize> {
        let total = self.components.checked_mul(self.tuples);
        total.ok_or_else(|| cursor.wrong(format_args!("{} times {} values", self.components, self.tuples)))
    }
}

/// Colours from 0 to 1 as the bytes that binary files have for them.
fn in_bytes(mut colours: Field) -> Field {
    if colours.kind == FieldType::F32 {
        colours.kind = FieldType::U8;
        // NaN becomes 0.
        colours.values.iter_mut().for_each(|x| *x = f64::from((255.0 * *x + 0.5) as u8));
    }
    colours
}
