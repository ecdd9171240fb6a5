// SPDX-License-Identifier: MIT OR Apache-2.0
//! Named data of vertices and faces: scalars and vectors that a file or the caller attached to a surface.

use super::Mesh;
use super::faces::{Faces, starts_from_counts};
use crate::error::{Error, Result, filled, try_copy, try_with_capacity};
use crate::math::Vec3;
use std::cmp::Ordering;

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
    /// 64-bit integers beyond 2^53 lose their last digits. Unsigned ones that this type does not hold are read as
    /// [`FieldType::F64`].
    I64,
    F32,
    #[default]
    F64,
}

/// Named numbers, `components` to a vertex or a face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Field {
    /// Its name; one line, not empty, without white space around it.
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

    /// Fills up to a count of items with NaN.
    pub(crate) fn pad(&mut self, items: usize) {
        if self.values.len() < items * self.components {
            self.values.resize(items * self.components, f64::NAN);
            // Integers have no value that says that there is none.
            self.kind = FieldType::F64;
        }
    }

    /// The field with the items that `from` lists.
    pub(crate) fn gathered(&self, from: impl ExactSizeIterator<Item = u32>) -> Result<Field> {
        let mut values = try_with_capacity("values", from.len() * self.components)?;
        for k in from {
            values.extend_from_slice(self.item(k as usize));
        }
        Ok(self.with_values(values))
    }

    /// Other values under the same name.
    pub(crate) fn with_values(&self, values: Vec<f64>) -> Field {
        Field { name: self.name.clone(), kind: self.kind, components: self.components, values }
    }

    /// Copies.
    pub(crate) fn try_clone(fields: &[Field]) -> Result<Vec<Field>> {
        let mut copies = try_with_capacity("fields", fields.len())?;
        for field in fields {
            copies.push(field.with_values(try_copy("values", &field.values)?));
        }
        Ok(copies)
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
    /// The pieces of faces that come to a vertex again in another row, ascending.
    pub of_pieces: Vec<PieceRows>,
}

/// A triangle, and the rows of its corners in the order in which the input gave them.
pub(super) type PieceRows = (u32, [u32; 3]);

impl Data {
    /// Sorts vertex data given by input vertex into rows; `source` has the input vertex of each corner.
    pub fn of(vertices: usize, faces: &Faces, source: &[u32], vertex: Vec<Field>, face: Vec<Field>) -> Result<Data> {
        if vertex.is_empty() {
            return Ok(Data { face, ..Data::default() });
        }
        let bits = |k: u32| vertex.iter().flat_map(move |f| f.item(k as usize).iter().map(|x| x.to_bits()));
        let by_data = |a, b| if a == b { Ordering::Equal } else { bits(a).cmp(bits(b)) };
        let (mut given_of_row, differs) = lowest(vertices, faces, source, |a, b| by_data(a, b).is_eq())?;
        let (mut row_of_corner, mut seam_rows) = (Vec::new(), Vec::new());
        if differs.contains(&true) {
            row_of_corner = first_with_data(faces, source, &differs, by_data)?;
            for (c, &v) in faces.corners.iter().enumerate() {
                row_of_corner[c] = match row_of_corner[c] {
                    NONE => v,
                    first if (first as usize) < c => row_of_corner[first as usize],
                    _ => {
                        for rows in [&mut given_of_row, &mut seam_rows] {
                            rows.try_reserve(1).map_err(|_| Error::memory("rows", rows.len()))?;
                        }
                        given_of_row.push(source[c]);
                        seam_rows.push(v);
                        given_of_row.len() as u32 - 1
                    }
                };
            }
        }
        let mut rows = try_with_capacity("fields", vertex.len())?;
        for field in vertex {
            rows.push(field.gathered(given_of_row.iter().copied())?);
        }
        Ok(Data { vertex: rows, face, row_of_corner, seam_rows, of_pieces: Vec::new() })
    }

    fn try_clone(&self) -> Result<Data> {
        Ok(Data {
            vertex: Field::try_clone(&self.vertex)?,
            face: Field::try_clone(&self.face)?,
            row_of_corner: try_copy("corners", &self.row_of_corner)?,
            seam_rows: try_copy("rows", &self.seam_rows)?,
            of_pieces: try_copy("pieces", &self.of_pieces)?,
        })
    }

