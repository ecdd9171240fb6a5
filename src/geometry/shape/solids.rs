// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constructors of the solids of revolution.

use super::outline::Outline;
use super::revolved::Revolved;
use crate::error::{Error, Result};
use crate::geometry::build::{between, direction, finite, half_angle, not_negative, positive};
use crate::primitive::profile::{Cone, Ring, Slab, Wedge};

impl Revolved<Ring> {
    pub(in crate::geometry) fn torus(center: [f64; 3], axis: [f64; 3], major: f64, minor: f64) -> Result<Self> {
        let (origin, axis) = (finite("center", center)?, direction("axis", axis)?);
        let profile = Ring { major: positive("major", major)?, minor: positive("minor", minor)? };
        if minor >= major {
            return Err(Error::invalid(format!("minor: {minor} is not below major = {major}")));
        }
        Ok(Revolved { origin, axis, profile })
    }
}

impl Revolved<Slab> {
    pub(in crate::geometry) fn cylinder(a: [f64; 3], b: [f64; 3], radius: f64) -> Result<Self> {
        let (axis, hi) = between(["a", "b", "b - a"], a, b)?;
        let profile = Slab { radius: positive("radius", radius)?, lo: 0.0, hi, rounding: 0.0 };
        Ok(Revolved { origin: finite("a", a)?, axis, profile })
    }

    pub(in crate::geometry) fn infinite_cylinder(point: [f64; 3], axis: [f64; 3], radius: f64) -> Result<Self> {
        let (origin, axis) = (finite("point", point)?, direction("axis", axis)?);
        let rounding = positive("radius", radius)?;
        let profile = Slab { radius: 0.0, lo: f64::NEG_INFINITY, hi: f64::INFINITY, rounding };
        Ok(Revolved { origin, axis, profile })
    }

    pub(in crate::geometry) fn capsule(a: [f64; 3], b: [f64; 3], radius: f64) -> Result<Self> {
        let (axis, hi) = between(["a", "b", "b - a"], a, b)?;
        let profile = Slab { radius: 0.0, lo: 0.0, hi, rounding: positive("radius", radius)? };
        Ok(Revolved { origin: finite("a", a)?, axis, profile })
    }

    pub(in crate::geometry) fn capsule_tips(tip_a: [f64; 3], tip_b: [f64; 3], radius: f64) -> Result<Self> {
        let (axis, length) = between(["tip_a", "tip_b", "tip_b - tip_a"], tip_a, tip_b)?;
        let profile = Slab { radius: 0.0, lo: radius, hi: length - radius, rounding: positive("radius", radius)? };
        if profile.lo >= profile.hi {
            return Err(Error::invalid(format!(
                "radius: {radius} is not below half the distance {length} of the tips"
            )));
        }
        Ok(Revolved { origin: finite("tip_a", tip_a)?, axis, profile })
    }

    pub(in crate::geometry) fn rounded_cylinder(
        center: [f64; 3],
        axis: [f64; 3],
        radius: f64,
        height: f64,
        rounding: f64,
    ) -> Result<Self> {
        let (origin, axis) = (finite("center", center)?, direction("axis", axis)?);
        let half = positive("height", height)? * 0.5;
        let most = positive("radius", radius)?.min(half);
        if not_negative("rounding", rounding)? > most {
            return Err(Error::invalid(format!(
                "rounding: {rounding} is above {most}, the lesser of radius and height / 2"
            )));
        }
        let core = half - rounding;
        Ok(Revolved { origin, axis, profile: Slab { radius: radius - rounding, lo: 0.0 - core, hi: core, rounding } })
    }
}

impl Revolved<Wedge> {
    pub(in crate::geometry) fn infinite_cone(tip: [f64; 3], axis: [f64; 3], angle: f64) -> Result<Self> {
        let (origin, axis) = (finite("tip", tip)?, direction("axis", axis)?);
        let (sin, cos) = half_angle("angle", angle)?;
        Ok(Revolved { origin, axis, profile: Wedge { sin, cos } })
    }
}

impl Revolved<Cone> {
    pub(in crate::geometry) fn cone(tip: [f64; 3], axis: [f64; 3], height: f64, angle: f64) -> Result<Self> {
        let (origin, axis) = (finite("tip", tip)?, direction("axis", axis)?);
        let height = positive("height", height)?;
        let (sin, cos) = half_angle("angle", angle)?;
        let no_base = || Error::invalid(format!("angle: {angle} gives a base of radius {}", height * (sin / cos)));
        Ok(Revolved { origin, axis, profile: Cone::new(sin, cos, height).ok_or_else(no_base)? })
    }
}

impl Revolved<Outline> {
    pub(in crate::geometry) fn polygon(origin: [f64; 3], axis: [f64; 3], points: &[[f64; 2]]) -> Result<Self> {
        let (origin, axis) = (finite("origin", origin)?, direction("axis", axis)?);
        Ok(Revolved { origin, axis, profile: Outline::revolved(points)? })
    }
}
