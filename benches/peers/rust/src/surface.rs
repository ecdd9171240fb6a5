// SPDX-License-Identifier: MIT OR Apache-2.0
//! parry's triangle mesh, whose sign is that of its pseudonormals.

use case::Case;
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::{TriMesh, TriMeshFlags};

pub fn build(case: &Case) -> TriMesh {
    let vertices = case.vertices.iter().map(|v| Vector::from_array(*v)).collect();
    TriMesh::with_flags(vertices, case.triangles.clone(), TriMeshFlags::ORIENTED).expect("a triangle mesh")
}

pub fn signed_distance(mesh: &TriMesh, p: [f64; 3]) -> f64 {
    let p = Vector::from_array(p);
    let found = mesh.project_local_point(p, false);
    let distance = (found.point - p).length();
    if found.is_inside { -distance } else { distance }
}
