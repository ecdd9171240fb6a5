// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices and faces as a file or the caller gives them, before anything was done to them.

use super::data::Field;
use super::faces::Faces;
use crate::error::{Result, Status};
use crate::math::Vec3;

/// Finite positions, faces whose corners are in range and at least three, and what is known of them. Faces are
/// numbered by [`Faces::input`]; tags and face data have one item for each of those numbers.
pub(crate) struct Input {
    pub positions: Vec<Vec3>,
    /// For each vertex the lowest one that it is known to be one with (itself: none), or none at all. Heeded
    /// where welding is off.
    pub same_as: Vec<u32>,
    pub faces: Faces,
    /// One for each face number, or none at all: every tag is 0.
    pub tags: Vec<i32>,
    /// The names of tags, ascending by tag, each tag at most once.
    pub tag_names: Vec<(i32, String)>,
    /// By vertex as given.
    pub vertex_data: Vec<Field>,
    pub face_data: Vec<Field>,
    /// Face numbers are below this, or below one more than the highest there is.
    pub numbers: usize,
    /// The status where the shape itself is unfit: the argument's or the file's fault.
    pub blame: Status,
}

impl Input {
    /// Faces without tags or data.
    pub fn new(positions: Vec<Vec3>, faces: Faces, blame: Status) -> Input {
        let (tags, tag_names, vertex_data, face_data) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Input { positions, same_as: Vec::new(), faces, tags, tag_names, vertex_data, face_data, numbers: 0, blame }
    }

    /// Triangles over three vertices of their own each, as in a file without shared vertices.
    pub fn triangle_soup(positions: Vec<Vec3>, blame: Status) -> Result<Input> {
        let count = positions.len() / 3;
        let mut faces = Faces::with_capacity(count, positions.len())?;
        for t in 0..count as u32 {
            faces.push(&[3 * t, 3 * t + 1, 3 * t + 2], t);
        }
        Ok(Input::new(positions, faces, blame))
    }

    /// Face numbers are below this.
    pub fn face_numbers(&self) -> usize {
        self.faces.input.last().map_or(0, |f| *f as usize + 1).max(self.numbers)
    }
}
