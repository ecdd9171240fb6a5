// SPDX-License-Identifier: MIT OR Apache-2.0
//! Nearest triangle: least squared distance as the kernel computes it, then least index.
//!
//! The hierarchy's leaves are looked at in f32, eight triangles at once (`primitive/estimate.rs`). What may be as near
//! as the nearest is at most is kept, and the kernel decides at the end among the few that are left, so the answer is
//! that of the kernel over all triangles to the bit.

use super::waiting::Waiting;
use super::{NO_TRIANGLE, Surface};
use crate::bvh::{self, GROUP, LeafDistance, Tree};
use crate::math::{Vec3, length};
use crate::primitive::triangle::{self, Foot, Prepared, RELATIVE_ERROR, V3};
use crate::simd::float8::Simd;
use crate::simd::lanes::{F64s, Lanes, WIDTH};
use crate::simd::{Kernel, dispatch, prefetch};

/// The nearest triangle and where on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// Distance, never negative.
    pub(crate) distance: f64,
    pub(crate) triangle: u32,
    /// 0 face, 1-3 edge, 4-6 vertex, in the corners as they stand.
    pub(crate) feature: usize,
    /// Where along the edge, 0 to 1 (features 1 to 3).
    along: f64,
    pub(crate) point: Vec3,
}

/// What a search has found so far.
#[derive(Clone, Copy)]
pub(super) struct Best {
    foot: Foot<f64>,
    pub(super) triangle: u32,
}

impl Best {
    pub(super) const NONE: Best =
        Best { foot: Foot { squared: f64::INFINITY, feature: 0.0, along: 0.0 }, triangle: NO_TRIANGLE };

    #[inline(always)]
    pub(super) fn offer(&mut self, foot: Foot<f64>, triangle: u32) {
        let squared = self.foot.squared;
        if foot.squared < squared || (foot.squared == squared && triangle < self.triangle) {
            *self = Best { foot, triangle };
        }
    }

    #[inline(always)]
    fn offer_all<const N: usize>(&mut self, feet: &Foot<F64s<N>>, triangles: &[u32]) {
        for (k, &triangle) in triangles.iter().enumerate() {
            let (squared, feature, along) = (feet.squared.0[k], feet.feature.0[k], feet.along.0[k]);
            self.offer(Foot { squared, feature, along }, triangle);
        }
    }

    /// Asks the kernel about up to eight triangles, with as many lanes as they need.
    #[inline(always)]
    pub(super) fn ask(&mut self, surface: &Surface, p: Vec3, triangles: &[u32]) {
        match *triangles {
            [] => {}
            [triangle] => self.offer(surface.foot(triangle, p), triangle),
            [_, _] | [_, _, _] | [_, _, _, _] => self.offer_all::<4>(&surface.feet(triangles, p), triangles),
            _ => self.offer_all::<WIDTH>(&surface.feet(triangles, p), triangles),
        }
    }
}

/// The search by the hierarchy.
struct Search<'a> {
    surface: &'a Surface,
    tree: &'a Tree,
    p: Vec3,
}

impl Kernel for Search<'_> {
    type Output = Best;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Best {
        let Search { surface, tree, p } = self;
        let mut best = Best::NONE;
        let mut candidates = Candidates::new(surface, p, &mut best);
        bvh::nearest::<S, bvh::Around>(simd, tree, p, f32::INFINITY, &mut candidates);
        best
    }
}

/// The search by the hierarchy that asks the kernel about every triangle of a leaf: in the compact layout, and from far away.
struct SearchByKernel<'a> {
    surface: &'a Surface,
    tree: &'a Tree,
    p: Vec3,
    best: Best,
}

impl Kernel for SearchByKernel<'_> {
    type Output = Best;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) -> Best {
        let (tree, p) = (self.tree, self.p);
        bvh::nearest::<S, bvh::Along<false>>(simd, tree, p, f32::INFINITY, &mut self);
        self.best
    }
}

impl<S: Simd> LeafDistance<S> for SearchByKernel<'_> {
    #[inline(always)]
    fn visit(&mut self, simd: S, leaf: usize, _: [f32; 3], _: f32) -> f32 {
        simd.apart(OfLeaf { search: self, leaf });
        self.tree.scaled(self.limit()) * (1.0 + 2.0 * f32::EPSILON)
    }
}

