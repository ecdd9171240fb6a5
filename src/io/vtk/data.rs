// SPDX-License-Identifier: MIT OR Apache-2.0
//! Data of points and cells in legacy VTK: attributes and fields.

use super::cursor::{Cursor, type_of};
use crate::error::{Error, Result, try_with_capacity};
use crate::io::number::Number;
use crate::mesh::{Field, FieldType};

/// Field data of a file that name its tags: `tag_name:NAME`, of which the one number is the tag.
pub(super) const TAG_NAME: &str = "tag_name:";

/// The named data of points or of cells.
#[derive(Default)]
pub(super) struct Data {
    fields: Vec<Field>,
    /// What the file says that there are of points or cells.
    count: Option<usize>,
}

impl Data {
    /// Reads what a keyword begins.
    pub fn read(&mut self, word: &[u8], count: usize, cursor: &mut Cursor) -> Result<()> {
        self.count = Some(count);
        match word {
            b"SCALARS" => self.scalars(count, cursor),
            b"COLOR_SCALARS" => {
                let (name, components) = (cursor.name()?, cursor.count()?);
                let number = if cursor.binary { Number::U8 } else { Number::F32 };
                self.add(name, components, count, number, cursor)
            }
            b"VECTORS" | b"NORMALS" => self.named(count, 3, cursor),
            b"TENSORS" => self.named(count, 9, cursor),
            b"TENSORS6" => self.named(count, 6, cursor),
            b"GLOBAL_IDS" | b"PEDIGREE_IDS" => self.named(count, 1, cursor),
            b"TEXTURE_COORDINATES" => {
                let (name, components) = (cursor.name()?, cursor.count()?);
                let number = number(cursor)?;
                self.add(name, components, count, number, cursor)
            }
            b"LOOKUP_TABLE" => {
                let (_, size) = (cursor.name()?, cursor.count()?);
                let numbers = size.checked_mul(4).ok_or_else(|| cursor.wrong("a LOOKUP_TABLE without end"))?;
                cursor.numbers(numbers, if cursor.binary { Number::U8 } else { Number::F32 }).map(|_| ())
            }
            b"FIELD" => {
                for array in arrays(cursor)? {
                    if let Some(field) = array.read(cursor)?.filter(|f| f.values.len() == count * f.components) {
                        self.push(field);
                    }
                }
                Ok(())
            }
            _ => Err(cursor.wrong(format_args!("\"{:.40}\" is no kind of data", String::from_utf8_lossy(word)))),
        }
    }

    fn scalars(&mut self, count: usize, cursor: &mut Cursor) -> Result<()> {
        let (name, number) = (cursor.name()?, number(cursor)?);
        let line = cursor.rest_of_line();
        let components = if line.is_empty() { Some(1) } else { line.parse().ok() };
        let Some(components) = components.filter(|n| (1..=4).contains(n)) else {
            return Err(cursor.wrong(format_args!("SCALARS of \"{line:.40}\" components, not 1 to 4")));
        };
        if cursor.peek().eq_ignore_ascii_case(b"LOOKUP_TABLE") {
            cursor.word();
            cursor.name()?;
        }
        self.add(name, components, count, number, cursor)
    }

    fn named(&mut self, count: usize, components: usize, cursor: &mut Cursor) -> Result<()> {
        let (name, number) = (cursor.name()?, number(cursor)?);
        self.add(name, components, count, number, cursor)
    }

    fn add(
        &mut self,
        name: String,
        components: usize,
        count: usize,
        number: Number,
        cursor: &mut Cursor,
    ) -> Result<()> {
        let array = Array { name, components, tuples: count, number: Some(number), text: false };
        if let Some(field) = array.read(cursor)? {
            self.push(field);
        }
        Ok(())
    }

    /// Of several of one name the first stays.
    fn push(&mut self, field: Field) {
        if field.components > 0 && !field.name.is_empty() && self.fields.iter().all(|f| f.name != field.name) {
            self.fields.push(field);
        }
    }

