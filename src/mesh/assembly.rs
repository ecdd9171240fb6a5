// SPDX-License-Identifier: MIT OR Apache-2.0
//! Meshes taken apart and put together: by tag, by component, several into one, all with their data.

use super::data::Field;
use super::faces::{Faces, Sets, starts_from_counts};
use super::{Input, Mesh, MeshOptions, Orient, build};
use crate::error::{Error, Result, Status, filled, try_copy, try_with_capacity};

/// What tags become where several meshes become one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JoinTags {
    /// As they are; of several names of a tag the first stays.
    #[default]
    Keep,
    /// Numbered anew from 0: mesh after mesh, each mesh's by rising tag. Names stay with what they name.
    Renumber,
    /// The number of the mesh.
    ByMesh,
}

/// What a mesh is split by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplitBy {
    /// One mesh a tag, by rising tag.
    Tag,
    /// One mesh for what edges connect, by the lowest face of each.
    Component,
}

/// The options under which a mesh that stands is built again as it is.
fn as_it_stands() -> MeshOptions {
    MeshOptions { weld_tolerance: -1.0, orient: Orient::Keep, ..MeshOptions::default() }
}

/// What the options mean for meshes that stand: with no tolerance above 0 nothing is welded, and then
/// [`Orient::Auto`] turns nothing. Vertices that repair split, and faces that were kept as given, stay so.
fn of_standing(options: &MeshOptions) -> MeshOptions {
    if options.weld_tolerance > 0.0 {
        return options.clone();
    }
    let orient = if options.orient == Orient::Auto { Orient::Keep } else { options.orient };
    MeshOptions { weld_tolerance: -1.0, orient, ..options.clone() }
}

impl Mesh {
    /// Several meshes as one, placed as the options say. Each keeps its vertices and its orientation, unless
    /// [`MeshOptions::weld_tolerance`] is above 0, which welds all of them together (1e-12 where positions are
    /// equal) and orients as [`MeshOptions::orient`] says; without it [`Orient::Auto`] turns nothing, the others
    /// do what they say. Face f of mesh k has the number f plus the [`Mesh::face_count`]s before it. Fields of
    /// one name and place become one; where a mesh has no such field its values are NaN.
    ///
    /// # Errors
    /// [`Status::InvalidArgument`]: no mesh; options out of range; a field of one name that has different
    /// counts of components; too many faces or vertices. [`Status::Memory`].
    pub fn join(meshes: &[&Mesh], tags: JoinTags, options: &MeshOptions) -> Result<Mesh> {
        options.check()?;
        if meshes.is_empty() {
            return Err(Error::invalid("meshes: none: a mesh has at least one face"));
        }
        let mut inputs = try_with_capacity("meshes", meshes.len())?;
        for mesh in meshes {
            inputs.push(mesh.as_input()?);
        }
        let same = meshes.iter().all(|mesh| mesh.orient == meshes[0].orient);
        let orient = if same { meshes[0].orient } else { Orient::Keep };
        Ok(build(join(inputs, tags)?, &of_standing(options))?.oriented_as_before(options, orient))
    }

    /// The same surface, placed; vertices and orientation stay as in [`Mesh::join`], with [`Orient::Flip`] all
    /// faces are turned over. Data stay as they are: those that are vectors are not turned along.
    ///
    /// # Errors
    /// Those of [`Mesh::join`].
    pub fn rebuilt(&self, options: &MeshOptions) -> Result<Mesh> {
        options.check()?;
        Ok(build(self.as_input()?, &of_standing(options))?.oriented_as_before(options, self.orient))
    }

