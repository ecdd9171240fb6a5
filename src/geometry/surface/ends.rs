// SPDX-License-Identifier: MIT OR Apache-2.0
//! Open meshes closed by triangles, which are surface like any other: over their boundary loops, or over loops swept out of
//! a box so far that no point in it has the end nearest.

use crate::error::{Error, Result, Status, try_with_capacity};
use crate::geometry::{Open, SdfOptions, SignMethod};
use crate::math::{Aabb, Vec3};
use crate::mesh::{self, Caps, LARGEST_COORDINATE, Lists, Mesh};
use crate::primitive::polygon::area_vector;
use crate::store::{Array, Packer, Unpacker, plain, wrong};

/// A loop leads out of the box where it ends within it by no more than this part of its size.
const SHORT: f64 = 0.25;

/// What comes as near as this part of the diagonal of the box to a face is at it.
const AT_FACE: f64 = 1e-6;

/// Ends lie farther beyond box and body than their diagonal, the larger ones farther: the end of a bore lies before the end
/// of what is around it.
const BEYOND: [f64; 2] = [1.25, 1.75];

/// A vertex at the end of a swept loop.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
struct Swept {
    /// The vertex of the mesh that is swept.
    source: u32,
    /// The face of the box: twice the axis, plus 1 for the upper one.
    face: u32,
    /// How far beyond box and body, in their diagonals.
    beyond: f64,
}

plain! {
    Swept { source: u32, face: u32, beyond: f64 }
}

/// Vertices that were made to close a mesh: they follow its own.
#[derive(Clone)]
pub(super) struct Ends {
    swept: Array<Swept>,
    /// The box they are swept out of, where there are some.
    domain: Aabb,
}

impl Default for Ends {
    fn default() -> Ends {
        Ends { swept: Array::default(), domain: Aabb::new(Vec3::ZERO, Vec3::ZERO) }
    }
}

impl Ends {
    /// How many.
    pub(super) fn swept(&self) -> usize {
        self.swept.len()
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.swept[..])
    }

    /// Adds them to the vertices of the mesh.
    pub(super) fn add_to(&self, vertices: &mut Vec<Vec3>) -> Result<()> {
        if self.swept.is_empty() {
            return Ok(());
        }
        let hull = self.domain.hull(Aabb::of(vertices.iter().copied()));
        let diagonal = hull.diagonal();
        let count = vertices.len() + self.swept.len();
        vertices.try_reserve(self.swept.len()).map_err(|_| Error::memory("vertices", count))?;
        for end in &self.swept {
            let axis = end.face as usize / 2;
            let far = end.beyond * diagonal;
            let place = if end.face % 2 == 1 { hull.hi[axis] + far } else { hull.lo[axis] - far };
            if place.abs() > LARGEST_COORDINATE {
                return Err(Error::invalid(format!(
                    "options.open_lo, options.open_hi: loops swept out of a box of this size end at {place:e}, beyond {LARGEST_COORDINATE:e}"
                )));
            }
            let mut p = vertices[end.source as usize];
            p[axis] = place;
            vertices.push(p);
        }
        Ok(())
    }

    pub(super) fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.array(&self.swept);
        out.vector(self.domain.lo);
        out.vector(self.domain.hi);
    }

    pub(super) fn unpack(from: &mut Unpacker, vertices: usize) -> Result<Ends> {
        let ends = Ends { swept: from.array("swept vertices")?, domain: Aabb::new(from.vector()?, from.vector()?) };
        let own = vertices.saturating_sub(ends.swept.len());
        let is_end = |s: &Swept| (s.source as usize) < own && s.face < 6 && s.beyond.abs() <= BEYOND[1];
        let is_box = ends.swept.is_empty() || (ends.domain.is_finite() && !ends.domain.is_empty());
        if from.checks() && !(is_box && ends.swept.iter().all(is_end)) {
            return Err(wrong("a vertex of a surface is swept from none"));
        }
        Ok(ends)
    }
}

