// SPDX-License-Identifier: MIT OR Apache-2.0
//! Edges of more than two faces, and edges whose two faces disagree.

use super::{Diagnosis, Subject, push};
use crate::error::Result;

/// An edge that two faces run along the same way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InconsistentEdge {
    /// Its vertices, the lower first.
    pub vertices: [u32; 2],
    /// The two faces, the lower first.
    pub faces: [u32; 2],
}

impl Diagnosis {
    pub(super) fn list_edges(&mut self, subject: &Subject) -> Result<()> {
        for edge in subject.edges.iter() {
            let ends = subject.ends_as_read(edge[0]);
            let vertices = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            match *edge {
                [_] => {}
                [g, h] => {
                    if ends == subject.ends_as_read(h) {
                        let faces = [subject.input_face(g), subject.input_face(h)];
                        push(&mut self.inconsistent_edges, "edges", InconsistentEdge { vertices, faces })?;
                    }
                }
                _ => {
                    push(&mut self.nonmanifold_edges, "edges", vertices)?;
                    self.nonmanifold_edge_faces.push(edge.iter().map(|&h| subject.input_face(h)))?;
                }
            }
        }
        Ok(())
    }
}
