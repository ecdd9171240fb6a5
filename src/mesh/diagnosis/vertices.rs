// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices at which a surface falls apart: the corners of faces at a vertex, linked where an edge of exactly
//! two faces leads from one to the next, must form one open fan or one closed disc.

use super::{Diagnosis, Subject, push};
use crate::error::{Result, filled};
use crate::mesh::edges::NONE;

/// A vertex of several fans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NonmanifoldVertex {
    /// The vertex.
    pub vertex: u32,
    /// The fans and discs that the faces at it form; an edge of more than two faces parts them.
    pub fans: u32,
}

impl Diagnosis {
    pub(super) fn list_vertices(&mut self, subject: &Subject) -> Result<()> {
        let topology = &subject.mesh.half_edges;
        let mut fans =
            Fans { subject, mates: subject.edges.mates()?, seen: filled("half-edges", topology.count(), false)? };
        for vertex in 0..subject.vertices.len() as u32 {
            let mut count = 0;
            for &corner in topology.outgoing(vertex) {
                count += u32::from(fans.follow(corner));
            }
            if count > 1 {
                push(&mut self.nonmanifold_vertices, "vertices", NonmanifoldVertex { vertex, fans: count })?;
            }
        }
        Ok(())
    }
}

/// Corners are known by the half-edge that leaves them.
struct Fans<'a> {
    subject: &'a Subject<'a>,
    mates: Vec<u32>,
    seen: Vec<bool>,
}

impl Fans<'_> {
    /// Marks the fan of a corner; false where it was seen before.
    fn follow(&mut self, corner: u32) -> bool {
        if self.seen[corner as usize] {
            return false;
        }
        self.seen[corner as usize] = true;
        self.spread(corner, true);
        self.spread(corner, false);
        true
    }

    /// Goes from corner to corner, first over the half-edge that leaves or the one that enters.
    fn spread(&mut self, mut corner: u32, mut over_leaving: bool) {
        let topology = &self.subject.mesh.half_edges;
        let vertex = topology.origin(corner);
        loop {
            let crossed = if over_leaving { corner } else { topology.previous(corner) };
            let mate = self.mates[crossed as usize];
            if mate == NONE {
                return;
            }
            // The next corner is entered over its leaving half-edge and left over the other, or the reverse.
            let leaves = topology.origin(mate) == vertex;
            corner = if leaves { mate } else { topology.next(mate) };
            over_leaving = !leaves;
            if std::mem::replace(&mut self.seen[corner as usize], true) {
                return;
            }
        }
    }
}
