// SPDX-License-Identifier: MIT OR Apache-2.0
//! Terrain: solid below bilinear patches through sampled heights. The value is the height above the terrain
//! over the greatest slope's secant, a lower bound of the distance (Hart 1996, section 2.3).

use super::axis::{Axis, between};
use super::pack::HEIGHT_FIELD;
use super::pyramid::Pyramid;
use super::{Facts, Shape};
use crate::error::{Error, Result, try_with_capacity};
use crate::math::{Aabb, Interval, Vec3};
use crate::store::{Array, Packer, Unpacker, wrong};

/// A computed height lies within this much of the greatest magnitude of its patch's corners: two
/// interpolations of three roundings each, twice over.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Below a surface z = h(x, y) over a tensor grid; beyond the grid the edge's heights go on.
pub(crate) struct HeightField {
    axes: [Axis; 2],
    /// x fastest, both axes rising.
    heights: Array<f64>,
    pyramid: Pyramid,
    /// sqrt(1 + g^2), rounded up, g the greatest slope.
    secant: f64,
}

/// The sample at (i, j, k) of the caller's array in the order of the rising axes.
pub(super) fn ordered(name: &str, axes: [Option<&Axis>; 3], given: &[f64]) -> Result<Vec<f64>> {
    let n = axes.map(|axis| axis.map_or(1, Axis::len));
    let count = n.iter().try_fold(1usize, |count, &n| count.checked_mul(n));
    if count != Some(given.len()) {
        let needed = count.map_or("too many".to_owned(), |count| count.to_string());
        return Err(Error::invalid(format!("{name}: {} numbers, {needed} needed", given.len())));
    }
    if let Some(i) = given.iter().position(|x| !x.is_finite()) {
        return Err(Error::invalid(format!("{name}[{i}]: {} is not finite", given[i])));
    }
    let mut samples = try_with_capacity("samples", given.len())?;
    let index = |k: usize, i: usize| axes[k].map_or(i, |axis| axis.given_index(i));
    for k in 0..n[2] {
        for j in 0..n[1] {
            let row = (index(2, k) * n[1] + index(1, j)) * n[0];
            samples.extend((0..n[0]).map(|i| given[row + index(0, i)]));
        }
    }
    Ok(samples)
}

/// sqrt(x^2 + y^2 + z^2) of non-negative numbers, rounded up.
pub(super) fn length_above(x: f64, y: f64, z: f64) -> f64 {
    let square = |x: f64| (x * x).next_up();
    let sum = (square(x) + square(y)).next_up() + square(z);
    sum.next_up().sqrt().next_up()
}

/// |a - b| / length, rounded up.
pub(super) fn slope_above(a: f64, b: f64, length: f64) -> f64 {
    if a == b { 0.0 } else { ((a - b).abs().next_up() / length.next_down()).next_up() }
}

