// SPDX-License-Identifier: MIT OR Apache-2.0
//! A box in any orientation, its edges rounded or not: the distance to its core less the rounding, exact
//! inside too because both only move planes.

use super::pack::{ROUNDED_BOX, not_negative};
use super::support::{UNIT, box_around, numbers};
use super::{Crossings, Facts, Shape};
use crate::error::{Error, Result};
use crate::geometry::build::{self, finite, positive};
use crate::geometry::placement::Placement;
use crate::math::{Aabb, Mat3, Vec3};
use crate::primitive::cuboid;
use crate::store::{Packer, Unpacker};

pub(in crate::geometry) struct RoundedBox {
    place: Placement,
    core: Aabb,
    radius: f64,
}

impl RoundedBox {
    /// `half` are the outer half sizes, the rounding included.
    pub(in crate::geometry) fn new(
        center: [f64; 3],
        half: [f64; 3],
        radius: f64,
        rotation: Option<[f64; 9]>,
    ) -> Result<RoundedBox> {
        let place = placement(center, "center", rotation)?;
        for (k, &h) in half.iter().enumerate() {
            positive(&format!("half[{k}]"), h)?;
        }
        let half = Vec3::from_array(half);
        let (radius, most) = (build::not_negative("radius", radius)?, half.min_element());
        if radius > most {
            return Err(Error::invalid(format!("radius: {radius} is above the least half size {most}")));
        }
        let core = half - Vec3::splat(radius);
        Ok(RoundedBox { place, core: Aabb::new(-core, core), radius })
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<RoundedBox> {
        let (place, core) = (Placement::unpack(from)?, Vec3::from_array(not_negative(from)?));
        let [radius] = not_negative(from)?;
        Ok(RoundedBox { place, core: Aabb::new(-core, core), radius })
    }
}

/// The frame at `origin` turned by `rotation`.
pub(super) fn placement(origin: [f64; 3], name: &str, rotation: Option<[f64; 9]>) -> Result<Placement> {
    Placement::new(rotation.unwrap_or(Mat3::IDENTITY.to_cols_array()), finite(name, origin)?)
}

impl Shape for RoundedBox {
    fn value(&self, p: Vec3) -> f64 {
        cuboid::value(self.core, self.place.to_body(p)) - self.radius
    }

    fn gradient(&self, p: Vec3) -> Vec3 {
        self.place.direction(cuboid::gradient(self.core, self.place.to_body(p)))
    }

    fn facts(&self) -> Facts {
        let half = self.core.hi + Vec3::splat(self.radius);
        let (size, shift) = (half.dot(Vec3::ONE), self.place.shift().abs().max_element());
        let bounds = self.place.box_to_space(box_around(Vec3::ZERO, half, half, size));
        let rounding = (UNIT, UNIT * (shift + size));
        Facts { reach_inward: self.radius, rounding, ..Facts::convex(bounds, size) }
    }

    /// Known where the edges are sharp.
    fn crossings(&self, a: Vec3, b: Vec3) -> Crossings {
        if self.radius > 0.0 {
            return Crossings::Unknown;
        }
        let at = |(t, normal): (f64, Vec3)| (t, self.place.direction(normal));
        match cuboid::interval(self.core, self.place.to_body(a), self.place.to_body(b)) {
            Some((enter, leave)) => Crossings::Between(at(enter), at(leave)),
            None => Crossings::Misses,
        }
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(ROUNDED_BOX);
        numbers(add, self.place.numbers().chain(self.core.hi.to_array()).chain([self.radius]));
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(ROUNDED_BOX);
        self.place.pack(out);
        out.vector(self.core.hi);
        out.number(self.radius);
    }

    fn bytes(&self) -> usize {
        size_of::<RoundedBox>()
    }
}
