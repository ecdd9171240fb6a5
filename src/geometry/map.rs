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
    back: Option<(Mat3, Vec3)>,
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
        let (least, most) = stretches(forward * (1.0 / size));
        // NaN where the matrix is zero.
        if least.is_nan() || least <= 1e-12 * most {
            return Err(Error::invalid(format!(
                "matrix: it shrinks a direction to {least:e} of its largest element, {size}: it has no inverse"
            )));
        }
        let inverse = forward.inverse();
        let room = 1.0 - 1e-9;
        Ok(Linear {
            matrix: inverse,
            offset: inverse * -shift,
            factor: least * size * room,
            norm: 1.0 / (least * size * room),
            back: Some((forward, shift)),
        })
    }

    /// The plane through `origin` along two unit vectors at a right angle, as the plane of x and y.
    pub(super) fn slice(origin: Vec3, u: Vec3, v: Vec3) -> Linear {
        let matrix = Mat3::from_cols(u, v, Vec3::ZERO);
        Linear { matrix, offset: origin, factor: 1.0, norm: 1.0 + 1e-9, back: None }
    }
}

/// The least and the largest factor by which a matrix lengthens: roots of the eigenvalues of its transpose
/// times itself, by Jacobi's rotations (Golub & Van Loan 2013, section 8.5).
fn stretches(m: Mat3) -> (f64, f64) {
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
    let roots = [0, 1, 2].map(|k| a[k][k].max(0.0).sqrt());
    (roots[0].min(roots[1]).min(roots[2]), roots[0].max(roots[1]).max(roots[2]))
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
            Map::Linear(Linear { back: Some((forward, shift)), factor, norm, offset, .. }) => {
                let to_space = |b: Aabb| around(b, *forward, *shift, |q| *forward * q + *shift);
                let most = stretches(*forward).1 * (1.0 + 1e-9);
                let unit = 64.0 * f64::EPSILON * factor * steep;
                // A point of space with coordinates up to E is mapped to within 3 norm E + |offset|.
                let (reach, far) = (3.0 * norm, offset.abs().max_element());
                Summary {
                    bounds: to_space(s.bounds),
                    rest: to_space(s.rest),
                    kind: bound(true),
                    lipschitz: s.lipschitz * (1.0 + 1e-12),
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
                lipschitz: s.lipschitz * (1.0 + 1e-12),
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
