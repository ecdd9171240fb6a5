// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bodies in closed form and sampled ones: the leaves of the tree that need no mesh. One shape a file.

mod axis;
mod cuboid;
mod ellipsoid;
mod expression;
mod extruded;
mod grid;
mod height_field;
mod lanes;
mod outline;
mod pack;
mod perlin;
mod plane;
mod profiles;
mod pyramid;
mod revolved;
mod rounded_box;
#[cfg(test)]
mod samples;
mod solids;
mod sphere;
mod support;
#[cfg(test)]
mod tests;

pub(super) use cuboid::Cuboid;
pub(super) use ellipsoid::Ellipsoid;
pub(crate) use expression::Expression;
pub use expression::ExpressionOptions;
pub(super) use extruded::Extruded;
pub(crate) use grid::Grid;
pub(crate) use height_field::HeightField;
pub(super) use pack::unpack;
pub(super) use perlin::Perlin;
pub(super) use plane::Plane;
pub(super) use revolved::Revolved;
pub(super) use rounded_box::RoundedBox;
pub(super) use sphere::Sphere;

use super::points::Points;
use crate::math::{Aabb, Interval, Vec3};
use crate::store::Packer;

/// A leaf that knows its value, its gradient and the facts that the tree above it needs.
pub(crate) trait Shape: Send + Sync {
    /// The value at a finite point: negative inside, positive outside. The same bits on every machine.
    fn value(&self, p: Vec3) -> f64;

    /// The values at many finite points: the bits of [`Shape::value`].
    fn values(&self, points: Points, out: &mut [f64]) {
        points.iter().zip(out).for_each(|(p, value)| *value = self.value(p));
    }

    /// The gradient of the value at a finite point: of length 1 where the shape is exact; never zero and
    /// never NaN (where there is none, that of either side).
    fn gradient(&self, p: Vec3) -> Vec3;

    /// What is known of the shape. Asked once, when the geometry is built.
    fn facts(&self) -> Facts;

    /// Numbers between which every computed value in the finite box `b` lies, where the shape knows better
    /// than the value in the middle and the Lipschitz constant do.
    fn range(&self, _b: Aabb) -> Interval {
        Interval::ALL
    }

    /// Whether the value may be NaN at a finite point.
    fn may_fail(&self) -> bool {
        false
    }

    /// Where the line through `a` (0) and `b` (1) is inside, with the outward normals at both ends, for a
    /// convex shape that has a closed form for it.
    fn crossings(&self, _a: Vec3, _b: Vec3) -> Crossings {
        Crossings::Unknown
    }

    /// Feeds the numbers that define the shape, and nothing else, to `add`; the first tells the kind of
    /// shape apart from all others.
    fn words(&self, add: &mut dyn FnMut(u64));

    /// The same to the bit, with whatever would take long to find anew, for a block.
    fn pack<'a>(&'a self, out: &mut Packer<'a>);

    /// Memory of the shape in bytes, what it holds on the heap included.
    fn bytes(&self) -> usize;
}

/// Where a line is inside a convex shape.
pub(crate) enum Crossings {
    /// Not known: the values along the line decide.
    Unknown,
    /// Nowhere.
    Misses,
    /// Between two places, each with the outward unit normal there.
    Between((f64, Vec3), (f64, Vec3)),
}

/// What the tree knows of a leaf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facts {
    /// Around the body: every point whose computed value is <= 0 lies within.
    pub(crate) bounds: Aabb,
    /// Around the rest of space and the surface.
    pub(crate) rest: Aabb,
    /// Whether the value is the signed distance everywhere. Where it is not, it is a lower bound of the
    /// distance if `lipschitz <= 1`, and else only its sign counts.
    pub(crate) exact: bool,
    /// |f(p) - f(q)| <= lipschitz |p - q|; infinite where unknown.
    pub(crate) lipschitz: f64,
    /// Every point of value <= d, d > 0, is within d * spread of `bounds`, and likewise -f of `rest`;
    /// 1 where the value is a distance, infinite where unknown.
    pub(crate) spread: f64,
    /// How far the surface can be offset outward so that the value minus the offset is still the exact
    /// distance (infinite for convex bodies; 0: not known).
    pub(crate) reach_outward: f64,
    /// The same inward (0 where there is a convex edge; the radius of a ball).
    pub(crate) reach_inward: f64,
    /// Bound on |computed value - true value| for coordinates of magnitude up to E: `rounding.0 * E + rounding.1`.
    pub(crate) rounding: (f64, f64),
}

impl Facts {
    /// An exact convex body; `size` is the largest magnitude among its numbers, and the value is off by at most
    /// 64 roundings of the coordinates and of it.
    pub(crate) fn convex(bounds: Aabb, size: f64) -> Facts {
        let unit = 64.0 * f64::EPSILON;
        Facts {
            bounds,
            rest: Aabb::ALL,
            exact: true,
            lipschitz: 1.0,
            spread: 1.0,
            reach_outward: f64::INFINITY,
            reach_inward: 0.0,
            rounding: (unit, unit * size),
        }
    }

    /// An exact body that is not convex.
    pub(crate) fn exact(bounds: Aabb, size: f64) -> Facts {
        Facts { reach_outward: 0.0, ..Facts::convex(bounds, size) }
    }
}
