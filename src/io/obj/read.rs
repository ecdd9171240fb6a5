// SPDX-License-Identifier: MIT OR Apache-2.0
//! OBJ, statement by statement: one a line, which a backslash joins to the next line.

use super::tags::Tags;
use crate::error::{Error, Result, Status};
use crate::io::words::Words;
use crate::math::Vec3;
use crate::mesh::{Faces, Field, Input};

/// Colours of vertices, as named data.
pub(super) const COLOURS: [&str; 3] = ["red", "green", "blue"];

/// Reads a file. A face's number counts the `f` statements; its tag is the group or object and the material that
/// it is in.
pub(in crate::io) fn read(bytes: &[u8]) -> Result<Input> {
    let mut words = Words::new(bytes);
    let mut reader = Reader { faces: Faces::with_capacity(0, 0)?, ..Reader::default() };
    loop {
        let keyword = words.next_on_line();
        if !keyword.is_empty() {
            reader.statement(keyword, &mut words)?;
        }
        if !words.next_line() {
            break;
        }
    }
    reader.finish(&words)
}

#[derive(Default)]
struct Reader {
    positions: Vec<Vec3>,
    /// One list a colour; empty until a vertex has colours, else as long as the positions.
    colours: [Vec<f64>; 3],
    faces: Faces,
    tags: Tags,
    /// The highest number of a vertex that a face names, and its line: the vertex may come later.
    highest: (i64, usize),
    /// The corners of a face.
    ring: Vec<u32>,
}

impl Reader {
    fn statement(&mut self, keyword: &[u8], words: &mut Words) -> Result<()> {
        let is = |name: &str| keyword.eq_ignore_ascii_case(name.as_bytes());
        if is("v") {
            self.vertex(words)?;
        } else if is("f") || is("fo") {
            self.face(words)?;
        } else if is("g") {
            self.tags.group(words.rest_of_line());
        } else if is("o") {
            self.tags.object(words.rest_of_line());
        } else if is("usemtl") {
            self.tags.material(words.rest_of_line());
        } else if keyword.starts_with(b"#") {
            // No backslash joins lines here: it may be the last of a folder's name.
            let text = words.rest_of_line();
            if keyword == b"#" {
                self.tags.comment(&text);
            }
            return Ok(());
        } else if !keyword[0].is_ascii_alphabetic() {
            return Err(words.unexpected(keyword, "a statement of OBJ"));
        }
        self.tags.end_of_statement();
        Ok(())
    }

    fn vertex(&mut self, words: &mut Words) -> Result<()> {
        let mut numbers = [b"".as_slice(); 7];
        let mut count = 0;
        while count < numbers.len() {
            numbers[count] = words.next_on_line();
            if numbers[count].is_empty() {
                break;
            }
            count += 1;
        }
        if ![3, 4, 6].contains(&count) {
            let more = if count == numbers.len() { " or more" } else { "" };
            return Err(Error::parse(format!(
                "line {}: v: {count}{more} numbers are not x y z, x y z w or x y z red green blue",
                words.line()
            )));
        }
        let [x, y, z, rest @ ..] = numbers;
        let position = Vec3::new(words.coordinate_in(x)?, words.coordinate_in(y)?, words.coordinate_in(z)?);
        let before = self.positions.len();
        // Corners are numbered in u32 everywhere.
        if before >= u32::MAX as usize - 1 {
            return Err(Error::unsupported(format!("line {}: v: more than {before} vertices", words.line())));
        }
        self.positions.try_reserve(1).map_err(|_| Error::memory("vertices", before + 1))?;
        self.positions.push(position);
        match count {
            // The weight of a rational curve's control point has no meaning for polygons.
            4 => _ = words.parsed::<f64>(rest[0], "a number")?,
            6 => {
                for (colour, word) in self.colours.iter_mut().zip(rest) {
                    let value = words.parsed(word, "a number")?;
                    pad(colour, before)?;
                    pad(colour, before + 1)?;
                    colour[before] = value;
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, words: &mut Words) -> Result<()> {
        self.ring.clear();
        let line = words.line();
        loop {
            let corner = words.next_on_line();
            if corner.is_empty() {
                break;
            }
            let vertex = self.corner(corner, words)?;
            self.ring.try_reserve(1).map_err(|_| Error::memory("corners", self.ring.len() + 1))?;
            self.ring.push(vertex);
        }
        if self.ring.len() < 3 {
            return Err(Error::parse(format!("line {line}: f: {} corners are fewer than three", self.ring.len())));
        }
        // Below the count of corners, which is checked.
        let number = self.faces.len() as u32;
        self.faces.try_push(&self.ring, number)?;
        self.tags.face()
    }

    /// The vertex of `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`, from 0.
    fn corner(&mut self, corner: &[u8], words: &Words) -> Result<u32> {
        let mut parts = corner.split(|b| *b == b'/');
        let wrong = || words.unexpected(corner, "a corner of a face");
        let number: i64 = words.parsed(parts.next().unwrap_or_default(), "a number").map_err(|_| wrong())?;
        let is_number =
            |part: &[u8]| part.iter().enumerate().all(|(k, b)| b.is_ascii_digit() || (k == 0 && *b == b'-'));
        if !parts.clone().all(is_number) || parts.count() > 2 {
            return Err(wrong());
        }
        let there = self.positions.len() as i64;
        let vertex = if number < 0 { there.checked_add(number) } else { number.checked_sub(1) };
        if number > self.highest.0 {
            self.highest = (number, words.line());
        }
        vertex
            .and_then(|v| u32::try_from(v).ok())
            .ok_or_else(|| out_of_range(words.line(), number, self.positions.len()))
    }

    fn finish(self, words: &Words) -> Result<Input> {
        let Reader { positions, colours, faces, tags, highest, .. } = self;
        if faces.len() == 0 {
            return Err(Error::parse(format!("line {}: the file ends without a face", words.line())));
        }
        if highest.0 > positions.len() as i64 {
            return Err(out_of_range(highest.1, highest.0, positions.len()));
        }
        let count = positions.len();
        let mut input = Input::new(positions, faces, Status::Parse);
        (input.tags, input.tag_names) = tags.finish()?;
        if !colours[0].is_empty() {
            for (name, mut values) in COLOURS.into_iter().zip(colours) {
                pad(&mut values, count)?;
                input.vertex_data.push(Field { name: name.to_owned(), components: 1, values, ..Field::default() });
            }
        }
        Ok(input)
    }
}

/// Vertices without colours have none: NaN.
fn pad(colour: &mut Vec<f64>, count: usize) -> Result<()> {
    colour.try_reserve(count - colour.len()).map_err(|_| Error::memory("colours", count))?;
    colour.resize(count, f64::NAN);
    Ok(())
}

fn out_of_range(line: usize, number: i64, vertices: usize) -> Error {
    let there = if number < 0 { " before it" } else { "" };
    Error::parse(format!("line {line}: f: {number} is not one of the {vertices} vertices{there}"))
}
