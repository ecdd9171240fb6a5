// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which sign a mesh can have, and why.

use super::Sign;
use crate::error::{Error, Result, Status};
use crate::geometry::{SdfOptions, SignMethod};
use crate::math::{Aabb, Vec3, length};
use crate::mesh::{HalfEdges, Lists, Mesh, Triangle, boundary_loops};
use std::fmt::Write;

/// A hole is small where it is less than this share of the mesh's extent, in the plane of the hole, and of its area.
const SMALL_EXTENT: f64 = 1.0 / 3.0;
const SMALL_AREA: f64 = 0.025;

/// So many vertices, about, tell how far a mesh reaches across a hole: the time is theirs times the loops.
const SOME: usize = 4096;

/// Loops that a message tells of.
const TOLD: usize = 4;

/// A loop of the boundary.
struct Hole {
    edges: usize,
    middle: Vec3,
    /// Share of the mesh's extent, across the hole.
    extent: f64,
    /// Share of the mesh's area.
    area: f64,
}

impl Hole {
    fn is_small(&self) -> bool {
        self.extent < SMALL_EXTENT && self.area < SMALL_AREA
    }
}

/// The sign that the options ask for and the mesh can have. `topology` is that of the triangles.
pub(super) fn choose(
    mesh: &Mesh,
    vertices: &[Vec3],
    triangles: &[Triangle],
    topology: &HalfEdges,
    options: &SdfOptions,
) -> Result<Sign> {
    let surface = mesh.surface();
    let manifold = surface.nonmanifold_edges == 0;
    let by_normals = if manifold { Sign::Pseudonormal } else { Sign::Crossings };
    let is_open = surface.unbalanced_edges > 0;
    match options.sign {
        SignMethod::None => Ok(Sign::Unsigned),
        SignMethod::Axis => Ok(Sign::Axis(options.axis as u8)),
        SignMethod::Ray => Ok(if is_open { Sign::Votes } else { Sign::Crossings }),
        SignMethod::Winding => Ok(by_normals),
        SignMethod::Pseudonormal if is_open => Err(Error::new(
            Status::Topology,
            format!(
                "mesh: PSEUDONORMAL needs a closed surface: {}; take AUTO, WINDING or RAY, or options.open",
                counts(mesh)
            ),
        )),
        SignMethod::Pseudonormal if !manifold => Err(Error::new(
            Status::Topology,
            format!("mesh: {} non-manifold edges have no pseudonormal; use AUTO or RAY", surface.nonmanifold_edges),
        )),
        SignMethod::Auto if is_open => {
            let holes = holes(vertices, triangles, &boundary_loops(topology)?);
            let large: Vec<&Hole> = holes.iter().filter(|hole| !hole.is_small()).collect();
            if large.is_empty() { Ok(by_normals) } else { Err(refusal(mesh, &large, holes.len())) }
        }
        _ => Ok(by_normals),
    }
}

/// Whether the boundary is small holes alone.
pub(super) fn has_small_holes(vertices: &[Vec3], triangles: &[Triangle], topology: &HalfEdges) -> Result<bool> {
    Ok(holes(vertices, triangles, &boundary_loops(topology)?).iter().all(Hole::is_small))
}

fn counts(mesh: &Mesh) -> String {
    let report = mesh.report();
    format!(
        "{} boundary edges, {} non-manifold edges and {} inconsistent edges as read, {} edges after orientation that do not have as many faces one way as the other",
        report.boundary_edges,
        report.nonmanifold_edges,
        report.inconsistent_edges,
        mesh.surface().unbalanced_edges
    )
}

fn refusal(mesh: &Mesh, large: &[&Hole], all: usize) -> Error {
    let mut text =
        format!("mesh: it has no inside that its holes leave no doubt about: {} of {all} loops", large.len());
    for (k, hole) in large.iter().take(TOLD).enumerate() {
        let [x, y, z] = hole.middle.to_array();
        let (extent, area) = (100.0 * hole.extent, 100.0 * hole.area);
        // Writing to a string does not fail.
        let _ = write!(
            text,
            "{} {} edges around ({x:.6e}, {y:.6e}, {z:.6e}), {extent:.0}% of the mesh across, a cap of {area:.1}% of its area",
            if k == 0 { ":" } else { ";" },
            hole.edges
        );
    }
    let more = if large.len() > TOLD { "; ..." } else { "" };
    let _ = write!(
        text,
        "{more} ({}); take sign EMB_SIGN_WINDING (2) or EMB_SIGN_RAY (3) for what is most likely inside, EMB_SIGN_AXIS (4) for a terrain, EMB_SIGN_NONE (5) for a baffle, open EMB_OPEN_CAP (1) or EMB_OPEN_SWEEP (2) for a body that ends or leaves the domain there, or repair it (emb_mesh_repair; emb_mesh_diagnose tells what is needed)",
        counts(mesh)
    );
    Error::new(Status::Topology, text)
}

/// The loops, as large as they are beside the mesh.
fn holes(vertices: &[Vec3], triangles: &[Triangle], loops: &Lists) -> Vec<Hole> {
    let at = |v: u32| vertices[v as usize];
    let area: f64 = triangles.iter().map(|t| length(cap(t.vertices.map(at)))).sum();
    let diagonal = Aabb::of(vertices.iter().copied()).diagonal();
    let some = || vertices.iter().copied().step_by(vertices.len().div_ceil(SOME));
    let of = |path: &[u32]| {
        let middle = path.iter().fold(Vec3::ZERO, |sum, &v| sum + at(v) / path.len() as f64);
        let next = path.iter().skip(1).chain(&path[..1]);
        let caps = path.iter().zip(next).map(|(&a, &b)| cap([at(a), at(b), middle]));
        let (mut normal, mut own) = (Vec3::ZERO, 0.0);
        caps.for_each(|n| {
            normal += n;
            own += length(n);
        });
        // Two directions across, whose extents tell; of a loop that is in no plane, three.
        let u = normal.any_orthogonal_vector();
        let plane = [u, normal.cross(u)].map(crate::math::unit);
        let extent = |along: Vec3, all: &mut dyn Iterator<Item = Vec3>| {
            let (lo, hi) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), p| {
                let x = (p - middle).dot(along);
                (lo.min(x), hi.max(x))
            });
            hi - lo
        };
        let share = |along: Vec3| extent(along, &mut path.iter().map(|&v| at(v))) / extent(along, &mut some());
        let box_share = Aabb::of(path.iter().map(|&v| at(v))).diagonal() / diagonal;
        let is_plane = length(normal) > 0.5 * own;
        let share = if is_plane { plane.map(share).into_iter().fold(box_share, f64::max) } else { box_share };
        Hole { edges: path.len(), middle, extent: share, area: own / area }
    };
    loops.iter().map(of).collect()
}

/// The area vector of a triangle.
fn cap([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a) * 0.5
}
