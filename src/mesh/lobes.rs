// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces parted into loops where they come to a vertex again.

use crate::error::{Result, filled, try_with_capacity};

/// No place.
const NONE: u32 = u32::MAX;

/// The loops of a face, as indices of its corners. The triangles that cut them, with the fillers, are as many as those
/// that cut the face, and keep its boundary.
pub(super) struct Lobes {
    /// The corners, loop by loop.
    corners: Vec<u32>,
    /// Where each loop ends in `corners`.
    ends: Vec<usize>,
    /// Two for each loop that was cut off: each has the vertex that it was cut off at twice.
    pub fillers: Vec<[u32; 3]>,
}

impl Lobes {
    /// Of a face whose neighbouring corners differ. No loop has a vertex twice; one may have two corners only. n log n.
    pub(super) fn of(face: &[u32]) -> Result<Lobes> {
        let n = face.len();
        let numbers = numbers(face)?;
        let mut place = filled("corners", n, NONE)?;
        let mut open: Vec<u32> = try_with_capacity("corners", n)?;
        let mut corners = try_with_capacity("corners", n)?;
        let mut ends = try_with_capacity("corners", n)?;
        let mut fillers = try_with_capacity("triangles", 2 * n)?;
        for (k, &number) in numbers.iter().enumerate() {
            let first = place[number as usize];
            if first == NONE {
                place[number as usize] = open.len() as u32;
                open.push(k as u32);
                continue;
            }
            let cut_off = &open[first as usize..];
            for &c in &cut_off[1..] {
                place[numbers[c as usize] as usize] = NONE;
            }
            corners.extend_from_slice(cut_off);
            ends.push(corners.len());
            let (k, next) = (k as u32, ((k + 1) % n) as u32);
            fillers.extend([[cut_off[0], cut_off[cut_off.len() - 1], k], [cut_off[0], k, next]]);
            open.truncate(first as usize + 1);
        }
        corners.extend_from_slice(&open);
        ends.push(corners.len());
        Ok(Lobes { corners, ends, fillers })
    }

    /// The loops.
    pub(super) fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        let start = |k: usize| if k == 0 { 0 } else { self.ends[k - 1] };
        (0..self.ends.len()).map(move |k| &self.corners[start(k)..self.ends[k]])
    }
}

/// For each corner a number below their count, the same where the vertex is.
fn numbers(face: &[u32]) -> Result<Vec<u32>> {
    let mut order: Vec<u32> = try_with_capacity("corners", face.len())?;
    order.extend(0..face.len() as u32);
    order.sort_unstable_by_key(|&k| (face[k as usize], k));
    let mut numbers = filled("corners", face.len(), 0)?;
    for w in order.windows(2) {
        let more = u32::from(face[w[0] as usize] != face[w[1] as usize]);
        numbers[w[1] as usize] = numbers[w[0] as usize] + more;
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_are_cut_off_where_a_vertex_comes_again() {
        let loops = |face: &[u32]| {
            let lobes = Lobes::of(face).unwrap();
            let of_vertices = |lobe: &[u32]| lobe.iter().map(|&k| face[k as usize]).collect::<Vec<_>>();
            // Sides that run both ways cancel: what is left are the sides of the face.
            let around = |l: &[u32]| (0..l.len()).map(|k| (l[k], l[(k + 1) % l.len()])).collect::<Vec<_>>();
            let mut sides: Vec<_> = lobes.iter().filter(|l| l.len() > 2).flat_map(around).collect();
            sides.extend(lobes.fillers.iter().flat_map(|t| around(t)));
            let mut left: Vec<_> = sides.iter().copied().filter(|(a, b)| !sides.contains(&(*b, *a))).collect();
            left.sort_unstable();
            assert_eq!(left, around(&(0..face.len() as u32).collect::<Vec<_>>()), "{face:?}");
            let triangles: usize = lobes.iter().map(|l| l.len() - 2).sum();
            assert_eq!(triangles + lobes.fillers.len(), face.len() - 2);
            lobes.iter().map(of_vertices).collect::<Vec<_>>()
        };
        assert_eq!(loops(&[5, 7, 9]), [[5, 7, 9]]);
        assert_eq!(loops(&[0, 1, 2, 0, 3, 4]), [[0, 1, 2], [0, 3, 4]]);
        assert_eq!(loops(&[6, 0, 1, 2, 0, 3, 4]), [vec![0, 1, 2], vec![6, 0, 3, 4]]);
        assert_eq!(loops(&[0, 1, 2, 3, 1, 4, 0, 5, 6]), [vec![1, 2, 3], vec![0, 1, 4], vec![0, 5, 6]]);
        assert_eq!(loops(&[0, 1, 2, 3, 1, 0, 8, 9]), [vec![1, 2, 3], vec![0, 1], vec![0, 8, 9]]);
    }
}
