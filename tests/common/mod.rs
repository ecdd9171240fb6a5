// SPDX-License-Identifier: MIT OR Apache-2.0
//! What the tests share: meshes that code generates, files made of them, and an independent sign.
//! Everything is deterministic; nothing is read from disk.

// Each test crate uses its own part of this.
#![allow(dead_code)]

pub mod bodies;
mod description;
pub mod edges;
pub mod lattices;
pub mod native;
pub mod obj_files;
pub mod points;
pub mod random;
pub mod rays;
pub mod same;
pub mod stl_bytes;
pub mod vtp_files;
pub mod winding;

#[allow(unused_imports)]
pub use description::{Described, described};

use embound::mesh::{Mesh, MeshOptions, Orient};

/// Triangles over shared vertices, before embound has seen them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Soup {
    pub vertices: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Soup {
    /// x0 y0 z0 x1 y1 z1 ...
    pub fn xyz(&self) -> Vec<f64> {
        self.vertices.concat()
    }

    /// a0 b0 c0 a1 b1 c1 ...
    pub fn indices(&self) -> Vec<u32> {
        self.triangles.concat()
    }

    /// The mesh with default options.
    pub fn mesh(&self) -> Mesh {
        self.mesh_with(&MeshOptions::default())
    }

    /// The mesh with the orientation as given.
    pub fn mesh_kept(&self) -> Mesh {
        self.mesh_with(&MeshOptions { orient: Orient::Keep, ..MeshOptions::default() })
    }

    /// The mesh with these options.
    pub fn mesh_with(&self, options: &MeshOptions) -> Mesh {
        Mesh::from_triangles(&self.xyz(), &self.indices(), None, options).expect("a generated mesh is valid")
    }

    /// The corners of triangle `t`.
    pub fn corners(&self, t: usize) -> [[f64; 3]; 3] {
        self.triangles[t].map(|v| self.vertices[v as usize])
    }

    /// `f` of every vertex.
    pub fn map(&self, mut f: impl FnMut([f64; 3]) -> [f64; 3]) -> Soup {
        Soup { vertices: self.vertices.iter().map(|&p| f(p)).collect(), triangles: self.triangles.clone() }
    }

    /// Every coordinate times `s`.
    pub fn scaled(&self, s: f64) -> Soup {
        self.map(|p| p.map(|c| c * s))
    }

    /// Moved by `d`.
    pub fn translated(&self, d: [f64; 3]) -> Soup {
        self.map(|p| [p[0] + d[0], p[1] + d[1], p[2] + d[2]])
    }

    /// Every triangle turned over.
    pub fn flipped(&self) -> Soup {
        self.flipped_where(|_| true)
    }

    /// The triangles that `which` names turned over.
    pub fn flipped_where(&self, which: impl Fn(usize) -> bool) -> Soup {
        let turn = |(k, &[a, b, c]): (usize, &[u32; 3])| if which(k) { [a, c, b] } else { [a, b, c] };
        Soup { vertices: self.vertices.clone(), triangles: self.triangles.iter().enumerate().map(turn).collect() }
    }

    /// Every triangle twice, the copies after the originals.
    pub fn duplicated(&self) -> Soup {
        Soup { vertices: self.vertices.clone(), triangles: [self.triangles.clone(), self.triangles.clone()].concat() }
    }

    /// Every triangle and its reverse.
    pub fn double_sided(&self) -> Soup {
        let back = self.flipped().triangles;
        Soup { vertices: self.vertices.clone(), triangles: [self.triangles.clone(), back].concat() }
    }

    /// All but the triangles that `which` names.
    pub fn without(&self, which: impl Fn(usize) -> bool) -> Soup {
        let kept = self.triangles.iter().enumerate().filter(|&(k, _)| !which(k)).map(|(_, &t)| t).collect();
        Soup { vertices: self.vertices.clone(), triangles: kept }
    }

    /// Both as one, nothing merged.
    pub fn and(&self, other: &Soup) -> Soup {
        let n = self.vertices.len() as u32;
        let moved = other.triangles.iter().map(|t| t.map(|v| v + n));
        Soup {
            vertices: [self.vertices.clone(), other.vertices.clone()].concat(),
            triangles: self.triangles.iter().copied().chain(moved).collect(),
        }
    }

    /// Three vertices of its own for each triangle, as in an STL file.
    pub fn unshared(&self) -> Soup {
        let vertices: Vec<[f64; 3]> = (0..self.triangles.len()).flat_map(|t| self.corners(t)).collect();
        let triangles = (0..self.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        Soup { vertices, triangles }
    }

    /// Lower and upper corner of its box.
    pub fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        let mut lo = [f64::INFINITY; 3];
        let mut hi = [f64::NEG_INFINITY; 3];
        for p in &self.vertices {
            for k in 0..3 {
                lo[k] = lo[k].min(p[k]);
                hi[k] = hi[k].max(p[k]);
            }
        }
        (lo, hi)
    }
}
