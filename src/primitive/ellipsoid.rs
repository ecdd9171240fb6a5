// SPDX-License-Identifier: MIT OR Apache-2.0
//! Exact signed distance to an ellipsoid after Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or
//! a Hyperellipsoid" (2013), with the root counted from the pole of the least axis: no cancellation in the
//! interior, and one formula for the value, its sign and the normal.
//!
//! With semi-axes e0 >= e1 >= e2, r_i = (e_i / e2)^2, k_i = r_i - 1 and n_i = r_i y_i / e_i, the nearest
//! point of y is x_i = r_i y_i / (t + k_i), where t > 0 is the largest root of sum (n_i / (t + k_i))^2 = 1.
//! Then y - x = (t - 1) v with v_i = y_i / (t + k_i), along the outward normal.

use crate::math::{Vec3, length, unit};

/// More steps than any input takes: the bracket shrinks to a factor of 4 within 12, then Newton doubles digits.
const STEPS: usize = 100;

/// The numbers of one ellipsoid, around the origin and along the axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ellipsoid {
    axes: Vec3,
    least: f64,
    /// Which axis is the least, the last of several.
    pole: usize,
    k: Vec3,
}

impl Ellipsoid {
    /// Semi-axes > 0.
    pub(crate) fn new(axes: Vec3) -> Ellipsoid {
        let least = axes.min_element();
        let pole = (0..3).rev().find(|&i| axes[i] == least).unwrap_or(2);
        let k = (axes - Vec3::splat(least)) / least * ((axes + Vec3::splat(least)) / least);
        Ellipsoid { axes, least, pole, k }
    }

    pub(crate) fn axes(&self) -> Vec3 {
        self.axes
    }

    /// Signed distance; its sign is that of sum (p_i / e_i)^2 - 1 as computed.
    pub(crate) fn value(&self, p: Vec3) -> f64 {
        let (less, v) = self.solve(p.abs());
        less * length(v)
    }

    /// The outward normal at the nearest point; towards larger coordinates where two are nearest.
    pub(crate) fn gradient(&self, p: Vec3) -> Vec3 {
        let (_, v) = self.solve(p.abs());
        let flip = |k: usize| if p[k] < 0.0 { -v[k] } else { v[k] };
        unit(Vec3::new(flip(0), flip(1), flip(2)))
    }

    /// `t - 1` and `v` for a point of the first octant.
    fn solve(&self, y: Vec3) -> (f64, Vec3) {
        let n = y / self.least * (self.axes / self.least);
        if !n.is_finite() {
            // So far off that the axes are below the last digit.
            return (1.0, y);
        }
        let poles_free = (0..3).all(|i| self.k[i] > 0.0 || n[i] == 0.0);
        let sum_at_pole = squares((0..3).filter(|&i| self.k[i] > 0.0).map(|i| n[i] / self.k[i]));
        if poles_free && sum_at_pole < 1.0 {
            // Between the sheets of the medial surface: the nearest points are off the plane, t = 0.
            let mut v = self.direction(y, 0.0);
            v[self.pole] = self.least * (1.0 - sum_at_pole).sqrt();
            return (-1.0, v);
        }
        let outside = squares((0..3).map(|i| y[i] / self.axes[i])) > 1.0;
        let root = self.root(n);
        let t = if outside { root.max(1.0) } else { root.min(1.0) };
        (t - 1.0, self.direction(y, t))
    }

    fn direction(&self, y: Vec3, t: f64) -> Vec3 {
        let part = |i: usize| if y[i] == 0.0 { 0.0 } else { y[i] / (t + self.k[i]) };
        Vec3::new(part(0), part(1), part(2))
    }

    /// The largest root. Newton from the left on a convex falling function never passes it; bisection of the
    /// exponent brings a far root near first.
    fn root(&self, n: Vec3) -> f64 {
        let ratio = |i: usize, t: f64| if n[i] == 0.0 { 0.0 } else { n[i] / (t + self.k[i]) };
        // Each term alone is >= 1 up to its n - k; all together are <= 1 from |n| on.
        let mut lo = (0..3).fold(0.0, |t: f64, i| t.max(n[i] - self.k[i]));
        let mut hi = length(n) * (1.0 + 8.0 * f64::EPSILON);
        for _ in 0..STEPS {
            if lo > 0.0 && hi > 4.0 * lo {
                let middle = lo.sqrt() * hi.sqrt();
                if squares((0..3).map(|i| ratio(i, middle))) >= 1.0 {
                    lo = middle;
                } else {
                    hi = middle;
                }
            }
            let mut excess = -1.0;
            let mut slope = 0.0;
            for i in 0..3 {
                let q = ratio(i, lo);
                excess += q * q;
                slope += if q == 0.0 { 0.0 } else { 2.0 * q * (q / (lo + self.k[i])) };
            }
            let next = lo + excess / slope;
            if !(next > lo && next < hi) {
                break;
            }
            lo = next;
        }
        lo
    }
}

fn squares(terms: impl Iterator<Item = f64>) -> f64 {
    terms.fold(0.0, |sum, x| sum + x * x)
}
