// SPDX-License-Identifier: MIT OR Apache-2.0
//! How vertices and faces become a mesh.

/// What to do about the orientation of faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Orient {
    /// Consistent and outward: see `orient.rs` for the rule.
    #[default]
    Auto,
    /// As given.
    Keep,
    /// Every face turned over, nothing else.
    Flip,
}

/// A point of the input becomes `shift + scale * rotation * p`, in f64, before welding.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshOptions {
    /// Uniform scale, > 0.
    pub scale: f64,
    /// Row-major rotation matrix.
    pub rotation: [f64; 9],
    /// Shift, after scale and rotation.
    pub shift: [f64; 3],
    /// Vertices nearer than this times the diagonal become one; 0: those with equal positions.
    pub weld_tolerance: f64,
    /// Orientation.
    pub orient: Orient,
    /// First index of `indices`: 0 or 1.
    pub index_base: u32,
}

impl Default for MeshOptions {
    fn default() -> MeshOptions {
        MeshOptions {
            scale: 1.0,
            rotation: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
            shift: [0.0; 3],
            weld_tolerance: 0.0,
            orient: Orient::Auto,
            index_base: 0,
        }
    }
}
