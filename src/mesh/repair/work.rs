// SPDX-License-Identifier: MIT OR Apache-2.0
//! A surface that is being repaired: its faces and the data of their corners, which the steps change in turn.

use crate::error::{Error, Result, Status, filled, try_copy, try_with_capacity};
use crate::math::{Vec3, length};
use crate::mesh::clean::{Corner, add_corner, close_ring};
use crate::mesh::data::{Field, FieldType};
use crate::mesh::faces::{Faces, starts_from_counts};
use crate::mesh::{Input, Mesh};

/// The surface between two steps.
pub(super) struct Work {
    pub positions: Vec<Vec3>,
    /// Their corners are vertices.
    pub faces: Faces,
    /// For each corner the item of the vertex data; none at all where there is no such data.
    pub rows: Vec<u32>,
    /// The tags of new faces, whose numbers follow those of the mesh.
    pub new_tags: Vec<i32>,
    /// Whether a step did anything.
    pub changed: bool,
}

impl Work {
    pub fn of(mesh: &Mesh) -> Result<Work> {
        let faces = mesh.half_edges.faces().try_clone()?;
        let rows = match (mesh.data.vertex.is_empty(), mesh.data.row_of_corner.is_empty()) {
            (true, _) => Vec::new(),
            (false, true) => try_copy("corners", &faces.corners)?,
            (false, false) => try_copy("corners", &mesh.data.row_of_corner)?,
        };
        let positions = try_copy("vertices", &mesh.vertices)?;
        Ok(Work { positions, faces, rows, new_tags: Vec::new(), changed: false })
    }

    /// A corner with its item of the vertex data; 0 where there is no such data.
    pub fn corner(&self, h: u32) -> Corner {
        (self.faces.corners[h as usize], self.rows.get(h as usize).copied().unwrap_or(0))
    }

    /// The corner after one of a face.
    pub fn next(&self, face: usize, h: u32) -> u32 {
        if h + 1 == self.faces.start[face + 1] { self.faces.start[face] } else { h + 1 }
    }

    pub fn length(&self, a: u32, b: u32) -> f64 {
        length(self.positions[b as usize] - self.positions[a as usize])
    }

    /// No faces yet, with room for those of this surface and some more corners.
    pub fn rings(&self, more_corners: usize) -> Result<Rings> {
        let corners = self.faces.corners.len().saturating_add(more_corners);
        fits("corners", corners)?;
        let tracked = !self.rows.is_empty();
        Ok(Rings {
            faces: Faces::with_capacity(self.faces.len(), corners)?,
            rows: try_with_capacity("corners", if tracked { corners } else { 0 })?,
            ring: Vec::new(),
            tracked,
        })
    }

    /// Takes over what was made of the faces.
    pub fn replace(&mut self, rings: Rings) -> Result<()> {
        if rings.faces.len() == 0 {
            let message = format!("mesh: none of {} faces has an area", self.faces.len());
            return Err(Error::new(Status::Topology, message));
        }
        (self.faces, self.rows) = (rings.faces, rings.rows);
        self.changed = true;
        Ok(())
    }

    /// As an input, with the tags, names and data of the mesh it came from. Faces that are new have NaN as their
    /// data, or 0 where its type is an integer.
    pub fn into_input(self, mesh: &Mesh) -> Result<Input> {
        let numbers = mesh.face_count + self.new_tags.len();
        let mut tags = try_with_capacity("tags", numbers)?;
        if !mesh.tags.is_empty() || self.new_tags.iter().any(|tag| *tag != 0) {
            tags.extend((0..mesh.face_count as u32).map(|f| mesh.tag(f)));
            tags.extend_from_slice(&self.new_tags);
        }
        let mut face_data = try_with_capacity("fields", mesh.data.face.len())?;
        for field in &mesh.data.face {
            let mut values = try_with_capacity("values", numbers.saturating_mul(field.components))?;
            values.extend_from_slice(&field.values);
            let none = if matches!(field.kind, FieldType::F32 | FieldType::F64) { f64::NAN } else { 0.0 };
            values.resize(numbers * field.components, none);
            face_data.push(field.with_values(values));
        }
        let mut input = self.with_vertex_data(&mesh.data.vertex)?;
        (input.tags, input.tag_names, input.face_data) = (tags, mesh.copied_tag_names()?, face_data);
        input.numbers = numbers;
        Ok(input)
    }

    /// One vertex of the input for each vertex and each item of the data that its corners have.
    fn with_vertex_data(self, fields: &[Field]) -> Result<Input> {
        if self.rows.is_empty() {
            return Ok(Input::new(self.positions, self.faces, Status::Topology));
        }
        let mut bucket = filled("vertices", self.positions.len() + 1, 0u32)?;
        for &v in &self.faces.corners {
            bucket[v as usize] += 1;
        }
        starts_from_counts(&mut bucket);
        let mut order = filled("corners", self.rows.len(), 0u32)?;
        for (h, &v) in self.faces.corners.iter().enumerate() {
            order[bucket[v as usize] as usize] = h as u32;
            bucket[v as usize] += 1;
        }
        let mut faces = self.faces;
        let mut row_of_given: Vec<u32> = try_with_capacity("rows", self.rows.len())?;
        let mut vertex_of_given: Vec<u32> = try_with_capacity("rows", self.rows.len())?;
        let mut same_as = try_with_capacity("rows", self.rows.len())?;
        let mut begin = 0;
        for (v, &end) in bucket[..self.positions.len()].iter().enumerate() {
            let corners = &mut order[begin..end as usize];
            corners.sort_unstable_by_key(|&h| (self.rows[h as usize], h));
            let first = row_of_given.len() as u32;
            for &h in &*corners {
                let row = self.rows[h as usize];
                if row_of_given.len() as u32 == first || row_of_given.last() != Some(&row) {
                    row_of_given.push(row);
                    vertex_of_given.push(v as u32);
                    same_as.push(first);
                }
                faces.corners[h as usize] = row_of_given.len() as u32 - 1;
            }
            begin = end as usize;
        }
        let mut positions = try_with_capacity("vertices", vertex_of_given.len())?;
        positions.extend(vertex_of_given.iter().map(|&v| self.positions[v as usize]));
        let mut input = Input { same_as, ..Input::new(positions, faces, Status::Topology) };
        for field in fields {
            input.vertex_data.push(field.gathered(row_of_given.iter().copied())?);
        }
        Ok(input)
    }
}

/// Faces that are made one after another from rings of corners.
pub(super) struct Rings {
    pub faces: Faces,
    pub rows: Vec<u32>,
    ring: Vec<Corner>,
    tracked: bool,
}

impl Rings {
    /// Adds a corner to the ring that is being made, unless it repeats the last one or ends a spike.
    pub fn add(&mut self, corner: Corner) {
        add_corner(&mut self.ring, corner);
    }

    /// Ends the ring; false where fewer than three corners are left, and no face is made of it.
    pub fn end(&mut self, number: u32) -> bool {
        close_ring(&mut self.ring);
        let enough = self.ring.len() > 2;
        if enough {
            self.faces.push_all(self.ring.iter().map(|c| c.0), number);
            self.rows.extend(self.ring.iter().filter(|_| self.tracked).map(|c| c.1));
        }
        self.ring.clear();
        enough
    }
}

/// Whether numbers of 32 bits, of which the last means "none", can count these.
pub(super) fn fits(what: &str, count: usize) -> Result<()> {
    if count >= u32::MAX as usize {
        return Err(Error::invalid(format!("mesh: repaired, it has {count} {what}, more than {}", u32::MAX - 1)));
    }
    Ok(())
}
