// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a scan of a lattice asks of the surface.

use super::sign::CLEAR_DISTANCE;
use super::{Surface, crossings::Hit};
use crate::math::{Aabb, Vec3};
use crate::primitive::crossing::fraction;
use crate::scan::Triangles;

/// Bodies much smaller or larger than this have squares that are no numbers.
const SIZES: [f64; 2] = [1e-90, 1e90];

impl Triangles for Surface {
    fn count(&self) -> usize {
        self.triangle_count()
    }

    #[inline(always)]
    fn corners(&self, triangle: u32) -> [Vec3; 3] {
        let [a, b, c] = self.triangles.vertex[triangle as usize];
        [self.vertices[a as usize], self.vertices[b as usize], self.vertices[c as usize]]
    }

    fn bounds(&self) -> Aabb {
        self.bounds
    }

    fn each_in(&self, region: Aabb, visit: &mut dyn FnMut(u32)) {
        self.overlapping(region, visit);
    }
}

impl Surface {
    /// Points farther than this from all triangles have a distance above zero, and their sign is that of the winding
    /// number along any line, whoever decides it.
    pub(crate) fn room(&self) -> f64 {
        2.0 * CLEAR_DISTANCE * self.diagonal.max(self.reach())
    }

    /// Whether a scan may stand in for points and edges one by one: brute force stays what it is.
    pub(crate) fn can_be_scanned(&self) -> bool {
        self.tree.is_some() && (SIZES[0]..SIZES[1]).contains(&self.diagonal) && self.reach() < SIZES[1]
    }

    /// The winding number far away.
    pub(crate) fn far_winding(&self) -> i32 {
        self.far_winding
    }

    /// The meeting of a segment with a triangle that it passes through with this change of the winding number.
    pub(crate) fn hit(&self, a: Vec3, b: Vec3, triangle: u32, change: i32) -> Hit {
        let normal = self.normal(triangle);
        Hit { t: fraction(a, b, self.corners(triangle), normal), triangle, change, normal }
    }
}
