// SPDX-License-Identifier: MIT OR Apache-2.0
//! Cells of a piece: where each ends in the list of corners, and the corners.

use super::array::Array;
use super::document::{Document, Section};
use crate::error::{Result, try_with_capacity};
use crate::mesh::Faces;

/// Cells of one kind.
pub(in crate::io) struct Cells {
    /// Where each ends in the corners.
    pub ends: Vec<usize>,
    pub corners: Vec<u32>,
}

/// The array of a section with this name.
fn named<'d, 'a>(document: &'d Document<'a>, piece: usize, section: Section, name: &str) -> Result<&'d Array<'a>> {
    for array in document.arrays(piece, section) {
        if array.name()? == name {
            return Ok(array);
        }
    }
    Err(document.pieces[piece].tag.wrong(format_args!("{section:?} have no array \"{name}\"")))
}

/// Where each cell ends in its list of corners.
pub(super) fn ends(document: &Document, piece: usize, section: Section, count: usize) -> Result<Vec<usize>> {
    if count == 0 {
        return Ok(Vec::new());
    }
    let array = named(document, piece, section, "offsets")?;
    let values = array.values(document, count)?;
    let mut ends = try_with_capacity("cells", count)?;
    let mut before = 0;
    for (k, x) in values.into_iter().enumerate() {
        // Also false for NaN; more corners than this there cannot be.
        if !(x >= before as f64 && x < u32::MAX as f64 && x.fract() == 0.0) {
            return Err(array.wrong(format_args!("cell {k} ends at {x}, the one before at {before}")));
        }
        before = x as usize;
        ends.push(before);
    }
    Ok(ends)
}

impl Cells {
    /// The cells of a section, whose corners are numbers below `points`, all plus `first`.
    pub(super) fn read(
        document: &Document,
        piece: usize,
        section: Section,
        count: usize,
        (first, points): (u32, usize),
    ) -> Result<Cells> {
        let ends = ends(document, piece, section, count)?;
        let Some(&last) = ends.last() else { return Ok(Cells { ends, corners: Vec::new() }) };
        let array = named(document, piece, section, "connectivity")?;
        let values = array.values(document, last)?;
        let mut corners = try_with_capacity("corners", last)?;
        for (k, x) in values.into_iter().enumerate() {
            if !(x >= 0.0 && x < points as f64 && x.fract() == 0.0) {
                return Err(array.wrong(format_args!("item {k}: {x} is not one of the {points} points")));
            }
            corners.push(x as u32 + first);
        }
        Ok(Cells { ends, corners })
    }

    /// How many.
    pub fn count(&self) -> usize {
        self.ends.len()
    }

    fn iter(&self) -> impl Iterator<Item = &[u32]> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(start, end)| &self.corners[*start..*end])
    }

    /// Adds polygons to the faces, numbered on from `number`. Those of fewer than three corners only count.
    pub fn add_polygons(&self, faces: &mut Faces, number: &mut u32) -> Result<()> {
        for corners in self.iter() {
            if corners.len() > 2 {
                faces.try_push(corners, *number)?;
            }
            *number += 1;
        }
        Ok(())
    }

    /// Adds the triangles of strips: every second one runs backwards. Triangles without area, with which strips
    /// turn corners, only count.
    pub fn add_strips(&self, faces: &mut Faces, number: &mut u32) -> Result<()> {
        for corners in self.iter() {
            for (k, triangle) in corners.windows(3).enumerate() {
                let &[a, b, c] = triangle else { continue };
                if has_area(triangle) {
                    faces.try_push(&if k % 2 == 0 { [a, b, c] } else { [b, a, c] }, *number)?;
                }
                *number += 1;
            }
        }
        Ok(())
    }

    /// The triangles of all strips that are not without area.
    pub fn strip_faces(&self) -> usize {
        self.iter().flat_map(|corners| corners.windows(3)).filter(|triangle| has_area(triangle)).count()
    }

    /// The triangles of each strip.
    pub fn strip_lengths(&self) -> impl Iterator<Item = usize> {
        self.iter().map(|corners| corners.len().saturating_sub(2))
    }
}

/// Whether three corners of a strip are different.
fn has_area(triangle: &[u32]) -> bool {
    matches!(triangle, [a, b, c] if a != b && b != c && c != a)
}
