// SPDX-License-Identifier: MIT OR Apache-2.0
//! From the pieces of a VTP file to a surface.

use super::cells::{Cells, ends};
use super::document::{Document, Section};
use super::fields::Fields;
use crate::error::{Error, Result, Status, try_with_capacity};
use crate::io::proportion::Demand;
use crate::math::Vec3;
use crate::mesh::{Faces, Field, FieldType, Input, LARGEST_COORDINATE};

/// The cell data that is the tags, and the arrays outside pieces that name them.
pub(in crate::io) const TAG: &str = "tag";
pub(in crate::io) const TAG_NUMBERS: &str = "tag_numbers";
pub(in crate::io) const TAG_NAMES: &str = "tag_names";

/// Reads a file. A face's number is that of its cell, piece after piece, in each in the order of VTK's reader:
/// vertices and lines, which are no faces, then strips, of which each triangle counts, then polygons. Cell data
/// `tag` of one integer are the tags.
pub(in crate::io) fn read(bytes: &[u8]) -> Result<Input> {
    let document = Document::read(bytes)?;
    let mut surface = Surface { faces: Faces::with_capacity(0, 0)?, ..Surface::default() };
    for piece in 0..document.pieces.len() {
        surface.add(&document, piece)?;
    }
    let Surface { positions, faces, numbers, vertex_data, face_data } = surface;
    if faces.len() == 0 {
        return Err(Error::parse(format!("offset {}: the file ends without a polygon", bytes.len())));
    }
    let mut input = Input::new(positions, faces, Status::Parse);
    input.numbers = numbers as usize;
    input.vertex_data = vertex_data.finish();
    input.face_data = face_data.finish();
    if let Some(at) = input.face_data.iter().position(is_tags) {
        let tags = input.face_data.remove(at).values;
        if tags.iter().any(|tag| *tag != 0.0) {
            input.tags = try_with_capacity("tags", tags.len())?;
            input.tags.extend(tags.iter().map(|tag| *tag as i32));
        }
    }
    input.tag_names = tag_names(&document)?;
    Demand::of(&input).check(document.size())?;
    Ok(input)
}

/// Whether a face field is what tags are read from: one integer that i32 holds.
pub(in crate::io) fn is_tags(field: &Field) -> bool {
    let integer = !matches!(field.kind, FieldType::F32 | FieldType::F64);
    field.name == TAG && field.components == 1 && integer && field.values.iter().all(|x| f64::from(*x as i32) == *x)
}

#[derive(Default)]
struct Surface {
    positions: Vec<Vec3>,
    faces: Faces,
    /// How many cells count as faces.
    numbers: u32,
    vertex_data: Fields,
    face_data: Fields,
}

impl Surface {
    /// Adds a piece.
    fn add(&mut self, document: &Document, number: usize) -> Result<()> {
        let piece = &document.pieces[number];
        let points = piece.tag.count("NumberOfPoints")?;
        let first = self.points(document, number, points)?;
        let arrays = document.arrays(number, Section::PointData);
        self.vertex_data.add(document, piece, arrays, (points, &[]))?;

        let verts = ends(document, number, Section::Verts, piece.tag.count("NumberOfVerts")?)?.len();
        let lines = ends(document, number, Section::Lines, piece.tag.count("NumberOfLines")?)?.len();
        let cells =
            |section, count: &str| Cells::read(document, number, section, piece.tag.count(count)?, (first, points));
        let strips = cells(Section::Strips, "NumberOfStrips")?;
        let polys = cells(Section::Polys, "NumberOfPolys")?;
        let others = [verts, lines, polys.count()].iter().fold(0, |sum: usize, n| sum.saturating_add(*n));
        let triangles: usize = strips.strip_lengths().sum();
        let total = others.saturating_add(triangles).saturating_add(self.numbers as usize);
        if total >= u32::MAX as usize {
            return Err(Error::unsupported(format!("faces: {total} are more than {}", u32::MAX - 1)));
        }
        let corners = [polys.corners.len(), strips.strip_faces().saturating_mul(3)]
            .iter()
            .fold(self.faces.corners.len(), |sum, n| sum.saturating_add(*n));
        Demand { points: self.positions.len(), corners, ..Demand::default() }.check(document.size())?;
        self.numbers += (verts + lines) as u32;
        strips.add_strips(&mut self.faces, &mut self.numbers)?;
        polys.add_polygons(&mut self.faces, &mut self.numbers)?;

        let mut repeats = Vec::new();
        if strips.count() > 0 {
            repeats = try_with_capacity("cells", others + strips.count())?;
            repeats.resize(verts + lines, 1);
            repeats.extend(strips.strip_lengths().map(|n| n as u32));
            repeats.resize(others + strips.count(), 1);
        }
        let arrays = document.arrays(number, Section::CellData);
        self.face_data.add(document, piece, arrays, (others + strips.count(), &repeats))
    }

