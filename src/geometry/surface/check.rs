// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where pseudonormals may decide the sign. They are right (Baerentzen & Aanaes 2005) where the surface
//! is embedded: where triangles meet in shared edges and vertices only, and each connected region has the
//! outside on its outer and the inside on its inner side. Both are checked exactly when the geometry is
//! built; near the triangles that fail, crossings decide. That is stronger than comparing each vertex and edge pseudonormal with a crossing count, which
//! misses an edge that pokes through a face between two vertices, and needs fewer crossing counts: one a
//! region.

use super::{Doubts, Sign, Surface, UNCLEAR};
use crate::bvh::Leaves;
use crate::error::{Error, Result, Status, filled};
use crate::geometry::SignMethod;
use crate::geometry::contacts::Contacts;
use crate::math::{Aabb, Vec3};
use crate::mesh::{HalfEdges, Sets, Triangle};
use crate::parallel::Run;
use crate::primitive::contact::triangles_touch;
use crate::primitive::polygon::are_collinear;

/// Where more pairs meet than this and one in so many triangles, crossings decide everywhere.
const LEAST_MOST: usize = 64;
const SHARE: usize = 32;

impl Surface {
    /// Hands the sign to the crossings where the surface is not embedded: near triangles that meet others, and near
    /// regions between those that do not have the outside on one and the inside on the other side. `topology` is that
    /// of the triangles.
    pub(super) fn check_embedding(
        &mut self,
        triangles: &[Triangle],
        topology: &HalfEdges,
        leaves: &Leaves,
        run: &Run,
    ) -> Result<()> {
        let asked = self.asked.0;
        let most = if asked == SignMethod::Pseudonormal { 0 } else { LEAST_MOST + self.triangles.len() / SHARE };
        let pairs = self.contacts(triangles, topology, leaves, most + 1, run)?;
        if asked == SignMethod::Pseudonormal {
            let fault = match pairs.first() {
                Some(&[t, s]) => format!(
                    "faces {} and {} meet, but for rounding, where they share no edge or vertex",
                    self.face(t),
                    self.face(s)
                ),
                None => match self.misplaced_regions(&Doubts::default())?.first() {
                    Some(&t) => format!("the piece of face {} lies inside another, or is inside out", self.face(t)),
                    None => return Ok(()),
                },
            };
            let message = format!("options.sign: PSEUDONORMAL is not right on this mesh: {fault}; use AUTO or RAY");
            return Err(Error::new(Status::Topology, message));
        }
        (self.why.pairs, self.why.more_pairs) = (pairs.len(), pairs.len() > most);
        if pairs.len() > most {
            self.sign = Sign::Crossings;
            return Ok(());
        }
        let count = self.triangles.len();
        let mut doubts = Doubts::default();
        pairs.iter().flatten().try_for_each(|&t| doubts.add(t, count))?;
        self.at_caps(|t| doubts.add(t, count))?;
        self.misplaced_regions(&doubts)?.into_iter().try_for_each(|t| doubts.add(t, count))?;
        self.doubt(doubts)
    }

    /// Leaves what is nearest to doubtful triangles to the crossings.
    pub(super) fn doubt(&mut self, doubts: Doubts) -> Result<()> {
        if doubts.bits.is_empty() {
            return Ok(());
        }
        let all = 0..self.triangles.len() as u32;
        if all.clone().all(|t| doubts.has(t)) {
            self.sign = Sign::Crossings;
            return Ok(());
        }
        let neighbours = self.own_neighbours()?;
        for t in all.clone().filter(|&t| doubts.has(t)) {
            for k in 0..3 {
                let neighbour = std::mem::replace(&mut neighbours[t as usize][k], UNCLEAR);
                if neighbour < UNCLEAR {
                    let back = neighbours[neighbour as usize].iter_mut().filter(|n| **n == t);
                    back.for_each(|n| *n = UNCLEAR);
                }
            }
        }
        let vertex_normals = self.vertex_normals.edit("normals")?;
        for t in all.filter(|&t| doubts.has(t)) {
            for v in self.triangles.vertex[t as usize] {
                vertex_normals[v as usize] = Vec3::ZERO;
            }
        }
        self.doubts = doubts;
        Ok(())
    }

    /// Pairs of triangles that meet where they should not, up to so many: of all such pairs the same ones in every run.
    fn contacts(
        &self,
        triangles: &[Triangle],
        topology: &HalfEdges,
        leaves: &Leaves,
        limit: usize,
        run: &Run,
    ) -> Result<Vec<[u32; 2]>> {
        let Some(tree) = &self.tree else { return Ok(Vec::new()) };
        let contacts = Contacts::new(&self.vertices, triangles, topology, self.rounding(), false, run)?;
        Ok(contacts.find(tree, leaves, limit, run)?.pairs)
    }

    /// The triangles that caps of holes touch: beyond a cap the winding number with the caps is another, and so a region
    /// ends there.
    fn at_caps(&self, mut visit: impl FnMut(u32) -> Result<()>) -> Result<()> {
        let Some(caps) = &self.closing else { return Ok(()) };
        for cap in (0..caps.len() as u32).map(|cap| caps.corners(cap)) {
            let mut done = Ok(());
            let [a, b, c] = cap;
            let is_flat = are_collinear(a, b, c);
            self.overlapping(Aabb::of(cap), |t| {
                if done.is_ok() && (is_flat || triangles_touch(self.corners(t), cap)) {
                    done = visit(t);
                }
            });
            done?;
        }
        Ok(())
    }

    /// Walls thinner than this have one side to a point beside them: either of their faces may be the nearest.
    fn rounding(&self) -> f64 {
        16.0 * f64::EPSILON * self.diagonal
    }

    /// The triangles of regions whose two sides are not outside and inside. A region is what hangs together by edges
    /// between triangles that are not doubtful: as no others meet it, its sides are the same everywhere.
    fn misplaced_regions(&self, doubts: &Doubts) -> Result<Vec<u32>> {
        let all = 0..self.triangles.len() as u32;
        let mut regions = Sets::new(self.triangles.len())?;
        for t in all.clone().filter(|&t| !doubts.has(t)) {
            for &s in &self.neighbours[t as usize] {
                if s < t && !doubts.has(s) {
                    regions.join(s, t);
                }
            }
        }
        // What a triangle with a normal says of its region.
        let mut is_right = filled("regions", self.triangles.len(), None)?;
        for t in all.clone().filter(|&t| !doubts.has(t)) {
            let (normal, region) = (self.normal(t), regions.find(t) as usize);
            if is_right[region].is_none() && normal != Vec3::ZERO {
                is_right[region] = Some(self.sides_are_right(t, normal));
            }
        }
        let mut misplaced = Vec::new();
        if !is_right.contains(&Some(false)) {
            return Ok(misplaced);
        }
        for t in all.filter(|&t| !doubts.has(t)) {
            if is_right[regions.find(t) as usize] == Some(false) {
                misplaced.try_reserve(1).map_err(|_| Error::memory("triangles", misplaced.len() + 1))?;
                misplaced.push(t);
            }
        }
        Ok(misplaced)
    }

    fn sides_are_right(&self, t: u32, normal: Vec3) -> bool {
        let [a, b, c] = self.corners(t);
        let middle = a / 3.0 + b / 3.0 + c / 3.0;
        let size = (b - a).length().max((c - b).length()).max((a - c).length());
        // Large beside the rounding of the coordinates, and small beside any wall that has two sides.
        let step = 64.0 * f64::EPSILON * size.max(middle.abs().max_element());
        (self.winding(middle + normal * step), self.winding(middle - normal * step)) == (0, 1)
    }
}
