// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lattices by classification: cubes that the surface keeps away from have one sign and no crossings, and only the
//! small ones that are left are asked point by point.

use super::intercept::{Crossing, CrossingForm, EmitCrossings, crossing};
use super::{Lattice, check, in_blocks};
use crate::error::{Error, Result};
use crate::geometry::Geometry;
use crate::math::{Aabb, Vec3};
use crate::parallel::Run;
use std::ops::Range;

/// Points of a block along each axis, of the cubes it is cut into first, and of those that are not cut any more.
const BLOCK: [usize; 3] = [64, 16, 16];
const LARGE: usize = 16;
const SMALL: usize = 4;

/// A crossing is computed with an error that is small beside this part of a cube.
const ROOM: f64 = 0.125;

pub(super) type Cube = [Range<usize>; 3];

/// Whether cubes may be left out: every value of a user's function has to be asked for.
pub(super) fn are_known(g: &Geometry) -> bool {
    !g.has_functions() && !g.may_fail()
}

/// [`super::fill_signs`] where [`are_known`].
pub(super) fn signs(
    g: &Geometry,
    lattice: &Lattice,
    run: &Run,
    emit: &(dyn Fn([usize; 3], &[i8]) + Sync),
) -> Result<()> {
    in_blocks(run, lattice.n(), BLOCK, &|block| {
        let [width, height, _] = block.each_ref().map(Range::len);
        let mut out = [0i8; BLOCK[0] * BLOCK[1] * BLOCK[2]];
        let place = |i: usize, j: usize, k: usize| {
            i - block[0].start + width * (j - block[1].start + height * (k - block[2].start))
        };
        for cube in cut(block, LARGE) {
            descend(&cube, &|cube| g.classify(around(lattice, cube, None)), &mut |cube, side| {
                let [x, y, z] = cube.clone();
                let count = x.len() * y.len() * z.len();
                let at = z.flat_map(|k| y.clone().map(move |j| (j, k)));
                if side != 0 {
                    at.for_each(|(j, k)| out[place(x.start, j, k)..][..x.len()].fill(side as i8));
                    return Ok(());
                }
                let (mut points, mut values) = ([Vec3::ZERO; SMALL * SMALL * SMALL], [0.0; SMALL * SMALL * SMALL]);
                let at = at.flat_map(|(j, k)| x.clone().map(move |i| [i, j, k]));
                points.iter_mut().zip(at.clone()).for_each(|(p, at)| *p = lattice.point(at));
                g.values(&points[..count], &mut values[..count]);
                for ((at, p), value) in at.zip(points).zip(values) {
                    check(g, value, p)?;
                    out[place(at[0], at[1], at[2])] = i8::from(value > 0.0) - i8::from(value < 0.0);
                }
                Ok(())
            })?;
        }
        let rows = block[2].clone().flat_map(|k| block[1].clone().map(move |j| (j, k)));
        rows.for_each(|(j, k)| emit([block[0].start, j, k], &out[place(block[0].start, j, k)..][..width]));
        Ok(())
    })
}

/// [`super::crossings`] where [`are_known`].
pub(super) fn crossings(
    g: &Geometry,
    lattice: &Lattice,
    axis: usize,
    form: CrossingForm,
    run: &Run,
    emit: EmitCrossings,
) -> Result<()> {
    in_blocks(run, lattice.edges(axis), BLOCK, &|block| {
        let mut found: Vec<([usize; 3], Crossing)> = Vec::new();
        for cube in cut(block, LARGE) {
            descend(&cube, &|cube| g.classify(around(lattice, cube, Some(axis))), &mut |cube, side| {
                if side != 0 {
                    return Ok(());
                }
                let [x, y, z] = cube;
                let rows = z.clone().flat_map(|k| y.clone().map(move |j| (j, k)));
                for from in rows.flat_map(|(j, k)| x.clone().map(move |i| [i, j, k])) {
                    let mut to = from;
                    to[axis] += 1;
                    let crossing = crossing(g, lattice.point(from), lattice.point(to), axis, form)?;
                    if crossing.is_any() {
                        found.try_reserve(1).map_err(|_| Error::memory("crossings", found.len() + 1))?;
                        found.push((from, crossing));
                    }
                }
                Ok(())
            })?;
        }
        found.sort_unstable_by_key(|(from, _)| [from[2], from[1], from[0]]);
        let mut found = &found[..];
        for (j, k) in block[2].clone().flat_map(|k| block[1].clone().map(move |j| (j, k))) {
            let here = found.iter().take_while(|(at, _)| at[1] == j && at[2] == k).count();
            let (row, rest) = found.split_at(here);
            found = rest;
            let none = Crossing { at: f64::NAN, count: 0, tag: -1, part: -1 };
            let mut told = [(0, none); BLOCK[0]];
            told.iter_mut().zip(row).for_each(|(told, (at, c))| *told = (at[0] - block[0].start, *c));
            emit([block[0].start, j, k], block[0].len(), &told[..here]);
        }
        Ok(())
    })
}

/// The pieces of a cube, of so many points a side at most.
fn cut(cube: &Cube, side: usize) -> impl Iterator<Item = Cube> {
    let pieces = move |range: &Range<usize>| {
        let Range { start, end } = *range;
        (start..end).step_by(side).map(move |from| from..end.min(from + side))
    };
    let [x, y, z] = [pieces(&cube[0]), pieces(&cube[1]), pieces(&cube[2])];
    z.flat_map(move |z| {
        let x = x.clone();
        y.clone().flat_map(move |y| {
            let z = z.clone();
            x.clone().map(move |x| [x, y.clone(), z.clone()])
        })
    })
}

/// Halves a cube until the side of its pieces is known, or they are small.
fn descend(cube: &Cube, side: &dyn Fn(&Cube) -> i32, work: &mut dyn FnMut(&Cube, i32) -> Result<()>) -> Result<()> {
    let known = side(cube);
    let most = cube.iter().map(Range::len).max().unwrap_or(0);
    if known != 0 || most <= SMALL {
        return work(cube, known);
    }
    cut(cube, most.div_ceil(2).max(SMALL)).try_for_each(|piece| descend(&piece, side, work))
}

/// Around the points of a cube; around its edges along an axis, with room for the rounding of crossings.
pub(super) fn around(lattice: &Lattice, cube: &Cube, edges: Option<usize>) -> Aabb {
    let mut b = Aabb::EMPTY;
    for k in 0..3 {
        let (first, last) = (cube[k].start, cube[k].end - 1 + usize::from(edges == Some(k)));
        let (p, q) = (lattice.axes[k][first], lattice.axes[k][last]);
        (b.lo[k], b.hi[k]) = (p.min(q), p.max(q));
    }
    if edges.is_some() {
        let room = Vec3::splat(ROOM * (b.hi - b.lo).max_element());
        b = Aabb::new(b.lo - room, b.hi + room);
    }
    b
}
