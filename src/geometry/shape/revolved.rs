// SPDX-License-Identifier: MIT OR Apache-2.0
//! Solids of revolution: a profile in the half plane (r >= 0, z) around any axis.

use super::support::{UNIT, across, box_around, numbers};
use super::{Facts, Shape};
use crate::math::{Vec3, length, unit};
use crate::store::Packer;

/// A signed distance in the half plane, which the solid inherits.
pub(in crate::geometry) trait Profile: Send + Sync {
    /// First word of the fingerprint.
    const KIND: u64;

    /// Exact inside and outside, the axis being no surface.
    fn value(&self, r: f64, z: f64) -> f64;

    /// Of length 1.
    fn gradient(&self, r: f64, z: f64) -> [f64; 2];

    /// The largest r * s + z * c of the profile, s >= 0; infinite where there is none.
    fn support(&self, s: f64, c: f64) -> f64;

    /// How far points of a bounded profile are from the origin, or the largest of its numbers.
    fn size(&self) -> f64;

    /// As in `Facts`: outward, inward.
    fn reach(&self) -> (f64, f64);

    /// The numbers that define it.
    fn numbers(&self, add: &mut dyn FnMut(f64));

    /// The same, with whatever else there is.
    fn pack(&self, out: &mut Packer) {
        self.numbers(&mut |x| out.number(x));
    }

    /// Memory on the heap.
    fn heap(&self) -> usize {
        0
    }
}

pub(in crate::geometry) struct Revolved<P> {
    pub(super) origin: Vec3,
    /// Of length 1.
    pub(super) axis: Vec3,
    pub(super) profile: P,
}

impl<P: Profile> Revolved<P> {
    /// z and the vector from the axis, both to a few roundings of |p - origin|.
    fn split(&self, p: Vec3) -> (f64, Vec3) {
        let d = p - self.origin;
        let z = d.dot(self.axis);
        (z, d - self.axis * z)
    }
}

impl<P: Profile> Shape for Revolved<P> {
    fn value(&self, p: Vec3) -> f64 {
        let (z, off) = self.split(p);
        self.profile.value(length(off), z)
    }

    /// On the axis, where every direction across it is as good: one of them.
    fn gradient(&self, p: Vec3) -> Vec3 {
        let (z, off) = self.split(p);
        let [from_axis, along] = self.profile.gradient(length(off), z);
        let away = unit(off);
        // What rounding alone put off the axis may point along it.
        let away = away - self.axis * away.dot(self.axis);
        let away = if length(away) < 0.5 { across(self.axis) } else { unit(away) };
        unit(away * from_axis + self.axis * along)
    }

    fn facts(&self) -> Facts {
        let across_axis = |k: usize| {
            let (u, v) = (self.axis[(k + 1) % 3], self.axis[(k + 2) % 3]);
            (u * u + v * v).sqrt()
        };
        let reach = |sign: f64| {
            let along = |k: usize| self.profile.support(across_axis(k), sign * self.axis[k]);
            Vec3::new(along(0), along(1), along(2))
        };
        let size = self.profile.size();
        let bounds = box_around(self.origin, reach(-1.0), reach(1.0), size);
        let (reach_outward, reach_inward) = self.profile.reach();
        let rounding = (UNIT, UNIT * (self.origin.abs().max_element() + size));
        Facts { reach_outward, reach_inward, rounding, ..Facts::exact(bounds, size) }
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(P::KIND);
        numbers(add, self.origin.to_array().into_iter().chain(self.axis.to_array()));
        self.profile.numbers(&mut |x| add((x + 0.0).to_bits()));
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(P::KIND);
        out.vector(self.origin);
        out.vector(self.axis);
        self.profile.pack(out);
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + self.profile.heap()
    }
}
