// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a mesh is like as read: after welding, before any repair.

use super::edges::{Edges, excess};
use super::faces::{Faces, Sets};
use super::measure::{Flux, Sum, corners, twice_area};
use super::{Report, Surface, Triangle};
use crate::error::{Result, filled};
use crate::math::{Vec3, length};
use crate::primitive::polygon;

impl Report {
    /// Counts edges and components, after [`Report::measure`]. Faces that welding collapsed have left `faces` already.
    pub(super) fn count(&mut self, faces: &Faces, edges: &Edges, of_half_edge: &[u32], flux: Flux) -> Result<()> {
        let mut sets = Sets::new(faces.len())?;
        let mut balanced = true;
        for edge in edges.iter() {
            let excess = excess(&faces.corners, edge);
            balanced &= excess == 0;
            match edge.len() {
                1 => self.boundary_edges += 1,
                2 => self.inconsistent_edges += usize::from(excess != 0),
                _ => self.nonmanifold_edges += 1,
            }
            for &h in &edge[1..] {
                sets.join(of_half_edge[edge[0] as usize], of_half_edge[h as usize]);
            }
        }
        self.components = (0..faces.len() as u32).filter(|&f| sets.find(f) == f).count();
        self.closed = self.boundary_edges == 0;
        self.consistent = self.inconsistent_edges == 0;
        self.volume = if balanced { flux.closed() } else { flux.open() };
        self.inside_out = balanced && self.volume < 0.0;
        Ok(())
    }

    /// One component, without copies, of which no edge has more than two faces and all faces agree.
    pub(super) fn is_one_consistent_sheet(&self) -> bool {
        self.components == 1 && self.duplicate_faces + self.nonmanifold_edges + self.inconsistent_edges == 0
    }

    /// Area, and the faces of zero area; the flux for [`Report::count`].
    pub(super) fn measure(
        &mut self,
        vertices: &[Vec3],
        faces: &Faces,
        triangles: &[Triangle],
        center: Vec3,
    ) -> Result<Flux> {
        let mut flat = filled("faces", faces.len(), true)?;
        let (mut total, mut flux) = (Sum::default(), Flux::new(center.x));
        for t in triangles {
            let [a, b, c] = corners(vertices, t);
            let twice = twice_area([a, b, c]);
            total.add(0.5 * length(twice));
            flux.add([a, b, c], twice);
            let flat = &mut flat[t.face as usize];
            *flat = *flat && polygon::are_collinear(a, b, c);
        }
        self.area = total.value();
        self.degenerate_faces += flat.iter().filter(|f| **f).count();
        Ok(flux)
    }
}

impl Surface {
    /// Counts the edges of the surface as it stands.
    pub(super) fn of(faces: &Faces, edges: &Edges, volume: f64) -> Surface {
        let mut surface = Surface { volume, ..Surface::default() };
        for edge in edges.iter() {
            surface.boundary_edges += usize::from(edge.len() == 1);
            surface.nonmanifold_edges += usize::from(edge.len() > 2);
            surface.unbalanced_edges += usize::from(excess(&faces.corners, edge) != 0);
        }
        surface
    }
}
