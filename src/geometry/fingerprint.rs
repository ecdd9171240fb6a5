// SPDX-License-Identifier: MIT OR Apache-2.0
//! A number that is equal for equal content on every rank, instruction set and run. Words are mixed by
//! the finaliser of SplitMix64 (Steele, Lea & Flood 2014).

use super::Geometry;
use super::node::Node;
use crate::math::Vec3;

impl Geometry {
    /// Equal for trees of equal content; 0 for trees with user functions. O(bytes).
    pub fn fingerprint(&self) -> u64 {
        if self.has_functions() {
            return 0;
        }
        let mut mixer = Mixer(0);
        self.mix(&mut mixer);
        mixer.0.max(1)
    }

    fn mix(&self, mixer: &mut Mixer) {
        match self.node() {
            Node::Sphere { center, radius } => mixer.add(1).vector(*center).number(*radius),
            Node::Cuboid(b) => mixer.add(2).vector(b.lo).vector(b.hi),
            Node::Surface(surface) => {
                mixer.add(3);
                surface.fingerprint(&mut |word| {
                    mixer.add(word);
                });
                mixer
            }
            Node::Function { .. } => mixer,
            Node::Union(parts) => mixer.add(4).parts(parts),
            Node::Intersection(parts) => mixer.add(5).parts(parts),
            Node::Complement(g) => mixer.add(6).part(g),
            Node::Translate(g, shift) => mixer.add(7).vector(*shift).part(g),
            Node::Place(g, placement) => placement.numbers().fold(mixer.add(8), |m, x| m.number(x)).part(g),
            Node::Part(g, label) => mixer.add(9).add(*label as u64).part(g),
        };
    }
}

struct Mixer(u64);

impl Mixer {
    fn add(&mut self, word: u64) -> &mut Mixer {
        let mut z = (self.0 ^ word).wrapping_add(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        self.0 = z ^ (z >> 31);
        self
    }

    fn number(&mut self, x: f64) -> &mut Mixer {
        self.add((x + 0.0).to_bits())
    }

    fn vector(&mut self, v: Vec3) -> &mut Mixer {
        self.number(v.x).number(v.y).number(v.z)
    }

    fn part(&mut self, g: &Geometry) -> &mut Mixer {
        g.mix(self);
        self
    }

    fn parts(&mut self, parts: &[Geometry]) -> &mut Mixer {
        self.add(parts.len() as u64);
        parts.iter().for_each(|g| {
            self.part(g);
        });
        self
    }
}
