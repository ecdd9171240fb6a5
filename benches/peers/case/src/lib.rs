// SPDX-License-Identifier: MIT OR Apache-2.0
//! A case: one mesh as bare arrays, the points every peer is asked about, and exact distances at some of
//! them. All files are little-endian numbers without a header, so that any language reads them in a line:
//!
//! | file | holds |
//! |---|---|
//! | `vertices.f64`, `triangles.u32` | x y z of each vertex; three corners of each triangle, outward |
//! | `uniform.f64`, `near.f64`, `grid.f64` | x y z of each point |
//! | `uniform.at.u32` ... | numbers of the points that are checked |
//! | `uniform.exact.f64` ... | their signed distances, by looking at every triangle |
//! | `mesh.stl` | the mesh again, in f32 |

mod report;

pub use report::{Verdict, peer, row, version};

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The point sets of a case.
pub const SETS: [&str; 3] = ["uniform", "near", "grid"];

/// A mesh and where its points lie.
pub struct Case {
    pub name: String,
    pub directory: PathBuf,
    pub vertices: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// Of the bounding box: errors are given in it.
    pub diagonal: f64,
}

/// Points to ask about, and the answers at some of them.
pub struct PointSet {
    pub points: Vec<[f64; 3]>,
    /// The points that are checked.
    pub at: Vec<u32>,
    /// Signed distances there.
    pub exact: Vec<f64>,
}

impl Case {
    /// The case in a directory, which lends it its name.
    pub fn read(directory: &Path) -> io::Result<Case> {
        let vertices = triples(&numbers(&directory.join("vertices.f64"), f64::from_le_bytes)?);
        let triangles = triples(&numbers(&directory.join("triangles.u32"), u32::from_le_bytes)?);
        let name = directory.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let (lo, hi) = bounds(&vertices);
        let diagonal = (0..3).map(|d| (hi[d] - lo[d]).powi(2)).sum::<f64>().sqrt();
        Ok(Case { name, directory: directory.to_owned(), vertices, triangles, diagonal })
    }

    /// A set of points by its name.
    pub fn set(&self, name: &str) -> io::Result<PointSet> {
        let path = |end: &str| self.directory.join(format!("{name}.{end}"));
        Ok(PointSet {
            points: triples(&numbers(&path("f64"), f64::from_le_bytes)?),
            at: numbers(&path("at.u32"), u32::from_le_bytes)?,
            exact: numbers(&path("exact.f64"), f64::from_le_bytes)?,
        })
    }
}

impl PointSet {
    /// Holds the answers at all points against the exact ones; see [`Verdict::of`].
    pub fn judge(&self, case: &Case, answers: &[f64], signed: bool, tolerance: f64) -> Verdict {
        let got = self.at.iter().map(|&at| answers[at as usize]);
        Verdict::of(got.zip(self.exact.iter().copied()), case.diagonal, signed, tolerance)
    }

    /// A tenth of the points, asked about before the clock runs.
    pub fn warm_up(&self) -> impl Iterator<Item = &[f64; 3]> {
        self.points.iter().step_by(10)
    }
}

/// The box around points.
pub fn bounds(points: &[[f64; 3]]) -> ([f64; 3], [f64; 3]) {
    points.iter().fold(([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]), |(lo, hi), p| {
        ([0, 1, 2].map(|d| lo[d].min(p[d])), [0, 1, 2].map(|d| hi[d].max(p[d])))
    })
}

/// Seconds that `work` takes, and what it gives.
pub fn seconds<R>(work: impl FnOnce() -> R) -> (f64, R) {
    let start = Instant::now();
    let result = work();
    (start.elapsed().as_secs_f64(), result)
}

/// Reads a file of bare numbers.
pub fn numbers<T, const N: usize>(path: &Path, from: fn([u8; N]) -> T) -> io::Result<Vec<T>> {
    let bytes = fs::read(path).map_err(|e| io::Error::new(e.kind(), format!("{}: {e}", path.display())))?;
    Ok(bytes.as_chunks().0.iter().map(|chunk| from(*chunk)).collect())
}

/// Writes a file of bare numbers.
pub fn write_numbers<const N: usize>(path: &Path, bytes: impl Iterator<Item = [u8; N]>) -> io::Result<()> {
    fs::write(path, bytes.flatten().collect::<Vec<u8>>())
}

fn triples<T: Copy>(flat: &[T]) -> Vec<[T; 3]> {
    flat.as_chunks().0.to_vec()
}