    /// The row of a corner, given with its vertex.
    pub fn row(&self, corner: u32, vertex: u32) -> u32 {
        self.row_of_corner.get(corner as usize).copied().unwrap_or(vertex)
    }
}

/// No corner, no vertex.
const NONE: u32 = u32::MAX;

/// The input vertex of the lowest corner of each vertex, and whether others are not the same.
fn lowest(
    vertices: usize,
    faces: &Faces,
    source: &[u32],
    same: impl Fn(u32, u32) -> bool,
) -> Result<(Vec<u32>, Vec<bool>)> {
    let mut lowest = filled("rows", vertices, NONE)?;
    let mut differs = filled("vertices", vertices, false)?;
    for (&v, &given) in faces.corners.iter().zip(source) {
        let (lowest, differs) = (&mut lowest[v as usize], &mut differs[v as usize]);
        if *lowest == NONE {
            *lowest = given;
        } else if !*differs {
            *differs = !same(*lowest, given);
        }
    }
    Ok((lowest, differs))
}

/// For each corner the lowest of its vertex with the same data; [`NONE`] where that is the lowest of all of its vertex.
/// The corners of a vertex are sorted by their data: a look at each pair would be quadratic.
fn first_with_data(
    faces: &Faces,
    source: &[u32],
    differs: &[bool],
    by_data: impl Fn(u32, u32) -> Ordering,
) -> Result<Vec<u32>> {
    let on_seams = || faces.corners.iter().zip(0u32..).filter(|(v, _)| differs[**v as usize]);
    let mut end = filled("vertices", differs.len() + 1, 0u32)?;
    on_seams().for_each(|(v, _)| end[*v as usize] += 1);
    starts_from_counts(&mut end);
    let mut sorted = filled("corners", end[differs.len()] as usize, 0u32)?;
    for (&v, c) in on_seams() {
        sorted[end[v as usize] as usize] = c;
        end[v as usize] += 1;
    }
    let mut first = filled("corners", source.len(), NONE)?;
    let mut from = 0;
    for &end in &end[..differs.len()] {
        let of_vertex = &mut sorted[from..end as usize];
        from = end as usize;
        let Some(&lowest) = of_vertex.first() else { continue };
        let by_data = |a: u32, b: u32| by_data(source[a as usize], source[b as usize]);
        of_vertex.sort_unstable_by(|a, b| by_data(*a, *b).then(a.cmp(b)));
        for group in of_vertex.chunk_by(|a, b| by_data(*a, *b).is_eq()).filter(|group| group[0] != lowest) {
            group.iter().for_each(|c| first[*c as usize] = group[0]);
        }
    }
    Ok(first)
}

impl Mesh {
    /// Writes the value of a vertex field to `out`, of one number a component: at a point of the given piece
    /// of an input face, with the barycentric weights of [`crate::geometry::Closest`]. NaN where there is no
    /// such face or piece.
    pub fn interpolate(&self, field: &Field, face: i64, piece: i32, barycentric: Vec3, out: &mut [f64]) {
        out.fill(f64::NAN);
        let Some(rows) = self.rows_of(face, piece) else { return };
        let weighted = rows.map(|row| field.item(row as usize));
        for (c, x) in out.iter_mut().enumerate() {
            // An absent corner has a weight of zero, and its value, which may be NaN, none.
            let terms = weighted.iter().zip(barycentric.to_array()).filter(|(_, w)| *w != 0.0);
            *x = terms.map(|(item, w)| item[c] * w).sum();
        }
    }

    /// Writes the value that a face field has on an input face to `out`; NaN where there is no such face.
    pub fn face_value(&self, field: &Field, face: i64, out: &mut [f64]) {
        out.fill(f64::NAN);
        if let Some(f) = usize::try_from(face).ok().filter(|f| *f < self.face_count) {
            out.copy_from_slice(field.item(f));
        }
    }

    /// The rows of the three corners of a piece, in the order in which the input gave them.
    fn rows_of(&self, face: i64, piece: i32) -> Option<[u32; 3]> {
        let f = self.half_edges.face_of_input(u32::try_from(face).ok()?)?;
        let piece = self.triangles_of(f).nth(usize::try_from(piece).ok()?)?;
        let triangle = self.triangles.get(piece)?;
        let given = |[a, b, c]: [u32; 3]| if triangle.turned { [a, c, b] } else { [a, b, c] };
        if self.data.row_of_corner.is_empty() {
            return Some(given(triangle.vertices));
        }
        if let Ok(own) = self.data.of_pieces.binary_search_by_key(&(piece as u32), |(t, _)| *t) {
            return Some(self.data.of_pieces[own].1);
        }
        // Any corner of the face at the vertex will do: all have one row.
        let first = self.half_edges.around_face(f).start;
        let row = |v: u32| {
            let leaving = self.half_edges.outgoing(v);
            let corner = leaving.get(leaving.partition_point(|h| *h < first));
            corner.map_or(v, |h| self.data.row(*h, v))
        };
        Some(given(triangle.vertices.map(row)))
    }

