// SPDX-License-Identifier: MIT OR Apache-2.0
//! The least value of all parts and the part it belongs to, and all parts with values close behind it.

use super::Parts;
use super::hierarchy::Hierarchy;
use super::spheres::Block;
use crate::bvh::{self, LeafDistance, Tree};
use crate::math::Vec3;
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, dispatch};

/// A part and its value.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct Found {
    pub(in crate::geometry) value: f64,
    pub(in crate::geometry) part: usize,
}

/// What a search does with what it meets.
trait Sink {
    /// Values above this are of no interest.
    fn limit(&self) -> f64;
    fn offer(&mut self, value: f64, part: usize);
}

/// The least value, of equal ones that of the first part; the first that is NaN ends the search.
struct Least(Found);

impl Sink for Least {
    #[inline(always)]
    fn limit(&self) -> f64 {
        if self.0.value.is_nan() { f64::NEG_INFINITY } else { self.0.value }
    }

    #[inline(always)]
    fn offer(&mut self, value: f64, part: usize) {
        let best = &mut self.0;
        if value < best.value || (value == best.value && part < best.part) || value.is_nan() {
            *best = Found { value, part };
        }
    }
}

/// The least value, and all that were less than `support` behind the least one so far.
struct Near {
    least: Least,
    support: f64,
    found: Vec<Found>,
}

impl Near {
    /// What the least value leaves of interest.
    fn end(&self) -> f64 {
        let least = self.least.limit();
        if least == f64::NEG_INFINITY { least } else { least + self.support }
    }
}

impl Sink for Near {
    fn limit(&self) -> f64 {
        self.end()
    }

    fn offer(&mut self, value: f64, part: usize) {
        self.least.offer(value, part);
        if value < self.end() {
            self.found.push(Found { value, part });
        }
    }
}

impl Parts {
    /// The least value (signs turned where all are), of equal ones that of the first part; NaN where one is
    /// NaN; +inf of part `usize::MAX` where there are none.
    pub(in crate::geometry) fn least(&self, p: Vec3) -> Found {
        let mut least = Least(Found { value: f64::INFINITY, part: usize::MAX });
        match &self.hierarchy {
            Some(hierarchy) if p.is_finite() => self.search(hierarchy, p, &mut least),
            _ => self.ask_all(p, &mut least),
        }
        least.0
    }

    /// The same, alone where it is not finite, else with all parts less than `support` behind it, in no order.
    /// Each part is asked once: asked twice, unions within unions would take twice as long with each level.
    pub(in crate::geometry) fn near(&self, p: Vec3, support: f64) -> Vec<Found> {
        let least = Least(Found { value: f64::INFINITY, part: usize::MAX });
        let mut near = Near { least, support, found: Vec::new() };
        match &self.hierarchy {
            Some(hierarchy) if p.is_finite() => self.search(hierarchy, p, &mut near),
            _ => self.ask_all(p, &mut near),
        }
        let end = near.end();
        near.found.retain(|f| f.value < end);
        // What is too large for the support to count stands alone.
        if near.found.is_empty() || !near.least.0.value.is_finite() { vec![near.least.0] } else { near.found }
    }

    /// Without a hierarchy.
    fn ask_all(&self, p: Vec3, sink: &mut impl Sink) {
        for part in 0..self.list.len() {
            let value = self.signed(part, p);
            sink.offer(value, part);
            if value.is_nan() {
                return;
            }
        }
    }

    #[inline(never)]
    fn search(&self, hierarchy: &Hierarchy, p: Vec3, sink: &mut impl Sink) {
        for &part in &hierarchy.beside {
            let value = self.signed(part as usize, p);
            sink.offer(value, part as usize);
            if value.is_nan() {
                return;
            }
        }
        let extent = p.abs().max_element();
        if let Some((tree, blocks)) = &hierarchy.spheres {
            dispatch(SphereSearch { tree, blocks, hierarchy, p, extent, sink });
        }
        if let Some((tree, parts)) = &hierarchy.others {
            let start = hierarchy.bound(sink.limit(), extent);
            let mut leaf = Others { all: self, parts, hierarchy, p, extent, sink };
            bvh::nearest::<true>(tree, p, start, &mut leaf);
        }
    }
}

struct SphereSearch<'a, S> {
    tree: &'a Tree,
    blocks: &'a [Block],
    hierarchy: &'a Hierarchy,
    p: Vec3,
    extent: f64,
    sink: &'a mut S,
}

impl<S: Sink> Kernel for SphereSearch<'_, S> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        let (tree, p, start) = (self.tree, self.p, self.hierarchy.bound(self.sink.limit(), self.extent));
        bvh::nearest::<true>(tree, p, start, &mut self);
    }
}

impl<S: Sink> LeafDistance for SphereSearch<'_, S> {
    #[inline(always)]
    fn visit(&mut self, leaf: usize) -> f64 {
        let block = &self.blocks[leaf];
        let values = block.values(self.p);
        let mut near = values.at_most(self.sink.limit());
        while near != 0 {
            let k = near.trailing_zeros() as usize & (WIDTH - 1);
            near &= near - 1;
            if block.part[k] != u32::MAX {
                self.sink.offer(values.0[k], block.part[k] as usize);
            }
        }
        self.hierarchy.bound(self.sink.limit(), self.extent)
    }
}

struct Others<'a, S> {
    all: &'a Parts,
    parts: &'a [u32],
    hierarchy: &'a Hierarchy,
    p: Vec3,
    extent: f64,
    sink: &'a mut S,
}

impl<S: Sink> LeafDistance for Others<'_, S> {
    fn visit(&mut self, leaf: usize) -> f64 {
        let part = self.parts[leaf] as usize;
        self.sink.offer(self.all.signed(part, self.p), part);
        self.hierarchy.bound(self.sink.limit(), self.extent)
    }
}
