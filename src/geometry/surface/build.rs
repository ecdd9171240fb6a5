// SPDX-License-Identifier: MIT OR Apache-2.0
//! From a mesh to a surface: which sign it can have, the hierarchy, and the check of every pseudonormal
//! against exact crossings.

use super::{Block, Corners, Sign, Surface};
use crate::bvh::{Leaves, Tree};
use crate::error::{Error, Result, Status, try_with_capacity};
use crate::geometry::{Accelerator, Open, SdfOptions, SignMethod};
use crate::math::{Aabb, Vec3, unit};
use crate::mesh::Mesh;
use crate::parallel::Run;
use crate::primitive::triangle::Prepared;
use crate::simd::lanes::WIDTH;
use std::collections::HashSet;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Triangles checked per chunk of work.
const CHUNK: usize = 1024;

impl Surface {
    /// Builds the distance to a mesh. O(n log n), plus, for a signed one, two crossing counts an edge and
    /// a vertex.
    pub(crate) fn new(mesh: &Mesh, options: &SdfOptions, run: &Run) -> Result<Surface> {
        let sign = choose_sign(mesh, options)?;
        let mut surface = assemble(mesh, options.accelerator != Accelerator::None, sign)?;
        if surface.sign == Sign::Pseudonormal {
            surface.distrust_flat_triangles();
            surface.check_pseudonormals(options.sign, run)?;
        }
        Ok(surface)
    }

    /// Pseudonormals at a triangle without area say nothing of the surface beyond it: crossings decide
    /// there.
    fn distrust_flat_triangles(&mut self) {
        let mut edges = HashSet::new();
        for t in 0..self.triangles.len() {
            if self.normal(t as u32) == Vec3::ZERO {
                let v = self.triangles[t].vertex;
                for k in 0..3 {
                    self.vertex_normals[v[k] as usize] = Vec3::ZERO;
                    edges.insert(undirected(v[k], v[(k + 1) % 3]));
                }
            }
        }
        if edges.is_empty() {
            return;
        }
        for (t, normals) in self.triangles.iter().zip(&mut self.edge_normals) {
            for (k, normal) in normals.iter_mut().enumerate() {
                if edges.contains(&undirected(t.vertex[k], t.vertex[(k + 1) % 3])) {
                    *normal = Vec3::ZERO;
                }
            }
        }
    }

    /// Just outside and just inside each edge and vertex, along its pseudonormal, the winding number must
    /// be 0 and 1. Anything else than these two says that the surface passes through itself, and then
    /// exact crossings decide everywhere. (At a saddle a vertex pseudonormal may rightly point into the
    /// body; such a vertex alone is left to the crossings.)
    fn check_pseudonormals(&mut self, asked: SignMethod, run: &Run) -> Result<()> {
        let faults = AtomicUsize::new(0);
        let vertex_is_clear: Vec<AtomicBool> = self.vertices.iter().map(|_| AtomicBool::new(true)).collect();
        let surface = &*self;
        let mut first = vec![u32::MAX; surface.vertices.len()];
        for (t, corners) in surface.triangles.iter().enumerate().rev() {
            corners.vertex.iter().for_each(|&v| first[v as usize] = t as u32);
        }
        run.for_each_chunk(surface.triangles.len().div_ceil(CHUNK), &|chunk| {
            let last = surface.triangles.len().min((chunk + 1) * CHUNK);
            for t in chunk * CHUNK..last {
                faults.fetch_add(surface.check_triangle(t, &first, &vertex_is_clear), Ordering::Relaxed);
            }
            Ok(())
        })?;
        let faults = faults.into_inner();
        if faults == 0 {
            for (normal, clear) in self.vertex_normals.iter_mut().zip(vertex_is_clear) {
                if !clear.into_inner() {
                    *normal = Vec3::ZERO;
                }
            }
            return Ok(());
        }
        if asked == SignMethod::Pseudonormal {
            return Err(Error::new(
                Status::Topology,
                format!(
                    "options.sign: PSEUDONORMAL, but the surface passes through itself: pseudonormals disagree with exact crossings {faults} times; use AUTO or RAY"
                ),
            ));
        }
        self.sign = Sign::Crossings;
        Ok(())
    }

