// SPDX-License-Identifier: MIT OR Apache-2.0
//! Faces that repeat others, have no area, hardly any, or no plane.

use super::{Diagnosis, DiagnosisOptions, Subject, push};
use crate::error::{Result, try_with_capacity};
use crate::math::{Aabb, Vec3, length, unit};
use crate::mesh::duplicates::{Repeats, runs_forward};
use crate::mesh::triangulate::is_warped;
use crate::primitive::polygon::{are_collinear, area_vector};

/// A face that repeats an earlier one: the same ring of vertices, from whichever corner, whichever way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Duplicate {
    /// The face.
    pub face: u32,
    /// The earliest face that it repeats.
    pub original: u32,
    /// Whether both ran the same way when read.
    pub same_way: bool,
}

/// A face and a number that says how bad it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceMeasure {
    /// The face.
    pub face: u32,
    /// The number.
    pub ratio: f64,
}

impl Diagnosis {
    pub(super) fn list_duplicates(&mut self, subject: &Subject, repeats: &Repeats) -> Result<()> {
        let faces = subject.faces;
        let direction = |f: usize| runs_forward(faces.face(f)) ^ subject.turned[f];
        for (f, &first) in repeats.either_way.iter().enumerate().filter(|(f, first)| *f != **first as usize) {
            let first = first as usize;
            let same_way = direction(f) == direction(first);
            let duplicate = Duplicate { face: faces.input[f], original: faces.input[first], same_way };
            push(&mut self.duplicates, "duplicate faces", duplicate)?;
        }
        Ok(())
    }

    pub(super) fn list_faces(&mut self, subject: &Subject, options: &DiagnosisOptions) -> Result<()> {
        let mesh = subject.mesh;
        self.shrunk_faces = try_with_capacity("faces", mesh.shrunk.len())?;
        self.shrunk_faces.extend_from_slice(&mesh.shrunk);
        for (f, ring) in subject.faces.iter().enumerate() {
            let face = subject.faces.input[f];
            let corners = ring.iter().map(|&v| subject.vertices[v as usize]);
            if mesh.is_flat(f) {
                push(&mut self.flat_faces, "faces", face)?;
                continue;
            }
            let pieces = mesh.triangles[subject.faces.triangles_of(f)].iter().map(|t| t.corners(subject.vertices));
            let ratio = thinness(corners.clone(), pieces);
            // What is no number comes of lengths beyond those of f64.
            if ratio < options.sliver_ratio || ratio.is_nan() {
                push(&mut self.slivers, "faces", FaceMeasure { face, ratio })?;
            }
            if ring.len() > 3 {
                let found = FaceMeasure { face, ratio: off_plane(corners) };
                if options.off_plane_ratio > 0.0 && found.ratio > options.off_plane_ratio {
                    push(&mut self.off_plane_faces, "faces", found)?;
                }
                if mesh.report.warped_faces > 0 && is_warped(subject.vertices, ring)? {
                    push(&mut self.warped_faces, "faces", found)?;
                }
            }
        }
        Ok(())
    }
}

impl super::Mesh {
    /// Whether a face of [`super::Mesh::half_edges`] has exactly zero area.
    pub(crate) fn is_flat(&self, f: usize) -> bool {
        self.triangles[self.half_edges.faces().triangles_of(f)].iter().all(|t| {
            let [a, b, c] = t.corners(&self.vertices);
            are_collinear(a, b, c)
        })
    }
}

/// Twice the area of a face over its squared length.
fn thinness(corners: impl Iterator<Item = Vec3> + Clone, pieces: impl Iterator<Item = [Vec3; 3]>) -> f64 {
    let farthest = |from: Vec3| {
        let further = |best: (Vec3, f64), p: Vec3| {
            let distance = length(p - from);
            if distance > best.1 { (p, distance) } else { best }
        };
        corners.clone().fold((from, 0.0), further)
    };
    let (far, reach) = farthest(corners.clone().next().unwrap_or(Vec3::ZERO));
    let inverse = 1.0 / reach.max(farthest(far).1);
    // Scaled first: squares of small lengths underflow.
    pieces.map(|[a, b, c]| length(((b - a) * inverse).cross((c - a) * inverse))).sum()
}

/// Half the room between two planes around the corners, over the diagonal of their box.
fn off_plane(corners: impl Iterator<Item = Vec3> + Clone) -> f64 {
    let bounds = Aabb::of(corners.clone());
    let normal = unit(area_vector(corners.clone()));
    let heights = corners.map(|p| (p - bounds.center()).dot(normal));
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    0.5 * (high - low) / bounds.diagonal()
}
