// SPDX-License-Identifier: MIT OR Apache-2.0
//! How vertices and faces become a mesh.

use crate::error::{Error, Result};
use crate::math::Vec3;

/// What to do about the orientation of faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Orient {
    /// Consistent and outward: neighbours agree, a body's outer shell faces outward and its cavities
    /// inward. Shells that agree already keep their orientation relative to the shell around them;
    /// `orient.rs` has the whole rule. Open shells only become consistent.
    #[default]
    Auto,
    /// As given.
    Keep,
    /// Every face turned over, nothing else.
    Flip,
    /// As [`Orient::Auto`], but every closed shell alternates with those around it, whatever it was as given:
    /// outermost shells face outward, those within them inward, and so on.
    Alternate,
}

/// A point of the input becomes `shift + scale * rotation * p`, in f64, before welding.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshOptions {
    /// Uniform scale, > 0 and finite.
    pub scale: f64,
    /// Row-major rotation matrix, proper to 1e-9.
    pub rotation: [f64; 9],
    /// Shift, after scale and rotation; finite.
    pub shift: [f64; 3],
    /// Vertices nearer than this times the diagonal become one, and so do chains of them; 0: those with
    /// equal positions (-0.0 equals 0.0); -1: none. Otherwise between 1e-12 and 0.5. Of meshes that stand
    /// ([`super::Mesh::join`]) 0 welds none either.
    pub weld_tolerance: f64,
    /// Orientation.
    pub orient: Orient,
    /// First index of `indices`: 0 or 1.
    pub index_base: u32,
}

/// Whether vertices can be welded within this part of the diagonal.
pub(super) fn is_tolerance(weld: f64) -> bool {
    weld == 0.0 || (1e-12..=0.5).contains(&weld)
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

impl MeshOptions {
    /// Every value is in its range, or [`crate::Status::InvalidArgument`] naming the one that is not.
    pub fn check(&self) -> Result<()> {
        if !(self.scale > 0.0 && self.scale.is_finite()) {
            return Err(Error::invalid(format!("options.scale: {} is not finite and above 0", self.scale)));
        }
        if let Some(k) = self.shift.iter().position(|c| !c.is_finite()) {
            return Err(Error::invalid(format!("options.shift[{k}]: {} is not finite", self.shift[k])));
        }
        let w = self.weld_tolerance;
        if !(w == -1.0 || is_tolerance(w)) {
            return Err(Error::invalid(format!(
                "options.weld_tolerance: {w} is neither 0, nor -1, nor between 1e-12 and 0.5"
            )));
        }
        if self.index_base > 1 {
            return Err(Error::invalid(format!("options.index_base: {} is neither 0 nor 1", self.index_base)));
        }
        self.check_rotation()
    }

    fn check_rotation(&self) -> Result<()> {
        let r = &self.rotation;
        if let Some(k) = r.iter().position(|c| !c.is_finite()) {
            return Err(Error::invalid(format!("options.rotation[{k}]: {} is not finite", r[k])));
        }
        let row = |i: usize| Vec3::new(r[3 * i], r[3 * i + 1], r[3 * i + 2]);
        for (i, j) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)] {
            let (product, wanted) = (row(i).dot(row(j)), if i == j { 1.0 } else { 0.0 });
            let error = (product - wanted).abs();
            // Huge entries may overflow to a NaN.
            if error.is_nan() || error > 1e-9 {
                return Err(Error::invalid(format!(
                    "options.rotation: the product of rows {i} and {j} is {product}, of a rotation {wanted}"
                )));
            }
        }
        let determinant = row(0).dot(row(1).cross(row(2)));
        if determinant < 0.0 {
            return Err(Error::invalid(format!("options.rotation: the determinant is {determinant}: a reflection")));
        }
        Ok(())
    }

    /// Where a point of the input comes to lie. -0.0 becomes 0.0, so equal positions have equal bits.
    pub(super) fn place(&self, p: Vec3) -> Vec3 {
        let (r, s) = (&self.rotation, self.scale);
        let row = |i: usize| self.shift[i] + s * (r[3 * i] * p.x + r[3 * i + 1] * p.y + r[3 * i + 2] * p.z) + 0.0;
        Vec3::new(row(0), row(1), row(2))
    }
}
