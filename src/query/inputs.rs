// SPDX-License-Identifier: MIT OR Apache-2.0
//! Points and lattices as callers hold them.

use crate::error::{Error, Result};
use crate::math::Vec3;

/// Points to ask about.
pub trait PointSource: Sync {
    /// How many.
    fn count(&self) -> usize;
    /// The points `start .. start + out.len()`.
    fn load(&self, start: usize, out: &mut [Vec3]);
}

/// Three arrays with one stride: stride 1 for separate arrays, stride 3 for `p`, `p[1..]`, `p[2..]`.
pub struct Strided<'a, T> {
    count: usize,
    axes: [&'a [T]; 3],
    stride: usize,
}

impl<'a, T: Copy + Into<f64> + Sync> Strided<'a, T> {
    /// `count` points; each array holds at least `(count - 1) * stride + 1` elements.
    pub fn new(count: usize, axes: [&'a [T]; 3], stride: usize) -> Result<Strided<'a, T>> {
        if stride == 0 {
            return Err(Error::invalid("stride: 0 is not at least 1"));
        }
        let needed = match count.checked_sub(1) {
            None => 0,
            Some(last) => last
                .checked_mul(stride)
                .and_then(|n| n.checked_add(1))
                .ok_or_else(|| Error::invalid(format!("count: {count} points of stride {stride} overflow")))?,
        };
        for (name, axis) in ["x", "y", "z"].iter().zip(axes) {
            if axis.len() < needed {
                return Err(Error::invalid(format!("{name}: {} elements, {needed} needed", axis.len())));
            }
        }
        Ok(Strided { count, axes, stride })
    }
}

impl<T: Copy + Into<f64> + Sync> PointSource for Strided<'_, T> {
    fn count(&self) -> usize {
        self.count
    }

    fn load(&self, start: usize, out: &mut [Vec3]) {
        let [x, y, z] = self.axes;
        for (k, p) in out.iter_mut().enumerate() {
            let at = (start + k) * self.stride;
            *p = Vec3::new(x[at].into(), y[at].into(), z[at].into());
        }
    }
}

/// A tensor grid: the point (i, j, k) is `(x[i], y[j], z[k])`.
#[derive(Clone, Copy)]
pub struct Lattice<'a> {
    /// The three axes.
    pub axes: [&'a [f64]; 3],
}

impl<'a> Lattice<'a> {
    /// Each axis finite and monotone either way, repeats allowed.
    pub fn new(x: &'a [f64], y: &'a [f64], z: &'a [f64]) -> Result<Lattice<'a>> {
        let axes = [x, y, z];
        for (name, axis) in ["x", "y", "z"].iter().zip(axes) {
            if let Some(i) = axis.iter().position(|c| !c.is_finite()) {
                return Err(Error::invalid(format!("lattice.{name}[{i}]: {} is not finite", axis[i])));
            }
            let falling = axis.first() > axis.last();
            let turn = axis.windows(2).position(|w| if falling { w[1] > w[0] } else { w[1] < w[0] });
            if let Some(i) = turn {
                return Err(Error::invalid(format!(
                    "lattice.{name}[{}]: {} after {} is not monotone",
                    i + 1,
                    axis[i + 1],
                    axis[i]
                )));
            }
        }
        let points = axes.iter().try_fold(1usize, |n, axis| n.checked_mul(axis.len()));
        if points.is_none_or(|n| n > isize::MAX as usize / 8) {
            let [a, b, c] = axes.map(<[f64]>::len);
            return Err(Error::invalid(format!("lattice.n: {a} x {b} x {c} points overflow")));
        }
        Ok(Lattice { axes })
    }

    /// The point (i, j, k).
    pub(super) fn point(&self, at: [usize; 3]) -> Vec3 {
        Vec3::new(self.axes[0][at[0]], self.axes[1][at[1]], self.axes[2][at[2]])
    }

    /// Edges along one axis, along each.
    pub(super) fn edges(&self, axis: usize) -> [usize; 3] {
        let mut edges = self.n();
        edges[axis] = edges[axis].saturating_sub(1);
        edges
    }

    /// Points along each axis.
    pub fn n(&self) -> [usize; 3] {
        self.axes.map(<[f64]>::len)
    }
}
