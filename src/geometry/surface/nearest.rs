// SPDX-License-Identifier: MIT OR Apache-2.0
//! Nearest triangle: least squared distance as the kernel computes it, then least index.

use super::{Block, NO_TRIANGLE, Surface};
use crate::bvh::{self, GROUP, LeafDistance, Tree};
use crate::math::{Vec3, length};
use crate::primitive::triangle::{self, Foot, RELATIVE_ERROR, V3};
use crate::simd::lanes::{F64x8, Lanes, WIDTH};
use crate::simd::{Kernel, dispatch, prefetch};

/// The nearest triangle and where on it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// Distance, never negative.
    pub(crate) distance: f64,
    pub(crate) triangle: u32,
    /// 0 face, 1-3 edge, 4-6 vertex, in the corners as they stand.
    pub(crate) feature: usize,
    pub(crate) point: Vec3,
    /// Of the corners as they stand.
    pub(crate) barycentric: Vec3,
}

/// What a search has found so far.
#[derive(Clone, Copy)]
struct Best {
    squared: f64,
    triangle: u32,
}

impl Best {
    const NONE: Best = Best { squared: f64::INFINITY, triangle: NO_TRIANGLE };

    #[inline(always)]
    fn offer(&mut self, squared: f64, triangle: u32) {
        if squared < self.squared || (squared == self.squared && triangle < self.triangle) {
            *self = Best { squared, triangle };
        }
    }
}

/// The search: by the hierarchy, or, without one, over everything.
struct Search<'a> {
    blocks: &'a [Block],
    tree: Option<&'a Tree>,
    p: Vec3,
}

impl Kernel for Search<'_> {
    type Output = Best;

    #[inline(always)]
    fn run(self) -> Best {
        let mut best = Best::NONE;
        let mut leaf = Leaf::new(self.blocks, self.tree, self.p, &mut best);
        match self.tree {
            Some(tree) => bvh::nearest::<false>(tree, self.p, f64::INFINITY, &mut leaf),
            None => {
                for k in 0..self.blocks.len() {
                    leaf.visit(k);
                }
            }
        }
        best
    }
}

/// The search by the hierarchy, for a few points side by side.
struct SearchGroup<'a> {
    blocks: &'a [Block],
    tree: &'a Tree,
    points: &'a [Vec3],
}

impl Kernel for SearchGroup<'_> {
    type Output = [Best; GROUP];

    #[inline(always)]
    fn run(self) -> [Best; GROUP] {
        let SearchGroup { blocks, tree, points } = self;
        let mut best = [Best::NONE; GROUP];
        let fetch = |leaf: usize| prefetch(&blocks[leaf]);
        let searches = points.iter().zip(&mut best);
        let searches = searches.map(|(&p, best)| (f64::INFINITY, Leaf::new(blocks, Some(tree), p, best)));
        bvh::nearest_for_group::<false, _>(tree, points, fetch, searches);
        best
    }
}

struct Leaf<'a> {
    blocks: &'a [Block],
    p: V3<F64x8>,
    /// Of the tree.
    diagonal: f64,
    best: &'a mut Best,
}

impl<'a> Leaf<'a> {
    #[inline(always)]
    fn new(blocks: &'a [Block], tree: Option<&Tree>, p: Vec3, best: &'a mut Best) -> Leaf<'a> {
        let p = V3([Lanes::splat(p.x), Lanes::splat(p.y), Lanes::splat(p.z)]);
        Leaf { blocks, p, diagonal: tree.map_or(0.0, Tree::diagonal), best }
    }
}

impl LeafDistance for Leaf<'_> {
    #[inline(always)]
    fn visit(&mut self, leaf: usize) -> f64 {
        let block = &self.blocks[leaf];
        let foot = triangle::nearest(&block.lanes, self.p);
        let mut near = foot.squared.at_most(self.best.squared);
        while near != 0 {
            let k = near.trailing_zeros() as usize & (WIDTH - 1);
            near &= near - 1;
            self.best.offer(foot.squared.0[k], block.triangle[k]);
        }
        let d = self.best.squared.sqrt();
        d + 2.0 * RELATIVE_ERROR * (d + self.diagonal)
    }
}

impl Surface {
    /// The nearest triangle to a finite point.
    pub(crate) fn nearest(&self, p: Vec3) -> Nearest {
        self.at(p, dispatch(Search { blocks: &self.blocks, tree: self.tree.as_ref(), p }))
    }

    /// The signed distances of many finite points.
    pub(crate) fn values(&self, points: &[Vec3], out: &mut [f64]) {
        self.for_each_nearest(points, |k, nearest| out[k] = self.signed(points[k], nearest));
    }

    /// The nearest triangle to each of many finite points, a few of them side by side.
    pub(crate) fn for_each_nearest(&self, points: &[Vec3], mut take: impl FnMut(usize, &Nearest)) {
        let Some(tree) = &self.tree else {
            return points.iter().enumerate().for_each(|(k, p)| take(k, &self.nearest(*p)));
        };
        for (g, points) in points.chunks(GROUP).enumerate() {
            let best = dispatch(SearchGroup { blocks: &self.blocks, tree, points });
            for (k, (p, best)) in points.iter().zip(best).enumerate() {
                take(g * GROUP + k, &self.at(*p, best));
            }
        }
    }

    /// What there is to know of the triangle found.
    fn at(&self, p: Vec3, best: Best) -> Nearest {
        // Beyond 1e154 every squared distance is infinite and the first triangle stands for all.
        let triangle = if best.triangle == NO_TRIANGLE { 0 } else { best.triangle };
        let prepared = self.prepared(triangle);
        let foot: Foot<f64> = triangle::nearest(&prepared, V3::from_vec(p));
        let (point, barycentric) = prepared.point(p, &foot);
        let distance = if best.squared.is_finite() { best.squared.sqrt() } else { length(p - self.vertices[0]) };
        Nearest { distance, triangle, feature: foot.feature as usize, point, barycentric }
    }

    /// Feature and barycentric coordinates in the order of the input face's corners.
    pub(crate) fn as_input(&self, nearest: &Nearest) -> (usize, Vec3) {
        if !self.triangles[nearest.triangle as usize].is_turned() {
            return (nearest.feature, nearest.barycentric);
        }
        let b = nearest.barycentric;
        ([0, 3, 2, 1, 4, 6, 5][nearest.feature], Vec3::new(b.x, b.z, b.y))
    }
}
