// SPDX-License-Identifier: MIT OR Apache-2.0
//! A function sampled on a tensor grid: trilinear between the samples, constant beyond the grid (the value at
//! its nearest point). In a cell each partial derivative is linear along each axis, so the square of the slope
//! is convex along each and greatest at a corner, which gives the Lipschitz constant; the projection onto the
//! grid's box does not stretch, so it holds everywhere.

use super::axis::{Axis, Place, between};
use super::height_field::{length_above, ordered, slope_above};
use super::pack::{GRID, aabb, pack_box};
use super::pyramid::{Pyramid, each};
use super::{Facts, Shape};
use crate::error::{Error, Result};
use crate::math::{Aabb, Interval, Vec3};
use crate::store::{Array, Packer, Unpacker, wrong};

/// A computed value lies within this much of the greatest magnitude of its cell's corners: three
/// interpolations of three roundings each, nearly twice over.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Interpolation of samples this far from zero cannot underflow to zero.
const TINY: f64 = 16.0 * f64::MIN_POSITIVE;

/// Trilinear interpolation of samples.
pub(crate) struct Grid {
    axes: [Axis; 3],
    /// x fastest, all axes rising.
    values: Array<f64>,
    pyramid: Pyramid,
    lipschitz: f64,
    /// Around what may be inside, and what may be outside.
    around: [Aabb; 2],
}

impl Grid {
    /// `values[(k * ny + j) * nx + i]` is that at `(axes[0][i], axes[1][j], axes[2][k])`.
    pub(crate) fn new(axes: [&[f64]; 3], values: &[f64]) -> Result<Grid> {
        let axes = [Axis::new("x", axes[0])?, Axis::new("y", axes[1])?, Axis::new("z", axes[2])?];
        let values = ordered("values", [Some(&axes[0]), Some(&axes[1]), Some(&axes[2])], values)?;
        let pyramid = Pyramid::new(axes.each_ref().map(Axis::len), &values)?;
        let mut grid = Grid { axes, values: values.into(), pyramid, lipschitz: 0.0, around: [Aabb::ALL; 2] };
        grid.lipschitz = grid.greatest_slope();
        grid.around = [grid.around(|v| v <= TINY), grid.around(|v| v >= -TINY)];
        if grid.lipschitz < 1e150 { Ok(grid) } else { Err(Error::invalid("values: a slope is above 1e150")) }
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Grid> {
        let axes = [Axis::unpack(from)?, Axis::unpack(from)?, Axis::unpack(from)?];
        let (values, pyramid) = Pyramid::unpack(from, axes.each_ref().map(Axis::len))?;
        let (lipschitz, around) = (from.finite()?, [aabb(from)?, aabb(from)?]);
        if (0.0..1e150).contains(&lipschitz) {
            Ok(Grid { axes, values, pyramid, lipschitz, around })
        } else {
            Err(wrong("a slope is out of range"))
        }
    }

    /// The corners of a cell, x fastest.
    fn corners(&self, cell: [usize; 3]) -> [f64; 8] {
        let [nx, ny, _] = self.axes.each_ref().map(Axis::len);
        let first = (cell[2] * ny + cell[1]) * nx + cell[0];
        std::array::from_fn(|c| self.values[first + (c & 1) + (c >> 1 & 1) * nx + (c >> 2) * nx * ny])
    }

    fn greatest_slope(&self) -> f64 {
        let steepest = |cell: [usize; 3]| {
            let v = self.corners(cell);
            let at_corner = |c: usize| {
                let along = |k: usize| slope_above(v[c], v[c ^ 1 << k], self.axes[k].length(cell[k]));
                length_above(along(0), along(1), along(2))
            };
            let is_flat = v.iter().all(|x| *x == v[0]);
            if is_flat { 0.0 } else { (0..8).map(at_corner).fold(0.0, f64::max) }
        };
        let mut greatest = 0.0f64;
        each(self.axes.each_ref().map(|axis| (0, axis.cells() - 1)), |cell| greatest = greatest.max(steepest(cell)));
        greatest
    }

    /// Where `p` is along each axis, and the corners of its cell.
    fn place(&self, p: Vec3) -> ([Place; 3], [f64; 8]) {
        let places = [self.axes[0].place(p.x), self.axes[1].place(p.y), self.axes[2].place(p.z)];
        let corners = self.corners(places.map(|place| place.cell));
        (places, corners)
    }

    /// Around the cells with a corner that `counts`; without end where such a corner is on the grid's border.
    fn around(&self, counts: impl Fn(f64) -> bool) -> Aabb {
        let n = self.axes.each_ref().map(Axis::len);
        // A node's cells reach to its neighbours: the hull of the nodes, one wider, is that of the cells.
        let (mut first, mut last) = (n, [0; 3]);
        for (index, _) in self.values.iter().enumerate().filter(|(_, v)| counts(**v)) {
            let node = [index % n[0], index / n[0] % n[1], index / n[0] / n[1]];
            for k in 0..3 {
                first[k] = first[k].min(node[k]);
                last[k] = last[k].max(node[k]);
            }
        }
        if first[0] > last[0] {
            return Aabb::EMPTY;
        }
        let lo = |k: usize| if first[k] == 0 { f64::NEG_INFINITY } else { self.axes[k].nodes()[first[k] - 1] };
        let hi = |k: usize| if last[k] + 1 == n[k] { f64::INFINITY } else { self.axes[k].nodes()[last[k] + 1] };
        Aabb::new(Vec3::new(lo(0), lo(1), lo(2)), Vec3::new(hi(0), hi(1), hi(2)))
    }
}

/// Trilinear, x first.
fn interpolated(v: &[f64; 8], along: [f64; 3]) -> f64 {
    let row = |c: usize| between(v[c], v[c + 1], along[0]);
    between(between(row(0), row(2), along[1]), between(row(4), row(6), along[1]), along[2])
}

impl Shape for Grid {
    fn value(&self, p: Vec3) -> f64 {
        let (places, corners) = self.place(p);
        interpolated(&corners, places.map(|place| place.along))
    }

