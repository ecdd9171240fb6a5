// SPDX-License-Identifier: MIT OR Apache-2.0
//! Constructors of sampled bodies and of expressions.

use crate::error::Result;
use crate::geometry::Geometry;
use crate::geometry::shape::{Expression, ExpressionOptions, Grid, HeightField};

impl Geometry {
    /// Terrain: solid below z = h(x, y), bilinear between the heights. `heights[j * nx + i]` is that at
    /// `(axes[0][i], axes[1][j])`. Each axis has at least two coordinates and rises or falls strictly; beyond its
    /// ends the edge's height goes on. Unbounded to the sides and below: intersect it with a box to end it.
    ///
    /// The value is (z - h) / sqrt(1 + g^2), g the greatest slope: a lower bound of the distance, with the sign
    /// exactly that of z - h. O(nx * ny); a value takes O(1) where the axes are even, else O(log n).
    pub fn height_field(axes: [&[f64]; 2], heights: &[f64]) -> Result<Geometry> {
        Geometry::leaf(Box::new(HeightField::new(axes, heights)?))
    }

    /// A function sampled on a tensor grid, negative inside: trilinear between the values, and beyond the grid
    /// that at its nearest point. `values[(k * ny + j) * nx + i]` is that at `(axes[0][i], axes[1][j], axes[2][k])`.
    /// Each axis has at least two coordinates and rises or falls strictly. A body that reaches the grid's border
    /// goes on beyond without end.
    ///
    /// The Lipschitz constant comes from the values; where it is at most 1 the value is a lower bound of the
    /// distance to the surface, else only its sign counts. O(nx * ny * nz).
    pub fn grid(axes: [&[f64]; 3], values: &[f64]) -> Result<Geometry> {
        Geometry::leaf(Box::new(Grid::new(axes, values)?))
    }

    /// A body where an expression of x, y and z is negative, such as `sqrt(x^2+y^2) - 0.3*sin(4*z)`.
    ///
    /// Operators `+ - * / ^` with the usual priorities: `-x^2` is -(x^2), `a^b^c` is a^(b^c). Numbers
    /// such as `1.5e-3`; the constants `pi` and `e`; the functions `sqrt abs exp ln log10 sin cos tan asin acos
    /// atan sinh cosh tanh`, `pow(a, b)`, `atan2(y, x)`, and `min` and `max` of two or more. A whole exponent up to
    /// 64 multiplies out and takes any base. Values have the same bits on every machine; NaN means that the
    /// expression has no value there.
    ///
    /// The body is cut off at `options.bounds`; outside, the value is at least the distance to them times the
    /// Lipschitz constant. At most 65536 bytes and 200 parentheses within each other. Where the Lipschitz
    /// constant is to be found, that takes up to some thousand evaluations.
    pub fn expression(text: &str, options: &ExpressionOptions) -> Result<Geometry> {
        Geometry::leaf(Box::new(Expression::new(text, options)?))
    }
}
