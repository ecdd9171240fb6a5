// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where a segment meets the surface. Exact and watertight along an axis; elsewhere a segment through a
//! vertex may be miscounted, which shows in the parity.

use super::Surface;
use crate::math::{Aabb, Vec3};
use crate::primitive::crossing::{AxisLine, segment_meets};
use crate::scan::Triangles;

/// One meeting of a segment with a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    /// 0 at the start, 1 at the end.
    pub(crate) t: f64,
    pub(crate) triangle: u32,
    /// Change of the winding number on the way from start to end.
    pub(crate) change: i32,
    /// Outward unit normal of the triangle.
    pub(crate) normal: Vec3,
}

impl Surface {
    /// All meetings with the open segment, those with caps of holes included, in order; of equal ones the lower triangle first.
    pub(crate) fn hits(&self, a: Vec3, b: Vec3) -> Vec<Hit> {
        let mut hits = Vec::new();
        let differing: Vec<usize> = (0..3).filter(|&k| a[k] != b[k]).collect();
        self.each_in(Aabb::of([a, b]), &mut |triangle| {
            let corners = Triangles::corners(self, triangle);
            let change = match differing[..] {
                [axis] => along_axis(axis, a, b, corners),
                _ => -segment_meets(a, b, corners),
            };
            if change != 0 {
                hits.push(self.hit(a, b, triangle, change));
            }
        });
        Hit::sort(&mut hits);
        hits
    }
}

impl Hit {
    /// In order; of equal ones the lower triangle first.
    pub(crate) fn sort(hits: &mut [Hit]) {
        hits.sort_unstable_by(|u, v| u.t.total_cmp(&v.t).then(u.triangle.cmp(&v.triangle)));
    }
}

/// Change of the winding number from `a` to `b`, which differ along `axis` only.
fn along_axis(axis: usize, a: Vec3, b: Vec3, corners: [Vec3; 3]) -> i32 {
    let line = AxisLine::new(axis, a);
    let turn = line.meets(corners);
    if turn == 0 {
        return 0;
    }
    let before = line.below(a[axis], corners, turn);
    let after = line.below(b[axis], corners, turn);
    turn * (i32::from(after) - i32::from(before))
}
