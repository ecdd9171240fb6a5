// SPDX-License-Identifier: MIT OR Apache-2.0
//! Linear maps of space that are no placements, with a shift: affine ones, and the plane of a slice.

use super::placement::around;
use super::properties::Kind;
use super::summary::Summary;
use crate::error::{Error, Result};
use crate::math::{Aabb, Mat3, Vec3, length};
use crate::store::{Packer, Unpacker};

/// `matrix * p + offset`, with what the value is multiplied by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Linear {
    matrix: Mat3,
    offset: Vec3,
    factor: f64,
    /// The largest factor by which the map lengthens.
    norm: f64,
    /// The way back, where there is one.
    back: Option<Back>,
}

/// `matrix * q + shift`: the inverse to within `error` of the length of a point.
#[derive(Clone, Copy, Debug)]
struct Back {
    matrix: Mat3,
    shift: Vec3,
    error: f64,
}

impl Linear {
    /// A point q of the body comes to `matrix * q + shift`; the value is multiplied by the least factor by
    /// which that lengthens, so that a distance becomes a lower bound of the distance.
    pub(super) fn affine(matrix: [f64; 9], shift: Vec3) -> Result<Linear> {
        if let Some(k) = matrix.iter().position(|c| !c.is_finite()) {
            return Err(Error::invalid(format!("matrix[{k}]: {} is not finite", matrix[k])));
        }
        let forward = Mat3::from_cols_array(&matrix).transpose();
        let size = forward.to_cols_array().into_iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        // Of length about 1; NaN where the matrix is zero.
        let forward_unit = forward * (1.0 / size);
        let inverse_unit = inverse(forward_unit);
        // From the inverse as it was computed: that is what values see.
        let least = if inverse_unit.is_finite() { 1.0 / most_stretch(inverse_unit) } else { 0.0 };
        let condition = most_stretch(forward_unit) / least;
        if condition.is_nan() || condition >= MOST_CONDITION {
            return Err(Error::invalid(format!(
                "matrix: it shrinks a direction to {least:e} of its largest element, {size}: it has no inverse"
            )));
        }
        let matrix = inverse_unit * (1.0 / size);
        let (factor, offset) = (least * size * (1.0 - 1e-9), matrix * -shift);
        if !(factor.is_normal() && matrix.is_finite() && offset.is_finite()) {
            return Err(Error::invalid(format!(
                "matrix: its largest element, {size:e}, brings the inverse beyond the range of numbers"
            )));
        }
        let back = Back { matrix: forward, shift, error: 64.0 * f64::EPSILON * condition };
        Ok(Linear { matrix, offset, factor, norm: 1.0 / factor, back: Some(back) })
    }

    /// The plane through `origin` along two unit vectors at a right angle, as the plane of x and y.
    pub(super) fn slice(origin: Vec3, u: Vec3, v: Vec3) -> Linear {
        let matrix = Mat3::from_cols(u, v, Vec3::ZERO);
        Linear { matrix, offset: origin, factor: 1.0, norm: 1.0 + 1e-9, back: None }
    }

    /// What it was made of.
    pub(super) fn pack(&self, out: &mut Packer) {
        out.word(u64::from(self.back.is_some()));
        match &self.back {
            Some(back) => {
                out.numbers(back.matrix.transpose().to_cols_array());
                out.vector(back.shift);
            }
            None => [self.offset, self.matrix.x_axis, self.matrix.y_axis].into_iter().for_each(|v| out.vector(v)),
        }
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Linear> {
        match from.flag()? {
            true => Linear::affine(from.numbers()?, from.vector()?),
            false => Ok(Linear::slice(from.vector()?, from.vector()?, from.vector()?)),
        }
    }

    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        self.matrix * p + self.offset
    }

    pub(super) fn factor(&self) -> f64 {
        self.factor
    }

    /// From the child's gradient: by the transpose of the derivative.
    pub(super) fn gradient(&self, g: Vec3) -> Vec3 {
        self.matrix.transpose() * g * self.factor
    }

    /// A box around the mapped points of a box, rounding included.
    pub(super) fn box_of(&self, b: Aabb) -> Aabb {
        around(b, self.matrix, self.offset, |p| self.point(p))
    }

