// SPDX-License-Identifier: MIT OR Apache-2.0
//! A number that is equal for equal content on every rank, instruction set and run. Words are mixed by
//! the finaliser of SplitMix64 (Steele, Lea & Flood 2014).

use super::level::Level;
use super::node::Node;
use super::{Geometry, kinds};
use std::collections::HashMap;
use std::sync::Arc;

impl Geometry {
    /// Equal for trees of equal content; 0 for trees with user functions. O(bytes).
    pub fn fingerprint(&self) -> u64 {
        if self.has_functions() {
            return 0;
        }
        self.digest(&mut HashMap::new()).max(1)
    }

    /// Of the node and all below it; shared parts are walked once.
    fn digest(&self, seen: &mut HashMap<usize, u64>) -> u64 {
        let key = Arc::as_ptr(&self.inner) as usize;
        if let Some(known) = seen.get(&key) {
            return *known;
        }
        let mut mixer = Mixer(0);
        self.mix(&mut mixer);
        self.node().children().iter().for_each(|g| {
            mixer.add(g.digest(seen));
        });
        seen.insert(key, mixer.0);
        mixer.0
    }

    /// The node's own numbers.
    fn mix(&self, mixer: &mut Mixer) {
        match self.node() {
            Node::Sphere(_) | Node::Shape(_) => {
                if let Some(shape) = self.node().shape() {
                    shape.words(&mut mixer.adder());
                }
            }
            Node::Surface(surface) => {
                mixer.add(kinds::SURFACE);
                surface.fingerprint(&mut mixer.adder());
            }
            Node::Function { .. } => {}
            Node::Union(parts) => mixer.words([kinds::UNION, parts.list().len() as u64]),
            Node::Intersection(parts) => mixer.words([kinds::INTERSECTION, parts.list().len() as u64]),
            Node::Complement(_) => mixer.words([kinds::COMPLEMENT]),
            Node::Translate(_, shift) => mixer.add(kinds::TRANSLATE).numbers(shift.to_array()),
            Node::Place(_, placement) => mixer.add(kinds::PLACE).numbers(placement.numbers()),
            Node::Part(_, label) => mixer.words([kinds::PART, *label as u64]),
            Node::Map(_, map) => map.words(&mut mixer.add(kinds::MAP).adder()),
            Node::Level(_, Level::Offset(d)) => mixer.add(kinds::LEVEL).numbers([*d]),
            Node::Level(_, Level::Annular(d)) => mixer.add(12).numbers([*d]),
            Node::Level(_, Level::Divided(c)) => mixer.add(13).numbers([*c]),
            Node::Stencil(_, stencil) => stencil.words(&mut mixer.add(kinds::STENCIL).adder()),
            Node::Repeat(repeat) => repeat.words(&mut mixer.add(kinds::REPEAT).adder()),
            Node::Smooth(smooth) => {
                mixer.words([kinds::SMOOTH, smooth.parts().list().len() as u64]);
                smooth.blend().words(&mut mixer.adder());
            }
        }
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

    fn words<const N: usize>(&mut self, all: [u64; N]) {
        all.into_iter().for_each(|word| {
            self.add(word);
        });
    }

    fn numbers(&mut self, all: impl IntoIterator<Item = f64>) {
        all.into_iter().for_each(|x| {
            self.add((x + 0.0).to_bits());
        });
    }

    fn adder(&mut self) -> impl FnMut(u64) {
        |word| {
            self.add(word);
        }
    }
}
