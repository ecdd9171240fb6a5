// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which side of an open surface a point is on, and whether all points of a box are on the same.

use super::sign::CLEAR_DISTANCE;
use super::{Closing, Sign, Surface};
use crate::math::{Aabb, Vec3};
use crate::primitive::crossing::AxisLine;
use crate::primitive::overlap::meets;

/// Of the six rays along the axes, inside is where so many say so.
const MOST: usize = 4;

/// Ways that lead off any line, plane or axis, one or the other.
const BESIDE: [[f64; 3]; 3] = [[0.53, 0.29, 0.79], [-0.61, 0.77, 0.17], [0.23, -0.89, 0.37]];

/// What a ray crosses.
#[derive(Clone, Copy, Default)]
struct Crossed {
    /// The change of the winding number on the way out.
    turns: i32,
    any: bool,
}

impl Surface {
    /// Whether the sign may change where the value is not zero: across a hole, or below a rim.
    pub(crate) fn has_jumps(&self) -> bool {
        self.closing.is_some() || matches!(self.sign, Sign::Axis(_))
    }

    /// Around the body, where it is not inverted.
    pub(crate) fn body_bounds(&self) -> Aabb {
        let mut bounds = self.bounds;
        if let Sign::Axis(axis) = self.sign {
            bounds.lo[usize::from(axis)] = f64::NEG_INFINITY;
        }
        bounds
    }

    /// Whether a point off the surface is inside.
    pub(super) fn is_inside(&self, p: Vec3) -> bool {
        match self.sign {
            Sign::Unsigned => false,
            Sign::Axis(axis) => self.along(usize::from(axis), p)[1].any,
            _ if !self.bounds.contains(p) => self.far_winding >= 1,
            Sign::Votes => self.votes(p),
            Sign::Pseudonormal | Sign::Crossings => {
                let Some(caps) = &self.closing else { return self.winding(p) >= 1 };
                // On an edge of a cap, which is nothing to the surface, a little beside it.
                let beside = BESIDE.map(|d| p + Vec3::from_array(d) * (CLEAR_DISTANCE * self.diagonal));
                let mut places = [p].into_iter().chain(beside);
                places.find_map(|p| caps.is_inside(p, self.winding(p))).unwrap_or(false)
            }
        }
    }

    /// The number that crossings of triangles and caps count on from, beginning at a point: from 1 on they are inside.
    pub(crate) fn winding_before(&self, p: Vec3) -> i32 {
        match self.sign {
            Sign::Votes | Sign::Axis(_) => i32::from(self.is_inside(p)),
            _ => self.winding(p),
        }
    }

    /// Whether a point may be on another side than the rest of space.
    pub(super) fn is_near_bounds(&self, p: Vec3) -> bool {
        self.bounds.contains(p) || matches!(self.sign, Sign::Axis(_))
    }

    /// Whether the caps of holes do not matter within this distance of a point.
    #[inline(always)]
    pub(super) fn settles_within(&self, p: Vec3, distance: f64) -> bool {
        self.closing.as_ref().is_none_or(|caps| caps.settles(Aabb::new(p - distance, p + distance)))
    }

    /// Whether in a box, off the surface, the side is what the winding number says.
    pub(super) fn settles(&self, b: Aabb) -> bool {
        self.closing.as_ref().is_none_or(|caps| caps.settles(b))
    }

    /// -1 where every double of a finite box that misses the surface is inside, +1 where outside, 0 where that is not known.
    pub(super) fn side_of_clear(&self, b: Aabb) -> i32 {
        let side = |is_inside: bool| if is_inside { -1 } else { 1 };
        match self.sign {
            Sign::Unsigned => 1,
            Sign::Axis(axis) => self.side_along(usize::from(axis), b),
            _ if self.bounds.intersection(b).is_empty() => side(self.far_winding >= 1),
            Sign::Votes => self.votes_of_clear(b),
            Sign::Pseudonormal | Sign::Crossings if self.settles(b) => side(self.is_inside(b.center())),
            // Beyond the bounds another rule holds.
            Sign::Pseudonormal | Sign::Crossings if self.bounds.intersection(b) == b => {
                let middle = b.center();
                let is_known = |caps: &Closing| caps.is_one_sided(b, self.winding(middle));
                if self.closing.as_ref().is_some_and(is_known) { side(self.is_inside(middle)) } else { 0 }
            }
            Sign::Pseudonormal | Sign::Crossings => 0,
        }
    }

    /// What the rays from a point cross, against an axis and along it.
    fn along(&self, axis: usize, p: Vec3) -> [Crossed; 2] {
        let line = AxisLine::new(axis, p);
        let mut column = Aabb::new(p, p);
        (column.lo[axis], column.hi[axis]) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut crossed = [Crossed::default(); 2];
        self.overlapping(column, |t| {
            let corners = self.corners(t);
            let turn = line.meets(corners);
            if turn == 0 {
                return;
            }
            let is_ahead = line.below(p[axis], corners, turn);
            let ray = &mut crossed[usize::from(is_ahead)];
            ray.turns += if is_ahead { turn } else { -turn };
            ray.any = true;
        });
        crossed
    }

    fn votes(&self, p: Vec3) -> bool {
        let (mut inside, mut outside) = (0, 0);
        for axis in 0..3 {
            for ray in self.along(axis, p) {
                *(if self.far_winding + ray.turns >= 1 { &mut inside } else { &mut outside }) += 1;
            }
            if inside >= MOST || outside > 6 - MOST {
                break;
            }
        }
        inside >= MOST
    }

    /// The column of a box along an axis: against it, or along it.
    fn column(&self, b: Aabb, axis: usize, ahead: bool) -> Aabb {
        // More than the rounding of any crossing.
        let room = Vec3::splat(1e-12 * (self.reach() + self.diagonal));
        let mut column = Aabb::new(b.lo - room, b.hi + room);
        *(if ahead { &mut column.hi[axis] } else { &mut column.lo[axis] }) =
            if ahead { f64::INFINITY } else { f64::NEG_INFINITY };
        column
    }

    /// Whether the rim may be met by a ray from a box.
    fn meets_rim(&self, column: Aabb) -> bool {
        self.closing.as_ref().is_some_and(|rim| rim.meets(column))
    }

    /// A ray whose column no rim is in crosses the same from everywhere in the box.
    fn votes_of_clear(&self, b: Aabb) -> i32 {
        // Beyond the bounds another rule holds.
        if self.bounds.intersection(b) != b {
            return 0;
        }
        let (mut inside, mut outside) = (0, 0);
        for axis in 0..3 {
            let rays = self.along(axis, b.center());
            for (ray, ahead) in rays.into_iter().zip([false, true]) {
                if !self.meets_rim(self.column(b, axis, ahead)) {
                    *(if self.far_winding + ray.turns >= 1 { &mut inside } else { &mut outside }) += 1;
                }
            }
        }
        i32::from(outside > 6 - MOST) - i32::from(inside >= MOST)
    }

    fn side_along(&self, axis: usize, b: Aabb) -> i32 {
        let column = self.column(b, axis, true);
        let mut any = false;
        self.overlapping(column, |t| any |= meets(self.corners(t), column));
        if !any {
            return 1;
        }
        // What is crossed more often one way than the other is crossed from everywhere.
        let ray = self.along(axis, b.center())[1];
        if ray.turns != 0 && !self.meets_rim(column) { -1 } else { 0 }
    }
}
