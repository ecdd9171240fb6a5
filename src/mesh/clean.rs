// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces over welded vertices: corners that became one, spikes and faces of fewer than three corners leave.

use super::faces::Faces;
use super::input::Input;
use super::weld::{UNUSED, Welded};
use crate::error::{Error, Result, filled, try_with_capacity};
use crate::math::Vec3;

/// Faces of at least three different corners, and the vertices they use.
pub(super) struct Cleaned {
    pub vertices: Vec<Vec3>,
    pub faces: Faces,
    /// The input vertex of each corner; none at all where the input has no vertex data.
    pub source: Vec<u32>,
    /// The numbers of faces that lost corners, ascending.
    pub shrunk: Vec<u32>,
}

/// A vertex, and the input vertex that became it.
pub(super) type Corner = (u32, u32);

/// Faces over welded vertices, without those that welding collapsed, and the vertices they use.
pub(super) fn clean(input: &Input, welded: Welded) -> Result<Cleaned> {
    let mut faces = Faces::with_capacity(input.faces.len(), input.faces.corners.len())?;
    let tracked = !input.vertex_data.is_empty();
    let mut source = try_with_capacity("corners", if tracked { input.faces.corners.len() } else { 0 })?;
    let (mut ring, mut shrunk) = (Vec::new(), Vec::new());
    for (corners, &number) in input.faces.iter().zip(&input.faces.input) {
        ring.clear();
        let mut lost = false;
        for &corner in corners {
            lost |= add_corner(&mut ring, (welded.of[corner as usize], corner));
        }
        lost |= close_ring(&mut ring);
        if lost {
            shrunk.try_reserve(1).map_err(|_| Error::memory("faces", shrunk.len() + 1))?;
            shrunk.push(number);
        }
        if ring.len() > 2 {
            faces.push_all(ring.iter().map(|c| c.0), number);
            source.extend(ring.iter().filter(|_| tracked).map(|c| c.1));
        }
    }
    if faces.len() == 0 {
        return Err(Error::new(
            input.blame,
            format!("faces: each of {} has fewer than three different corners", input.faces.len()),
        ));
    }
    let vertices = if shrunk.is_empty() { welded.vertices } else { compact(welded.vertices, &mut faces)? };
    Ok(Cleaned { vertices, faces, source, shrunk })
}

/// Adds a corner unless it repeats the last one or ends a spike (x, y, x), which encloses nothing.
pub(super) fn add_corner(ring: &mut Vec<Corner>, v: Corner) -> bool {
    let n = ring.len();
    if n > 0 && ring[n - 1].0 == v.0 {
        return true;
    }
    if n > 1 && ring[n - 2].0 == v.0 {
        ring.pop();
        return true;
    }
    ring.push(v);
    false
}

/// The same across the end of the ring.
pub(super) fn close_ring(ring: &mut Vec<Corner>) -> bool {
    let before = ring.len();
    // Where it begins now: taking the first corner away again and again would be quadratic.
    let mut from = 0;
    loop {
        let n = ring.len();
        let left = n - from;
        if left > 1 && ring[n - 1].0 == ring[from].0 {
            ring.pop();
        } else if left > 2 && ring[n - 2].0 == ring[from].0 {
            ring.truncate(n - 2);
        } else if left > 2 && ring[n - 1].0 == ring[from + 1].0 {
            ring.pop();
            from += 1;
        } else {
            break;
        }
    }
    ring.drain(..from);
    ring.len() < before
}

/// Leaves out vertices that no face uses any more.
fn compact(mut vertices: Vec<Vec3>, faces: &mut Faces) -> Result<Vec<Vec3>> {
    let mut new = filled("vertices", vertices.len(), UNUSED)?;
    for &v in &faces.corners {
        new[v as usize] = 0;
    }
    let mut left = 0;
    for v in 0..vertices.len() {
        if new[v] != UNUSED {
            new[v] = left as u32;
            vertices[left] = vertices[v];
            left += 1;
        }
    }
    vertices.truncate(left);
    for v in &mut faces.corners {
        *v = new[*v as usize];
    }
    Ok(vertices)
}