/// The mesh with the triangles that close it as the options say, and what was made for it; none where it has no boundary,
/// or where the options leave it open. The mesh holds no face twice.
pub(super) fn close(mesh: &Mesh, options: &SdfOptions) -> Result<Option<(Mesh, Ends)>> {
    let name = match options.open {
        Open::Error => return Ok(None),
        Open::Cap => "CAP",
        Open::Sweep => "SWEEP",
    };
    if let SignMethod::None | SignMethod::Axis = options.sign {
        return Err(Error::invalid(format!(
            "options.open: {name} closes the mesh, options.sign {} (AXIS 4, NONE 5) is for open ones",
            options.sign as i32
        )));
    }
    let domain = if options.open == Open::Sweep { domain(options)? } else { Aabb::EMPTY };
    let topology = mesh.half_edges();
    if mesh.surface().unbalanced_edges == 0 {
        return Ok(None);
    }
    let one_way = mesh::one_way_edges(topology)?;
    if one_way > 0 {
        return Err(Error::new(
            Status::Topology,
            format!(
                "mesh: {one_way} edges have two faces that run along them the same way, so that options.open, {name}, cannot give it an inside; orient it (EMB_ORIENT_AUTO), or repair it where it has one side only"
            ),
        ));
    }
    let loops = mesh::boundary_loops(topology)?;
    let (ends, triangles) = match options.open {
        Open::Sweep => sweep(mesh, &loops, domain)?,
        _ => (Ends::default(), cap(mesh, &loops)?),
    };
    let mut vertices = try_with_capacity("vertices", mesh.vertices().len())?;
    vertices.extend_from_slice(mesh.vertices());
    ends.add_to(&mut vertices)?;
    let closed = mesh.closed_by(&vertices[mesh.vertices().len()..], &triangles)?;
    Ok(Some((closed, ends)))
}

/// The box of the options.
fn domain(options: &SdfOptions) -> Result<Aabb> {
    let [lo, hi] = [options.open_lo, options.open_hi];
    let is_box = (0..3).all(|k| lo[k].is_finite() && hi[k].is_finite() && lo[k] < hi[k]);
    if !is_box {
        return Err(Error::invalid(format!(
            "options.open_lo, options.open_hi: {lo:?} to {hi:?} is no finite box of some size along each axis, which SWEEP needs"
        )));
    }
    Ok(Aabb::new(Vec3::from_array(lo), Vec3::from_array(hi)))
}

/// Triangles over the loops.
fn cap(mesh: &Mesh, loops: &Lists) -> Result<Vec<[u32; 3]>> {
    let mut caps = Caps::new(mesh.vertices().len(), mesh.triangles(), loops)?;
    let mut triangles = Vec::new();
    for ring in loops.iter() {
        if !caps.cap(mesh.vertices(), ring, &mut triangles)? {
            return Err(Error::new(
                Status::Topology,
                format!(
                    "mesh: options.open, CAP: {} crosses itself as seen along its area vector, and has too many edges for other ways; close it before, with a face for each part of it",
                    named(ring, Aabb::of(points(mesh, ring)))
                ),
            ));
        }
    }
    Ok(triangles)
}

