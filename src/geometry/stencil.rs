// SPDX-License-Identifier: MIT OR Apache-2.0
//! Smoothed bodies: the value is a mean of the child's values at points around, with weights that are not
//! negative and add up to one.

use super::Geometry;
use super::closest::Closest;
use super::properties::Kind;
use super::summary::{ROOT_OF_THREE, Summary, grown};
use crate::error::{Error, Result, try_with_capacity};
use crate::math::{Aabb, Interval, Vec3};
use crate::store::{Packer, Unpacker, wrong};

pub(super) struct Stencil {
    /// Offset and weight of each sample.
    samples: Vec<(Vec3, f64)>,
    /// Largest offset along an axis.
    reach: f64,
}

impl Stencil {
    /// 27 points at 0 and +-h along each axis; one displaced along n axes weighs alpha^(3-n) ((1-alpha)/2)^n.
    pub(super) fn blur(h: f64, alpha: f64) -> Result<Stencil> {
        let side = (1.0 - alpha) * 0.5;
        Stencil::product(&[(-h, side), (0.0, alpha), (h, side)])
    }

    /// `count` points evenly in [-d, d] along each axis with binomial weights, which are exact.
    pub(super) fn mollify(d: f64, count: usize) -> Result<Stencil> {
        let last = count - 1;
        let mut along = try_with_capacity("samples", count)?;
        let mut binomial = 1.0;
        for k in 0..count {
            let place = if last == 0 { 0.0 } else { (2.0 * k as f64 - last as f64) / last as f64 };
            along.push((place * d, binomial));
            binomial = binomial * (last - k) as f64 / (k + 1) as f64;
        }
        let total: f64 = along.iter().map(|(_, w)| w).sum();
        along.iter_mut().for_each(|(_, w)| *w /= total);
        Stencil::product(&along)
    }

    fn product(along: &[(f64, f64)]) -> Result<Stencil> {
        let mut samples = try_with_capacity("samples", along.len() * along.len() * along.len())?;
        for (z, c) in along {
            for (y, b) in along {
                samples.extend(along.iter().map(|(x, a)| (Vec3::new(*x, *y, *z), a * b * c)));
            }
        }
        samples.retain(|(_, weight)| *weight > 0.0);
        let reach = along.iter().fold(0.0, |m: f64, (x, _)| m.max(x.abs()));
        if samples.is_empty() {
            return Err(Error::invalid("weights: all of them are zero"));
        }
        Ok(Stencil { samples, reach })
    }

    pub(super) fn pack(&self, out: &mut Packer) {
        out.word(self.samples.len() as u64);
        out.numbers(self.samples.iter().flat_map(|(d, weight)| [d.x, d.y, d.z, *weight]));
        out.number(self.reach);
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Stencil> {
        let count = from.count(4, "samples")?;
        let mut samples = try_with_capacity("samples", count)?;
        for _ in 0..count {
            samples.push((from.vector()?, from.finite()?));
        }
        let stencil = Stencil { samples, reach: from.finite()? };
        let is_fit = |(_, weight): &(Vec3, f64)| *weight > 0.0;
        let is_mean = count > 0 && stencil.samples.iter().all(is_fit) && stencil.reach >= 0.0;
        if is_mean { Ok(stencil) } else { Err(wrong("a mean has no samples, or weights that are none")) }
    }

    pub(super) fn value(&self, g: &Geometry, p: Vec3) -> f64 {
        // Zero times an infinite value would be NaN, but no weight is zero.
        self.samples.iter().map(|(d, weight)| weight * g.raw_value(p + *d)).sum()
    }

    /// The sums that [`Stencil::value`] takes, side by side: `add` adds the child's values, displaced and weighed.
    pub(super) fn values(
        &self,
        sums: &mut [f64],
        mut add: impl FnMut(Vec3, f64, &mut [f64]) -> Result<()>,
    ) -> Result<()> {
        sums.fill(std::iter::empty::<f64>().sum());
        self.samples.iter().try_for_each(|(d, weight)| add(*d, *weight, sums))
    }

    /// Value and gradient, and what is known of the child at the point itself. Each sample is asked once: asked
    /// twice, means of means would take twice as long with each level.
    pub(super) fn closest(&self, g: &Geometry, p: Vec3) -> (f64, Vec3, Closest) {
        let (mut value, mut gradient, mut middle) = (0.0, Vec3::ZERO, None);
        for (d, weight) in &self.samples {
            let answer = g.raw_closest(p + *d);
            value += weight * answer.value;
            gradient += answer.gradient * *weight;
            if *d == Vec3::ZERO {
                middle = Some(answer);
            }
        }
        (value, gradient, middle.unwrap_or_else(|| g.raw_closest(p)))
    }

    /// The values of a box: those of the child around it, and the rounding of the sum.
    pub(super) fn range(&self, g: &Geometry, b: Aabb) -> Interval {
        self.range_of(g.range(self.around(b)))
    }

    /// Around all samples of a box.
    pub(super) fn around(&self, b: Aabb) -> Aabb {
        grown(b, Vec3::splat(self.reach))
    }

    /// The values of a box, from the child's around it.
    pub(super) fn range_of(&self, f: Interval) -> Interval {
        let rounding = 2.0 * f64::EPSILON * (self.samples.len() + 4) as f64;
        let widen = |x: f64| if x.is_finite() { x.abs() * rounding } else { 0.0 };
        Interval::new(f.lo - widen(f.lo).max(widen(f.hi)), f.hi + widen(f.lo).max(widen(f.hi)))
    }

    /// Of the node over a child of which `s` is known.
    pub(super) fn summary(&self, s: Summary) -> Summary {
        let rounding = 2.0 * f64::EPSILON * (self.samples.len() + 4) as f64;
        let (steep, reach) = (s.steepness(), ROOT_OF_THREE * self.reach);
        Summary {
            // Where the mean is not positive, one of the samples is not.
            bounds: grown(s.bounds, Vec3::splat(self.reach)),
            rest: grown(s.rest, Vec3::splat(self.reach)),
            kind: if s.lipschitz <= 1.0 { Kind::LowerBound } else { Kind::SignOnly },
            reach_outward: 0.0,
            reach_inward: 0.0,
            rounding: (
                s.rounding.0 + rounding * steep,
                s.rounding.1 + (s.rounding.0 + rounding * steep) * reach + rounding * s.magnitude,
            ),
            magnitude: s.magnitude + steep * reach,
            ..s
        }
    }

    pub(super) fn words(&self, add: &mut dyn FnMut(u64)) {
        add(self.samples.len() as u64);
        for (d, weight) in &self.samples {
            d.to_array().iter().chain([weight]).for_each(|x| add((x + 0.0).to_bits()));
        }
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.samples[..])
    }
}