impl HeightField {
    /// `heights[j * nx + i]` is that at `(axes[0][i], axes[1][j])`.
    pub(crate) fn new(axes: [&[f64]; 2], heights: &[f64]) -> Result<HeightField> {
        let axes = [Axis::new("x", axes[0])?, Axis::new("y", axes[1])?];
        let heights = ordered("heights", [Some(&axes[0]), Some(&axes[1]), None], heights)?;
        let pyramid = Pyramid::new([axes[0].len(), axes[1].len(), 1], &heights)?;
        let mut field = HeightField { axes, heights: heights.into(), pyramid, secant: 1.0 };
        field.secant = field.greatest_secant();
        // Beyond that the value's own digits run out.
        if field.secant < 1e150 { Ok(field) } else { Err(Error::invalid("heights: a slope is above 1e150")) }
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<HeightField> {
        let axes = [Axis::unpack(from)?, Axis::unpack(from)?];
        let (heights, pyramid) = Pyramid::unpack(from, [axes[0].len(), axes[1].len(), 1])?;
        let secant = from.finite()?;
        if (1.0..1e150).contains(&secant) {
            Ok(HeightField { axes, heights, pyramid, secant })
        } else {
            Err(wrong("a slope is out of range"))
        }
    }

    /// In a patch each partial derivative is linear along the other axis: the slope is greatest at a corner.
    fn greatest_secant(&self) -> f64 {
        let mut secant = 1.0f64;
        for j in 0..self.axes[1].cells() {
            for i in 0..self.axes[0].cells() {
                let ([a, b], [c, d]) = self.corners(i, j);
                let (dx, dy) = (self.axes[0].length(i), self.axes[1].length(j));
                let along_x = [slope_above(a, b, dx), slope_above(c, d, dx)];
                let along_y = [slope_above(a, c, dy), slope_above(b, d, dy)];
                for (x, y) in along_x.iter().flat_map(|x| along_y.iter().map(move |y| (*x, *y))) {
                    secant = secant.max(length_above(1.0, x, y));
                }
            }
        }
        secant
    }

    /// The heights at the corners of a patch: at its lower y, at its upper y.
    fn corners(&self, i: usize, j: usize) -> ([f64; 2], [f64; 2]) {
        let nx = self.axes[0].len();
        let (lower, upper) = (j * nx + i, (j + 1) * nx + i);
        ([self.heights[lower], self.heights[lower + 1]], [self.heights[upper], self.heights[upper + 1]])
    }

    /// The height at (x, y): the one place where it is computed.
    fn height(&self, x: f64, y: f64) -> f64 {
        let (px, py) = (self.axes[0].place(x), self.axes[1].place(y));
        let ([a, b], [c, d]) = self.corners(px.cell, py.cell);
        between(between(a, b, px.along), between(c, d, px.along), py.along)
    }

    /// The height above the terrain, over the secant; its sign is that of `above` even where it underflows.
    fn scaled(&self, above: f64) -> f64 {
        let value = above / self.secant;
        if value == 0.0 && above != 0.0 { f64::from_bits(1).copysign(above) } else { value }
    }

    /// Between the heights, those that rounding can bring about included.
    fn widened(range: Interval) -> Interval {
        let reach = ROUNDING * range.lo.abs().max(range.hi.abs());
        Interval { lo: range.lo - reach, hi: range.hi + reach }.outward()
    }

    /// Every height over the rectangle. A patch takes its extremes over a part of it at that part's corners:
    /// those are nodes within, points where the border crosses grid lines, and the rectangle's own corners.
    fn heights_over(&self, lo: Vec3, hi: Vec3) -> Interval {
        let mut found = Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY };
        let mut add = |x: f64, y: f64| {
            let h = self.height(x, y);
            found = found.hull(Interval { lo: h, hi: h });
        };
        let [xs, ys] = &self.axes;
        // The first node not below `lo` and the first one above `hi`.
        let within = |axis: &Axis, lo: f64, hi: f64| {
            let nodes = axis.nodes();
            (nodes.partition_point(|&c| c < lo), nodes.partition_point(|&c| c <= hi))
        };
        let (i, j) = (within(xs, lo.x, hi.x), within(ys, lo.y, hi.y));
        for x in [lo.x, hi.x] {
            add(x, lo.y);
            add(x, hi.y);
            ys.nodes()[j.0..j.1].iter().for_each(|&y| add(x, y));
        }
        for y in [lo.y, hi.y] {
            xs.nodes()[i.0..i.1].iter().for_each(|&x| add(x, y));
        }
        if i.0 < i.1 && j.0 < j.1 {
            found = self.pyramid.range(&self.heights, [(i.0, i.1 - 1), (j.0, j.1 - 1), (0, 0)], found);
        }
        HeightField::widened(found)
    }
}

impl Shape for HeightField {
    fn value(&self, p: Vec3) -> f64 {
        self.scaled(p.z - self.height(p.x, p.y))
    }

    fn gradient(&self, p: Vec3) -> Vec3 {
        let (px, py) = (self.axes[0].place(p.x), self.axes[1].place(p.y));
        let ([a, b], [c, d]) = self.corners(px.cell, py.cell);
        let slope = |a: f64, b: f64, axis: &Axis, cell: usize, inside: bool| {
            if inside { (b - a) / axis.length(cell) } else { 0.0 }
        };
        let along_x = slope(between(a, c, py.along), between(b, d, py.along), &self.axes[0], px.cell, px.inside);
        let along_y = slope(between(a, b, px.along), between(c, d, px.along), &self.axes[1], py.cell, py.inside);
        Vec3::new(-along_x / self.secant, -along_y / self.secant, 1.0 / self.secant)
    }

    fn facts(&self) -> Facts {
        let heights = HeightField::widened(self.pyramid.all());
        let size = heights.lo.abs().max(heights.hi.abs());
        Facts {
            bounds: Aabb::new(Vec3::NEG_INFINITY, Vec3::new(f64::INFINITY, f64::INFINITY, heights.hi)),
            rest: Aabb::new(Vec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, heights.lo), Vec3::INFINITY),
            exact: false,
            lipschitz: 1.0,
            // z - h <= d * secant.
            spread: self.secant * (1.0 + 8.0 * f64::EPSILON),
            reach_outward: 0.0,
            reach_inward: 0.0,
            rounding: (4.0 * f64::EPSILON, 2.0 * ROUNDING * size),
        }
    }

    fn range(&self, b: Aabb) -> Interval {
        let above = Interval::new(b.lo.z, b.hi.z) - self.heights_over(b.lo, b.hi);
        // Division by one number is monotone, rounding included.
        Interval::new(self.scaled(above.lo), self.scaled(above.hi)).outward()
    }

    fn words(&self, add: &mut dyn FnMut(u64)) {
        add(HEIGHT_FIELD);
        for axis in &self.axes {
            add(axis.len() as u64);
            axis.nodes().iter().for_each(|x| add(x.to_bits()));
        }
        self.heights.iter().for_each(|h| add(h.to_bits()));
    }

    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.word(HEIGHT_FIELD);
        self.axes.iter().for_each(|axis| axis.pack(out));
        out.array(&self.heights);
        self.pyramid.pack(out);
        out.number(self.secant);
    }

    fn bytes(&self) -> usize {
        let axes: usize = self.axes.iter().map(Axis::bytes).sum();
        size_of::<HeightField>() + axes + size_of_val(&self.heights[..]) + self.pyramid.bytes()
    }
}

#[cfg(test)]
mod tests;
