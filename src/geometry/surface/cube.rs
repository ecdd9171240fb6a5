// SPDX-License-Identifier: MIT OR Apache-2.0
//! The nearest of few triangles to each of the 4 x 4 x 4 points of a cube of a lattice: triangle by triangle, eight
//! points side by side, first in f32 and then, where a triangle may be the nearest, by the kernel.

use super::few::Few;
use super::nearest::Best;
use super::{NO_TRIANGLE, Nearest, Surface};
use crate::bvh::Tree;
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::primitive::estimate::{ABOVE, BELOW, Estimate};
use crate::primitive::triangle::{self, Foot, Prepared, V3};
use crate::simd::Kernel;
use crate::simd::float8::{Float8, Simd, slack};
use crate::simd::lanes::{F64s, Lanes, WIDTH};

/// Points along an axis, and in all.
pub(super) const SIDE: usize = 4;
const POINTS: usize = SIDE * SIDE * SIDE;

/// Eight points are two rows of an x; of these there are so many.
const GROUPS: usize = POINTS / WIDTH;

/// The points of a cube, x fastest. Where it is thinner, its last points stand in for the others.
pub(super) struct Points {
    axes: [[f64; SIDE]; 3],
    /// As a tree places them, for two rows, for each pair of rows and for each layer.
    x: [f32; WIDTH],
    y: [[f32; WIDTH]; SIDE / 2],
    z: [f32; SIDE],
    slack: f32,
    /// Of pairs of rows and of layers, as many as are there.
    halves: usize,
    layers: usize,
    /// A bit for each point that is there.
    present: u64,
}

impl Points {
    pub(super) fn new(tree: &Tree, axes: [&[f64]; 3]) -> Points {
        let mut all = [[0.0; SIDE]; 3];
        for (to, from) in all.iter_mut().zip(axes) {
            for (k, c) in to.iter_mut().enumerate() {
                *c = from[k.min(from.len() - 1)];
            }
        }
        let placed = [0, 1, 2, 3].map(|k| tree.place(Vec3::new(all[0][k], all[1][k], all[2][k])));
        let largest = placed.iter().fold(0.0f64, |most, p| most.max(p.abs().max_element()));
        let (mut x, mut y, mut z) = ([0.0; WIDTH], [[0.0; WIDTH]; SIDE / 2], [0.0; SIDE]);
        for k in 0..WIDTH {
            x[k] = placed[k % SIDE].x as f32;
            y[0][k] = placed[k / SIDE].y as f32;
            y[1][k] = placed[SIDE / 2 + k / SIDE].y as f32;
        }
        for k in 0..SIDE {
            z[k] = placed[k].z as f32;
        }
        let row = (1u64 << axes[0].len()) - 1;
        let layer = (0..axes[1].len()).fold(0, |bits, j| bits | row << (SIDE * j));
        let present = (0..axes[2].len()).fold(0, |bits, k| bits | layer << (SIDE * SIDE * k));
        let (halves, layers) = (axes[1].len().div_ceil(2), axes[2].len());
        Points { axes: all, x, y, z, slack: slack(largest), halves, layers, present }
    }

    #[inline(always)]
    fn at(&self, point: usize) -> [f64; 3] {
        let [i, j, k] = [point % SIDE, point / SIDE % SIDE, point / (SIDE * SIDE) % SIDE];
        [self.axes[0][i], self.axes[1][j], self.axes[2][k]]
    }
}

/// What each point has found, and scratch.
pub(super) struct Cube {
    best: [Best; POINTS],
    /// Of each triangle, and more that are not in use, the estimates at the points.
    estimates: Vec<[f32; POINTS]>,
}

impl Default for Cube {
    fn default() -> Cube {
        Cube { best: [Best::NONE; POINTS], estimates: Vec::new() }
    }
}

