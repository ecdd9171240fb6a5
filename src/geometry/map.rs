// SPDX-License-Identifier: MIT OR Apache-2.0
//! Bodies seen through a map of space that is no rigid placement: the value is that of the child at the
//! mapped point, times a factor.

use super::placement::around;
use super::properties::Kind;
use super::summary::{Summary, grown};
use crate::error::{Error, Result};
use crate::math::{Aabb, Mat3, Vec3, length};

/// From a point of space to a point of the child.
#[derive(Clone, Copy, Debug)]
pub(super) enum Map {
    Linear(Linear),
    /// Stretched apart: p - clamp(p, -e, e).
    Elongate(Vec3),
    /// Turned about the z axis by so many radians a unit of height.
    Twist(f64),
}

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

impl Map {
    /// The child's point.
    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        match self {
            Map::Linear(l) => l.matrix * p + l.offset,
            Map::Elongate(e) => p - p.clamp(-*e, *e),
            Map::Twist(rate) => {
                let (s, c) = turn(*rate * p.z);
                Vec3::new(c * p.x + s * p.y, c * p.y - s * p.x, p.z)
            }
        }
    }

    /// What the child's value is multiplied by.
    pub(super) fn factor(&self) -> f64 {
        match self {
            Map::Linear(l) => l.factor,
            Map::Elongate(_) | Map::Twist(_) => 1.0,
        }
    }

    /// The gradient at `p` from the child's at the mapped point: by the transpose of the derivative.
    pub(super) fn gradient(&self, p: Vec3, g: Vec3) -> Vec3 {
        match self {
            Map::Linear(l) => l.matrix.transpose() * g * l.factor,
            Map::Elongate(e) => Vec3::select(p.abs().cmpgt(*e), g, Vec3::ZERO),
            Map::Twist(rate) => {
                let (s, c) = turn(*rate * p.z);
                let q = self.point(p);
                Vec3::new(c * g.x - s * g.y, s * g.x + c * g.y, g.z + rate * (g.x * q.y - g.y * q.x))
            }
        }
    }

    /// Whether straight lines stay straight.
    pub(super) fn is_linear(&self) -> bool {
        matches!(self, Map::Linear(_))
    }

    /// A box around the mapped points of a box, rounding included.
    pub(super) fn box_of(&self, b: Aabb) -> Aabb {
        match self {
            Map::Linear(l) => around(b, l.matrix, l.offset, |p| self.point(p)),
            // Monotone along each axis, rounding included.
            Map::Elongate(_) => Aabb::new(self.point(b.lo), self.point(b.hi)),
            Map::Twist(rate) => {
                let corner = b.lo.abs().max(b.hi.abs());
                let radius = length(Vec3::new(corner.x, corner.y, 0.0)) * (1.0 + 1e-12);
                let half = (0.5 * (b.hi.z - b.lo.z) * rate).abs();
                let middle = self.point(b.center());
                let reach =
                    length((b.hi - b.lo).with_z(0.0)) * 0.5 + radius * (half + 1e-12 * (1.0 + (rate * corner.z).abs()));
                let reach = if reach < 2.0 * radius { reach } else { 2.0 * radius };
                let reach = Vec3::new(reach, reach, 0.0) * (1.0 + 1e-12);
                Aabb::new((middle - reach).with_z(b.lo.z), (middle + reach).with_z(b.hi.z))
            }
        }
    }

    /// Of the node over a child of which `s` is known.
    pub(super) fn summary(&self, s: Summary) -> Summary {
        let bound = |is_bound: bool| match s.kind {
            Kind::SignOnly => Kind::SignOnly,
            _ if is_bound && s.lipschitz <= 1.0 => Kind::LowerBound,
            _ => Kind::SignOnly,
        };
        let base = Summary { reach_outward: 0.0, reach_inward: 0.0, ..s };
        let steep = s.steepness();
        match self {
            Map::Linear(Linear { back: Some(back), factor, norm, offset, .. }) => {
                let to_space = |b: Aabb| back.around(b);
                let most = back.most();
                let unit = 64.0 * f64::EPSILON * factor * steep;
                // A point of space with coordinates up to E is mapped to within 3 norm E + |offset|.
                let (reach, far) = (3.0 * norm, offset.abs().max_element());
                Summary {
                    bounds: to_space(s.bounds),
                    rest: to_space(s.rest),
                    kind: bound(true),
                    spread: s.spread * most / factor,
                    spread_rest: s.spread_rest * most / factor,
                    spread_axis: s.spread.max(s.spread_rest) * most / factor,
                    rounding: (
                        (factor * s.rounding.0 + unit) * reach,
                        factor * s.rounding.1 + (factor * s.rounding.0 + unit) * far,
                    ),
                    ..base
                }
            }
            Map::Linear(l) => Summary {
                bounds: self.sliced(l, s.bounds),
                rest: self.sliced(l, s.rest),
                kind: bound(true),
                // Nothing is known of how fast the value rises within the plane.
                spread: f64::INFINITY,
                spread_rest: f64::INFINITY,
                spread_axis: f64::INFINITY,
                rounding: (
                    3.0 * s.rounding.0 + 64.0 * f64::EPSILON * steep,
                    s.rounding.1 + (s.rounding.0 + 64.0 * f64::EPSILON * steep) * l.offset.abs().max_element(),
                ),
                ..base
            },
            Map::Elongate(e) => Summary {
                bounds: grown(s.bounds, *e),
                rest: grown(s.rest, *e),
                kind: bound(true),
                rounding: (2.0 * s.rounding.0 + 4.0 * f64::EPSILON * steep, s.rounding.1),
                ..base
            },
            Map::Twist(_) => Summary {
                bounds: turned_about_z(s.bounds),
                rest: turned_about_z(s.rest),
                kind: Kind::SignOnly,
                lipschitz: f64::INFINITY,
                spread: f64::INFINITY,
                spread_rest: f64::INFINITY,
                spread_axis: f64::INFINITY,
                rounding: (2.0 * s.rounding.0 + 64.0 * f64::EPSILON * steep, s.rounding.1),
                ..base
            },
        }
    }

    /// Around the part of a plane that lies in a box: every height is in it.
    fn sliced(&self, l: &Linear, b: Aabb) -> Aabb {
        let mut plane = Aabb::ALL;
        if b.lo.cmpgt(b.hi).any() || !b.is_finite() {
            return plane;
        }
        // u and v of a point of the box: its offset from the origin along both.
        let seen = around(b, l.matrix.transpose(), l.offset, |p| l.matrix.transpose() * (p - l.offset));
        for k in 0..2 {
            (plane.lo[k], plane.hi[k]) = (seen.lo[k], seen.hi[k]);
        }
        plane
    }

    pub(super) fn words(&self, add: &mut dyn FnMut(u64)) {
        let mut number = |x: f64| add((x + 0.0).to_bits());
        match self {
            Map::Linear(l) => {
                number(1.0);
                l.matrix.to_cols_array().into_iter().for_each(&mut number);
                l.offset.to_array().into_iter().for_each(&mut number);
                number(l.factor);
            }
            Map::Elongate(e) => {
                number(2.0);
                e.to_array().into_iter().for_each(number);
            }
            Map::Twist(rate) => {
                number(3.0);
                number(*rate);
            }
        }
    }
}

fn turn(angle: f64) -> (f64, f64) {
    (libm::sin(angle), libm::cos(angle))
}

/// Around a box turned about the z axis by any angle.
fn turned_about_z(b: Aabb) -> Aabb {
    let corner = b.lo.abs().max(b.hi.abs());
    let radius = length(Vec3::new(corner.x, corner.y, 0.0)) * (1.0 + 1e-12);
    if radius.is_finite() && b.lo.cmple(b.hi).all() {
        Aabb::new(Vec3::new(-radius, -radius, b.lo.z), Vec3::new(radius, radius, b.hi.z))
    } else if b.is_empty() && b == Aabb::EMPTY {
        b
    } else {
        Aabb::ALL
    }
}
