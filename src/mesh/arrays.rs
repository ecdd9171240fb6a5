// SPDX-License-Identifier: MIT OR Apache-2.0
//! The caller's arrays, checked.

use super::MeshOptions;
use super::faces::Faces;
use super::input::Input;
use crate::error::{Error, Result, Status, try_with_capacity};
use crate::math::Vec3;

/// Checks vertices, faces and tags. `offsets` of none: triangles.
pub(super) fn check(
    xyz: &[f64],
    offsets: Option<&[usize]>,
    indices: &[u32],
    tags: Option<&[i32]>,
    options: &MeshOptions,
) -> Result<Input> {
    options.check()?;
    let positions = positions(xyz)?;
    if u32::try_from(indices.len()).is_err() {
        return Err(Error::invalid(format!("indices: {} are more than {}", indices.len(), u32::MAX)));
    }
    let face_count = match offsets {
        Some(offsets) => check_offsets(offsets, indices.len())?,
        None if indices.is_empty() => return Err(Error::invalid("indices: empty: a mesh has at least one face")),
        None if !indices.len().is_multiple_of(3) => {
            return Err(Error::invalid(format!("indices: {} values are not 3 a triangle", indices.len())));
        }
        None => indices.len() / 3,
    };
    if let Some(tags) = tags
        && tags.len() != face_count
    {
        return Err(Error::invalid(format!("tags: {} values for {face_count} faces", tags.len())));
    }
    let range = |f: usize| offsets.map_or(3 * f..3 * f + 3, |offsets| offsets[f]..offsets[f + 1]);
    let mut faces = Faces::with_capacity(face_count, indices.len())?;
    let mut face = Vec::new();
    for f in 0..face_count {
        face.clear();
        for at in range(f) {
            face.push(check_index(indices[at], at, f, positions.len(), options.index_base)?);
        }
        faces.push(&face, f as u32);
    }
    let mut own_tags = try_with_capacity("tags", tags.map_or(0, <[i32]>::len))?;
    own_tags.extend_from_slice(tags.unwrap_or(&[]));
    Ok(Input { tags: own_tags, ..Input::new(positions, faces, Status::InvalidArgument) })
}

fn positions(xyz: &[f64]) -> Result<Vec<Vec3>> {
    if !xyz.len().is_multiple_of(3) {
        return Err(Error::invalid(format!("xyz: {} values are not 3 a vertex", xyz.len())));
    }
    // The last number means "none" in index arrays.
    if xyz.len() / 3 >= u32::MAX as usize {
        return Err(Error::invalid(format!("xyz: {} vertices are more than {}", xyz.len() / 3, u32::MAX - 1)));
    }
    if let Some(k) = xyz.iter().position(|c| !c.is_finite()) {
        return Err(Error::invalid(format!("xyz[{k}]: {} is not finite (vertex {})", xyz[k], k / 3)));
    }
    let mut positions = try_with_capacity("vertices", xyz.len() / 3)?;
    positions.extend(xyz.chunks_exact(3).map(|p| Vec3::new(p[0], p[1], p[2])));
    Ok(positions)
}

/// The number of faces, at least one, of three corners or more each.
fn check_offsets(offsets: &[usize], indices: usize) -> Result<usize> {
    let faces = offsets.len().saturating_sub(1);
    if faces == 0 {
        return Err(Error::invalid(format!("offsets: {} values: a mesh has at least one face", offsets.len())));
    }
    if offsets[0] != 0 {
        return Err(Error::invalid(format!("offsets[0]: {} is not 0", offsets[0])));
    }
    for (f, w) in offsets.windows(2).enumerate() {
        if w[1] < w[0] {
            return Err(Error::invalid(format!("offsets[{}]: {} after {} is not ascending", f + 1, w[1], w[0])));
        }
        if w[1] - w[0] < 3 {
            return Err(Error::invalid(format!("offsets[{}]: face {f} has {} corners, below 3", f + 1, w[1] - w[0])));
        }
    }
    if offsets[faces] != indices {
        return Err(Error::invalid(format!(
            "offsets[{faces}]: {} is not the count of indices, {indices}",
            offsets[faces]
        )));
    }
    Ok(faces)
}

fn check_index(index: u32, at: usize, face: usize, vertices: usize, base: u32) -> Result<u32> {
    match index.checked_sub(base) {
        Some(v) if (v as usize) < vertices => Ok(v),
        _ => Err(Error::invalid(format!(
            "indices[{at}]: {index} of face {face} does not count one of {vertices} vertices from {base}"
        ))),
    }
}