    /// The mesh with one more field, or another instead of one of the same name and place. `values` has an
    /// item for each vertex as it stands, or for each input face.
    ///
    /// # Errors
    /// [`Status::InvalidArgument`](crate::Status): a name that is empty, not one line or has white space around it, a
    /// count that is not that of the vertices or faces. [`Status::Memory`](crate::Status).
    pub fn with_field(&self, on_faces: bool, mut field: Field) -> Result<Mesh> {
        let items = if on_faces { self.face_count } else { self.vertices.len() };
        check_field(&field, items)?;
        if !on_faces {
            let more = self.data.seam_rows.len().saturating_mul(field.components);
            field.values.try_reserve_exact(more).map_err(|_| Error::memory("values", more))?;
            for &v in &self.data.seam_rows {
                field.values.extend_from_within(v as usize * field.components..(v as usize + 1) * field.components);
            }
        }
        let mut mesh = self.copied()?;
        let own = if on_faces { &mut mesh.data.face } else { &mut mesh.data.vertex };
        match own.iter_mut().find(|f| f.name == field.name) {
            Some(known) => *known = field,
            None => own.push(field),
        }
        Ok(mesh)
    }

    /// The mesh with other tags, one for each input face, and their names, in any order.
    ///
    /// # Errors
    /// [`Status::InvalidArgument`](crate::Status): a count that is not that of the faces, a tag named twice, a name
    /// that is empty, not one line or has white space around it. [`Status::Memory`](crate::Status).
    pub fn with_tags(&self, tags: &[i32], mut names: Vec<(i32, String)>) -> Result<Mesh> {
        if tags.len() != self.face_count {
            return Err(Error::invalid(format!("tags: {} values for {} faces", tags.len(), self.face_count)));
        }
        if let Some((tag, name)) = names.iter().find(|(_, name)| !is_name(name)) {
            return Err(Error::invalid(format!("names: {name:?} of tag {tag} {NO_NAME}")));
        }
        names.sort();
        if let Some(w) = names.windows(2).find(|w| w[0].0 == w[1].0) {
            return Err(Error::invalid(format!("names: tag {} has two names", w[0].0)));
        }
        Ok(Mesh { tags: try_copy("tags", tags)?, tag_names: names, ..self.copied()? })
    }

    pub(super) fn copied(&self) -> Result<Mesh> {
        Ok(Mesh {
            vertices: try_copy("vertices", &self.vertices)?,
            triangles: try_copy("triangles", &self.triangles)?,
            tags: try_copy("tags", &self.tags)?,
            tag_names: self.copied_tag_names()?,
            data: self.data.try_clone()?,
            face_count: self.face_count,
            shrunk: try_copy("faces", &self.shrunk)?,
            half_edges: self.half_edges.try_clone()?,
            report: self.report.clone(),
            surface: self.surface,
            orient: self.orient,
        })
    }

    /// A copy of the names of all tags.
    pub(super) fn copied_tag_names(&self) -> Result<Vec<(i32, String)>> {
        let mut names = try_with_capacity("names", self.tag_names.len())?;
        names.extend(self.tag_names.iter().cloned());
        Ok(names)
    }
}

/// What every format can give back: a line without white space around it.
fn is_name(name: &str) -> bool {
    !name.is_empty() && name.trim() == name && !name.chars().any(char::is_control)
}

const NO_NAME: &str = "is empty, not one line or has white space around it";

/// Checks the name and the size of a field that a caller gives.
fn check_field(Field { name, components, values, .. }: &Field, items: usize) -> Result<()> {
    if !is_name(name) {
        return Err(Error::invalid(format!("name: {name:?} {NO_NAME}")));
    }
    if *components == 0 || items.checked_mul(*components) != Some(values.len()) {
        return Err(Error::invalid(format!("values: {} are not {components} for each of {items} items", values.len())));
    }
    Ok(())
}