    /// Of the node over a child of which all but what the map changes is in `s`.
    pub(super) fn summary(&self, s: Summary, kind: Kind) -> Summary {
        let steep = s.steepness();
        // A point of space up to E from the origin is mapped to within norm E + |offset|.
        let far = length(self.offset);
        let Some(back) = &self.back else {
            let unit = s.rounding.0 + 64.0 * f64::EPSILON * steep;
            return Summary {
                bounds: self.sliced(s.bounds),
                rest: self.sliced(s.rest),
                kind,
                // Nothing is known of how fast the value rises within the plane.
                spread: f64::INFINITY,
                spread_rest: f64::INFINITY,
                spread_axis: f64::INFINITY,
                rounding: (unit, s.rounding.1 + unit * far),
                magnitude: s.magnitude + steep * far,
                ..s
            };
        };
        let (factor, widest) = (self.factor, back.most() / self.factor);
        let unit = factor * s.rounding.0 + 64.0 * f64::EPSILON * factor * steep;
        Summary {
            bounds: back.around(s.bounds),
            rest: back.around(s.rest),
            kind,
            spread: s.spread * widest,
            spread_rest: s.spread_rest * widest,
            spread_axis: s.spread.max(s.spread_rest) * widest,
            rounding: (unit * self.norm, factor * (s.rounding.1 + 2.0 * f64::EPSILON * s.magnitude) + unit * far),
            magnitude: factor * (s.magnitude + steep * far),
            ..s
        }
    }

    /// Around the part of a plane that lies in a box: every height is in it.
    fn sliced(&self, b: Aabb) -> Aabb {
        let mut plane = Aabb::ALL;
        if b.lo.cmpgt(b.hi).any() || !b.is_finite() {
            return plane;
        }
        // u and v of a point of the box: its offset from the origin along both.
        let seen = around(b, self.matrix.transpose(), self.offset, |p| self.matrix.transpose() * (p - self.offset));
        for k in 0..2 {
            (plane.lo[k], plane.hi[k]) = (seen.lo[k], seen.hi[k]);
        }
        plane
    }

    /// The numbers that define it.
    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> {
        self.matrix.to_cols_array().into_iter().chain(self.offset.to_array()).chain([self.factor])
    }
}

/// Matrices that stretch in one direction so many times as much as in another are refused.
const MOST_CONDITION: f64 = 1e12;

/// By Gauss' and Jordan's elimination with the largest pivots (Golub & Van Loan 2013, section 3.4): its error is
/// that of the matrix's elements times how far the stretches differ. (Cofactors would square that.) Not finite
/// where a pivot is zero.
fn inverse(m: Mat3) -> Mat3 {
    let columns = m.to_cols_array_2d();
    let mut rows: [[f64; 6]; 3] =
        [0, 1, 2].map(|r| std::array::from_fn(|c| if c < 3 { columns[c][r] } else { f64::from(c == r + 3) }));
    let mut pivots = [(0, 0); 3];
    for step in 0..3 {
        let used = pivots;
        let is_free = |r: usize, c: usize| used[..step].iter().all(|&(row, column)| row != r && column != c);
        let free = (0..9).map(|k| (k / 3, k % 3)).filter(|&(r, c)| is_free(r, c));
        let (row, column) = free.fold((9, 9), |best, (r, c)| match best {
            (9, 9) => (r, c),
            (row, column) if rows[r][c].abs() > rows[row][column].abs() => (r, c),
            _ => best,
        });
        pivots[step] = (row, column);
        let pivot = rows[row][column];
        rows[row].iter_mut().for_each(|x| *x /= pivot);
        let line = rows[row];
        for r in (0..3).filter(|&r| r != row) {
            let factor = rows[r][column];
            (0..6).for_each(|c| rows[r][c] -= factor * line[c]);
        }
    }
    let mut transposed = Mat3::ZERO;
    for (row, column) in pivots {
        *transposed.col_mut(column) = Vec3::from_slice(&rows[row][3..]);
    }
    transposed.transpose()
}

/// The largest factor by which a matrix lengthens: the root of the largest eigenvalue of its transpose times
/// itself, by Jacobi's rotations (Golub & Van Loan 2013, section 8.5). (The least one would drown in its
/// rounding.)
fn most_stretch(m: Mat3) -> f64 {
    let gram = m.transpose() * m;
    let mut a = gram.to_cols_array_2d();
    for _ in 0..30 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            for k in 0..3 {
                (a[k][p], a[k][q]) = (c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]);
            }
            for k in 0..3 {
                (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]);
            }
        }
    }
    [0, 1, 2].map(|k| a[k][k].max(0.0).sqrt()).into_iter().fold(0.0, f64::max)
}

impl Back {
    /// Around a box of the body, in space: it holds every point that is mapped into the box.
    fn around(&self, b: Aabb) -> Aabb {
        let b = around(b, self.matrix, self.shift, |q| self.matrix * q + self.shift);
        if !b.is_finite() {
            return b;
        }
        let extent = length(b.lo.abs().max(b.hi.abs())) + length(self.shift);
        let room = Vec3::splat(self.error * extent);
        Aabb::new(b.lo - room, b.hi + room)
    }

    /// The largest factor by which it lengthens.
    fn most(&self) -> f64 {
        let size = self.matrix.to_cols_array().into_iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        most_stretch(self.matrix * (1.0 / size)) * size * (1.0 + 1e-9 + self.error)
    }
}
