// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a mesh to a surface: which sign it can have, and the hierarchy.

use super::{Block, Corners, Sign, Surface};
use crate::bvh::{LEAF_SIZE, Tree};
use crate::error::{Error, Result, Status, try_with_capacity};
use crate::geometry::{Accelerator, Open, SdfOptions, SignMethod};
use crate::math::Aabb;
use crate::mesh::Mesh;
use crate::parallel::Run;
use crate::primitive::triangle::Prepared;
use crate::simd::lanes::WIDTH;

impl Surface {
    /// Builds the distance to a mesh. O(n log n), the check that it does not pass through itself included.
    pub(crate) fn new(mesh: &Mesh, options: &SdfOptions, run: &Run) -> Result<Surface> {
        let sign = choose_sign(mesh, options)?;
        let distinct = mesh.without_copies()?;
        let mesh = distinct.as_ref().unwrap_or(mesh);
        let mut surface = assemble(mesh, sign)?;
        if surface.sign == Sign::Pseudonormal {
            surface.distrust_unclear_normals(mesh);
            surface.check_embedding(mesh, options.sign, run)?;
        }
        if options.accelerator == Accelerator::None {
            surface.tree = None;
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
                "mesh: it has no inside: {} boundary edges, {} non-manifold edges and {} inconsistent edges as read, {} edges after repair that do not have as many faces one way as the other; close it, raise weld_tolerance if vertices nearly coincide, or take sign EMB_SIGN_NONE (5) for the unsigned distance",
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

/// Lays everything out; the sign is not checked yet.
fn assemble(mesh: &Mesh, sign: Sign) -> Result<Surface> {
    let (vertices, triangles) = (mesh.vertices(), mesh.triangles());
    if triangles.is_empty() {
        return Err(Error::new(Status::Topology, "mesh: no triangle has three different corners"));
    }
    let corners = |t: usize| triangles[t].corners(vertices);
    let mut boxes = try_with_capacity("boxes", triangles.len())?;
    boxes.extend((0..triangles.len()).map(|t| Aabb::of(corners(t))));
    let (tree, leaves) = Tree::build(&boxes, LEAF_SIZE)?;
    let mut blocks = try_with_capacity("blocks", leaves.start.len())?;
    let mut places = try_with_capacity("places", triangles.len())?;
    places.resize(triangles.len(), 0u32);
    for leaf in leaves.start.windows(2) {
        let members: Vec<_> = leaves.order[leaf[0] as usize..leaf[1] as usize]
            .iter()
            .map(|&t| (t, Prepared::new(corners(t as usize))))
            .collect();
        for (lane, (t, _)) in members.iter().enumerate() {
            places[*t as usize] = (blocks.len() * WIDTH + lane) as u32;
        }
        blocks.push(Block::new(&members));
    }
    let bounds = Aabb::of((0..triangles.len()).flat_map(corners));
    let normals = mesh.pseudonormals()?;
    let mut laid_out = try_with_capacity("triangles", triangles.len())?;
    let mut first = 0;
    laid_out.extend(triangles.iter().zip(places).enumerate().map(|(k, (t, place))| {
        if triangles[first].face != t.face {
            first = k;
        }
        let piece = 2 * (k - first) as u32 + u32::from(t.turned);
        Corners { vertex: t.vertices, face: t.face, tag: mesh.tag(t.face), place, piece }
    }));
    let mut positions = try_with_capacity("vertices", vertices.len())?;
    positions.extend_from_slice(vertices);
    Ok(Surface {
        blocks,
        tree: Some(tree),
        vertices: positions,
        triangles: laid_out,
        edge_normals: normals.edge,
        vertex_normals: normals.vertex,
        bounds,
        diagonal: bounds.diagonal(),
        sign,
        far_winding: i32::from(sign != Sign::Unsigned && mesh.surface().volume < 0.0),
    })
}
