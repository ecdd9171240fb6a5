// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces given more than once.

use super::Triangle;
use super::edges::{Edges, NONE};
use super::faces::{Faces, starts_from_counts};
use crate::error::{Result, filled, try_copy, try_with_capacity};
use std::cmp::Ordering;

/// Faces that repeat an earlier one: the same ring of vertices, from whichever corner (for triangles: the
/// same vertices). The lowest of each is not marked.
pub(crate) struct Repeats {
    /// For each face the earliest of its copies, whichever way it runs: itself where there is none.
    pub either_way: Vec<u32>,
    /// The earliest of those that run the same way.
    pub same_way: Vec<u32>,
}

impl Repeats {
    /// Faces that repeat an earlier one, whichever way.
    pub fn count(&self) -> usize {
        self.either_way.iter().enumerate().filter(|(f, first)| *f != **first as usize).count()
    }
}

/// Where edges are known, most meshes are known to have no faces that repeat others: these would share all their edges,
/// with each other alone or with more faces.
pub(super) fn find_by_edges(faces: &Faces, vertices: usize, edges: &Edges, of_half_edge: &[u32]) -> Result<Repeats> {
    // The last one across an edge.
    let mut beside = filled("faces", faces.len(), NONE)?;
    for edge in edges.iter() {
        let known = match *edge {
            [_] => false,
            [g, h] => {
                let [f, g] = [g, h].map(|h| of_half_edge[h as usize]);
                let known = f != g && (beside[f as usize] == g || beside[g as usize] == f);
                (beside[f as usize], beside[g as usize]) = (g, f);
                known
            }
            _ => true,
        };
        if known {
            return find(faces, vertices);
        }
    }
    let mut itself = beside;
    itself.iter_mut().zip(0..).for_each(|(f, k)| *f = k);
    Ok(Repeats { same_way: try_copy("faces", &itself)?, either_way: itself })
}

/// Finds them in near linear time.
pub(crate) fn find(faces: &Faces, vertices: usize) -> Result<Repeats> {
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
    let mut repeats = Repeats { either_way: try_with_capacity("faces", faces.len())?, same_way: Vec::new() };
    repeats.either_way.extend(0..faces.len() as u32);
    repeats.same_way = try_with_capacity("faces", faces.len())?;
    repeats.same_way.extend(0..faces.len() as u32);
    let forward = |f: u32| runs_forward(faces.face(f as usize));
    let compare = |f: &u32, g: &u32| compare_rings(faces.face(*f as usize), faces.face(*g as usize));
    let mut begin = 0;
    for &end in &bucket[..vertices] {
        let group = &mut order[begin..end as usize];
        if group.len() > 1 {
            group.sort_unstable_by(|f, g| compare(f, g).then(f.cmp(g)));
            for copies in group.chunk_by(|f, g| compare(f, g) == Ordering::Equal) {
                // The earliest that runs the other way than the very first: looking for it anew at each copy is
                // quadratic.
                let mut reverse = None;
                for &copy in &copies[1..] {
                    repeats.either_way[copy as usize] = copies[0];
                    repeats.same_way[copy as usize] = match forward(copy) == forward(copies[0]) {
                        true => copies[0],
                        false => *reverse.get_or_insert(copy),
                    };
                }
            }
        }
        begin = end as usize;
    }
    Ok(repeats)
}

/// Leaves out what repeats an earlier one by `first`; `Triangle::face` then counts in what is left.
pub(super) fn leave_out(faces: &Faces, triangles: &[Triangle], first: &[u32]) -> Result<(Faces, Vec<Triangle>)> {
    let mut kept = Faces::with_capacity(faces.len(), faces.corners.len())?;
    let mut kept_triangles = try_with_capacity("triangles", triangles.len())?;
    for f in (0..faces.len()).filter(|&f| first[f] as usize == f) {
        let face = kept.len() as u32;
        kept.push(faces.face(f), faces.input[f]);
        kept_triangles.extend(triangles[faces.triangles_of(f)].iter().map(|t| Triangle { face, ..*t }));
    }
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

/// The ring read from a corner and in a direction that depend on the ring alone.
fn canonical(ring: &[u32]) -> impl Iterator<Item = u32> {
    let (from, step) = least_reading(ring);
    (0..ring.len()).map(move |k| ring[(from + k * step) % ring.len()])
}

/// Which way a face runs through its ring.
pub(super) fn runs_forward(face: &[u32]) -> bool {
    least_reading(face).1 == 1
}

/// The corner and the step of the least reading of a ring.
fn least_reading(ring: &[u32]) -> (usize, usize) {
    let n = ring.len();
    let reading = move |from: usize, step: usize| (0..n).map(move |k| ring[(from + k * step) % n]);
    let lowest = ring.iter().min();
    let starts = (0..n).filter(move |&k| Some(&ring[k]) == lowest);
    starts
        .flat_map(|from| [(from, 1), (from, n - 1)])
        .min_by(|&(p, s), &(q, t)| reading(p, s).cmp(reading(q, t)))
        .unwrap_or((0, 1))
}
