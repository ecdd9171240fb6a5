// SPDX-License-Identifier: MIT OR Apache-2.0
//! Nearest triangle: least squared distance as the kernel computes it, then least index.

use super::{Block, NO_TRIANGLE, Surface};
use crate::bvh::{self, LeafDistance, Tree};
use crate::math::{Vec3, length};
use crate::primitive::triangle::{self, Foot, RELATIVE_ERROR, V3};
use crate::simd::lanes::{F64x8, Lanes, WIDTH};
use crate::simd::{Kernel, dispatch};

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
        let p = V3([Lanes::splat(self.p.x), Lanes::splat(self.p.y), Lanes::splat(self.p.z)]);
        let diagonal = self.tree.map_or(0.0, Tree::diagonal);
        let mut leaf = Leaf { blocks: self.blocks, p, diagonal, best: Best::NONE };
        match self.tree {
            Some(tree) => bvh::nearest::<false>(tree, self.p, f64::INFINITY, &mut leaf),
            None => {
                for k in 0..self.blocks.len() {
                    leaf.visit(k);
                }
            }
        }
        leaf.best
    }
}

struct Leaf<'a> {
    blocks: &'a [Block],
    p: V3<F64x8>,
    /// Of the tree.
    diagonal: f64,
    best: Best,
}

impl LeafDistance for Leaf<'_> {
    #[inline(always)]
    fn visit(&mut self, leaf: usize) -> f64 {
        let block = &self.blocks[leaf];
        let foot = triangle::nearest(&block.lanes, self.p);
        for k in 0..WIDTH {
            self.best.offer(foot.squared.0[k], block.triangle[k]);
        }
        let d = self.best.squared.sqrt();
        d + 2.0 * RELATIVE_ERROR * (d + self.diagonal)
    }
}

impl Surface {
    /// The nearest triangle to a finite point.
    pub(crate) fn nearest(&self, p: Vec3) -> Nearest {
        let best = dispatch(Search { blocks: &self.blocks, tree: self.tree.as_ref(), p });
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
        if !self.triangles[nearest.triangle as usize].turned {
            return (nearest.feature, nearest.barycentric);
        }
        let b = nearest.barycentric;
        ([0, 3, 2, 1, 4, 6, 5][nearest.feature], Vec3::new(b.x, b.z, b.y))
    }
}
