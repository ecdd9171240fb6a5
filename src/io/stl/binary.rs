// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binary STL: 80 bytes of header, a count, and 50 bytes a triangle (normal, corners, attribute word), all
//! little-endian. Normals and attributes are ignored: some writers put colours there.

use super::Triangles;
use crate::error::{Error, Result, try_with_capacity};
use crate::math::{Vec3, cross_of_differences, unit};
use crate::mesh::Mesh;

const HEADER: usize = 84;
const TRIANGLE: usize = 50;
const NORMAL: usize = 12;

/// Must not begin with "solid", which some readers take for ASCII.
const TITLE: &[u8] = b"binary STL by embound";

/// Bytes that the count of a file asks for; none where it has no count.
pub(super) fn claimed_size(bytes: &[u8]) -> Option<u64> {
    count(bytes).map(|n| HEADER as u64 + TRIANGLE as u64 * u64::from(n))
}

fn count(bytes: &[u8]) -> Option<u32> {
    bytes.get(HEADER - 4..HEADER)?.try_into().ok().map(u32::from_le_bytes)
}

/// Reads the triangles. Bytes after the last one are ignored.
pub(super) fn read(bytes: &[u8]) -> Result<Triangles> {
    let size = bytes.len();
    let Some(count) = count(bytes) else {
        return Err(Error::parse(format!(
            "offset {size}: the file ends within the {HEADER} bytes of header and count"
        )));
    };
    let there = (size - HEADER) / TRIANGLE;
    if count == 0 {
        return Err(Error::parse(format!("offset 80: the count of triangles is 0; {} bytes follow", size - HEADER)));
    }
    // Nothing is allocated by the claim alone.
    if there < count as usize {
        return Err(Error::parse(format!(
            "offset {size}: the file ends after {there} of the {count} triangles it claims"
        )));
    }
    let body = &bytes[HEADER..HEADER + TRIANGLE * count as usize];
    let mut corners = try_with_capacity("corners", 3 * count as usize)?;
    for (t, triangle) in body.chunks_exact(TRIANGLE).enumerate() {
        let number = |k: usize| {
            let at = NORMAL + 4 * k;
            f64::from(f32::from_le_bytes([triangle[at], triangle[at + 1], triangle[at + 2], triangle[at + 3]]))
        };
        let numbers: [f64; 9] = std::array::from_fn(number);
        if let Some(k) = numbers.iter().position(|x| !x.is_finite()) {
            let offset = HEADER + TRIANGLE * t + NORMAL + 4 * k;
            return Err(Error::parse(format!(
                "offset {offset}: the coordinate {} of triangle {t} is not finite",
                numbers[k]
            )));
        }
        let [a, b, c, d, e, f, g, h, i] = numbers;
        corners.extend([Vec3::new(a, b, c), Vec3::new(d, e, f), Vec3::new(g, h, i)]);
    }
    Ok(Triangles { corners, ..Triangles::default() })
}

/// The bytes of a file with the triangles of the surface as it stands.
pub(in crate::io) fn write(mesh: &Mesh) -> Result<Vec<u8>> {
    let (vertices, triangles) = (mesh.vertices(), mesh.triangles());
    for (v, p) in vertices.iter().enumerate() {
        if let Some(c) = p.to_array().into_iter().find(|&c| !(c as f32).is_finite()) {
            return Err(Error::unsupported(format!("vertex {v}: the coordinate {c:e} is beyond the f32 of STL")));
        }
    }
    let mut out = try_with_capacity("bytes", HEADER + TRIANGLE * triangles.len())?;
    out.extend_from_slice(TITLE);
    out.resize(HEADER - 4, b' ');
    // Triangles are counted in u32 everywhere.
    out.extend_from_slice(&(triangles.len() as u32).to_le_bytes());
    for t in triangles {
        let [a, b, c] = t.corners(vertices);
        for v in [unit(cross_of_differences(a, b, c)), a, b, c] {
            for x in v.to_array() {
                out.extend_from_slice(&(x as f32).to_le_bytes());
            }
        }
        out.extend_from_slice(&[0, 0]);
    }
    Ok(out)
}
