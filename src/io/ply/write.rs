// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binary little-endian PLY with everything that a mesh carries.

use super::header::Vector;
use crate::error::{Error, Result, try_with_capacity};
use crate::io::number::Number;
use crate::mesh::{Field, FieldType, Mesh};
use std::collections::BTreeSet;

/// The bytes of a file with the surface as it stands: one vertex a row of the vertex data, so that corners of
/// one position and different data stay apart. Faces are numbered anew.
pub(in crate::io) fn write(mesh: &Mesh) -> Result<Vec<u8>> {
    check_names(mesh)?;
    let rows = mesh.row_count();
    let topology = mesh.half_edges();
    let tagged = mesh.is_tagged();
    let mut out = header(mesh, rows, tagged).into_bytes();
    let each = |fields: &[Field]| fields.iter().map(|f| f.components).sum::<usize>();
    let body = rows * (24 + 8 * each(mesh.vertex_fields()))
        + topology.face_count() * (8 + 8 * each(mesh.face_fields()))
        + 4 * topology.count();
    out.try_reserve_exact(body).map_err(|_| Error::memory("bytes", body))?;
    for row in 0..rows as u32 {
        for c in mesh.vertices()[mesh.vertex_of_row(row) as usize].to_array() {
            out.extend_from_slice(&c.to_le_bytes());
        }
        for field in mesh.vertex_fields() {
            field.item(row as usize).iter().for_each(|x| Number::of_field(field.kind).encode(*x, &mut out));
        }
    }
    let mut ring = try_with_capacity("corners", 16)?;
    for face in 0..topology.face_count() as u32 {
        ring.clear();
        ring.extend(topology.around_face(face).map(|h| mesh.vertex_data_row(h)));
        out.extend_from_slice(&(ring.len() as u32).to_le_bytes());
        ring.iter().for_each(|r| out.extend_from_slice(&r.to_le_bytes()));
        let number = topology.input_face(face);
        if tagged {
            out.extend_from_slice(&mesh.tag(number).to_le_bytes());
        }
        for field in mesh.face_fields() {
            field.item(number as usize).iter().for_each(|x| Number::of_field(field.kind).encode(*x, &mut out));
        }
    }
    Ok(out)
}

fn header(mesh: &Mesh, rows: usize, tagged: bool) -> String {
    let mut text = String::from("ply\nformat binary_little_endian 1.0\n");
    for (tag, name) in mesh.tag_names() {
        text += &format!("comment tag {tag} {name}\n");
    }
    let vector = |on_faces: bool, f: &Field| Vector { on_faces, components: f.components, name: f.name.clone() };
    let of_vertices: Vec<_> = mesh.vertex_fields().iter().map(|f| (vector(false, f), f.kind)).collect();
    let of_faces: Vec<_> = mesh.face_fields().iter().map(|f| (vector(true, f), f.kind)).collect();
    for (v, _) in of_vertices.iter().chain(&of_faces) {
        if v.components > 1 || v.property(0) != v.name {
            let on = if v.on_faces { "face" } else { "vertex" };
            text += &format!("comment field {on} {} {}\n", v.components, v.name);
        }
    }
    text += &format!("element vertex {rows}\nproperty double x\nproperty double y\nproperty double z\n");
    declare(&mut text, &of_vertices);
    text += &format!("element face {}\nproperty list uint uint vertex_indices\n", mesh.half_edges().face_count());
    if tagged {
        text += "property int tag\n";
    }
    declare(&mut text, &of_faces);
    text + "end_header\n"
}

/// No two properties may have one name.
fn check_names(mesh: &Mesh) -> Result<()> {
    for (on_faces, fields, own) in
        [(false, mesh.vertex_fields(), &["x", "y", "z"][..]), (true, mesh.face_fields(), &["vertex_indices", "tag"])]
    {
        let mut names: BTreeSet<String> = own.iter().map(|n| (*n).to_owned()).collect();
        for field in fields {
            let vector = Vector { on_faces, components: field.components, name: field.name.clone() };
            for c in 0..field.components {
                let name = vector.property(c);
                if names.contains(&name.to_ascii_lowercase()) && own.contains(&&name.to_ascii_lowercase()[..])
                    || !names.insert(name.clone())
                {
                    return Err(Error::unsupported(format!(
                        "data \"{}\": PLY has another property {name}",
                        field.name
                    )));
                }
            }
        }
    }
    Ok(())
}

/// A property for each component.
fn declare(text: &mut String, fields: &[(Vector, FieldType)]) {
    for (vector, kind) in fields {
        for c in 0..vector.components {
            *text += &format!("property {} {}\n", type_name(*kind), vector.property(c));
        }
    }
}

fn type_name(t: FieldType) -> &'static str {
    match t {
        FieldType::I8 => "char",
        FieldType::U8 => "uchar",
        FieldType::I16 => "short",
        FieldType::U16 => "ushort",
        FieldType::I32 => "int",
        FieldType::U32 => "uint",
        FieldType::I64 => "int64",
        FieldType::F32 => "float",
        FieldType::F64 => "double",
    }
}