    /// The mesh in parts that keep vertices, orientation, tags, their names, and data. Vertices and faces are
    /// numbered anew in each, in their order.
    ///
    /// # Errors
    /// [`Status::Memory`].
    pub fn split(&self, by: SplitBy) -> Result<Vec<Mesh>> {
        let (part_of_face, parts) = self.parts(by)?;
        let mut end = filled("parts", parts + 1, 0u32)?;
        part_of_face.iter().for_each(|&part| end[part as usize] += 1);
        starts_from_counts(&mut end);
        let mut members = filled("faces", part_of_face.len(), 0u32)?;
        for (f, &part) in part_of_face.iter().enumerate() {
            members[end[part as usize] as usize] = f as u32;
            end[part as usize] += 1;
        }
        let mut marks = filled("rows", self.row_count(), u32::MAX)?;
        let mut split = try_with_capacity("parts", parts)?;
        let mut first = 0;
        for &end in &end[..parts] {
            let faces = &members[first..end as usize];
            let part = build(self.input_of(faces, &mut marks)?, &as_it_stands())?;
            split.push(Mesh { orient: self.orient, ..part });
            first = end as usize;
        }
        Ok(split)
    }

    /// Where the options leave the way that faces run as it is, it is what it was made to be.
    fn oriented_as_before(self, options: &MeshOptions, orient: Orient) -> Mesh {
        match options.orient {
            Orient::Auto if options.weld_tolerance <= 0.0 => Mesh { orient, ..self },
            _ => self,
        }
    }

    /// How many parts [`Mesh::split`] gives.
    ///
    /// # Errors
    /// [`Status::Memory`].
    pub fn part_count(&self, by: SplitBy) -> Result<usize> {
        Ok(self.parts(by)?.1)
    }

    /// The part of each face as it stands, and how many there are.
    pub(super) fn parts(&self, by: SplitBy) -> Result<(Vec<u32>, usize)> {
        let topology = &self.half_edges;
        let mut part = filled("faces", topology.face_count(), 0u32)?;
        match by {
            SplitBy::Tag => {
                let tags = self.used_tags()?;
                for (part, &f) in part.iter_mut().zip(&topology.faces().input) {
                    *part = tags.partition_point(|t| *t < self.tag(f)) as u32;
                }
                Ok((part, tags.len()))
            }
            SplitBy::Component => {
                let mut sets = Sets::new(part.len())?;
                let edges = super::edges::Edges::of(self.vertices.len(), topology.faces().half_edges())?;
                for edge in edges.iter() {
                    edge[1..].iter().for_each(|&h| sets.join(topology.face(edge[0]), topology.face(h)));
                }
                let mut count = 0;
                for f in 0..part.len() {
                    let first = sets.find(f as u32) as usize;
                    part[f] = if first == f { count } else { part[first] };
                    count += u32::from(first == f);
                }
                Ok((part, count as usize))
            }
        }
    }

    /// The different tags of the faces as they stand, ascending.
    ///
    /// # Errors
    /// [`Status::Memory`].
    pub fn used_tags(&self) -> Result<Vec<i32>> {
        different(self.half_edges.faces().input.iter().map(|&f| self.tag(f)))
    }

    /// All faces with their numbers, as an input.
    pub(crate) fn as_input(&self) -> Result<Input> {
        let rows = self.row_count();
        let mut input = Input::new(try_with_capacity("vertices", rows)?, Faces::default(), Status::InvalidArgument);
        input.positions.extend((0..rows as u32).map(|r| self.vertices[self.vertex_of_row(r) as usize]));
        input.same_as = try_with_capacity("vertices", rows)?;
        input.same_as.extend((0..rows as u32).map(|r| self.vertex_of_row(r)));
        input.faces = self.half_edges.faces().try_clone()?;
        if !self.data.row_of_corner.is_empty() {
            input.faces.corners.copy_from_slice(&self.data.row_of_corner);
        }
        input.tags = try_copy("tags", &self.tags)?;
        input.tag_names = self.copied_tag_names()?;
        input.vertex_data = Field::try_clone(&self.data.vertex)?;
        input.face_data = Field::try_clone(&self.data.face)?;
        input.numbers = self.face_count;
        Ok(input)
    }

