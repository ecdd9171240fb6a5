// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces cut into triangles.

use super::Triangle;
use super::faces::Faces;
use crate::error::{Error, Result, Status, try_with_capacity};
use crate::math::{Aabb, Vec3, length, unit};
use crate::primitive::polygon;

/// Off the plane of a face by at most this part of its size, and by what rounding to f32 explains.
const PLANARITY: f64 = 1e-5;
const F32_ROUNDING: f64 = 2.4e-7;

/// The triangles of all faces in order. `Triangle::face` counts in `faces`, not in the input.
pub(super) fn triangulate(vertices: &[Vec3], faces: &Faces, blame: Status) -> Result<Vec<Triangle>> {
    let count = faces.corners.len() - 2 * faces.len();
    let mut triangles = try_with_capacity("triangles", count)?;
    let mut scratch = Scratch::default();
    for (f, corners) in faces.iter().enumerate() {
        let face = f as u32;
        if let &[a, b, c] = corners {
            triangles.push(Triangle { vertices: [a, b, c], face, turned: false });
            continue;
        }
        scratch.cut(vertices, corners).map_err(|why| Error::new(blame, format!("face {}: {why}", faces.input[f])))?;
        let to_vertices = |t: &[u32; 3]| Triangle { vertices: t.map(|k| corners[k as usize]), face, turned: false };
        triangles.extend(scratch.triangles.iter().map(to_vertices));
    }
    Ok(triangles)
}

/// Buffers that serve one face after another.
#[derive(Default)]
struct Scratch {
    points: Vec<[f64; 2]>,
    ring: Vec<u32>,
    triangles: Vec<[u32; 3]>,
}

impl Scratch {
    /// Fills `triangles`, as indices into `corners`, or says why not.
    fn cut(&mut self, vertices: &[Vec3], corners: &[u32]) -> std::result::Result<(), String> {
        let n = corners.len();
        let at = |k: usize| vertices[corners[k] as usize];
        let points = (0..n).map(at);
        self.ring.resize(n, 0);
        self.triangles.resize(n - 2, [0; 3]);
        let normal = polygon::area_vector(points.clone());
        if (2..n).all(|k| polygon::are_collinear(at(0), at(1), at(k))) {
            for (k, t) in self.triangles.iter_mut().enumerate() {
                *t = [0, k as u32 + 1, k as u32 + 2];
            }
            return Ok(());
        }
        if normal == Vec3::ZERO {
            return Err(format!("its {n} corners enclose no area, so it crosses itself"));
        }
        check_planarity(points.clone(), unit(normal))?;
        let [u, v] = polygon::projection(normal);
        self.points.clear();
        self.points.extend(points.map(|p| [p[u], p[v]]));
        if polygon::clip_ears(&self.points, &mut self.ring, &mut self.triangles) {
            Ok(())
        } else {
            Err(format!("its {n} corners cross themselves"))
        }
    }
}

fn check_planarity(points: impl Iterator<Item = Vec3> + Clone, normal: Vec3) -> std::result::Result<(), String> {
    let bounds = Aabb::of(points.clone());
    let largest = bounds.lo.abs().max(bounds.hi.abs());
    let allowed = PLANARITY * bounds.diagonal() + F32_ROUNDING * length(largest);
    let heights = points.map(|p| (p - bounds.center()).dot(normal));
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    if high - low > 2.0 * allowed {
        return Err(format!("its corners are {:e} off a plane, more than {allowed:e}", 0.5 * (high - low)));
    }
    Ok(())
}
