// SPDX-License-Identifier: MIT OR Apache-2.0
//! The pieces of a mesh that edges hold together, each measured as read.

use super::{Diagnosis, NO_COMPONENT, Subject};
use crate::error::{Result, filled, try_with_capacity};
use crate::math::{Aabb, Vec3, length};
use crate::mesh::faces::Sets;
use crate::mesh::measure::{Flux, Sum, twice_area};

/// A set of faces connected over edges, whatever number of faces these have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Component {
    /// Its lowest face.
    pub lowest_face: u32,
    /// Its faces; copies count.
    pub faces: usize,
    /// The triangles they are cut into.
    pub triangles: usize,
    /// Edges of one face.
    pub boundary_edges: usize,
    /// Edges of more than two faces.
    pub nonmanifold_edges: usize,
    /// Edges that two faces run along the same way.
    pub inconsistent_edges: usize,
    /// Of negative volume, and every edge is crossed as often one way as the other.
    pub inside_out: bool,
    /// Flux of the field (x, 0, 0): of a closed and consistent component its signed volume.
    pub volume: f64,
    /// Area of its faces.
    pub area: f64,
    /// Lower corner of the box around it.
    pub lo: [f64; 3],
    /// Upper corner.
    pub hi: [f64; 3],
    /// Faces that orientation has turned over since.
    pub turned_faces: usize,
}

impl Component {
    /// No edge has exactly one face.
    pub fn is_closed(&self) -> bool {
        self.boundary_edges == 0
    }

    /// No two faces run along their common edge the same way.
    pub fn is_consistent(&self) -> bool {
        self.inconsistent_edges == 0
    }
}

impl Diagnosis {
    pub(super) fn list_components(&mut self, subject: &Subject) -> Result<()> {
        let of_face = self.number_components(subject)?;
        let count = self.components.len();
        let mut unbalanced = filled("components", count, false)?;
        for edge in subject.edges.iter() {
            let component = of_face[subject.of_half_edge[edge[0] as usize] as usize] as usize;
            let c = &mut self.components[component];
            let first = subject.ends_as_read(edge[0]);
            let along = edge.iter().filter(|&&h| subject.ends_as_read(h) == first).count();
            unbalanced[component] |= 2 * along != edge.len();
            match edge.len() {
                1 => c.boundary_edges += 1,
                2 => c.inconsistent_edges += usize::from(along == 2),
                _ => c.nonmanifold_edges += 1,
            }
        }
        self.measure_components(subject, &of_face, &unbalanced)?;
        self.component_of_face = filled("faces", subject.mesh.face_count, NO_COMPONENT)?;
        for (f, &component) in of_face.iter().enumerate() {
            self.component_of_face[subject.faces.input[f] as usize] = component;
        }
        Ok(())
    }

    /// Counts the faces of each component; the component of each face that is left.
    fn number_components(&mut self, subject: &Subject) -> Result<Vec<u32>> {
        let mut sets = Sets::new(subject.faces.len())?;
        for edge in subject.edges.iter() {
            for &h in &edge[1..] {
                sets.join(subject.of_half_edge[edge[0] as usize], subject.of_half_edge[h as usize]);
            }
        }
        let mut of_face = filled("faces", subject.faces.len(), NO_COMPONENT)?;
        for f in 0..subject.faces.len() {
            let lowest = sets.find(f as u32) as usize;
            if lowest == f {
                of_face[f] = self.components.len() as u32;
                let component = Component { lowest_face: subject.faces.input[f], ..Component::default() };
                super::push(&mut self.components, "components", component)?;
            }
            of_face[f] = of_face[lowest];
            let component = &mut self.components[of_face[f] as usize];
            component.faces += 1;
            component.triangles += subject.faces.triangles_of(f).len();
            component.turned_faces += usize::from(subject.turned[f]);
        }
        Ok(of_face)
    }

    fn measure_components(&mut self, subject: &Subject, of_face: &[u32], unbalanced: &[bool]) -> Result<()> {
        let mut bounds = filled("components", self.components.len(), Aabb::EMPTY)?;
        let pieces = || (0..subject.faces.len()).flat_map(|f| subject.faces.triangles_of(f).map(move |t| (f, t)));
        for (f, t) in pieces() {
            let b = &mut bounds[of_face[f] as usize];
            *b = b.hull(Aabb::of(subject.mesh.triangles[t].corners(subject.vertices)));
        }
        let mut sums: Vec<(Sum, Flux)> = try_with_capacity("components", self.components.len())?;
        sums.extend(bounds.iter().map(|b| (Sum::default(), Flux::new(b.center().x))));
        for (f, t) in pieces() {
            let corners = subject.corners_as_read(&subject.mesh.triangles[t]);
            let twice: Vec3 = twice_area(corners);
            let (area, flux) = &mut sums[of_face[f] as usize];
            area.add(0.5 * length(twice));
            flux.add(corners, twice);
        }
        for (k, component) in self.components.iter_mut().enumerate() {
            let (area, flux) = &sums[k];
            component.area = area.value();
            component.volume = if unbalanced[k] { flux.open() } else { flux.closed() };
            component.inside_out = !unbalanced[k] && component.volume < 0.0;
            (component.lo, component.hi) = (bounds[k].lo.to_array(), bounds[k].hi.to_array());
        }
        Ok(())
    }
}
