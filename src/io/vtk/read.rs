// SPDX-License-Identifier: MIT OR Apache-2.0
//! Reading legacy VTK: points, cells in the old form and in that of version 5, data of points and cells.

use super::cursor::{Cursor, type_of};
use super::data::Data;
use crate::error::{Error, Result, Status, try_with_capacity};
use crate::io::number::Number;
use crate::io::proportion::Demand;
use crate::io::text::way_out;
use crate::io::vtp::cells::Cells;
use crate::math::Vec3;
use crate::mesh::{Faces, Input, LARGEST_COORDINATE};

/// What is known of a file so far.
struct File<'a> {
    cursor: Cursor<'a>,
    version: f64,
    points: Vec<Vec3>,
    /// Of vertices and lines, which are no faces.
    other_cells: usize,
    polygons: Cells,
    strips: Cells,
    tag_names: Vec<(i32, String)>,
    of_points: Data,
    of_cells: Data,
}

/// What data belong to from here on.
#[derive(Clone, Copy, PartialEq)]
enum Of {
    Nothing,
    Points(usize),
    Cells(usize),
}

/// Reads a file. A face's number is that of its cell among polygons, and behind them the triangles of strips.
pub(in crate::io) fn read(bytes: &[u8]) -> Result<Input> {
    let mut file = File::open(bytes)?;
    let mut of = Of::Nothing;
    loop {
        let word = file.cursor.word().to_ascii_uppercase();
        match &word[..] {
            b"" => break,
            b"POINTS" if file.points.is_empty() => file.read_points()?,
            b"VERTICES" | b"LINES" => {
                let (ends, _) = file.cells()?;
                file.other_cells += ends.len();
            }
            b"POLYGONS" if file.polygons.ends.is_empty() => file.polygons = file.faces()?,
            b"TRIANGLE_STRIPS" if file.strips.ends.is_empty() => file.strips = file.faces()?,
            b"POINT_DATA" => of = Of::Points(file.cursor.count()?),
            b"CELL_DATA" => of = Of::Cells(file.cursor.count()?),
            b"FIELD" if of == Of::Nothing => {
                let names = super::data::names(&mut file.cursor)?;
                if file.tag_names.is_empty() {
                    file.tag_names = names;
                }
            }
            _ => match of {
                Of::Points(count) => file.of_points.read(&word, count, &mut file.cursor)?,
                Of::Cells(count) => file.of_cells.read(&word, count, &mut file.cursor)?,
                Of::Nothing => return Err(file.unknown(&word)),
            },
        }
    }
    file.finish(bytes.len())
}