impl SearchByKernel<'_> {
    /// As far as what the kernel is off by leaves of interest.
    #[inline(always)]
    fn limit(&self) -> f64 {
        let (distance, diagonal) = (self.best.foot.squared.sqrt(), self.surface.diagonal());
        distance + 4.0 * RELATIVE_ERROR * (distance + diagonal)
    }

    /// The same from far away; of all triangles where there is no memory for it.
    fn far_away(mut self) -> Best {
        let (tree, p) = (self.tree, self.p);
        let done = tree.nearest_from_far(p, |leaf| {
            dispatch(OfLeaf { search: &mut self, leaf });
            self.limit() * tree.scale()
        });
        if done.is_ok() { self.best } else { dispatch(OfAll { surface: self.surface, p }) }
    }
}

struct OfLeaf<'a, 'b> {
    search: &'a mut SearchByKernel<'b>,
    leaf: usize,
}

impl Kernel for OfLeaf<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let OfLeaf { search, leaf } = self;
        search.best.ask(search.surface, search.p, search.surface.members(leaf));
    }
}

/// Brute force: the kernel for every triangle.
pub(super) struct OfAll<'a> {
    pub(super) surface: &'a Surface,
    pub(super) p: Vec3,
}

impl Kernel for OfAll<'_> {
    type Output = Best;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> Best {
        let OfAll { surface, p } = self;
        let mut best = Best::NONE;
        for from in (0..surface.triangles.len() as u32).step_by(WIDTH) {
            let mut all = [0; WIDTH];
            for k in 0..WIDTH {
                all[k] = from + k as u32;
            }
            let count = WIDTH.min(surface.triangles.len() - from as usize);
            best.offer_all::<WIDTH>(&surface.feet(&all[..count], p), &all[..count]);
        }
        best
    }
}

/// The search by the hierarchy, for a few points side by side.
struct SearchGroup<'a> {
    surface: &'a Surface,
    tree: &'a Tree,
    points: &'a [Vec3],
}

impl Kernel for SearchGroup<'_> {
    type Output = [Best; GROUP];

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> [Best; GROUP] {
        let SearchGroup { surface, tree, points } = self;
        let mut best = [Best::NONE; GROUP];
        let fetch = |leaf: usize| prefetch(&surface.leaves[leaf]);
        let searches = points.iter().zip(&mut best);
        let searches = searches.map(|(&p, best)| (f32::INFINITY, Candidates::new(surface, p, best)));
        bvh::nearest_for_group::<S, bvh::Around, _>(simd, tree, points, fetch, searches);
        best
    }
}

/// The search as it goes from leaf to leaf.
struct Candidates<'a> {
    waiting: Waiting<'a>,
    out: &'a mut Best,
}

impl<'a> Candidates<'a> {
    #[inline(always)]
    fn new(surface: &'a Surface, p: Vec3, out: &'a mut Best) -> Candidates<'a> {
        Candidates { waiting: Waiting::new(surface, p), out }
    }
}

impl<S: Simd> LeafDistance<S> for Candidates<'_> {
    #[inline(always)]
    fn visit(&mut self, simd: S, leaf: usize, at: [f32; 3], slack: f32) -> f32 {
        let leaf = &self.waiting.surface.leaves[leaf];
        self.waiting.look(simd, leaf, at, slack)
    }

    #[inline(always)]
    fn fetch(&self, leaf: usize) {
        prefetch(&self.waiting.surface.leaves[leaf]);
    }

    #[inline(always)]
    fn finish(&mut self, simd: S) {
        self.waiting.settle_all(simd);
        *self.out = self.waiting.best;
    }
}

impl Surface {
    /// The nearest triangle to a finite point.
    pub(crate) fn nearest(&self, p: Vec3) -> Nearest {
        self.at(
            p,
            match &self.tree {
                Some(tree) if tree.is_far(p) => SearchByKernel { surface: self, tree, p, best: Best::NONE }.far_away(),
                Some(tree) if self.compact.is_some() => {
                    dispatch(SearchByKernel { surface: self, tree, p, best: Best::NONE })
                }
                Some(tree) => dispatch(Search { surface: self, tree, p }),
                None => dispatch(OfAll { surface: self, p }),
            },
        )
    }

