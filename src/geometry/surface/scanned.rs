// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a scan of a lattice asks of the surface.

use super::sign::CLEAR_DISTANCE;
use super::{Closing, Sign, Surface, crossings::Hit};
use crate::math::{Aabb, Vec3, cross_of_differences, unit};
use crate::primitive::crossing::fraction;
use crate::scan::Triangles;

/// Bodies much smaller or larger than this have squares that are no numbers.
const SIZES: [f64; 2] = [1e-90, 1e90];

impl Triangles for Surface {
    /// The triangles, and after them the caps of holes.
    fn count(&self) -> usize {
        self.triangle_count() + self.closing.as_ref().map_or(0, Closing::len)
    }

    #[inline(always)]
    fn corners(&self, triangle: u32) -> [Vec3; 3] {
        if let (Some(caps), true) = (&self.closing, self.is_cap(triangle)) {
            return caps.corners(triangle - self.triangles.len() as u32);
        }
        let [a, b, c] = self.triangles.vertex[triangle as usize];
        [self.vertices[a as usize], self.vertices[b as usize], self.vertices[c as usize]]
    }

    fn bounds(&self) -> Aabb {
        self.bounds
    }

    fn each_in(&self, region: Aabb, visit: &mut dyn FnMut(u32)) {
        self.overlapping(region, &mut *visit);
        if let Some(caps) = &self.closing {
            caps.each_in(region, |cap| visit(self.triangles.len() as u32 + cap));
        }
    }

    fn is_settled(&self, region: Aabb) -> bool {
        self.settles(region)
    }
}

impl Surface {
    /// Whether this is the number of a cap: no surface is there.
    #[inline(always)]
    pub(crate) fn is_cap(&self, triangle: u32) -> bool {
        triangle as usize >= self.triangles.len()
    }

    /// Points farther than this from all triangles have a distance above zero, and their sign is that of the winding
    /// number along any line, whoever decides it.
    pub(crate) fn room(&self) -> f64 {
        2.0 * CLEAR_DISTANCE * self.diagonal.max(self.reach())
    }

    /// Whether a scan may stand in for points and edges one by one: brute force stays what it is.
    pub(crate) fn can_be_scanned(&self) -> bool {
        let by_winding = !matches!(self.sign, Sign::Votes | Sign::Axis(_));
        by_winding && self.tree.is_some() && (SIZES[0]..SIZES[1]).contains(&self.diagonal) && self.reach() < SIZES[1]
    }

    /// The winding number far away.
    pub(crate) fn far_winding(&self) -> i32 {
        self.far_winding
    }

    /// The meeting of a segment with a triangle that it passes through with this change of the winding number.
    pub(crate) fn hit(&self, a: Vec3, b: Vec3, triangle: u32, change: i32) -> Hit {
        let corners = Triangles::corners(self, triangle);
        let normal = match self.is_cap(triangle) {
            true => unit(cross_of_differences(corners[0], corners[1], corners[2])),
            false => self.normal(triangle),
        };
        Hit { t: fraction(a, b, corners, normal), triangle, change, normal }
    }
}
