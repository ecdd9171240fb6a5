// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces given more than once.

use super::Triangle;
use super::faces::{Faces, filled, starts_from_counts};
use crate::error::Result;
use std::cmp::Ordering;

/// Which faces repeat an earlier one: the same ring of vertices, from whichever corner and in either
/// direction (for triangles: the same vertices). The lowest of each is not marked.
pub(super) fn find(faces: &Faces, vertices: usize) -> Result<Vec<bool>> {
    let lowest = |face: &[u32]| face.iter().copied().min().unwrap_or(0) as usize;
    let mut bucket = filled("vertices", vertices + 1, 0u32)?;
    for face in faces.iter() {
        bucket[lowest(face)] += 1;
    }
    starts_from_counts(&mut bucket);
    let mut order = filled("faces", faces.len(), 0u32)?;
    for (f, face) in faces.iter().enumerate() {
        let slot = &mut bucket[lowest(face)];
        order[*slot as usize] = f as u32;
        *slot += 1;
    }
    let mut repeats = filled("faces", faces.len(), false)?;
    let compare = |f: &u32, g: &u32| compare_rings(faces.face(*f as usize), faces.face(*g as usize));
    let mut begin = 0;
    for &end in &bucket[..vertices] {
        let group = &mut order[begin..end as usize];
        if group.len() > 1 {
            group.sort_unstable_by(|f, g| compare(f, g).then(f.cmp(g)));
            for pair in group.windows(2) {
                repeats[pair[1] as usize] = compare(&pair[0], &pair[1]) == Ordering::Equal;
            }
        }
        begin = end as usize;
    }
    Ok(repeats)
}

/// Leaves out what is marked.
pub(super) fn leave_out(faces: &Faces, triangles: &[Triangle], repeats: &[bool]) -> Result<(Faces, Vec<Triangle>)> {
    let mut kept = Faces::with_capacity(faces.len(), faces.corners.len())?;
    let mut kept_triangles = crate::error::try_with_capacity("triangles", triangles.len())?;
    let mut new = filled("faces", faces.len(), 0u32)?;
    for f in (0..faces.len()).filter(|&f| !repeats[f]) {
        new[f] = kept.len() as u32;
        kept.push(faces.face(f), faces.input[f]);
    }
    let of_kept = triangles.iter().filter(|t| !repeats[t.face as usize]);
    kept_triangles.extend(of_kept.map(|t| Triangle { face: new[t.face as usize], ..*t }));
    Ok((kept, kept_triangles))
}

fn compare_rings(f: &[u32], g: &[u32]) -> Ordering {
    if let (&[a, b, c], &[d, e, h]) = (f, g) {
        return sorted([a, b, c]).cmp(&sorted([d, e, h]));
    }
    f.len().cmp(&g.len()).then_with(|| canonical(f).cmp(canonical(g)))
}

fn sorted([a, b, c]: [u32; 3]) -> [u32; 3] {
    let (low, high) = (a.min(b), a.max(b));
    [low.min(c), low.max(high.min(c)), high.max(c)]
}

/// The ring read from a corner and in a direction that depend on the ring alone: the least such reading.
fn canonical(ring: &[u32]) -> impl Iterator<Item = u32> {
    let n = ring.len();
    let reading = move |from: usize, step: usize| (0..n).map(move |k| ring[(from + k * step) % n]);
    let lowest = ring.iter().min();
    let starts = (0..n).filter(move |&k| Some(&ring[k]) == lowest);
    let best = starts
        .flat_map(|from| [(from, 1), (from, n - 1)])
        .min_by(|&(p, s), &(q, t)| reading(p, s).cmp(reading(q, t)))
        .unwrap_or((0, 1));
    reading(best.0, best.1)
}
