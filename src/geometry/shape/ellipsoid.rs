// SPDX-License-Identifier: MIT OR Apache-2.0
//! The ellipsoid in any orientation.

use super::pack::ELLIPSOID;
use super::rounded_box::placement;
use super::support::{UNIT, box_around, numbers};
use super::{Crossings, Facts, Shape};
use crate::error::{Error, Result};
use crate::geometry::build::positive;
use crate::geometry::placement::Placement;
use crate::math::{Vec3, unit};
use crate::primitive::{ellipsoid, sphere};
use crate::store::{Packer, Unpacker};

pub(in crate::geometry) struct Ellipsoid {
    place: Placement,
    body: ellipsoid::Ellipsoid,
}

impl Ellipsoid {
    pub(in crate::geometry) fn new(center: [f64; 3], axes: [f64; 3], rotation: Option<[f64; 9]>) -> Result<Ellipsoid> {
        Ellipsoid::placed(placement(center, "center", rotation)?, axes)
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Ellipsoid> {
        Ellipsoid::placed(Placement::unpack(from)?, from.numbers()?)
    }

    fn placed(place: Placement, axes: [f64; 3]) -> Result<Ellipsoid> {
        for (k, &e) in axes.iter().enumerate() {
            positive(&format!("semi_axes[{k}]"), e)?;
        }
        let (least, most) = axes.iter().fold((f64::INFINITY, 0.0f64), |(a, b), &e| (a.min(e), b.max(e)));
        if most / least > MOST_RATIO {
            return Err(Error::invalid(format!(
                "semi_axes: {most:e} is more than {MOST_RATIO:e} times {least:e}, which is beyond the range of numbers"
            )));
        }
        Ok(Ellipsoid { place, body: ellipsoid::Ellipsoid::new(Vec3::from_array(axes)) })
    }
}

/// Ratios whose squares numbers can hold with room for points.
const MOST_RATIO: f64 = 1e100;

impl Shape for Ellipsoid {
    fn value(&self, p: Vec3) -> f64 {
        self.body.value(self.place.to_body(p))
    }

    fn gradient(&self, p: Vec3) -> Vec3 {
        self.place.direction(self.body.gradient(self.place.to_body(p)))
    }

    /// The root is stable: an error in its equation is one of the surface, along its normal, of the same
    /// share of the greatest axis, whatever the ratio of the axes is.
    fn facts(&self) -> Facts {
        let axes = self.body.axes();
        let (least, most) = (axes.min_element(), axes.max_element());
        let bounds = self.place.box_to_space(box_around(Vec3::ZERO, axes, axes, most));
        let rounding = (UNIT, UNIT * (self.place.shift().abs().max_element() + most));
        Facts { reach_inward: least * (least / most), rounding, ..Facts::convex(bounds, most) }
    }

    /// In coordinates that make it a ball of radius 1.
    fn crossings(&self, a: Vec3, b: Vec3) -> Crossings {
        let axes = self.body.axes();
        let (a, b) = (self.place.to_body(a) / axes, self.place.to_body(b) / axes);
        let at = |t: f64| (t, self.place.direction(unit((a + (b - a) * t) / axes)));
        match sphere::interval(Vec3::ZERO, 1.0, a, b) {
            Some((enter, leave)) => Crossings::Between(at(enter), at(leave)),
            None => Crossings::Misses,
        }
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(ELLIPSOID);
        numbers(add, self.place.numbers().chain(self.body.axes().to_array()));
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(ELLIPSOID);
        self.place.pack(out);
        out.vector(self.body.axes());
    }

    fn bytes(&self) -> usize {
        size_of::<Ellipsoid>()
    }
}
