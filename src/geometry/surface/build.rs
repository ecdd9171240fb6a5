// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a mesh to a surface: which sign it can have, and the hierarchy.

use super::choose::{choose, has_small_holes};
use super::ends;
use super::normals::normals;
use super::{
    ALONE, Closing, Doubts, Kept, Leaf, NO_FACE, NO_TRIANGLE, NO_VOLUME, Origin, PIECE, Sides, Sign, Surface,
    Triangles, Why,
};
use crate::bvh::{LEAF_SIZE, Leaves, Tree};
use crate::error::{Error, Result, Status, filled, try_copy, try_with_capacity};
use crate::geometry::segment::NO_TAG;
use crate::geometry::{Accelerator, SdfOptions};
use crate::math::{Aabb, Vec3};
use crate::mesh::{self, HalfEdges, Mesh, Orient, Triangle};
use crate::parallel::Run;
use crate::primitive::estimate::Estimates;
use crate::simd::lanes::WIDTH;
use crate::store::Array;
use std::sync::Arc;

impl Surface {
    /// Builds the distance to a mesh. O(n log n), the check that it does not pass through itself included.
    pub(crate) fn new(mesh: &Mesh, options: &SdfOptions, run: &Run) -> Result<Surface> {
        let distinct = mesh.without_copies()?;
        let mesh = distinct.as_ref().unwrap_or(mesh);
        let (closed, ends) = ends::close(mesh, options)?.unzip();
        let mesh = closed.as_ref().unwrap_or(mesh);
        let of_triangles = HalfEdges::of_pieces(mesh)?;
        let topology = of_triangles.as_ref().unwrap_or(mesh.half_edges());
        if mesh.triangles().is_empty() {
            return Err(Error::new(Status::Topology, "mesh: no triangle has three different corners"));
        }
        let (vertices, pieces) = (mesh.vertices(), mesh.triangles());
        let sign = choose(mesh, vertices, pieces, topology, options)?;
        // Reading has turned what was closed, and left what is open as it was.
        let has_inside = !matches!(sign, Sign::Unsigned | Sign::Axis(_));
        let volume = if has_inside { volume(mesh, topology)? } else { 0.0 };
        let is_open = mesh.surface().unbalanced_edges > 0;
        let is_turned = has_inside && is_open && mesh.orient() == Orient::Auto && volume < 0.0;
        let turned = if is_turned { Some(turned(pieces)?) } else { None };
        let of_turned = turned.as_ref().map(|pieces| HalfEdges::of_triangles(vertices.len(), pieces)).transpose()?;
        let (pieces, topology) = (turned.as_deref().unwrap_or(pieces), of_turned.as_ref().unwrap_or(topology));
        let (triangles, neighbours) = shape(mesh, pieces, topology, run)?;
        let kept = Kept {
            triangles: Arc::new(triangles),
            topology: neighbours.into(),
            asked: (options.sign, sign),
            ends: ends.unwrap_or_default(),
        };
        let bounds = |t: usize| Aabb::of(pieces[t].corners(vertices));
        let silent = run.silent();
        let (tree, leaves) = Tree::build(pieces.len(), &bounds, LEAF_SIZE, &silent)?;
        // Around what is inside out is the body; of a sheet that is open as a whole neither side is it.
        let is_negative = has_inside && sign != Sign::Votes && !is_turned && volume < 0.0;
        let is_inverted = is_negative && (!is_open || has_small_holes(vertices, pieces, topology)?);
        let far_winding = i32::from(is_inverted);
        let vertices = try_copy("vertices", vertices)?;
        let mut surface = Surface::over(kept, vertices, (tree, &leaves), topology, far_winding, &silent)?;
        surface.why.nonmanifold = mesh.surface().nonmanifold_edges;
        if surface.sign == Sign::Pseudonormal {
            surface.check_embedding(pieces, topology, &leaves, run)?;
        }
        surface.laid_out(options.accelerator, leaves)
    }

    /// What remains to be done when the sign is known.
    pub(super) fn laid_out(mut self, accelerator: Accelerator, leaves: Leaves) -> Result<Surface> {
        if !matches!(self.sign, Sign::Votes | Sign::Axis(_)) {
            self.sides = Sides::new(&self)?;
        }
        match accelerator {
            Accelerator::Auto => {}
            Accelerator::None => (self.tree, self.leaves) = (None, Array::default()),
            Accelerator::Compact => {
                (self.compact, self.leaves) = (Some(leaves), Array::default());
                self.tree = self.tree.map(Tree::without_fit);
            }
        }
        Ok(self)
    }