    fn gradient(&self, p: Vec3) -> Vec3 {
        let (places, v) = self.place(p);
        let along = places.map(|place| place.along);
        let component = |k: usize| {
            // The value at either face across axis k, over the length between them.
            let at = |side: f64| interpolated(&v, std::array::from_fn(|m| if m == k { side } else { along[m] }));
            if places[k].inside { (at(1.0) - at(0.0)) / self.axes[k].length(places[k].cell) } else { 0.0 }
        };
        let gradient = Vec3::new(component(0), component(1), component(2));
        // Constant there: no direction is better than another.
        if gradient == Vec3::ZERO { Vec3::Z } else { gradient }
    }

    fn facts(&self) -> Facts {
        let all = self.pyramid.all();
        Facts {
            bounds: self.around[0],
            rest: self.around[1],
            exact: false,
            lipschitz: self.lipschitz,
            spread: f64::INFINITY,
            reach_outward: 0.0,
            reach_inward: 0.0,
            rounding: (0.0, 2.0 * ROUNDING * all.lo.abs().max(all.hi.abs())),
        }
    }

    fn range(&self, b: Aabb) -> Interval {
        let (lo, hi) = (b.lo.to_array(), b.hi.to_array());
        let span = std::array::from_fn(|k| (self.axes[k].place(lo[k]).cell, self.axes[k].place(hi[k]).cell + 1));
        let none = Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY };
        let range = self.pyramid.range(&self.values, span, none);
        // Of one sign where all corners are: weights are not negative.
        let reach = |end: f64| ROUNDING * end.abs() + TINY;
        let lo = if range.lo > TINY { range.lo * (1.0 - ROUNDING) } else { range.lo - reach(range.lo) };
        let hi = if range.hi < -TINY { range.hi * (1.0 - ROUNDING) } else { range.hi + reach(range.hi) };
        Interval::new(lo, hi).outward()
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(GRID);
        for axis in &self.axes {
            add(axis.len() as u64);
            axis.nodes().iter().for_each(|x| add(x.to_bits()));
        }
        self.values.iter().for_each(|v| add(v.to_bits()));
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(GRID);
        self.axes.iter().for_each(|axis| axis.pack(out));
        out.array(&self.values);
        self.pyramid.pack(out);
        out.number(self.lipschitz);
        self.around.iter().for_each(|b| pack_box(*b, out));
    }

    fn bytes(&self) -> usize {
        let axes: usize = self.axes.iter().map(Axis::bytes).sum();
        size_of::<Grid>() + axes + size_of_val(&self.values[..]) + self.pyramid.bytes()
    }
}

#[cfg(test)]
mod tests;