    /// The signed distances of many finite points.
    pub(crate) fn values(&self, points: &[Vec3], out: &mut [f64]) {
        self.for_each_nearest(points, |k, nearest| out[k] = self.signed(points[k], nearest));
    }

    /// The nearest triangle to each of many finite points, a few of them side by side.
    pub(crate) fn for_each_nearest(&self, points: &[Vec3], mut take: impl FnMut(usize, &Nearest)) {
        let Some(tree) = self.tree.as_ref().filter(|_| self.compact.is_none()) else {
            return points.iter().enumerate().for_each(|(k, p)| take(k, &self.nearest(*p)));
        };
        for (g, points) in points.chunks(GROUP).enumerate() {
            if points.iter().any(|p| tree.is_far(*p)) {
                points.iter().enumerate().for_each(|(k, p)| take(g * GROUP + k, &self.nearest(*p)));
                continue;
            }
            let best = dispatch(SearchGroup { surface: self, tree, points });
            for (k, (p, best)) in points.iter().zip(best).enumerate() {
                take(g * GROUP + k, &self.at(*p, best));
            }
        }
    }

    /// A triangle for the kernel.
    #[inline(always)]
    pub(super) fn prepared(&self, triangle: u32) -> Prepared<f64> {
        let [a, b, c] = self.corners(triangle);
        let normal = self.normals[triangle as usize];
        let corners = [V3([a.x, a.y, a.z]), V3([b.x, b.y, b.z]), V3([c.x, c.y, c.z])];
        Prepared::of(corners, V3([normal.x, normal.y, normal.z]))
    }

    /// The nearest point of a triangle.
    pub(super) fn nearest_of(&self, triangle: u32, p: Vec3) -> Vec3 {
        triangle::point(self.corners(triangle), self.normal(triangle), p, &self.foot(triangle, p))
    }

    /// The kernel's answer for one triangle.
    #[inline(always)]
    pub(super) fn foot(&self, triangle: u32, p: Vec3) -> Foot<f64> {
        triangle::nearest(&self.prepared(triangle), V3([p.x, p.y, p.z]))
    }

    /// The same for up to N; the lanes left over repeat the first.
    #[inline(always)]
    fn feet<const N: usize>(&self, triangles: &[u32], p: Vec3) -> Foot<F64s<N>> {
        let none = V3([F64s::splat(0.0); 3]);
        let (mut corner, mut normal) = ([none; 3], none);
        for k in 0..N {
            let t = triangles[if k < triangles.len() { k } else { 0 }] as usize;
            for (i, &v) in self.triangles.vertex[t].iter().enumerate() {
                let at = self.vertices[v as usize];
                (corner[i].0[0].0[k], corner[i].0[1].0[k], corner[i].0[2].0[k]) = (at.x, at.y, at.z);
            }
            let n = self.normals[t];
            (normal.0[0].0[k], normal.0[1].0[k], normal.0[2].0[k]) = (n.x, n.y, n.z);
        }
        let p = V3([Lanes::splat(p.x), Lanes::splat(p.y), Lanes::splat(p.z)]);
        triangle::nearest(&Prepared::of(corner, normal), p)
    }

    /// What there is to know of the triangle found.
    pub(super) fn at(&self, p: Vec3, best: Best) -> Nearest {
        // Beyond 1e154 every squared distance is infinite and the first triangle stands for all.
        let (triangle, foot) = match best.triangle {
            NO_TRIANGLE => (0, self.foot(0, p)),
            triangle => (triangle, best.foot),
        };
        let point = triangle::point(self.corners(triangle), self.normal(triangle), p, &foot);
        let squared = best.foot.squared;
        let distance = if squared.is_finite() { squared.sqrt() } else { length(p - self.vertices[0]) };
        Nearest { distance, triangle, feature: foot.feature as usize, along: foot.along, point }
    }

    /// Feature and barycentric coordinates in the order of the input face's corners.
    pub(crate) fn as_input(&self, nearest: &Nearest) -> (usize, Vec3) {
        let b = self.prepared(nearest.triangle).barycentric(nearest.feature, nearest.along, nearest.point);
        if !self.triangles.is_turned(nearest.triangle) {
            return (nearest.feature, b);
        }
        ([0, 3, 2, 1, 4, 6, 5][nearest.feature], Vec3::new(b.x, b.z, b.y))
    }
}
