// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writing legacy VTK: version 4.2, which every reader knows, in big-endian bytes.

use super::cursor::escaped;
use crate::error::{Error, Result};
use crate::io::number::Number;
use crate::io::vtp::read::{TAG, TAG_NAMES, TAG_NUMBERS, is_tags};
use crate::mesh::{Field, Mesh};

/// The bytes of a file with the surface as it stands: one point a row of the vertex data. Faces are numbered anew.
pub(in crate::io) fn write(mesh: &Mesh) -> Result<Vec<u8>> {
    let topology = mesh.half_edges();
    let (rows, faces) = (mesh.row_count(), topology.face_count());
    let tagged = mesh.is_tagged();
    if mesh.face_fields().iter().any(|f| f.name == TAG && (tagged || is_tags(f))) {
        return Err(Error::unsupported(format!("face data \"{TAG}\": the name is that of the tags in a file")));
    }
    let numbers = topology.count() + faces;
    if i32::try_from(numbers).is_err() || i32::try_from(rows).is_err() {
        return Err(Error::unsupported(format!(
            "mesh: {numbers} indices are more than this version of the format holds"
        )));
    }
    let mut out = Vec::new();
    let bytes = 24 * rows + 4 * numbers;
    out.try_reserve(bytes).map_err(|_| Error::memory("bytes", bytes))?;
    out.extend_from_slice(b"# vtk DataFile Version 4.2\nsurface mesh\nBINARY\nDATASET POLYDATA\n");
    if !mesh.tag_names().is_empty() {
        let count = mesh.tag_names().len();
        head(&mut out, format_args!("FIELD FieldData 2"));
        array(&mut out, TAG_NUMBERS, 1, count, Number::I32, mesh.tag_names().iter().map(|(tag, _)| f64::from(*tag)));
        head(&mut out, format_args!("{TAG_NAMES} 1 {count} string"));
        mesh.tag_names().iter().for_each(|(_, name)| string(&mut out, name.as_bytes()));
        out.push(b'\n');
    }
    head(&mut out, format_args!("POINTS {rows} double"));
    let position = |row: u32| mesh.vertices()[mesh.vertex_of_row(row) as usize].to_array();
    put(&mut out, Number::F64, (0..rows as u32).flat_map(position));
    head(&mut out, format_args!("\nPOLYGONS {faces} {numbers}"));
    for f in 0..faces as u32 {
        let ring = topology.around_face(f);
        put(&mut out, Number::I32, std::iter::once(ring.len() as f64));
        put(&mut out, Number::I32, ring.map(|h| f64::from(mesh.vertex_data_row(h))));
    }
    if !mesh.vertex_fields().is_empty() {
        head(&mut out, format_args!("\nPOINT_DATA {rows}\nFIELD FieldData {}", mesh.vertex_fields().len()));
        for field in mesh.vertex_fields() {
            data(&mut out, field, rows, field.values.iter().copied());
        }
    }
    if tagged || !mesh.face_fields().is_empty() {
        let count = mesh.face_fields().len() + usize::from(tagged);
        head(&mut out, format_args!("\nCELL_DATA {faces}\nFIELD FieldData {count}"));
        let input = || topology.faces().input.iter();
        if tagged {
            array(&mut out, TAG, 1, faces, Number::I32, input().map(|f| f64::from(mesh.tag(*f))));
        }
        for field in mesh.face_fields() {
            data(&mut out, field, faces, input().flat_map(|f| field.item(*f as usize).iter().copied()));
        }
    }
    Ok(out)
}

fn head(out: &mut Vec<u8>, line: std::fmt::Arguments) {
    out.extend_from_slice(line.to_string().as_bytes());
    out.push(b'\n');
}

fn data(out: &mut Vec<u8>, field: &Field, items: usize, values: impl Iterator<Item = f64>) {
    array(out, &field.name, field.components, items, Number::of_field(field.kind), values);
}

fn array(
    out: &mut Vec<u8>,
    name: &str,
    components: usize,
    items: usize,
    number: Number,
    values: impl Iterator<Item = f64>,
) {
    head(out, format_args!("{} {components} {items} {}", escaped(name), type_name(number)));
    put(out, number, values);
    out.push(b'\n');
}

fn put(out: &mut Vec<u8>, number: Number, values: impl Iterator<Item = f64>) {
    for x in values {
        let at = out.len();
        number.encode(x, out);
        out[at..].reverse();
    }
}

/// A string behind the count of its bytes, whose first two bits say how many bytes the count has.
fn string(out: &mut Vec<u8>, text: &[u8]) {
    let (size, bits) = match text.len() {
        0..=0x3f => (1, 3),
        0x40..=0x3fff => (2, 2),
        0x4000..=0x3fff_ffff => (4, 1),
        _ => (8, 0),
    };
    let at = out.len();
    out.extend_from_slice(&(text.len() as u64).to_be_bytes()[8 - size..]);
    out[at] |= bits << 6;
    out.extend_from_slice(text);
}

fn type_name(number: Number) -> &'static str {
    match number {
        Number::I8 => "char",
        Number::U8 => "unsigned_char",
        Number::I16 => "short",
        Number::U16 => "unsigned_short",
        Number::I32 => "int",
        Number::U32 => "unsigned_int",
        // How many bytes a long has depends on the reader's system.
        Number::I64 => "vtktypeint64",
        Number::U64 => "vtktypeuint64",
        Number::F32 => "float",
        Number::F64 => "double",
    }
}
