// SPDX-License-Identifier: MIT OR Apache-2.0
//! Checks of the arguments of shapes; each error names the argument and the value.

use super::finite;
use crate::error::{Error, Result};
use crate::math::{Vec3, length, unit};

/// The number, where it is finite.
pub(in crate::geometry) fn finite_number(name: &str, x: f64) -> Result<f64> {
    if x.is_finite() { Ok(x) } else { Err(Error::invalid(format!("{name}: {x} is not finite"))) }
}

/// The number, where it is finite and > 0.
pub(in crate::geometry) fn positive(name: &str, x: f64) -> Result<f64> {
    if x > 0.0 && x.is_finite() { Ok(x) } else { Err(Error::invalid(format!("{name}: {x} is not finite and > 0"))) }
}

/// The number, where it is finite and >= 0.
pub(in crate::geometry) fn not_negative(name: &str, x: f64) -> Result<f64> {
    if x >= 0.0 && x.is_finite() {
        Ok(x + 0.0)
    } else {
        Err(Error::invalid(format!("{name}: {x} is not finite and >= 0")))
    }
}

/// The vector scaled to length 1.
pub(in crate::geometry) fn direction(name: &str, v: [f64; 3]) -> Result<Vec3> {
    let u = unit(finite(name, v)?);
    if u == Vec3::ZERO {
        return Err(Error::invalid(format!("{name}: ({}, {}, {}) has no direction", v[0], v[1], v[2])));
    }
    // Without -0.0: equal directions have equal fingerprints.
    Ok(u + Vec3::ZERO)
}

/// From `a` to `b`: the direction and the length. `names` are those of a, b and the difference.
pub(in crate::geometry) fn between(names: [&str; 3], a: [f64; 3], b: [f64; 3]) -> Result<(Vec3, f64)> {
    let step = finite(names[1], b)? - finite(names[0], a)?;
    let along = direction(names[2], step.to_array())?;
    Ok((along, positive(names[2], length(step))?))
}

/// Sine and cosine of half a full angle in degrees, between 0 and 180.
pub(in crate::geometry) fn half_angle(name: &str, degrees: f64) -> Result<(f64, f64)> {
    if !(degrees > 0.0 && degrees < 180.0) {
        return Err(Error::invalid(format!("{name}: {degrees} is not above 0 and below 180")));
    }
    let half = degrees * (std::f64::consts::PI / 360.0);
    let (sin, cos) = (libm::sin(half), libm::cos(half));
    Ok((positive(name, sin)?, positive(name, cos)?))
}
