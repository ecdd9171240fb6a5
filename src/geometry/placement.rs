// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rigid placement: a rotation and a shift, and how they compose.

use crate::error::{Error, Result};
use crate::math::{Aabb, Mat3, Vec3};

/// A point q of the body comes to `rotation * q + shift`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    rotation: Mat3,
    inverse: Mat3,
    shift: Vec3,
}

/// How far a given matrix may be from a rotation.
const TOLERANCE: f64 = 1e-9;

impl Placement {
    /// From a row-major matrix that is a rotation to within [`TOLERANCE`]; it is made one to rounding.
    pub(super) fn new(rotation: [f64; 9], shift: Vec3) -> Result<Placement> {
        if let Some(k) = rotation.iter().position(|c| !c.is_finite()) {
            return Err(Error::invalid(format!("rotation[{k}]: {} is not finite", rotation[k])));
        }
        let rotation = Mat3::from_cols_array(&rotation).transpose();
        let gram = rotation.transpose() * rotation;
        let off = (gram - Mat3::IDENTITY).to_cols_array().into_iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        if off > TOLERANCE {
            return Err(Error::invalid(format!(
                "rotation: off an orthogonal matrix by {off}, more than {TOLERANCE:e}"
            )));
        }
        if rotation.determinant() < 0.0 {
            return Err(Error::invalid("rotation: determinant -1 is a reflection"));
        }
        Ok(Placement::orthonormal(rotation, shift))
    }

    /// One Newton step towards the nearest rotation; a rotation by multiples of 90 degrees stays as is.
    fn orthonormal(m: Mat3, shift: Vec3) -> Placement {
        let rotation = m * ((Mat3::IDENTITY * 3.0 - m.transpose() * m) * 0.5);
        Placement { rotation, inverse: rotation.transpose(), shift }
    }

    /// Only a shift.
    pub(super) fn translation(shift: Vec3) -> Placement {
        Placement { rotation: Mat3::IDENTITY, inverse: Mat3::IDENTITY, shift }
    }

    /// First `first`, then `self`.
    pub(super) fn after(&self, first: &Placement) -> Placement {
        Placement::orthonormal(self.rotation * first.rotation, self.rotation * first.shift + self.shift)
    }

    /// A point of space, seen from the body.
    pub(super) fn to_body(self, p: Vec3) -> Vec3 {
        self.inverse * (p - self.shift)
    }

    /// A point of the body, in space.
    pub(super) fn to_space(self, q: Vec3) -> Vec3 {
        self.rotation * q + self.shift
    }

    /// A direction of the body, in space.
    pub(super) fn direction(self, v: Vec3) -> Vec3 {
        self.rotation * v
    }

    /// A box of the body, in space: a box around it, rounding included.
    pub(super) fn box_to_space(self, b: Aabb) -> Aabb {
        around(b, self.rotation, self.to_space(Vec3::ZERO), |c| self.to_space(c))
    }

    /// A box of space, seen from the body: it holds [`Placement::to_body`] of each of its points.
    pub(super) fn box_to_body(self, b: Aabb) -> Aabb {
        around(b, self.inverse, self.shift, |c| self.to_body(c))
    }

    /// Rounding of [`Placement::to_body`] for coordinates up to `extent`.
    pub(super) fn rounding(self, extent: f64) -> f64 {
        16.0 * f64::EPSILON * (extent + self.shift.abs().max_element())
    }

    pub(super) fn shift(self) -> Vec3 {
        self.shift
    }

    pub(super) fn numbers(self) -> impl Iterator<Item = f64> {
        self.rotation.to_cols_array().into_iter().chain(self.shift.to_array())
    }
}

fn around(b: Aabb, turn: Mat3, shift: Vec3, map: impl Fn(Vec3) -> Vec3) -> Aabb {
    if b.is_empty() {
        return Aabb::EMPTY;
    }
    if !b.is_finite() {
        // Only a turned slab could be bounded more tightly; all of space is always right.
        return Aabb::ALL;
    }
    let half = (b.hi - b.lo) * 0.5;
    let reach = turn.x_axis.abs() * half.x + turn.y_axis.abs() * half.y + turn.z_axis.abs() * half.z;
    let extent = b.lo.abs().max(b.hi.abs()).max_element() + shift.abs().max_element();
    let reach = reach + Vec3::splat(32.0 * f64::EPSILON * extent);
    let center = map(b.center());
    Aabb::new(center - reach, center + reach)
}