    /// Some faces, numbered anew, as an input. `marks` has an item a row, all `u32::MAX`, and has that again.
    fn input_of(&self, faces: &[u32], marks: &mut [u32]) -> Result<Input> {
        let own = self.half_edges.faces();
        let corners = faces.iter().map(|&f| own.face(f as usize).len()).sum();
        let mut rows: Vec<u32> = try_with_capacity("rows", marks.len().min(2 * corners))?;
        // The vertex with each of its rows, so that a seam's rows know the vertex that they are at.
        let rows_at = |h: u32| (self.half_edges.origin(h), self.data.row(h, self.half_edges.origin(h)));
        for (v, row) in faces.iter().flat_map(|&f| self.half_edges.around_face(f)).map(rows_at) {
            for r in [v, row] {
                if std::mem::replace(&mut marks[r as usize], 0) == u32::MAX {
                    rows.push(r);
                }
            }
        }
        rows.sort_unstable_by_key(|&r| (self.vertex_of_row(r), r));
        (0..).zip(&rows).for_each(|(k, &r)| marks[r as usize] = k);
        let mut out = Faces::with_capacity(faces.len(), corners)?;
        for (number, &f) in faces.iter().enumerate() {
            let ring = self.half_edges.around_face(f);
            out.push_all(ring.map(|h| marks[rows_at(h).1 as usize]), number as u32);
        }
        let mut input = Input::new(try_with_capacity("vertices", rows.len())?, out, Status::InvalidArgument);
        input.positions.extend(rows.iter().map(|&r| self.vertices[self.vertex_of_row(r) as usize]));
        input.same_as = try_with_capacity("vertices", rows.len())?;
        input.same_as.extend(rows.iter().map(|&r| marks[self.vertex_of_row(r) as usize]));
        rows.iter().for_each(|&r| marks[r as usize] = u32::MAX);
        let numbers = || faces.iter().map(|&f| self.half_edges.input_face(f));
        if !self.tags.is_empty() {
            input.tags = try_with_capacity("tags", faces.len())?;
            input.tags.extend(numbers().map(|f| self.tag(f)));
        }
        let named = different(numbers().map(|f| self.tag(f)))?;
        input.tag_names.extend(named.iter().filter_map(|&tag| Some((tag, self.tag_name(tag)?.to_owned()))));
        for field in &self.data.vertex {
            input.vertex_data.push(field.gathered(rows.iter().copied())?);
        }
        for field in &self.data.face {
            input.face_data.push(field.gathered(numbers())?);
        }
        Ok(input)
    }

    /// The vertex that a row of the vertex data belongs to.
    pub(crate) fn vertex_of_row(&self, row: u32) -> u32 {
        let extra = (row as usize).checked_sub(self.vertices.len());
        extra.map_or(row, |e| self.data.seam_rows[e])
    }
}

/// Several inputs as one.
pub(crate) fn join(mut inputs: Vec<Input>, tags: JoinTags) -> Result<Input> {
    let vertices: usize = inputs.iter().map(|i| i.positions.len()).sum();
    let corners: usize = inputs.iter().map(|i| i.faces.corners.len()).sum();
    let numbers: usize = inputs.iter().map(Input::face_numbers).sum();
    if vertices.max(corners).max(numbers) >= u32::MAX as usize {
        return Err(Error::invalid(format!(
            "meshes: {vertices} vertices, {corners} corners and {numbers} faces: one of them is above {}",
            u32::MAX - 1
        )));
    }
    renumber_tags(&mut inputs, tags)?;
    let blame = inputs.first().map_or(Status::InvalidArgument, |i| i.blame);
    let faces = inputs.iter().map(|i| i.faces.len()).sum();
    let mut all = Input::new(try_with_capacity("vertices", vertices)?, Faces::with_capacity(faces, corners)?, blame);
    all.vertex_data = join_fields(&inputs, |i| (&i.vertex_data, i.positions.len()))?;
    all.face_data = join_fields(&inputs, |i| (&i.face_data, i.face_numbers()))?;
    let tagged = inputs.iter().any(|i| !i.tags.is_empty());
    let known = inputs.iter().any(|i| !i.same_as.is_empty());
    all.tags = try_with_capacity("tags", if tagged { numbers } else { 0 })?;
    all.same_as = try_with_capacity("vertices", if known { vertices } else { 0 })?;
    let mut first_number = 0;
    for input in inputs {
        let (first, count) = (all.positions.len() as u32, input.face_numbers());
        for (face, number) in input.faces.iter().zip(&input.faces.input) {
            all.faces.push_all(face.iter().map(|v| v + first), number + first_number);
        }
        if known {
            let same = (0..input.positions.len()).map(|v| input.same_as.get(v).copied().unwrap_or(v as u32) + first);
            all.same_as.extend(same);
        }
        if tagged {
            all.tags.extend((0..count).map(|f| input.tags.get(f).copied().unwrap_or(0)));
        }
        all.positions.extend(input.positions);
        for (tag, name) in input.tag_names {
            if let Err(at) = all.tag_names.binary_search_by_key(&tag, |(t, _)| *t) {
                all.tag_names.insert(at, (tag, name));
            }
        }
        first_number += count as u32;
    }
    all.numbers = numbers;
    Ok(all)
}