    /// Adds the points of a piece; the number of the first.
    fn points(&mut self, document: &Document, piece: usize, count: usize) -> Result<u32> {
        let first = self.positions.len();
        if count == 0 {
            return Ok(first as u32);
        }
        let tag = &document.pieces[piece].tag;
        let array = document.arrays(piece, Section::Points).next();
        let array = array.ok_or_else(|| tag.wrong(format_args!("no array of its {count} points")))?;
        if array.components()? != 3 {
            return Err(array.wrong(format_args!("{} components, not 3", array.components()?)));
        }
        let values = array.values(document, count)?;
        if let Some(k) = values.iter().position(|x| !x.is_finite() || x.abs() > LARGEST_COORDINATE) {
            let (point, x) = (k / 3, values[k]);
            return Err(array.wrong(format_args!("point {point}: {x} is not a finite coordinate")));
        }
        let total = first + count;
        if total >= u32::MAX as usize {
            return Err(Error::unsupported(format!("points: {total} are more than {}", u32::MAX - 1)));
        }
        self.positions.try_reserve(count).map_err(|_| Error::memory("points", total))?;
        self.positions.extend(values.chunks_exact(3).map(|p| Vec3::new(p[0], p[1], p[2])));
        Ok(first as u32)
    }
}

/// The names of tags that arrays outside pieces hold.
fn tag_names(document: &Document) -> Result<Vec<(i32, String)>> {
    let (mut numbers, mut names) = (None, None);
    for array in document.field_data() {
        match &*array.name()? {
            TAG_NUMBERS => numbers = Some(array.values(document, array.tag.count("NumberOfTuples")?)?),
            TAG_NAMES if !array.is_numeric()? => names = Some((array, array.strings(document)?)),
            _ => {}
        }
    }
    let (Some(numbers), Some((array, names))) = (numbers, names) else { return Ok(Vec::new()) };
    if numbers.len() != names.len() {
        return Err(array.wrong(format_args!("{} names of {} tags", names.len(), numbers.len())));
    }
    let mut names = names.into_iter();
    named_tags(numbers, || Ok(names.next().unwrap_or_default()), |what| array.wrong(what))
}

/// Tags with their names, ascending by tag. Of several names of a tag the first stays; an empty one is none.
pub(in crate::io) fn named_tags(
    numbers: Vec<f64>,
    mut name: impl FnMut() -> Result<String>,
    wrong: impl Fn(&str) -> Error,
) -> Result<Vec<(i32, String)>> {
    let mut named = try_with_capacity("names", numbers.len())?;
    for number in numbers {
        let name = name()?;
        if f64::from(number as i32) != number {
            return Err(wrong(&format!("\"{name:.40}\" is the name of {number}, which is no tag")));
        }
        if !name.is_empty() {
            named.push((number as i32, name));
        }
    }
    named.sort_by_key(|(tag, _)| *tag);
    named.dedup_by_key(|(tag, _)| *tag);
    Ok(named)
}