    /// Lays everything out. The sign is that which the topology of the triangles allows; it is not checked yet.
    pub(super) fn over(
        kept: Kept,
        vertices: Vec<Vec3>,
        (mut tree, order): (Tree, &Leaves),
        topology: &HalfEdges,
        far_winding: i32,
        run: &Run,
    ) -> Result<Surface> {
        let triangles = &kept.triangles;
        let corners = |t: usize| {
            let [a, b, c] = triangles.vertex[t];
            [vertices[a as usize], vertices[b as usize], vertices[c as usize]]
        };
        let none = Leaf { estimates: Estimates::NONE, triangle: [NO_TRIANGLE; WIDTH] };
        let mut leaves = filled("leaves", order.start.len() - 1, none)?;
        run.for_each_piece(&mut leaves, PIECE / WIDTH, &|from, leaves| {
            for (k, leaf) in (from..).zip(leaves) {
                let members = order.start[k] as usize..order.start[k + 1] as usize;
                for (lane, &t) in order.order[members].iter().enumerate() {
                    leaf.estimates.set(lane, corners(t as usize).map(|c| tree.place(c)));
                    leaf.triangle[lane] = t;
                }
            }
            Ok(())
        })?;
        tree.fit(order, &|t| corners(t as usize), run)?;
        let (normals, vertex_normals) = normals(triangles.len(), &corners, topology, vertices.len(), run)?;
        let mut boxes = filled("boxes", triangles.len().div_ceil(PIECE), Aabb::EMPTY)?;
        run.for_each_piece(&mut boxes, 1, &|piece, hull| {
            let members = piece * PIECE..triangles.len().min((piece + 1) * PIECE);
            hull[0] = members.map(|t| Aabb::of(corners(t))).fold(Aabb::EMPTY, Aabb::hull);
            Ok(())
        })?;
        let bounds = boxes.into_iter().fold(Aabb::EMPTY, Aabb::hull);
        let sign = kept.asked.1;
        let mut surface = Surface {
            leaves: leaves.into(),
            compact: None,
            tree: Some(tree),
            vertices: vertices.into(),
            triangles: kept.triangles,
            normals: normals.into(),
            neighbours: kept.topology.clone(),
            topology: kept.topology,
            vertex_normals: vertex_normals.into(),
            bounds,
            diagonal: bounds.diagonal(),
            sign,
            asked: kept.asked,
            doubts: Doubts::default(),
            sides: Sides::default(),
            closing: None,
            why: Why::default(),
            ends: kept.ends,
            far_winding,
        };
        surface.closing = match sign {
            Sign::Unsigned => None,
            Sign::Pseudonormal | Sign::Crossings => Closing::caps(topology, &surface.vertices)?,
            Sign::Votes | Sign::Axis(_) => Closing::rim(topology, &surface.vertices)?,
        };
        if let Some(closing) = &surface.closing {
            (surface.why.loops, surface.why.edges) = (closing.loops(), closing.len());
        }
        if sign == Sign::Pseudonormal {
            surface.distrust_unclear_normals(topology, run)?;
        }
        Ok(surface)
    }
}

/// The volume that a mesh encloses, together with caps over its holes; 0 of a sheet, where it is rounding.
fn volume(mesh: &Mesh, topology: &HalfEdges) -> Result<f64> {
    let Some(caps) = Closing::caps(topology, mesh.vertices())? else { return Ok(mesh.surface().volume) };
    let (bounds, diagonal) = (mesh.bounds(), mesh.bounds().diagonal());
    let volume = mesh::volume(mesh.vertices(), mesh.triangles(), bounds.center()) + caps.volume(bounds.center());
    Ok(if volume.abs() > NO_VOLUME * diagonal * diagonal * diagonal { volume } else { 0.0 })
}

/// Triangles that run the other way.
fn turned(triangles: &[Triangle]) -> Result<Vec<Triangle>> {
    let mut all = try_copy("triangles", triangles)?;
    for t in &mut all {
        t.vertices.swap(1, 2);
        t.turned = !t.turned;
    }
    Ok(all)
}

/// Triangles, of the faces of a mesh or of none, and their neighbours. `topology` is that of the triangles.
fn shape(mesh: &Mesh, triangles: &[Triangle], topology: &HalfEdges, run: &Run) -> Result<(Triangles, Vec<[u32; 3]>)> {
    let run = &run.silent();
    let mut neighbours = filled("neighbours", triangles.len(), [ALONE; 3])?;
    let neighbour = |h: u32| topology.twin(h).map_or(ALONE, |twin| topology.face(twin));
    run.for_each_piece(&mut neighbours, PIECE, &|from, piece| {
        let of = |t: u32| [3 * t, 3 * t + 1, 3 * t + 2].map(neighbour);
        piece.iter_mut().zip(from as u32..).for_each(|(neighbours, t)| *neighbours = of(t));
        Ok(())
    })?;
    let mut vertex = try_with_capacity("triangles", triangles.len())?;
    vertex.extend(triangles.iter().map(|t| t.vertices));
    let mut origin = Vec::new();
    // Nothing is kept where there is nothing to keep.
    if triangles.iter().zip(0..).any(|(t, k)| t.face != k || t.turned || mesh.tag(t.face) != 0) {
        origin = try_with_capacity("triangles", triangles.len())?;
        let mut first = 0;
        origin.extend(triangles.iter().enumerate().map(|(k, t)| {
            if triangles[first].face != t.face {
                first = k;
            }
            let tag = if t.face == NO_FACE { NO_TAG } else { mesh.tag(t.face) };
            Origin { face: t.face, tag, piece: 2 * (k - first) as u32 + u32::from(t.turned) }
        }));
    }
    Ok((Triangles { vertex: vertex.into(), origin: origin.into() }, neighbours))
}
