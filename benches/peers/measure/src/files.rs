// SPDX-License-Identifier: MIT OR Apache-2.0
//! A case as embound holds it.

use case::{Case, write_numbers};
use embound::geometry::{Accelerator, Geometry, SdfOptions};
use embound::mesh::{Mesh, MeshOptions};
use embound::parallel::Run;
use std::error::Error;
use std::path::Path;

/// embound's mesh of a case: as it stands, since it was welded and oriented when the case was written.
pub fn mesh(case: &Case) -> Result<Mesh, Box<dyn Error>> {
    let flat = (case.vertices.concat(), case.triangles.concat());
    Ok(Mesh::from_triangles(&flat.0, &flat.1, None, &MeshOptions::default())?)
}

/// The signed distance, by the hierarchy or by looking at every triangle.
pub fn geometry(mesh: &Mesh, accelerator: Accelerator, run: &Run) -> Result<Geometry, Box<dyn Error>> {
    Ok(Geometry::from_mesh(mesh, &SdfOptions { accelerator, ..SdfOptions::default() }, run)?)
}

/// Writes points as a set of a case.
pub fn write_points(path: &Path, points: &[[f64; 3]]) -> std::io::Result<()> {
    write_numbers(path, points.iter().flatten().map(|c| c.to_le_bytes()))
}
