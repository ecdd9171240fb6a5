// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writing VTP: one piece of polygons, all data appended as little-endian bytes with sizes of 64 bits.

use super::read::{TAG, TAG_NAMES, TAG_NUMBERS, is_tags};
use crate::error::{Error, Result, try_with_capacity};
use crate::io::number::Number;
use crate::io::text::{Text, attribute, one_line};
use crate::mesh::{Field, Mesh};

/// The bytes of a file with the surface as it stands: its polygons, named data, tags and names of tags.
pub(in crate::io) fn write(mesh: &Mesh) -> Result<Vec<u8>> {
    let topology = mesh.half_edges();
    let faces = topology.face_count();
    let tagged = mesh.is_tagged();
    let clashes = |f: &&Field| f.name == TAG && (tagged || is_tags(f));
    if mesh.face_fields().iter().any(|f| clashes(&f)) {
        return Err(Error::unsupported(format!("face data \"{TAG}\": the name is that of the tags in a file")));
    }
    let mut file = Appended::default();
    file.add(format_args!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n<PolyData>\n"
    ))?;
    names(mesh, &mut file)?;
    let points = mesh.row_count();
    file.add(format_args!("<Piece NumberOfPoints=\"{points}\" NumberOfPolys=\"{faces}\">\n<PointData>\n"))?;
    for field in mesh.vertex_fields() {
        let number = Number::of_field(field.kind);
        file.array(&field.name, number, field.components, field.values.iter().copied())?;
    }
    file.add(format_args!("</PointData>\n<CellData>\n"))?;
    if tagged {
        let tags = topology.faces().input.iter().map(|f| f64::from(mesh.tag(*f)));
        file.array(TAG, Number::I32, 1, tags)?;
    }
    for field in mesh.face_fields() {
        let values = topology.faces().input.iter().flat_map(|f| field.item(*f as usize).iter().copied());
        file.array(&field.name, Number::of_field(field.kind), field.components, values)?;
    }
    file.add(format_args!("</CellData>\n<Points>\n"))?;
    let position = |row: u32| mesh.vertices()[mesh.vertex_of_row(row) as usize].to_array();
    file.array("Points", Number::F64, 3, (0..points as u32).flat_map(position))?;
    file.add(format_args!("</Points>\n<Polys>\n"))?;
    let row = |h: u32| f64::from(mesh.vertex_data_row(h));
    file.array("connectivity", Number::I64, 1, (0..topology.count() as u32).map(row))?;
    let ends = (0..faces as u32).map(|f| f64::from(topology.around_face(f).end));
    file.array("offsets", Number::I64, 1, ends)?;
    file.add(format_args!("</Polys>\n</Piece>\n</PolyData>\n"))?;
    file.finish()
}

/// The names of tags.
fn names(mesh: &Mesh, file: &mut Appended) -> Result<()> {
    let count = mesh.tag_names().len();
    if count == 0 {
        return Ok(());
    }
    file.add(format_args!("<FieldData>\n"))?;
    let numbers = mesh.tag_names().iter().map(|(tag, _)| f64::from(*tag));
    file.tuples(TAG_NUMBERS, Number::I32, count, numbers)?;
    let strings: String = mesh.tag_names().iter().map(|(_, name)| one_line(name) + "\0").collect();
    file.strings(TAG_NAMES, count, strings.as_bytes())?;
    file.add(format_args!("</FieldData>\n"))
}

/// The tags of a file, and the data that come behind them.
#[derive(Default)]
struct Appended {
    tags: Text,
    data: Vec<u8>,
}

impl Appended {
    /// Adds tags.
    fn add(&mut self, text: std::fmt::Arguments) -> Result<()> {
        self.tags.add(text)
    }

    /// An array of points or cells.
    fn array(
        &mut self,
        name: &str,
        number: Number,
        components: usize,
        values: impl Iterator<Item = f64>,
    ) -> Result<()> {
        let (kind, name, offset) = (number.name(), attribute(name), self.data.len());
        self.add(format_args!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" \
             offset=\"{offset}\"/>\n"
        ))?;
        self.numbers(number, values)
    }

    /// An array that is neither.
    fn tuples(&mut self, name: &str, number: Number, count: usize, values: impl Iterator<Item = f64>) -> Result<()> {
        let (kind, name, offset) = (number.name(), attribute(name), self.data.len());
        self.add(format_args!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfTuples=\"{count}\" format=\"appended\" \
             offset=\"{offset}\"/>\n"
        ))?;
        self.numbers(number, values)
    }

    /// Strings that each end with a zero.
    fn strings(&mut self, name: &str, count: usize, bytes: &[u8]) -> Result<()> {
        let (name, offset) = (attribute(name), self.data.len());
        self.add(format_args!(
            "<Array type=\"String\" Name=\"{name}\" NumberOfTuples=\"{count}\" format=\"appended\" \
             offset=\"{offset}\"/>\n"
        ))?;
        self.data.try_reserve(8 + bytes.len()).map_err(|_| Error::memory("bytes", bytes.len()))?;
        self.data.extend((bytes.len() as u64).to_le_bytes());
        self.data.extend_from_slice(bytes);
        Ok(())
    }

    fn numbers(&mut self, number: Number, values: impl Iterator<Item = f64>) -> Result<()> {
        let at = self.data.len();
        self.data.try_reserve(8).map_err(|_| Error::memory("bytes", at))?;
        self.data.extend([0; 8]);
        for x in values {
            self.data.try_reserve(8).map_err(|_| Error::memory("bytes", self.data.len()))?;
            number.encode(x, &mut self.data);
        }
        let size = (self.data.len() - at - 8) as u64;
        self.data[at..at + 8].copy_from_slice(&size.to_le_bytes());
        Ok(())
    }

    /// The whole file.
    fn finish(self) -> Result<Vec<u8>> {
        let (begin, end) = ("<AppendedData encoding=\"raw\">\n_", "\n</AppendedData>\n</VTKFile>\n");
        let tags = self.tags.into_bytes();
        let mut file = try_with_capacity("bytes", tags.len() + begin.len() + self.data.len() + end.len())?;
        for part in [&tags, begin.as_bytes(), &self.data, end.as_bytes()] {
            file.extend_from_slice(part);
        }
        Ok(file)
    }
}
