// SPDX-License-Identifier: MIT OR Apache-2.0
//! Writing OBJ: polygons as they stand, every coordinate with the digits that give its bits again.

use super::read::COLOURS;
use crate::error::Result;
use crate::io::text::{Text, one_line};
use crate::mesh::{Field, Mesh};

/// The bytes of a file with the surface as it stands. A group begins wherever the tag changes, so that faces
/// keep their order. Vertex data red, green and blue are written as they are; the format holds no other data.
pub(in crate::io) fn write(mesh: &Mesh) -> Result<Vec<u8>> {
    let mut out = Text::default();
    out.add(format_args!("# OBJ by embound\n"))?;
    let colours = colours(mesh);
    vertices(mesh, colours, &mut out)?;
    let topology = mesh.half_edges();
    let tagged = mesh.is_tagged();
    let mut current = None;
    for f in 0..topology.face_count() as u32 {
        let tag = mesh.tag(topology.input_face(f));
        if tagged && current != Some(tag) {
            group(mesh, tag, &mut out)?;
            current = Some(tag);
        }
        out.add(format_args!("f"))?;
        for h in topology.around_face(f) {
            let vertex = topology.origin(h);
            let row = if colours.is_some() { mesh.vertex_data_row(h) } else { vertex };
            out.add(format_args!(" {}", u64::from(row) + 1))?;
        }
        out.add(format_args!("\n"))?;
    }
    unused_names(mesh, &mut out)?;
    Ok(out.into_bytes())
}

fn colours(mesh: &Mesh) -> Option<[&Field; 3]> {
    let field = |name: &str| mesh.vertex_fields().iter().find(|f| f.name == name && f.components == 1);
    let [red, green, blue] = COLOURS.map(field);
    Some([red?, green?, blue?])
}

/// A vertex a row of the colours, where there are any.
fn vertices(mesh: &Mesh, colours: Option<[&Field; 3]>, out: &mut Text) -> Result<()> {
    let seams = if colours.is_some() { mesh.data().seam_rows.len() } else { 0 };
    for row in 0..(mesh.vertices().len() + seams) as u32 {
        let p = mesh.vertices()[mesh.vertex_of_row(row) as usize];
        out.add(format_args!("v {:?} {:?} {:?}", p.x, p.y, p.z))?;
        let values = colours.map(|c| c.map(|field| field.values[row as usize]));
        if let Some([r, g, b]) = values.filter(|v| v.iter().any(|x| !x.is_nan())) {
            out.add(format_args!(" {r:?} {g:?} {b:?}"))?;
        }
        out.add(format_args!("\n"))?;
    }
    Ok(())
}

/// The group of a tag: a comment with its number and name, and for other readers a name of one word.
fn group(mesh: &Mesh, tag: i32, out: &mut Text) -> Result<()> {
    let name = one_line(mesh.tag_name(tag).unwrap_or(""));
    if name.is_empty() {
        return out.add(format_args!("# tag {tag}\ng tag_{tag}\n"));
    }
    let word: String = name.chars().map(|c| if c.is_whitespace() { '_' } else { c }).collect();
    out.add(format_args!("# tag {tag} {name}\ng {word}\n"))
}

/// Groups without faces keep the names of tags that no face has.
fn unused_names(mesh: &Mesh, out: &mut Text) -> Result<()> {
    let mut used: Vec<i32> = mesh.half_edges().faces().input.iter().map(|f| mesh.tag(*f)).collect();
    used.sort_unstable();
    used.dedup();
    for (tag, _) in mesh.tag_names().iter().filter(|(tag, _)| used.binary_search(tag).is_err()) {
        group(mesh, *tag, out)?;
    }
    Ok(())
}
