// SPDX-License-Identifier: MIT OR Apache-2.0
//! Placement: a rotation or a reflection, a uniform scale and a shift, and how they compose.

use crate::error::{Error, Result};
use crate::math::{Aabb, Mat3, Vec3};
use crate::store::{Packer, Unpacker, wrong};

/// A point q of the body comes to `scale * rotation * q + shift`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    /// Orthogonal: a rotation or a reflection.
    rotation: Mat3,
    inverse: Mat3,
    scale: f64,
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
                "rotation: off an orthogonal matrix by {off:e}, more than {TOLERANCE:e}"
            )));
        }
        if rotation.determinant() < 0.0 {
            return Err(Error::invalid("rotation: determinant -1 is a reflection"));
        }
        Ok(Placement::orthonormal(rotation, 1.0, shift))
    }

    /// One Newton step towards the nearest orthogonal matrix; one of zeros and ones stays as it is.
    fn orthonormal(m: Mat3, scale: f64, shift: Vec3) -> Placement {
        let rotation = m * ((Mat3::IDENTITY * 3.0 - m.transpose() * m) * 0.5);
        Placement { rotation, inverse: rotation.transpose(), scale, shift }
    }

    /// Only a shift.
    pub(super) fn translation(shift: Vec3) -> Placement {
        Placement { rotation: Mat3::IDENTITY, inverse: Mat3::IDENTITY, scale: 1.0, shift }
    }

    /// Only a scale, about the origin.
    pub(super) fn scaling(scale: f64) -> Placement {
        Placement { scale, ..Placement::translation(Vec3::ZERO) }
    }

    /// By an angle in degrees, right-handed, about a unit axis through a point. Multiples of 90 degrees about
    /// an axis of coordinates are exact.
    pub(super) fn turn(axis: Vec3, degrees: f64, point: Vec3) -> Placement {
        let (sin, cos) = sin_cos_degrees(degrees);
        let (x, y, z) = (axis.x, axis.y, axis.z);
        let cross = Mat3::from_cols(Vec3::new(0.0, z, -y), Vec3::new(-z, 0.0, x), Vec3::new(y, -x, 0.0));
        let along = Mat3::from_cols(axis * x, axis * y, axis * z);
        // Rodrigues' formula.
        let rotation = Mat3::IDENTITY * cos + cross * sin + along * (1.0 - cos);
        let turned = Placement::orthonormal(rotation, 1.0, Vec3::ZERO);
        Placement { shift: point - turned.rotation * point, ..turned }
    }

    /// In the plane through a point with this unit normal.
    pub(super) fn reflection(point: Vec3, normal: Vec3) -> Placement {
        let along = Mat3::from_cols(normal * normal.x, normal * normal.y, normal * normal.z);
        let mirror = Placement::orthonormal(Mat3::IDENTITY - along * 2.0, 1.0, Vec3::ZERO);
        Placement { shift: point - mirror.rotation * point, ..mirror }
    }

    /// First `first`, then `self`.
    pub(super) fn after(&self, first: &Placement) -> Placement {
        Placement::orthonormal(self.rotation * first.rotation, self.scale * first.scale, self.to_space(first.shift))
    }

    pub(super) fn pack(self, out: &mut Packer) {
        out.numbers(self.numbers());
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Placement> {
        let rotation = Mat3::from_cols_array(&from.numbers()?);
        let (shift, scale) = (from.vector()?, from.finite()?);
        let inverse = rotation.transpose();
        let off =
            (inverse * rotation - Mat3::IDENTITY).to_cols_array().into_iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        if off > TOLERANCE || !(scale > 0.0 && scale.is_normal() && (1.0 / scale).is_normal()) {
            return Err(wrong("a placement is none"));
        }
        Ok(Placement { rotation, inverse, scale, shift })
    }

    /// What the value is multiplied by.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// A point of space, seen from the body.
    pub(super) fn to_body(self, p: Vec3) -> Vec3 {
        let q = self.inverse * (p - self.shift);
        if self.scale == 1.0 { q } else { q / self.scale }
    }

    /// A point of the body, in space.
    pub(super) fn to_space(self, q: Vec3) -> Vec3 {
        let q = if self.scale == 1.0 { q } else { q * self.scale };
        self.rotation * q + self.shift
    }

    /// A direction of the body, in space.
    pub(super) fn direction(self, v: Vec3) -> Vec3 {
        self.rotation * v
    }

    /// A direction of space, seen from the body, so that places along it keep their number.
    pub(super) fn direction_to_body(self, v: Vec3) -> Vec3 {
        let v = self.inverse * v;
        if self.scale == 1.0 { v } else { v / self.scale }
    }

    /// A box of the body, in space: a box around it, rounding included.
    pub(super) fn box_to_space(self, b: Aabb) -> Aabb {
        around(b, self.rotation * self.scale, self.shift, |c| self.to_space(c))
    }

    /// A box of space, seen from the body: it holds [`Placement::to_body`] of each of its points.
    pub(super) fn box_to_body(self, b: Aabb) -> Aabb {
        around(b, self.inverse * (1.0 / self.scale), self.shift, |c| self.to_body(c))
    }

    /// The magnitude beyond which a value of the body is beyond `far` in space.
    pub(super) fn before(self, far: f64) -> f64 {
        (far / self.scale).next_up()
    }

    pub(super) fn shift(self) -> Vec3 {
        self.shift
    }

    pub(super) fn numbers(self) -> impl Iterator<Item = f64> {
        self.rotation.to_cols_array().into_iter().chain(self.shift.to_array()).chain([self.scale])
    }
}

/// Around a box mapped by `turn`, whose middle `map` maps: it holds every mapped point, rounding included.
/// Corners in wrong order, of a box that there is not, are put in order.
pub(super) fn around(b: Aabb, turn: Mat3, shift: Vec3, map: impl Fn(Vec3) -> Vec3) -> Aabb {
    if b == Aabb::EMPTY {
        return b;
    }
    if !b.is_finite() {
        // Only a turned slab could be bounded more tightly; all of space is always right.
        return Aabb::ALL;
    }
    let half = ((b.hi - b.lo) * 0.5).abs();
    let columns = [turn.x_axis.abs(), turn.y_axis.abs(), turn.z_axis.abs()];
    let reach = columns[0] * half.x + columns[1] * half.y + columns[2] * half.z;
    let extent = b.lo.abs().max(b.hi.abs()).max_element() + shift.abs().max_element();
    let size = (columns[0] + columns[1] + columns[2]).max_element().max(1.0);
    let reach = reach + Vec3::splat(32.0 * f64::EPSILON * extent * size);
    let center = map(b.center());
    Aabb::new(center - reach, center + reach)
}

/// Sine and cosine of an angle in degrees; exact for multiples of 90.
pub(super) fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let turns = libm::rint(degrees / 90.0);
    let rest = (degrees - turns * 90.0) * (std::f64::consts::PI / 180.0);
    let (sin, cos) = if rest == 0.0 { (0.0, 1.0) } else { (libm::sin(rest), libm::cos(rest)) };
    match turns.rem_euclid(4.0) as i32 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}