impl<'a> File<'a> {
    fn open(bytes: &'a [u8]) -> Result<File<'a>> {
        let mut cursor = Cursor::new(bytes.trim_ascii_start());
        let first = cursor.rest_of_line();
        let version = first.split_whitespace().last().and_then(|v| v.parse().ok());
        let Some(version) = version.filter(|_| first.to_ascii_lowercase().starts_with("# vtk datafile version")) else {
            return Err(Error::parse(format!(
                "line 1: \"{first:.40}\" is not \"# vtk DataFile Version\" and a number"
            )));
        };
        cursor.skip_lines(1);
        cursor.rest_of_line();
        let kind = cursor.word();
        let binary = kind.eq_ignore_ascii_case(b"BINARY");
        if !binary && !kind.eq_ignore_ascii_case(b"ASCII") {
            return Err(
                cursor.wrong(format_args!("\"{:.40}\" is neither ASCII nor BINARY", String::from_utf8_lossy(kind)))
            );
        }
        if !cursor.word().eq_ignore_ascii_case(b"DATASET") {
            return Err(cursor.wrong("there is no DATASET"));
        }
        let kind = cursor.word();
        if !kind.eq_ignore_ascii_case(b"POLYDATA") {
            let (shown, way_out) = (String::from_utf8_lossy(kind), way_out(kind));
            return Err(Error::unsupported(format!(
                "{}: the dataset is {shown:.40}, not POLYDATA{way_out}",
                cursor.place()
            )));
        }
        cursor.binary = binary;
        Ok(File {
            cursor,
            version,
            points: Vec::new(),
            other_cells: 0,
            polygons: Cells { ends: Vec::new(), corners: Vec::new() },
            strips: Cells { ends: Vec::new(), corners: Vec::new() },
            tag_names: Vec::new(),
            of_points: Data::default(),
            of_cells: Data::default(),
        })
    }

    fn unknown(&self, word: &[u8]) -> Error {
        self.cursor.wrong(format_args!("\"{:.40}\" is no part of a POLYDATA", String::from_utf8_lossy(word)))
    }

    fn read_points(&mut self) -> Result<()> {
        let (count, number) = (self.cursor.count()?, self.number()?);
        if count >= u32::MAX as usize {
            return Err(self.cursor.wrong(format_args!("{count} points are more than {}", u32::MAX - 1)));
        }
        let values = self.cursor.numbers(3 * count, number)?;
        self.cursor.skip_metadata(3)?;
        if let Some(k) = values.iter().position(|x| !x.is_finite() || x.abs() > LARGEST_COORDINATE) {
            return Err(self.cursor.wrong(format_args!(
                "the coordinate {} of point {} is not finite",
                values[k],
                k / 3
            )));
        }
        self.points = try_with_capacity("points", count)?;
        self.points.extend(values.chunks_exact(3).map(|p| Vec3::new(p[0], p[1], p[2])));
        Ok(())
    }

    fn number(&mut self) -> Result<Number> {
        let word = self.cursor.word();
        type_of(word).ok_or_else(|| {
            self.cursor.wrong(format_args!("\"{:.40}\" is no type of numbers", String::from_utf8_lossy(word)))
        })
    }

    /// Where each cell ends among the corners, and all corners.
    fn cells(&mut self) -> Result<(Vec<usize>, Vec<f64>)> {
        let (first, second) = (self.cursor.count()?, self.cursor.count()?);
        let offsets =
            self.cursor.peek().eq_ignore_ascii_case(b"OFFSETS") && (self.version >= 5.0 || !self.cursor.binary);
        if !offsets {
            return self.counted(first, second);
        }
        self.cursor.word();
        let number = self.number()?;
        let offsets = self.cursor.numbers(first, number)?;
        self.cursor.skip_metadata(1)?;
        if !self.cursor.word().eq_ignore_ascii_case(b"CONNECTIVITY") {
            return Err(self.cursor.wrong("there is no CONNECTIVITY behind OFFSETS"));
        }
        let number = self.number()?;
        let corners = self.cursor.numbers(second, number)?;
        self.cursor.skip_metadata(1)?;
        let rises = offsets.windows(2).all(|w| w[0] <= w[1]);
        let ends = offsets.first().is_none_or(|x| *x == 0.0) && *offsets.last().unwrap_or(&0.0) == second as f64;
        if !rises || !ends {
            return Err(self.cursor.wrong(format_args!("OFFSETS do not rise from 0 to {second}")));
        }
        let mut found = try_with_capacity("cells", offsets.len())?;
        found.extend(offsets.iter().skip(1).map(|x| *x as usize));
        Ok((found, corners))
    }

    /// The old form: each cell's count of corners before them.
    fn counted(&mut self, count: usize, size: usize) -> Result<(Vec<usize>, Vec<f64>)> {
        if count > size {
            return Err(self.cursor.wrong(format_args!("{size} numbers cannot hold {count} cells")));
        }
        let mut values = self.cursor.numbers(size, Number::I32)?;
        let mut ends = try_with_capacity("cells", count)?;
        let (mut at, mut end) = (0, 0);
        for cell in 0..count {
            let length = values.get(at).copied().unwrap_or(-1.0);
            let fits = length >= 0.0 && length.fract() == 0.0 && length <= (size - at).saturating_sub(1) as f64;
            if at >= size || !fits {
                return Err(self
                    .cursor
                    .wrong(format_args!("cell {cell} has {length} corners, and {size} numbers hold all")));
            }
            let length = length as usize;
            values.copy_within(at + 1..at + 1 + length, end);
            (at, end) = (at + 1 + length, end + length);
            ends.push(end);
        }
        if at < size {
            return Err(self.cursor.wrong(format_args!("{count} cells have {at} of {size} numbers")));
        }
        values.truncate(end);
        Ok((ends, values))
    }

    fn faces(&mut self) -> Result<Cells> {
        let (ends, values) = self.cells()?;
        let mut corners = try_with_capacity("corners", values.len())?;
        for (k, x) in values.into_iter().enumerate() {
            if !(x >= 0.0 && x < self.points.len() as f64 && x.fract() == 0.0) {
                let cell = ends.partition_point(|end| *end <= k);
                let count = self.points.len();
                return Err(self
                    .cursor
                    .wrong(format_args!("the index {x} of cell {cell} is not one of {count} points")));
            }
            corners.push(x as u32);
        }
        Ok(Cells { ends, corners })
    }

    fn finish(self, size: usize) -> Result<Input> {
        let (points, cells) = (self.points.len(), self.other_cells + self.polygons.count() + self.strips.count());
        let end = self.cursor.place();
        let triangles: usize = self.strips.strip_lengths().sum();
        let data = self.of_cells.components().saturating_mul(triangles);
        let corners = self.polygons.corners.len() + 3 * self.strips.strip_faces();
        Demand { points, corners, vertex_values: 0, face_values: data }.check(size)?;
        let mut faces = Faces::with_capacity(self.polygons.count(), self.polygons.corners.len())?;
        let mut number = 0;
        self.polygons.add_polygons(&mut faces, &mut number)?;
        self.strips.add_strips(&mut faces, &mut number)?;
        if faces.len() == 0 {
            return Err(Error::parse(format!("{end}: the file ends without a polygon")));
        }
        // The cell that each face number comes from.
        let mut cell_of = try_with_capacity("faces", number as usize)?;
        cell_of.extend((0..self.polygons.count()).map(|k| (self.other_cells + k) as u32));
        for (k, triangles) in self.strips.strip_lengths().enumerate() {
            let cell = self.other_cells + self.polygons.count() + k;
            cell_of.resize(cell_of.len() + triangles, cell as u32);
        }
        let mut input = Input::new(self.points, faces, Status::Parse);
        input.numbers = number as usize;
        input.vertex_data = self.of_points.finish("POINT_DATA", points)?;
        let mut of_cells = self.of_cells.finish("CELL_DATA", cells)?;
        if let Some(at) = of_cells.iter().position(crate::io::vtp::read::is_tags) {
            let tags = of_cells.remove(at);
            input.tags = try_with_capacity("tags", cell_of.len())?;
            input.tags.extend(cell_of.iter().map(|c| tags.values[*c as usize] as i32));
        }
        for field in of_cells {
            input.face_data.push(field.gathered(cell_of.iter().copied())?);
        }
        input.tag_names = self.tag_names;
        Ok(input)
    }
}