fn renumber_tags(inputs: &mut [Input], tags: JoinTags) -> Result<()> {
    let mut next = 0;
    for (k, input) in inputs.iter_mut().enumerate() {
        let count = input.face_numbers();
        match tags {
            JoinTags::Keep => {}
            JoinTags::ByMesh => {
                input.tags = filled("tags", count, k as i32)?;
                input.tag_names.truncate(1);
                input.tag_names.iter_mut().for_each(|(tag, _)| *tag = k as i32);
            }
            JoinTags::Renumber => {
                if input.tags.is_empty() {
                    input.tags = filled("tags", count, 0)?;
                }
                let old = different(input.faces.input.iter().map(|f| input.tags[*f as usize]))?;
                let beyond = i32::try_from(next as usize + old.len());
                let beyond = beyond.map_err(|_| Error::invalid(format!("tags: more than {} of them", i32::MAX)))?;
                let anew = |tag: i32| old.binary_search(&tag).map_or(-1, |at| next + at as i32);
                input.tags.iter_mut().for_each(|tag| *tag = anew(*tag));
                input.tag_names.iter_mut().for_each(|(tag, _)| *tag = anew(*tag));
                input.tag_names.retain(|(tag, _)| *tag >= 0);
                next = beyond;
            }
        }
    }
    Ok(())
}

/// Each tag once, ascending.
fn different(tags: impl ExactSizeIterator<Item = i32>) -> Result<Vec<i32>> {
    let mut all = try_with_capacity("tags", tags.len())?;
    all.extend(tags);
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

/// The fields of all inputs, by name in the order in which they turn up.
fn join_fields<'a>(inputs: &'a [Input], of: impl Fn(&'a Input) -> (&'a Vec<Field>, usize)) -> Result<Vec<Field>> {
    let total = inputs.iter().map(|i| of(i).1).sum::<usize>();
    let mut joined: Vec<Field> = Vec::new();
    let mut filled_to = 0;
    for input in inputs {
        let (fields, items) = of(input);
        for field in fields {
            let at = match joined.iter().position(|f| f.name == field.name) {
                Some(at) => at,
                None => {
                    let values = try_with_capacity("values", total.saturating_mul(field.components))?;
                    joined.push(field.with_values(values));
                    joined.len() - 1
                }
            };
            let own = &mut joined[at];
            if own.components != field.components {
                return Err(Error::invalid(format!(
                    "meshes: the field \"{}\" has {} components in one and {} in another",
                    field.name, own.components, field.components
                )));
            }
            if own.kind != field.kind {
                own.kind = super::FieldType::F64;
            }
            own.pad(filled_to);
            own.values.extend_from_slice(&field.values);
        }
        filled_to += items;
    }
    joined.iter_mut().for_each(|field| field.pad(total));
    Ok(joined)
}