    /// The fields, if there are as many items as the mesh has.
    pub fn finish(self, what: &str, items: usize) -> Result<Vec<Field>> {
        // A file may have several sections, each with a count of its own.
        let wrong = self.fields.iter().find(|f| f.values.len() != items * f.components);
        match (self.count.filter(|count| *count != items), wrong) {
            (Some(count), _) => Err(Error::parse(format!("{what}: {count} items for {items}"))),
            (_, Some(f)) => {
                let count = f.values.len() / f.components;
                Err(Error::parse(format!("{what}: \"{}\" has {count} items for {items}", f.name)))
            }
            _ => Ok(self.fields),
        }
    }
}

fn number(cursor: &mut Cursor) -> Result<Number> {
    let word = cursor.word();
    type_of(word)
        .ok_or_else(|| cursor.wrong(format_args!("\"{:.40}\" is no type of numbers", String::from_utf8_lossy(word))))
}

/// The names of tags among the field data of a file.
pub(super) fn names(cursor: &mut Cursor) -> Result<Vec<(i32, String)>> {
    let mut names = Vec::new();
    for array in arrays(cursor)? {
        if let Some(field) = array.read(cursor)?
            && let (Some(name), [tag]) = (field.name.strip_prefix(TAG_NAME), &field.values[..])
            && f64::from(*tag as i32) == *tag
            && !name.is_empty()
        {
            names.push((*tag as i32, name.to_owned()));
        }
    }
    names.sort();
    names.dedup_by_key(|(tag, _)| *tag);
    Ok(names)
}

/// What comes behind FIELD: the arrays one after another, each to be read before the next.
fn arrays<'c, 'a>(cursor: &'c mut Cursor<'a>) -> Result<impl Iterator<Item = Array> + use<>> {
    let _ = cursor.name()?;
    let count = cursor.count()?;
    Ok((0..count).map(|_| Array::default()))
}

#[derive(Default)]
struct Array {
    name: String,
    components: usize,
    tuples: usize,
    /// None: its head is still to be read, or its values are text or bits.
    number: Option<Number>,
    text: bool,
}

impl Array {
    /// The values; none where they are no numbers.
    fn read(mut self, cursor: &mut Cursor) -> Result<Option<Field>> {
        if self.number.is_none() {
            while cursor.peek().eq_ignore_ascii_case(b"METADATA") {
                cursor.word();
                cursor.skip_block();
            }
            (self.name, self.components, self.tuples) = (cursor.name()?, cursor.count()?, cursor.count()?);
            let word = cursor.word().to_ascii_lowercase();
            let total = self.total(cursor)?;
            self.text = word == b"string";
            if self.text && !cursor.binary {
                cursor.skip_lines(total.saturating_add(1));
                return Ok(None);
            }
            if word == b"bit" {
                if cursor.binary {
                    cursor.raw(total.div_ceil(8), 1).map(|_| ())?
                } else {
                    cursor.numbers(total, Number::I8).map(|_| ())?
                }
                return Ok(None);
            }
            if self.text {
                return Err(Error::unsupported(format!("{}: an array of strings in bytes", cursor.place())));
            }
            let known = type_of(&word);
            let shown = String::from_utf8_lossy(&word);
            self.number =
                Some(known.ok_or_else(|| cursor.wrong(format_args!("\"{shown:.40}\" is no type of numbers")))?);
        }
        let total = self.total(cursor)?;
        let Some(number) = self.number else { return Ok(None) };
        let values = cursor.numbers(total, number)?;
        let kind: FieldType = number.field_type(&values);
        let mut own = try_with_capacity("values", values.len())?;
        own.extend(values);
        Ok(Some(Field { name: self.name, kind, components: self.components, values: own }))
    }

    fn total(&self, cursor: &Cursor) -> Result<usize> {
        let total = self.components.checked_mul(self.tuples);
        total.ok_or_else(|| cursor.wrong(format_args!("{} times {} values", self.components, self.tuples)))
    }
}
