// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a mesh to a surface: which sign it can have, and the hierarchy.

use super::{ALONE, Corners, Doubts, Leaf, NO_TRIANGLE, Sides, Sign, Surface};
use crate::bvh::{LEAF_SIZE, Tree};
use crate::error::{Error, Result, Status, try_copy, try_with_capacity};
use crate::geometry::{Accelerator, Open, SdfOptions, SignMethod};
use crate::math::{Aabb, Vec3};
use crate::mesh::{HalfEdges, Mesh, filled};
use crate::parallel::Run;
use crate::primitive::estimate::Estimates;
use crate::primitive::triangle;
use crate::simd::lanes::WIDTH;

/// Leaves or triangles that a thread does in one go.
const PIECE: usize = 2048;

impl Surface {
    /// Builds the distance to a mesh. O(n log n), the check that it does not pass through itself included.
    pub(crate) fn new(mesh: &Mesh, options: &SdfOptions, run: &Run) -> Result<Surface> {
        let sign = choose_sign(mesh, options)?;
        let distinct = mesh.without_copies()?;
        let mesh = distinct.as_ref().unwrap_or(mesh);
        let of_triangles = HalfEdges::of_pieces(mesh)?;
        let topology = of_triangles.as_ref().unwrap_or(mesh.half_edges());
        let mut surface = assemble(mesh, topology, sign, run)?;
        if surface.sign == Sign::Pseudonormal {
            surface.distrust_unclear_normals(mesh);
            surface.check_embedding(mesh, topology, options.sign, run)?;
        }
        surface.sides = Sides::new(&surface)?;
        if options.accelerator == Accelerator::None {
            (surface.tree, surface.leaves) = (None, Vec::new());
        }
        Ok(surface)
    }
}

/// The sign the options ask for and the mesh can have.
fn choose_sign(mesh: &Mesh, options: &SdfOptions) -> Result<Sign> {
    if options.accelerator == Accelerator::Compact {
        return Err(Error::unsupported("options.accelerator: COMPACT (2) is not available in this version"));
    }
    if options.open != Open::Error {
        return Err(Error::unsupported(format!(
            "options.open: {} (CAP 1, SWEEP 2) is not available in this version",
            options.open as i32
        )));
    }
    let surface = mesh.surface();
    match options.sign {
        SignMethod::None => return Ok(Sign::Unsigned),
        SignMethod::Winding | SignMethod::Axis => {
            return Err(Error::unsupported(format!(
                "options.sign: {} (WINDING 2, AXIS 4) is not available in this version",
                options.sign as i32
            )));
        }
        _ => {}
    }
    if surface.unbalanced_edges > 0 {
        let report = mesh.report();
        return Err(Error::new(
            Status::Topology,
            format!(
                "mesh: it has no inside: {} boundary edges, {} non-manifold edges and {} inconsistent edges as read, {} edges after orientation that do not have as many faces one way as the other; repair it (emb_mesh_repair; emb_mesh_diagnose tells what is needed, such as the hole_length of each rim), or take sign EMB_SIGN_NONE (5) for the unsigned distance",
                report.boundary_edges, report.nonmanifold_edges, report.inconsistent_edges, surface.unbalanced_edges
            ),
        ));
    }
    let manifold = surface.nonmanifold_edges == 0;
    match options.sign {
        SignMethod::Pseudonormal if !manifold => Err(Error::new(
            Status::Topology,
            format!("mesh: {} non-manifold edges have no pseudonormal; use AUTO or RAY", surface.nonmanifold_edges),
        )),
        SignMethod::Ray => Ok(Sign::Crossings),
        _ => Ok(if manifold { Sign::Pseudonormal } else { Sign::Crossings }),
    }
}

/// Lays everything out; the sign is not checked yet. `topology` is that of the triangles.
fn assemble(mesh: &Mesh, topology: &HalfEdges, sign: Sign, run: &Run) -> Result<Surface> {
    // What comes after it tells the progress.
    let run = &Run { progress: None, ..*run };
    let (vertices, triangles) = (mesh.vertices(), mesh.triangles());
    if triangles.is_empty() {
        return Err(Error::new(Status::Topology, "mesh: no triangle has three different corners"));
    }
    let corners = |t: usize| triangles[t].corners(vertices);
    let (mut tree, order) = Tree::build(triangles.len(), &|t| Aabb::of(corners(t)), LEAF_SIZE, run)?;
    let none = Leaf { estimates: Estimates::NONE, triangle: [NO_TRIANGLE; WIDTH] };
    let mut leaves = filled("leaves", order.start.len() - 1, none)?;
    run.for_each_piece(&mut leaves, PIECE, &|from, leaves| {
        for (k, leaf) in (from..).zip(leaves) {
            let members = order.start[k] as usize..order.start[k + 1] as usize;
            for (lane, &t) in order.order[members].iter().enumerate() {
                leaf.estimates.set(lane, corners(t as usize).map(|c| tree.place(c)));
                leaf.triangle[lane] = t;
            }
        }
        Ok(())
    })?;
    tree.fit(&order, &|t| corners(t as usize), run)?;
    drop(order);
    let mut normals = filled("normals", triangles.len(), Vec3::ZERO)?;
    run.for_each_piece(&mut normals, PIECE, &|from, normals| {
        normals.iter_mut().enumerate().for_each(|(k, n)| *n = triangle::normal(corners(from + k)));
        Ok(())
    })?;
    let mut neighbours = try_with_capacity("neighbours", triangles.len())?;
    let neighbour = |h: u32| topology.twin(h).map_or(ALONE, |twin| topology.face(twin));
    neighbours.extend((0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2].map(neighbour)));
    let mut laid_out = try_with_capacity("triangles", triangles.len())?;
    let mut first = 0;
    laid_out.extend(triangles.iter().enumerate().map(|(k, t)| {
        if triangles[first].face != t.face {
            first = k;
        }
        let piece = 2 * (k - first) as u32 + u32::from(t.turned);
        Corners { vertex: t.vertices, face: t.face, tag: mesh.tag(t.face), piece }
    }));
    let bounds = Aabb::of((0..triangles.len()).flat_map(corners));
    Ok(Surface {
        leaves,
        tree: Some(tree),
        vertices: try_copy("vertices", vertices)?,
        triangles: laid_out,
        normals,
        neighbours,
        vertex_normals: mesh.pseudonormals()?.vertex,
        bounds,
        diagonal: bounds.diagonal(),
        sign,
        doubts: Doubts::default(),
        sides: Sides::default(),
        far_winding: i32::from(sign != Sign::Unsigned && mesh.surface().volume < 0.0),
    })
}
