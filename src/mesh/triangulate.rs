// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces cut into triangles.

use super::data::PieceRows;
use super::faces::Faces;
use super::lobes::Lobes;
use super::{Triangle, ears};
use crate::error::{Error, Result, filled, try_copy, try_with_capacity};
use crate::math::{Aabb, Vec3, length, unit};
use crate::primitive::least_area::{Stretch, least_area};
use crate::primitive::polygon;

/// Off the plane of a face by at most this part of its size, and by what rounding to f32 explains: beyond, a
/// face counts as warped.
const PLANARITY: f64 = 1e-5;
const F32_ROUNDING: f64 = 2.4e-7;

/// The least area, which takes the cube of the number of corners, is looked for over faces of up to so many: some
/// 20 ms, and 0.1 ms a corner where all of a large face is such parts.
const MOST_CORNERS: usize = 250;

/// From about here on a tree of the corners finds ears faster than a look at each.
const MANY_CORNERS: usize = 100;

/// Faces as triangles.
pub(super) struct Cut {
    /// Those of all faces in order. `Triangle::face` counts in the faces, not in the input.
    pub triangles: Vec<Triangle>,
    /// How many faces are warped.
    pub warped: usize,
    /// As [`super::Data::of_pieces`].
    pub rows: Vec<PieceRows>,
}

/// Cuts all faces. `rows` has a row of data for each corner, or nothing.
///
/// Every face keeps its boundary. Seen along its area vector, a face that the diagonals from its first corner cut
/// is cut by those; another that does not cross itself by clipping ears; and what does by the triangulation of least
/// area. Of more than [`MOST_CORNERS`] corners, what does is parted where it comes to a vertex again, and each part cut
/// by these rules; what then still crosses itself is cut into a fan.
pub(super) fn triangulate(vertices: &[Vec3], faces: &Faces, rows: &[u32]) -> Result<Cut> {
    let count = faces.corners.len() - 2 * faces.len();
    let mut triangles = try_with_capacity("triangles", count)?;
    let mut scratch = Scratch::default();
    let mut rows_of_pieces = Vec::new();
    let mut warped = 0;
    for (f, corners) in faces.iter().enumerate() {
        let face = f as u32;
        if let &[a, b, c] = corners {
            triangles.push(Triangle { vertices: [a, b, c], face, turned: false });
            continue;
        }
        warped += usize::from(!scratch.cut(vertices, corners)?);
        let to_vertices = |t: &[u32; 3]| Triangle { vertices: t.map(|k| corners[k as usize]), face, turned: false };
        let rows = rows.get(faces.start[f] as usize..faces.start[f + 1] as usize).unwrap_or_default();
        if !rows.is_empty() && is_again_in_another_row(corners, rows)? {
            let count = scratch.triangles.len();
            rows_of_pieces.try_reserve(count).map_err(|_| Error::memory("pieces", count))?;
            let to_rows = |t: &[u32; 3]| t.map(|k| rows[k as usize]);
            rows_of_pieces.extend((triangles.len() as u32..).zip(scratch.triangles.iter().map(to_rows)));
        }
        triangles.extend(scratch.triangles.iter().map(to_vertices));
    }
    Ok(Cut { triangles, warped, rows: rows_of_pieces })
}

/// Whether a face has a vertex twice, in different rows.
fn is_again_in_another_row(corners: &[u32], rows: &[u32]) -> Result<bool> {
    let mut sorted = try_with_capacity("corners", corners.len())?;
    sorted.extend(corners.iter().zip(rows));
    sorted.sort_unstable();
    Ok(sorted.windows(2).any(|w| w[0].0 == w[1].0 && w[0].1 != w[1].1))
}

/// Whether a face counts as warped.
pub(super) fn is_warped(vertices: &[Vec3], corners: &[u32]) -> Result<bool> {
    Ok(corners.len() > 3 && !Scratch::default().cut(vertices, corners)?)
}

/// Buffers that serve one face after another.
#[derive(Default)]
struct Scratch {
    points: Vec<[f64; 2]>,
    ring: Vec<u32>,
    triangles: Vec<[u32; 3]>,
}

