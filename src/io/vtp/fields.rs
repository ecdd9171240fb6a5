// SPDX-License-Identifier: MIT OR Apache-2.0
//! Named data of all pieces of a file, joined.

use super::array::Array;
use super::document::{Document, Piece};
use crate::error::{Error, Result};
use crate::mesh::Field;
use std::collections::BTreeMap;

/// Data of points or of cells.
#[derive(Default)]
pub(super) struct Fields {
    fields: Vec<Field>,
    of_name: BTreeMap<String, usize>,
    items: usize,
    /// Values that strips repeat.
    repeated: usize,
}

impl Fields {
    /// Adds the arrays of a piece, whose item k counts `repeats[k]` times, once where that is empty. Every piece
    /// with items has the same arrays. Strings, bits and arrays without a name are left out.
    pub fn add<'d, 'a: 'd>(
        &mut self,
        document: &Document<'a>,
        piece: &Piece<'a>,
        arrays: impl Iterator<Item = &'d Array<'a>>,
        (items, repeats): (usize, &[u32]),
    ) -> Result<()> {
        if items == 0 {
            return Ok(());
        }
        let first = self.items == 0;
        let total: usize = if repeats.is_empty() { items } else { repeats.iter().map(|n| *n as usize).sum() };
        let mut added = 0;
        for array in arrays {
            let name = array.name()?;
            if name.is_empty() || !array.is_numeric()? {
                continue;
            }
            let components = array.components()?;
            let at = match self.of_name.get(&name) {
                Some(&at) => at,
                None if first => self.new_field(&name, components)?,
                None => return Err(array.wrong("the pieces before have no such array")),
            };
            let field = &mut self.fields[at];
            if field.components != components {
                let before = field.components;
                return Err(array.wrong(format_args!("{components} components, {before} in the pieces before")));
            }
            if field.values.len() != self.items * components {
                return Err(array.wrong("an array of this name is there already"));
            }
            let values = array.values(document, items)?;
            let kind = array.number()?.field_type(&values);
            if !first && kind != field.kind {
                return Err(array.wrong(format_args!("values of {kind:?}, {:?} in the pieces before", field.kind)));
            }
            field.kind = kind;
            if !repeats.is_empty() {
                // What is repeated must stay in proportion to the data.
                self.repeated = self.repeated.saturating_add(total.saturating_mul(components));
                if self.repeated > document.size() {
                    let (n, data) = (self.repeated, document.size());
                    return Err(Error::unsupported(format!(
                        "array \"{name}\": {n} values of the triangles of strips are too many for {data} bytes of data"
                    )));
                }
            }
            append(field, values, total, repeats)?;
            added += 1;
        }
        if added < self.fields.len() {
            let missing = self.fields.iter().find(|f| f.values.len() == self.items * f.components);
            let name = missing.map_or("", |f| &f.name);
            return Err(piece.tag.wrong(format_args!("no array \"{name}\", which the pieces before have")));
        }
        self.items += total;
        Ok(())
    }

    fn new_field(&mut self, name: &str, components: usize) -> Result<usize> {
        let at = self.fields.len();
        self.fields.try_reserve(1).map_err(|_| Error::memory("fields", at + 1))?;
        self.fields.push(Field { name: name.to_owned(), components, ..Field::default() });
        self.of_name.insert(name.to_owned(), at);
        Ok(at)
    }

    /// All of them.
    pub fn finish(self) -> Vec<Field> {
        self.fields
    }
}

/// Adds values to a field, each item so often.
fn append(field: &mut Field, values: Vec<f64>, total: usize, repeats: &[u32]) -> Result<()> {
    if field.values.is_empty() && repeats.is_empty() {
        field.values = values;
        return Ok(());
    }
    let count = total * field.components;
    field.values.try_reserve(count).map_err(|_| Error::memory("values", count))?;
    if repeats.is_empty() {
        field.values.extend(values);
        return Ok(());
    }
    for (item, times) in values.chunks_exact(field.components).zip(repeats) {
        (0..*times).for_each(|_| field.values.extend_from_slice(item));
    }
    Ok(())
}