/// The loops swept: walls of two triangles an edge, and an end.
fn sweep(mesh: &Mesh, loops: &Lists, domain: Aabb) -> Result<(Ends, Vec<[u32; 3]>)> {
    // Face, area as seen along the axis, and number.
    let mut order = try_with_capacity("loops", loops.len())?;
    for (k, ring) in loops.iter().enumerate() {
        let face = face_led_to(mesh, ring, domain)?;
        order.push((face, area_vector(points(mesh, ring))[face as usize / 2].abs(), k));
    }
    order.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.2.cmp(&b.2)));
    let own = mesh.vertices().len();
    let mut swept: Vec<Swept> = Vec::new();
    // Where the end of each loop begins, in the order in which they are swept.
    let mut rims = Lists::default();
    for (rank, &(face, _, k)) in order.iter().enumerate() {
        let ring = loops.get(k).unwrap_or_default();
        let beyond = BEYOND[0] + (BEYOND[1] - BEYOND[0]) * (rank as f64 / order.len() as f64);
        let mut rim: Vec<u32> = try_with_capacity("vertices", ring.len())?;
        swept.try_reserve(ring.len()).map_err(|_| Error::memory("vertices", swept.len() + ring.len()))?;
        let place = |v: u32| {
            let mut p = mesh.vertices()[v as usize];
            p[face as usize / 2] = 0.0;
            p
        };
        for (at, &source) in ring.iter().enumerate() {
            // Of an edge along the axis both ends come to lie at one place.
            let again = if at > 0 && place(ring[at - 1]) == place(source) {
                rim.last()
            } else if at + 1 == ring.len() && place(ring[0]) == place(source) {
                rim.first()
            } else {
                None
            };
            rim.push(match again {
                Some(&v) => v,
                None => {
                    swept.push(Swept { source, face, beyond });
                    (own + swept.len() - 1) as u32
                }
            });
        }
        rims.push(rim.into_iter())?;
    }
    if own + swept.len() >= u32::MAX as usize {
        return Err(Error::unsupported(format!("mesh: with its loops swept it has {} vertices", own + swept.len())));
    }
    let ends = Ends { swept: swept.into(), domain };
    let mut vertices = try_with_capacity("vertices", own)?;
    vertices.extend_from_slice(mesh.vertices());
    ends.add_to(&mut vertices)?;
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for (&(.., k), rim) in order.iter().zip(rims.iter()) {
        let ring = loops.get(k).unwrap_or_default();
        triangles.try_reserve(2 * ring.len()).map_err(|_| Error::memory("triangles", 2 * ring.len()))?;
        for at in 0..ring.len() {
            let next = if at + 1 == ring.len() { 0 } else { at + 1 };
            let ([a, b], [far_a, far_b]) = ([ring[at], ring[next]], [rim[at], rim[next]]);
            triangles.push([a, b, far_b]);
            if far_a != far_b {
                triangles.push([a, far_b, far_a]);
            }
        }
        let mut end = try_with_capacity("vertices", rim.len())?;
        end.extend_from_slice(rim);
        end.dedup();
        while end.len() > 1 && end.last() == end.first() {
            end.pop();
        }
        mesh::cap_plane(&vertices, &end, &mut triangles)?;
    }
    Ok((ends, triangles))
}

/// The face of the box that a loop leads out by: the one that its farthest vertex is nearest to.
fn face_led_to(mesh: &Mesh, ring: &[u32], domain: Aabb) -> Result<u32> {
    let around = Aabb::of(points(mesh, ring));
    // How far within the box it ends, and how far its farthest vertex is.
    let within = |f: usize| match (f / 2, f % 2) {
        (axis, 1) => (domain.hi[axis] - around.hi[axis], domain.hi[axis] - around.lo[axis]),
        (axis, _) => (around.lo[axis] - domain.lo[axis], around.hi[axis] - domain.lo[axis]),
    };
    let face = (1..6).fold(0, |best, f| if within(f).1 < within(best).1 { f } else { best });
    let (ends, farthest) = within(face);
    let wide = around.diagonal();
    let refused = |what: String| Err(Error::new(Status::Topology, format!("mesh: options.open, SWEEP: {what}")));
    if ends > SHORT * wide {
        return refused(format!(
            "{} leads nowhere: it ends {ends:e} within the box of options.open_lo and options.open_hi, more than a quarter of its size, {wide:e}; fill it (emb_mesh_repair), or take EMB_OPEN_CAP",
            named(ring, around)
        ));
    }
    let near = AT_FACE * domain.diagonal();
    let spans = |axis: usize| [2 * axis, 2 * axis + 1].iter().all(|&f| within(f).0 <= near.max(ends));
    if farthest > near && (0..3).any(|axis| axis != face / 2 && spans(axis)) {
        return refused(format!(
            "{} leads out of the box of options.open_lo and options.open_hi by several faces; close it before, or take EMB_SIGN_AXIS where it is terrain",
            named(ring, around)
        ));
    }
    Ok(face as u32)
}

fn points<'a>(mesh: &'a Mesh, ring: &'a [u32]) -> impl Iterator<Item = Vec3> + Clone + 'a {
    ring.iter().map(|&v| mesh.vertices()[v as usize])
}

/// A loop as messages have it.
fn named(ring: &[u32], around: Aabb) -> String {
    let ([a, b, c], [x, y, z]) = (around.lo.to_array(), around.hi.to_array());
    format!("the boundary loop of {} edges from ({a:e}, {b:e}, {c:e}) to ({x:e}, {y:e}, {z:e})", ring.len())
}
