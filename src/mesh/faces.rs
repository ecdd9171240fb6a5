// SPDX-License-Identifier: MIT OR Apache-2.0
//! Polygons as flat index arrays, and vectors whose size comes from input.

use crate::error::{Error, Result, try_copy, try_with_capacity};

/// Polygons: face f has the corners `corners[start[f]..start[f + 1]]`. Its half-edges have the same numbers
/// as its corners: each runs from its corner to the next one of the face.
#[derive(Clone, Debug, Default)]
pub(crate) struct Faces {
    pub start: Vec<u32>,
    pub corners: Vec<u32>,
    /// The input face that each comes from, ascending.
    pub input: Vec<u32>,
}

impl Faces {
    /// None yet, with room for some.
    pub fn with_capacity(faces: usize, corners: usize) -> Result<Faces> {
        let mut start = try_with_capacity("faces", faces + 1)?;
        start.push(0);
        Ok(Faces { start, corners: try_with_capacity("corners", corners)?, input: try_with_capacity("faces", faces)? })
    }

    /// A copy.
    pub fn try_clone(&self) -> Result<Faces> {
        Ok(Faces {
            start: try_copy("faces", &self.start)?,
            corners: try_copy("corners", &self.corners)?,
            input: try_copy("faces", &self.input)?,
        })
    }

    /// Room for more.
    pub fn reserve(&mut self, faces: usize, corners: usize) -> Result<()> {
        let numbers = self.start.try_reserve(faces).and_then(|()| self.input.try_reserve(faces));
        numbers.map_err(|_| Error::memory("faces", self.len() + faces))?;
        self.corners.try_reserve(corners).map_err(|_| Error::memory("corners", self.corners.len() + corners))
    }

    /// Adds a face.
    pub fn push(&mut self, corners: &[u32], input: u32) {
        self.corners.extend_from_slice(corners);
        self.start.push(self.corners.len() as u32);
        self.input.push(input);
    }

    /// The same where no room was reserved, and where the count of corners may go beyond their numbers.
    pub fn try_push(&mut self, corners: &[u32], input: u32) -> Result<()> {
        let count = self.corners.len() + corners.len();
        if count >= u32::MAX as usize {
            return Err(Error::unsupported(format!("faces: {count} corners are more than {}", u32::MAX - 1)));
        }
        let reserved = self.corners.try_reserve(corners.len()).and_then(|()| self.start.try_reserve(1));
        reserved.and_then(|()| self.input.try_reserve(1)).map_err(|_| Error::memory("corners", count))?;
        self.push(corners, input);
        Ok(())
    }

    /// The same from an iterator.
    pub fn push_all(&mut self, corners: impl Iterator<Item = u32>, input: u32) {
        self.corners.extend(corners);
        self.start.push(self.corners.len() as u32);
        self.input.push(input);
    }

    /// The triangles that a face is cut into, where all triangles are in the order of the faces.
    pub fn triangles_of(&self, f: usize) -> std::ops::Range<usize> {
        self.start[f] as usize - 2 * f..self.start[f + 1] as usize - 2 * (f + 1)
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.input.len()
    }

    /// The corners of one.
    pub fn face(&self, f: usize) -> &[u32] {
        &self.corners[self.start[f] as usize..self.start[f + 1] as usize]
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> + Clone {
        self.start.windows(2).map(|w| &self.corners[w[0] as usize..w[1] as usize])
    }

    /// Both ends of each half-edge, in order.
    pub fn half_edges(&self) -> impl Iterator<Item = (u32, u32)> + Clone {
        self.iter().flat_map(|face| {
            let n = face.len();
            (0..n).map(move |k| (face[k], face[if k + 1 == n { 0 } else { k + 1 }]))
        })
    }

    /// The face of each half-edge.
    pub fn of_half_edges(&self) -> Result<Vec<u32>> {
        let mut of = try_with_capacity("half-edges", self.corners.len())?;
        for (f, corners) in self.iter().enumerate() {
            of.resize(of.len() + corners.len(), f as u32);
        }
        Ok(of)
    }
}

/// Turns counts into starts: afterwards `v[k]` is the sum of what came before, and the last the total.
pub(crate) fn starts_from_counts(v: &mut [u32]) {
    let mut total = 0;
    for slot in v {
        let count = *slot;
        *slot = total;
        total += count;
    }
}

/// Disjoint sets whose representative is their lowest member (Tarjan 1975, with path halving).
pub(crate) struct Sets {
    parent: Vec<u32>,
}

impl Sets {
    /// `count` sets of one member.
    pub fn new(count: usize) -> Result<Sets> {
        let mut parent = try_with_capacity("set members", count)?;
        parent.extend(0..count as u32);
        Ok(Sets { parent })
    }

    /// The representative.
    pub fn find(&mut self, mut a: u32) -> u32 {
        while self.parent[a as usize] != a {
            let up = self.parent[self.parent[a as usize] as usize];
            self.parent[a as usize] = up;
            a = up;
        }
        a
    }

    /// Makes two sets one.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}
