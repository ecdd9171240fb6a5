// SPDX-License-Identifier: MIT OR Apache-2.0
//! Perlin noise, summed over octaves (Perlin 2002).

use super::pack::PERLIN;
use super::support::numbers;
use super::{Facts, Shape};
use crate::error::{Error, Result};
use crate::geometry::build::{not_negative, positive};
use crate::math::{Aabb, Interval, Vec3};
use crate::primitive::noise;
use crate::store::{Packer, Unpacker};

const MAX_OCTAVES: u32 = 16;

pub(in crate::geometry) struct Perlin {
    amplitude: f64,
    frequency: Vec3,
    persistence: f64,
    octaves: u32,
    seed: u64,
    table: [u8; 256],
}

impl Perlin {
    pub(in crate::geometry) fn new(
        amplitude: f64,
        frequency: [f64; 3],
        persistence: f64,
        octaves: u32,
        seed: u64,
    ) -> Result<Perlin> {
        positive("amplitude", amplitude)?;
        for (k, &f) in frequency.iter().enumerate() {
            not_negative(&format!("frequency[{k}]"), f)?;
        }
        positive("persistence", persistence)?;
        if !(1..=MAX_OCTAVES).contains(&octaves) {
            return Err(Error::invalid(format!("octaves: {octaves} is not between 1 and {MAX_OCTAVES}")));
        }
        let frequency = Vec3::from_array(frequency) + Vec3::ZERO;
        let shape = Perlin { amplitude, frequency, persistence, octaves, seed, table: noise::permutation(seed) };
        if !shape.facts().lipschitz.is_finite() || !shape.magnitude().is_finite() {
            return Err(Error::invalid(format!("amplitude: {amplitude:e} makes values without bound")));
        }
        Ok(shape)
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Perlin> {
        let (amplitude, frequency, persistence) = (from.finite()?, from.numbers()?, from.finite()?);
        let octaves = from.index(1 << 31, "octaves")? as u32;
        Perlin::new(amplitude, frequency, persistence, octaves, from.word()?)
    }

    /// Factor of the coordinates and of the noise, octave by octave.
    fn octaves(&self) -> impl Iterator<Item = (f64, f64)> {
        let next = |&(scale, weight): &(f64, f64)| Some((scale * 2.0, weight * self.persistence));
        std::iter::successors(Some((1.0, self.amplitude)), next).take(self.octaves as usize)
    }

    /// Bound of |value|, its rounding included.
    fn magnitude(&self) -> f64 {
        self.octaves().map(|(_, weight)| weight).sum::<f64>() * (noise::MAGNITUDE * (1.0 + 1e-12))
    }
}

impl Shape for Perlin {
    fn value(&self, p: Vec3) -> f64 {
        let one = |(scale, weight): (f64, f64)| weight * noise::noise(&self.table, p * self.frequency * scale).0;
        self.octaves().map(one).fold(0.0, |sum, x| sum + x)
    }

    /// The true gradient: it may be zero.
    fn gradient(&self, p: Vec3) -> Vec3 {
        let one = |(scale, weight): (f64, f64)| {
            let slope = noise::noise(&self.table, p * self.frequency * scale).1;
            slope * self.frequency * (scale * weight)
        };
        self.octaves().map(one).fold(Vec3::ZERO, |sum, x| sum + x)
    }

    fn facts(&self) -> Facts {
        let steepest = self.octaves().map(|(scale, weight)| scale * weight).sum::<f64>();
        let lipschitz = steepest * self.frequency.max_element() * (noise::LIPSCHITZ * (1.0 + 1e-12));
        Facts {
            exact: false,
            lipschitz,
            spread: f64::INFINITY,
            reach_outward: 0.0,
            // Each coordinate is rounded once before its whole part is taken off, exactly.
            rounding: (2.0 * f64::EPSILON * lipschitz, 64.0 * f64::EPSILON * self.magnitude()),
            ..Facts::convex(Aabb::ALL, 0.0)
        }
    }

    fn range(&self, _b: Aabb) -> Interval {
        let most = self.magnitude();
        Interval::new(-most, most)
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(PERLIN);
        numbers(add, self.frequency.to_array().into_iter().chain([self.amplitude, self.persistence]));
        add(u64::from(self.octaves));
        add(self.seed);
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(PERLIN);
        out.number(self.amplitude);
        out.vector(self.frequency);
        out.number(self.persistence);
        out.word(u64::from(self.octaves));
        out.word(self.seed);
    }

    fn bytes(&self) -> usize {
        size_of::<Perlin>()
    }
}