impl Cube {
    #[inline(always)]
    pub(super) fn find<S: Simd>(
        &mut self,
        simd: S,
        (surface, tree): (&Surface, &Tree),
        few: &Few,
        axes: [&[f64]; 3],
    ) -> Result<()> {
        let points = Points::new(tree, axes);
        self.best = [Best::NONE; POINTS];
        let room = few.members.len().saturating_sub(self.estimates.len());
        self.estimates.try_reserve(room).map_err(|_| Error::memory("triangles", few.members.len()))?;
        self.estimates.resize(self.estimates.len() + room, [0.0; POINTS]);
        let mut limits = [[f32::INFINITY; WIDTH]; GROUPS];
        for (member, out) in few.members.iter().zip(&mut self.estimates) {
            let estimates = &surface.leaves[member.leaf as usize].estimates;
            let (one, margin) =
                (estimates.one(simd, member.lane as usize), estimates.margin(member.lane as usize, points.slack));
            estimate(simd, &points, &one, margin, &mut limits, out);
        }
        for (member, estimates) in few.members.iter().zip(&self.estimates) {
            let leaf = &surface.leaves[member.leaf as usize];
            let margin = leaf.estimates.margin(member.lane as usize, points.slack);
            let mut near = 0u64;
            for (g, limits) in limits.iter().enumerate() {
                let Some(estimates) = estimates[WIDTH * g..].first_chunk() else { continue };
                let lower = S::Float::load(simd, estimates).mul(S::Float::splat(simd, BELOW));
                let lower = lower.sub(S::Float::splat(simd, margin));
                let bits = lower.sub(S::Float::load(simd, limits)).not_above(0.0);
                near |= u64::from(bits) << (WIDTH * g);
            }
            near &= points.present;
            if near != 0 {
                simd.apart(Ask {
                    surface,
                    points: &points,
                    best: &mut self.best,
                    triangle: leaf.triangle[member.lane as usize],
                    near,
                });
            }
        }
        Ok(())
    }

    /// What was found for a point; of nothing, as where coordinates leave no room for a choice, what the hierarchy finds.
    pub(super) fn nearest(&self, surface: &Surface, p: Vec3, [i, j, k]: [usize; 3]) -> Nearest {
        let best = self.best[i + SIDE * (j + SIDE * k)];
        if best.triangle == NO_TRIANGLE { surface.nearest(p) } else { surface.at(p, best) }
    }
}

/// Estimates of one triangle at all points, which lower the points' limits.
#[inline(always)]
fn estimate<S: Simd>(
    simd: S,
    points: &Points,
    one: &Estimate<S::Float>,
    margin: f32,
    limits: &mut [[f32; WIDTH]; GROUPS],
    out: &mut [f32; POINTS],
) {
    let (above, margin) = (S::Float::splat(simd, ABOVE), S::Float::splat(simd, margin));
    let x = one.along::<S>(0, S::Float::load(simd, &points.x));
    for half in 0..points.halves.min(SIDE / 2) {
        let y = one.along::<S>(1, S::Float::load(simd, &points.y[half]));
        let rows = [x[0].add(y[0]), x[1].add(y[1]), x[2].add(y[2])];
        for layer in 0..points.layers.min(SIDE) {
            let z = one.along::<S>(2, S::Float::splat(simd, points.z[layer]));
            let distance = one.distances(simd, [rows[0].add(z[0]), rows[1].add(z[1]), rows[2].add(z[2])]);
            let group = half + SIDE / 2 * layer;
            let upper = distance.mul(above).add(margin);
            limits[group] = upper.min(S::Float::load(simd, &limits[group])).lanes();
            out[WIDTH * group..][..WIDTH].copy_from_slice(&distance.lanes());
        }
    }
}

/// The kernel for one triangle and the points it may be nearest to.
struct Ask<'a> {
    surface: &'a Surface,
    points: &'a Points,
    best: &'a mut [Best; POINTS],
    triangle: u32,
    near: u64,
}

impl Kernel for Ask<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(mut self, _: S) {
        let prepared = self.surface.prepared(self.triangle);
        while self.near != 0 {
            self.some(&prepared);
        }
    }
}

/// Points that the kernel takes at a time.
const N: usize = 4;

impl Ask<'_> {
    /// Asks for some of the points. (Eight at a time leave too few registers.)
    #[inline(always)]
    fn some(&mut self, prepared: &Prepared<f64>) {
        let mut p = V3([F64s::<N>::splat(0.0); 3]);
        let (mut which, mut count) = ([0; N], 0);
        for k in 0..N {
            if self.near != 0 {
                which[k] = self.near.trailing_zeros() as usize & (POINTS - 1);
                self.near &= self.near - 1;
                count += 1;
            } else {
                which[k] = which[0];
            }
            let at = self.points.at(which[k]);
            (p.0[0].0[k], p.0[1].0[k], p.0[2].0[k]) = (at[0], at[1], at[2]);
        }
        let feet = triangle::nearest(&prepared.splat(), p);
        for k in 0..count {
            let foot = Foot { squared: feet.squared.0[k], feature: feet.feature.0[k], along: feet.along.0[k] };
            self.best[which[k]].offer(foot, self.triangle);
        }
    }
}