impl Scratch {
    /// Fills `triangles`, as indices into `corners`; whether the face is plane and does not cross itself.
    fn cut(&mut self, vertices: &[Vec3], corners: &[u32]) -> Result<bool> {
        let n = corners.len();
        let at = |k: usize| vertices[corners[k] as usize];
        let points = (0..n).map(at);
        self.fan(corners)?;
        if polygon::are_on_a_line(points.clone()) {
            return Ok(true);
        }
        let normal = polygon::area_vector(points.clone());
        if normal != Vec3::ZERO {
            let [u, v] = polygon::projection(normal);
            self.points.clear();
            self.points.extend(points.clone().map(|p| [p[u], p[v]]));
            if polygon::is_cut_by_fan(&self.points) || self.clip_ears()? {
                return Ok(is_plane(points, unit(normal)));
            }
        }
        self.fan(corners)?;
        if n > MOST_CORNERS {
            self.cut_lobes(vertices, corners)?;
            return Ok(false);
        }
        // Sides between two corners at one vertex are allowed: where a face touches itself in a vertex the triangles
        // there have no area, and any others would cover what the face does not.
        let points: Vec<Vec3> = points.collect();
        let mut table = filled("sides of a face", n * n, Stretch::default())?;
        least_area(&points, |_, _| false, &mut table, &mut self.triangles);
        Ok(false)
    }

    /// Cuts each loop of a face on its own where it comes to a vertex again.
    fn cut_lobes(&mut self, vertices: &[Vec3], corners: &[u32]) -> Result<()> {
        let lobes = Lobes::of(corners)?;
        if lobes.iter().len() == 1 {
            return Ok(());
        }
        let mut triangles = try_with_capacity("triangles", corners.len() - 2)?;
        triangles.extend_from_slice(&lobes.fillers);
        let mut lobe = Vec::new();
        for ring in lobes.iter().filter(|ring| ring.len() > 2) {
            lobe.clear();
            lobe.extend(ring.iter().map(|&k| corners[k as usize]));
            self.cut(vertices, &lobe)?;
            triangles.extend(self.triangles.iter().map(|t| t.map(|k| ring[k as usize])));
        }
        self.triangles = triangles;
        Ok(())
    }

    /// The ears of `points`, the same both ways.
    fn clip_ears(&mut self) -> Result<bool> {
        if self.points.len() < MANY_CORNERS {
            self.ring.resize(self.points.len(), 0);
            Ok(polygon::clip_ears(&self.points, &mut self.ring, &mut self.triangles))
        } else {
            ears::clip_ears(&self.points, &mut self.triangles)
        }
    }

    /// The fan from the first corner whose vertex comes once: no triangle has a vertex twice then.
    fn fan(&mut self, corners: &[u32]) -> Result<()> {
        let n = corners.len() as u32;
        let first = if corners[1..].contains(&corners[0]) { first_alone(corners)? } else { 0 };
        let from_first = |k: u32| if k < n - first { first + k } else { k - (n - first) };
        self.triangles.clear();
        self.triangles.extend((1..n - 1).map(|k| [first, from_first(k), from_first(k + 1)]));
        Ok(())
    }
}

/// The first corner whose vertex comes once; the first of all where none does.
fn first_alone(corners: &[u32]) -> Result<u32> {
    let mut sorted = try_copy("corners", corners)?;
    sorted.sort_unstable();
    let comes_once = |c: &u32| sorted.get(sorted.partition_point(|other| other < c) + 1) != Some(c);
    Ok(corners.iter().position(comes_once).unwrap_or(0) as u32)
}

fn is_plane(points: impl Iterator<Item = Vec3> + Clone, normal: Vec3) -> bool {
    let bounds = Aabb::of(points.clone());
    let largest = bounds.lo.abs().max(bounds.hi.abs());
    let allowed = PLANARITY * bounds.diagonal() + F32_ROUNDING * length(largest);
    let heights = points.map(|p| (p - bounds.center()).dot(normal));
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    high - low <= 2.0 * allowed
}
