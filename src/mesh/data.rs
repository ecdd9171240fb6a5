// SPDX-License-Identifier: MIT OR Apache-2.0
//! Named data of vertices and faces: scalars and vectors that a file or the caller attached to a surface.

use super::faces::{Faces, filled};
use crate::error::{Error, Result, try_with_capacity};

/// The type that the values had in the file, and have again when written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum FieldType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    /// 64-bit integers beyond 2^53 lose their last digits.
    I64,
    F32,
    #[default]
    F64,
}

/// Named numbers, `components` to a vertex or a face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Field {
    /// Its name; one line, not empty.
    pub name: String,
    /// The type of its values outside.
    pub kind: FieldType,
    /// Numbers an item, at least 1.
    pub components: usize,
    /// All of them, item after item.
    pub values: Vec<f64>,
}

impl Field {
    /// Where the values of an item are.
    pub fn item(&self, k: usize) -> &[f64] {
        &self.values[k * self.components..(k + 1) * self.components]
    }

    /// The field with the items that `from` lists.
    pub(crate) fn gathered(&self, from: impl ExactSizeIterator<Item = u32>) -> Result<Field> {
        let mut values = try_with_capacity("values", from.len() * self.components)?;
        for k in from {
            values.extend_from_slice(self.item(k as usize));
        }
        Ok(Field { name: self.name.clone(), kind: self.kind, components: self.components, values })
    }
}

/// The named data of a mesh.
///
/// Vertices that welding made one may have had different values (a seam). Row v of a vertex field is vertex
/// v's value as the lowest corner has it; what differs has rows of its own behind those, and corners know
/// their row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Data {
    pub vertex: Vec<Field>,
    /// By input face.
    pub face: Vec<Field>,
    /// The row of each half-edge's origin; none at all where it is the vertex.
    pub row_of_corner: Vec<u32>,
    /// The vertex of each row from the count of vertices on.
    pub seam_rows: Vec<u32>,
}

impl Data {
    /// Sorts vertex data given by input vertex into rows; `source` has the input vertex of each corner.
    pub fn of(vertices: usize, faces: &Faces, source: &[u32], vertex: Vec<Field>, face: Vec<Field>) -> Result<Data> {
        if vertex.is_empty() {
            return Ok(Data { face, ..Data::default() });
        }
        const NONE: u32 = u32::MAX;
        let mut given_of_row = filled("rows", vertices, NONE)?;
        let mut next_row = filled("rows", vertices, NONE)?;
        let mut vertex_of_row: Vec<u32> = (0..vertices as u32).collect();
        let mut row_of_corner = try_with_capacity("corners", source.len())?;
        let bits = |k: u32| vertex.iter().flat_map(move |f| f.item(k as usize).iter().map(|x| x.to_bits()));
        for (&v, &given) in faces.corners.iter().zip(source) {
            if given_of_row[v as usize] == NONE {
                given_of_row[v as usize] = given;
            }
            let mut row = v;
            while given_of_row[row as usize] != given && !bits(given_of_row[row as usize]).eq(bits(given)) {
                if next_row[row as usize] == NONE {
                    next_row[row as usize] = given_of_row.len() as u32;
                    given_of_row.push(given);
                    next_row.push(NONE);
                    vertex_of_row.push(v);
                }
                row = next_row[row as usize];
            }
            row_of_corner.push(row);
        }
        let seam_rows = vertex_of_row.split_off(vertices);
        let mut rows = try_with_capacity("fields", vertex.len())?;
        for field in &vertex {
            rows.push(field.gathered(given_of_row.iter().copied())?);
        }
        if seam_rows.is_empty() {
            row_of_corner = Vec::new();
        }
        Ok(Data { vertex: rows, face, row_of_corner, seam_rows })
    }

    /// The row of a corner, given with its vertex.
    pub fn row(&self, corner: u32, vertex: u32) -> u32 {
        self.row_of_corner.get(corner as usize).copied().unwrap_or(vertex)
    }
}

/// Checks the names and sizes of fields that a caller gives.
pub(crate) fn check_fields(what: &str, fields: &[Field], items: usize) -> Result<()> {
    for (k, field) in fields.iter().enumerate() {
        let Field { name, components, values, .. } = field;
        if name.is_empty() || name.chars().any(char::is_control) {
            return Err(Error::invalid(format!("{what}[{k}].name: \"{name}\" is empty or not one line")));
        }
        if fields[..k].iter().any(|f| f.name == *name) {
            return Err(Error::invalid(format!("{what}[{k}].name: \"{name}\" is there already")));
        }
        if *components == 0 || items.checked_mul(*components) != Some(values.len()) {
            return Err(Error::invalid(format!(
                "{what}[{k}]: {} values are not {components} for each of {items} items",
                values.len()
            )));
        }
    }
    Ok(())
}
