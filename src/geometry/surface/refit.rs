// SPDX-License-Identifier: MIT OR Apache-2.0
//! The same triangles over vertices that have moved: what hangs together stays shared, what lies where is made anew.

use super::{Closing, Kept, NO_VOLUME, PIECE, Sign, Surface};
use crate::bvh::{LEAF_SIZE, Leaves, Tree};
use crate::error::{Error, Result, Status, filled, try_with_capacity};
use crate::geometry::{Accelerator, RefitCheck};
use crate::math::{Aabb, Vec3};
use crate::mesh::{self, HalfEdges, LARGEST_COORDINATE, SMALLEST_DIAGONAL, Triangle};
use crate::parallel::Run;

impl Surface {
    /// The distance to the triangles over other vertices, three coordinates each. O(n), but for the check.
    pub(crate) fn refit(&self, xyz: &[f64], check: RefitCheck, run: &Run) -> Result<Surface> {
        let silent = &run.silent();
        let vertices = self.moved(xyz)?;
        let mut triangles = try_with_capacity("triangles", self.triangles.len())?;
        triangles.extend(self.triangles.vertex.iter().zip(0..).map(|(&vertices, t)| Triangle {
            vertices,
            face: self.triangles.origin(t).face,
            turned: self.triangles.is_turned(t),
        }));
        let topology = HalfEdges::of_neighbours(vertices.len(), &triangles, &self.topology)?;
        self.keeps_its_side(&vertices, &triangles, &topology, silent)?;
        let bounds = |t: u32| Aabb::of(triangles[t as usize].corners(&vertices));
        let (tree, order) = match &self.tree {
            Some(tree) => {
                let of_leaf = |k: usize| self.members(k).iter().map(|&t| bounds(t)).fold(Aabb::EMPTY, Aabb::hull);
                (tree.refit(self.leaf_count(), &of_leaf, silent)?, self.order()?)
            }
            None => Tree::build(triangles.len(), &|t| bounds(t as u32), LEAF_SIZE, silent)?,
        };
        let kept = Kept {
            triangles: self.triangles.clone(),
            topology: self.topology.clone(),
            asked: self.asked,
            ends: self.ends.clone(),
        };
        let mut surface = Surface::over(kept, vertices, (tree, &order), &topology, self.far_winding, silent)?;
        surface.why.nonmanifold = self.why.nonmanifold;
        match (surface.sign, check) {
            (Sign::Pseudonormal, RefitCheck::Check) => surface.check_embedding(&triangles, &topology, &order, run)?,
            (Sign::Pseudonormal, RefitCheck::Trust) => {
                surface.sign = self.sign;
                (surface.why.pairs, surface.why.more_pairs) = (self.why.pairs, self.why.more_pairs);
                surface.doubt(self.doubts.clone())?;
            }
            _ => {}
        }
        let accelerator = match (&self.tree, &self.compact) {
            (None, _) => Accelerator::None,
            (_, Some(_)) => Accelerator::Compact,
            _ => Accelerator::Auto,
        };
        let surface = surface.laid_out(accelerator, order)?;
        run.tell(1.0)?;
        Ok(surface)
    }

    /// Vertices to be moved.
    pub(crate) fn vertex_count(&self) -> usize {
        self.vertices.len() - self.ends.swept()
    }

    /// The vertices, checked as those of a mesh are, and those that close it.
    fn moved(&self, xyz: &[f64]) -> Result<Vec<Vec3>> {
        if xyz.len() != 3 * self.vertex_count() {
            return Err(Error::invalid(format!(
                "xyz: {} coordinates are not three for each of the {} vertices of the mesh",
                xyz.len(),
                self.vertex_count()
            )));
        }
        let mut vertices = try_with_capacity("vertices", self.vertices.len())?;
        // No -0.0.
        vertices.extend(xyz.chunks_exact(3).map(|p| Vec3::new(p[0] + 0.0, p[1] + 0.0, p[2] + 0.0)));
        let is_fit = |p: &Vec3| p.is_finite() && p.abs().max_element() <= LARGEST_COORDINATE;
        if let Some(v) = vertices.iter().position(|p| !is_fit(p)) {
            let Vec3 { x, y, z } = vertices[v];
            return Err(Error::invalid(format!(
                "xyz: vertex {v} lies at ({x:e}, {y:e}, {z:e}), not finite or beyond {LARGEST_COORDINATE:e}"
            )));
        }
        let diagonal = Aabb::of(vertices.iter().copied()).diagonal();
        if diagonal <= SMALLEST_DIAGONAL {
            return Err(Error::invalid(format!(
                "xyz: the box around the vertices has the diagonal {diagonal:e}, not above {SMALLEST_DIAGONAL:e}"
            )));
        }
        self.ends.add_to(&mut vertices)?;
        Ok(vertices)
    }

    /// Whether the inside is still where it was: no motion of a body turns it inside out, a reflection does.
    fn keeps_its_side(&self, vertices: &[Vec3], triangles: &[Triangle], topology: &HalfEdges, run: &Run) -> Result<()> {
        if !matches!(self.sign, Sign::Pseudonormal | Sign::Crossings) {
            return Ok(());
        }
        let bounds = Aabb::of(vertices.iter().copied());
        let mut volumes = filled("volumes", triangles.len().div_ceil(PIECE), 0.0)?;
        run.for_each_piece(&mut volumes, 1, &|piece, volume| {
            let members = &triangles[piece * PIECE..triangles.len().min((piece + 1) * PIECE)];
            volume[0] = mesh::volume(vertices, members, bounds.center());
            Ok(())
        })?;
        let caps = Closing::caps(topology, vertices)?.map_or(0.0, |caps| caps.volume(bounds.center()));
        let volume = volumes.iter().sum::<f64>() + caps;
        let diagonal = bounds.diagonal();
        let least = NO_VOLUME * diagonal * diagonal * diagonal;
        let was_negative = match &self.closing {
            None => self.is_inverted(),
            Some(caps) => {
                let apex = self.bounds.center();
                mesh::volume(&self.vertices, triangles, apex) + caps.volume(apex) < 0.0
            }
        };
        if volume.abs() > least && (volume < 0.0) != was_negative {
            return Err(Error::new(
                Status::Topology,
                format!(
                    "xyz: the vertices turn the surface inside out: the volume that its faces enclose is {volume:e}; make a geometry of a mesh anew, which finds the way that its faces run"
                ),
            ));
        }
        Ok(())
    }

    /// The triangles, leaf after leaf.
    fn order(&self) -> Result<Leaves> {
        let mut order = try_with_capacity("triangles", self.triangles.len())?;
        let mut start = try_with_capacity("leaves", self.leaf_count() + 1)?;
        start.push(0);
        for leaf in 0..self.leaf_count() {
            order.extend(self.members(leaf));
            start.push(order.len() as u32);
        }
        Ok(Leaves { order: order.into(), start: start.into() })
    }
}