    /// Checks the edges of a triangle that run to a higher vertex, and the vertices it is the first triangle of.
    fn check_triangle(&self, t: usize, first: &[u32], vertex_is_clear: &[AtomicBool]) -> usize {
        let corners = self.corners(t as u32);
        let vertex = self.triangles[t].vertex;
        let mut faults = 0;
        let shortest = (0..3).map(|k| (corners[(k + 1) % 3] - corners[k]).length()).fold(f64::INFINITY, f64::min);
        let largest = corners.iter().map(|c| c.abs().max_element()).fold(0.0, f64::max);
        // Small beside the features, large beside the rounding of the coordinates.
        let step = (1e-4 * shortest).max(64.0 * f64::EPSILON * largest);
        for k in 0..3 {
            let next = (k + 1) % 3;
            if vertex[k] < vertex[next] {
                let (outer, inner) = self.sides(corners[k] * 0.5 + corners[next] * 0.5, self.edge_normals[t][k], step);
                faults += usize::from((outer, inner) != (0, 1));
            }
            if first[vertex[k] as usize] != t as u32 {
                continue;
            }
            let normal = self.vertex_normals[vertex[k] as usize];
            let (outer, inner) = self.sides(corners[k], normal, step);
            if !(0..=1).contains(&outer) || !(0..=1).contains(&inner) {
                faults += 1;
            } else if (outer, inner) != (0, 1) {
                vertex_is_clear[vertex[k] as usize].store(false, Ordering::Relaxed);
            }
        }
        faults
    }

    /// Winding numbers a step outward and a step inward; (0, 1) where there is no normal to check.
    fn sides(&self, at: Vec3, normal: Vec3, step: f64) -> (i32, i32) {
        let along = unit(normal) * step;
        if along == Vec3::ZERO {
            return (0, 1);
        }
        (self.winding(at + along), self.winding(at - along))
    }
}

fn undirected(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
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
                "mesh: no inside: {} boundary edges, {} non-manifold edges, {} inconsistent edges as read; {} edges without a partner after orientation (sign NONE gives the unsigned distance)",
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
fn assemble(mesh: &Mesh, accelerated: bool, sign: Sign) -> Result<Surface> {
    let (vertices, triangles) = (mesh.vertices(), mesh.triangles());
    if triangles.is_empty() {
        return Err(Error::new(Status::Topology, "mesh: no triangle has three different corners"));
    }
    let corners = |t: usize| triangles[t].vertices.map(|v| vertices[v as usize]);
    let (tree, leaves) = if accelerated {
        let mut boxes = try_with_capacity("boxes", triangles.len())?;
        boxes.extend((0..triangles.len()).map(|t| Aabb::of(corners(t))));
        let (tree, leaves) = Tree::build(&boxes)?;
        (Some(tree), leaves)
    } else {
        (None, in_order(triangles.len()))
    };
    let mut blocks = try_with_capacity("blocks", leaves.start.len())?;
    let mut places = vec![0u32; triangles.len()];
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
    Ok(Surface {
        blocks,
        tree,
        vertices: vertices.to_vec(),
        triangles: triangles
            .iter()
            .zip(places)
            .map(|(t, place)| Corners {
                vertex: t.vertices,
                face: t.face,
                tag: mesh.tag(t.face),
                place,
                turned: t.turned,
            })
            .collect(),
        edge_normals: normals.edge,
        vertex_normals: normals.vertex,
        bounds,
        diagonal: bounds.diagonal(),
        sign,
        far_winding: i32::from(sign != Sign::Unsigned && mesh.surface().volume < 0.0),
    })
}

/// Leaves of a surface without hierarchy.
fn in_order(count: usize) -> Leaves {
    let start = (0..=count.div_ceil(WIDTH)).map(|k| (k * WIDTH).min(count) as u32).collect();
    Leaves { order: (0..count as u32).collect(), start }
}
