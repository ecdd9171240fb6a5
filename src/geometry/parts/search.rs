// SPDX-License-Identifier: MIT OR Apache-2.0
//! The least value of all parts and the part it belongs to, and all parts with values close behind it.

use super::Parts;
use super::hierarchy::Hierarchy;
use super::spheres::Block;
use crate::bvh::{self, GROUP, LeafDistance, Tree};
use crate::geometry::summary::ROOT_OF_THREE;
use crate::math::Vec3;
use crate::simd::float8::Simd;
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, dispatch, prefetch};

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

const NOTHING: Least = Least(Found { value: f64::INFINITY, part: usize::MAX });

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
        let mut least = NOTHING;
        match &self.hierarchy {
            Some(hierarchy) if p.is_finite() => self.search(hierarchy, p, &mut least),
            _ => self.ask_all(p, &mut least),
        }
        least.0
    }

    /// Whether many points at once cost less than one after another.
    pub(in crate::geometry) fn is_batched(&self) -> bool {
        self.hierarchy.as_ref().is_some_and(|h| h.spheres.is_some())
    }

    /// The value of [`Parts::least`] at each of many finite points.
    pub(in crate::geometry) fn least_values(&self, points: &[Vec3], out: &mut [f64]) {
        let Some((hierarchy, (tree, blocks))) = self.hierarchy.as_ref().and_then(|h| Some((h, h.spheres.as_ref()?)))
        else {
            points.iter().zip(out).for_each(|(p, value)| *value = self.least(*p).value);
            return;
        };
        for (points, out) in points.chunks(GROUP).zip(out.chunks_mut(GROUP)) {
            let mut least = [NOTHING; GROUP];
            for (p, least) in points.iter().zip(&mut least) {
                self.ask_beside(hierarchy, *p, least);
            }
            dispatch(SphereGroup { tree, blocks, hierarchy, points, least: &mut least });
            for ((p, least), value) in points.iter().zip(&mut least).zip(out) {
                self.search_others(hierarchy, *p, least);
                *value = least.0.value;
            }
        }
    }

    /// The same, alone where it is not finite, else with all parts less than `support` behind it, in no order.
    /// Each part is asked once: asked twice, unions within unions would take twice as long with each level.
    pub(in crate::geometry) fn near(&self, p: Vec3, support: f64) -> Vec<Found> {
        let mut near = Near { least: NOTHING, support, found: Vec::new() };
        match &self.hierarchy {
            Some(hierarchy) if p.is_finite() => self.search(hierarchy, p, &mut near),
            _ => self.ask_all(p, &mut near),
        }
        let end = near.end();
        near.found.retain(|f| f.value < end);
        // What is too large for the support to count stands alone.
        if near.found.is_empty() || !near.least.0.value.is_finite() { vec![near.least.0] } else { near.found }
    }

    /// Asks parts one after another, until one has no value.
    fn ask(&self, parts: impl Iterator<Item = usize>, p: Vec3, sink: &mut impl Sink) {
        for part in parts {
            let value = self.signed(part, p);
            sink.offer(value, part);
            if value.is_nan() {
                return;
            }
        }
    }

    /// Without a hierarchy.
    fn ask_all(&self, p: Vec3, sink: &mut impl Sink) {
        self.ask(0..self.list.len(), p, sink);
    }

    #[inline(never)]
    fn search(&self, hierarchy: &Hierarchy, p: Vec3, sink: &mut impl Sink) {
        self.ask_beside(hierarchy, p, sink);
        if let Some((tree, blocks)) = &hierarchy.spheres {
            dispatch(SphereSearch { tree, blocks, hierarchy, p, extent: extent(p), sink });
        }
        self.search_others(hierarchy, p, sink);
    }

    /// The parts that are always asked.
    fn ask_beside(&self, hierarchy: &Hierarchy, p: Vec3, sink: &mut impl Sink) {
        self.ask(hierarchy.beside.iter().map(|&part| part as usize), p, sink);
    }

    fn search_others(&self, hierarchy: &Hierarchy, p: Vec3, sink: &mut impl Sink) {
        if let Some((tree, parts)) = &hierarchy.others {
            dispatch(Others { all: self, tree, parts, hierarchy, p, extent: extent(p), sink });
        }
    }
}

/// Balls, at a few points side by side.
struct SphereGroup<'a> {
    tree: &'a Tree,
    blocks: &'a [Block],
    hierarchy: &'a Hierarchy,
    points: &'a [Vec3],
    least: &'a mut [Least; GROUP],
}

impl Kernel for SphereGroup<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let SphereGroup { tree, blocks, hierarchy, points, least } = self;
        let searches = points.iter().zip(least.iter_mut()).map(|(&p, sink)| {
            let extent = extent(p);
            let start = hierarchy.bound(sink.limit(), extent);
            (tree.scaled(start), SphereSearch { tree, blocks, hierarchy, p, extent, sink })
        });
        bvh::nearest_for_group::<S, bvh::Along<true>, _>(simd, tree, points, |leaf| prefetch(&blocks[leaf]), searches);
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

impl<K: Sink> Kernel for SphereSearch<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let (tree, p) = (self.tree, self.p);
        let start = tree.scaled(self.hierarchy.bound(self.sink.limit(), self.extent));
        bvh::nearest::<S, bvh::Along<true>>(simd, tree, p, start, &mut self);
    }
}

impl<S: Simd, K: Sink> LeafDistance<S> for SphereSearch<'_, K> {
    #[inline(always)]
    fn visit(&mut self, _: S, leaf: usize, _: [f32; 3], _: f32) -> f32 {
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
        self.tree.scaled(self.hierarchy.bound(self.sink.limit(), self.extent))
    }
}

struct Others<'a, K> {
    all: &'a Parts,
    tree: &'a Tree,
    parts: &'a [u32],
    hierarchy: &'a Hierarchy,
    p: Vec3,
    extent: f64,
    sink: &'a mut K,
}

impl<K: Sink> Kernel for Others<'_, K> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let (tree, p) = (self.tree, self.p);
        let start = tree.scaled(self.hierarchy.bound(self.sink.limit(), self.extent));
        bvh::nearest::<S, bvh::Along<true>>(simd, tree, p, start, &mut self);
    }
}

impl<S: Simd, K: Sink> LeafDistance<S> for Others<'_, K> {
    #[inline(always)]
    fn visit(&mut self, _: S, leaf: usize, _: [f32; 3], _: f32) -> f32 {
        let part = self.parts[leaf] as usize;
        self.sink.offer(self.all.signed(part, self.p), part);
        self.tree.scaled(self.hierarchy.bound(self.sink.limit(), self.extent))
    }
}

/// How far a point is from the origin at most.
#[inline(always)]
fn extent(p: Vec3) -> f64 {
    ROOT_OF_THREE * p.abs().max_element()
}
