// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where a ray meets the surface. A hierarchy's leaves are looked at in f32, eight triangles at once
//! (`primitive/pass.rs`); whether the ray meets one of those that are left is decided exactly, and so is where.

use super::{NO_TRIANGLE, Surface};
use crate::bvh::{Ahead, LeafOnLine, Line, Seen, Tree};
use crate::error::Result;
use crate::math::Vec3;
use crate::primitive::ray::Ray;
use crate::simd::float8::Simd;
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, dispatch, prefetch};

/// One meeting of a ray with a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Met {
    pub(crate) triangle: u32,
    /// Whether the ray passes towards the outer side of the triangle.
    pub(crate) leaves: bool,
}

/// A ray on its way through a surface.
struct Way<'a, F> {
    surface: &'a Surface,
    ray: &'a Ray,
    limit: f64,
    offer: F,
}

impl<F: FnMut(Met) -> f64> Way<'_, F> {
    /// Asks about one triangle.
    #[inline(never)]
    fn ask(&mut self, triangle: u32) {
        let corners = self.surface.corners(triangle);
        let turn = self.ray.meets(corners);
        if turn != 0 {
            self.limit = (self.offer)(Met { triangle, leaves: turn > 0 });
        }
    }
}

impl<S: Simd, F: FnMut(Met) -> f64> LeafOnLine<S> for Way<'_, F> {
    #[inline(always)]
    fn visit(&mut self, simd: S, leaf: usize, line: &Line) -> f64 {
        let surface = self.surface;
        match surface.leaves.get(leaf) {
            Some(leaf) => {
                let mut left = leaf.estimates.passed(simd, line.middle, line.direction);
                while left != 0 {
                    let triangle = leaf.triangle[left.trailing_zeros() as usize & (WIDTH - 1)];
                    left &= left - 1;
                    if triangle != NO_TRIANGLE {
                        self.ask(triangle);
                    }
                }
            }
            None => surface.members(leaf).iter().for_each(|&t| self.ask(t)),
        }
        self.limit
    }

    #[inline(always)]
    fn fetch(&self, leaf: usize) {
        if let Some(leaf) = self.surface.leaves.get(leaf) {
            prefetch(leaf);
        }
    }
}

/// The same along a line.
struct Follow<'a, 'b, F> {
    tree: &'a Tree,
    line: &'b Line,
    ahead: &'b mut Ahead,
    way: Way<'a, F>,
}

impl<F: FnMut(Met) -> f64> Kernel for Follow<'_, '_, F> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let to = self.way.limit;
        self.tree.along_line(simd, self.line, to, self.ahead, &mut self.way);
    }
}

impl Surface {
    /// Hands `offer` the meetings within the range of a ray, in no given order; those beyond a limit, at first `to` and
    /// then what `offer` says, may be left out.
    pub(crate) fn along_ray(&self, ray: &Ray, to: f64, ahead: &mut Ahead, offer: impl FnMut(Met) -> f64) -> Result<()> {
        let mut way = Way { surface: self, ray, limit: to, offer };
        let Some(tree) = &self.tree else {
            (0..self.triangles.len() as u32).for_each(|t| way.ask(t));
            return Ok(());
        };
        match tree.see(ray.origin, ray.direction, ray.from) {
            Seen::Missed => {}
            Seen::Line(line) => dispatch(Follow { tree, line: &line, ahead, way }),
            Seen::Far => tree.along_ray(ray.origin, ray.direction, [ray.from, to], ahead, |leaf| {
                self.members(leaf).iter().for_each(|&t| way.ask(t));
                way.limit
            })?,
        }
        Ok(())
    }

    /// Where a ray meets a triangle that it does meet, as the ray scales it.
    pub(crate) fn place_on(&self, ray: &Ray, met: Met) -> f64 {
        ray.place(self.corners(met.triangle))
    }

    /// Outward unit normal of a triangle; zero where its area is.
    pub(crate) fn outward(&self, triangle: u32) -> Vec3 {
        self.normal(triangle)
    }
}
