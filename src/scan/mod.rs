// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lattice lines against triangles. All triangles are drawn onto all lines along one axis, slab by slab, instead of
//! asking each point or edge of the lattice for its triangles: which triangles a line meets, where along it, and which
//! points come so near to a triangle that rounding may take them for points of it. That is the winding number of
//! every other point, and every crossing of every edge, by the predicates that single points and edges ask.

mod axis;
mod near;
mod rows;

pub(crate) use axis::Axis;

use crate::error::{Error, Result, filled};
use crate::math::{Aabb, Vec3};
use crate::parallel::Run;
use axis::common;
use near::near;
use rows::{Lines, Meeting};
use std::ops::Range;

/// Triangles that a thread puts into slabs in one go.
const PIECE: usize = 4096;

/// Lines of a slab, about, and how many rows of them it has at least and at most.
const LINES: usize = 4096;
const ROWS: [usize; 2] = [4, 16];

/// Points a side of cubes that are not looked at more closely.
const UNSETTLED: usize = 4;

/// Triangles to be drawn.
pub(crate) trait Triangles: Sync {
    fn count(&self) -> usize;
    fn corners(&self, triangle: u32) -> [Vec3; 3];
    fn bounds(&self) -> Aabb;
    /// Calls `visit` for every triangle whose box meets a region, and maybe for others.
    fn each_in(&self, region: Aabb, visit: &mut dyn FnMut(u32));
    /// Whether in a box, away from triangles, the winding number says all. What it does not is told as if a triangle were
    /// near.
    fn is_settled(&self, region: Aabb) -> bool;
}

/// The lines of a lattice along one axis, cut into slabs.
pub(crate) struct Scan<'a, T> {
    triangles: &'a T,
    axes: [Axis; 3],
    axis: usize,
    /// The axis across the slabs, and the one along their rows.
    across: usize,
    along: usize,
    rows: usize,
    /// Points nearer to a triangle than this are told.
    room: f64,
    /// Those of slab k are `members[start[k]..start[k + 1]]`.
    start: Vec<u32>,
    members: Vec<u32>,
    /// Where not all is settled, by indices.
    unsettled: Vec<[Range<usize>; 3]>,
}

/// What is found in one slab, and buffers that serve one slab after another.
#[derive(Default)]
pub(crate) struct Slab {
    rows: Range<usize>,
    width: usize,
    found: Vec<(u32, Met)>,
    start: Vec<u32>,
    met: Vec<Met>,
    near: Vec<[u32; 2]>,
}

/// A triangle that a line meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Met {
    /// Twice the number of points of the line below the triangle, plus 1 where the turn is -1.
    place: u32,
    pub(crate) triangle: u32,
}

impl Met {
    /// How many points of the line lie below the triangle.
    #[inline(always)]
    pub(crate) fn below(self) -> usize {
        (self.place >> 1) as usize
    }

    /// As [`crate::primitive::crossing::AxisLine::meets`].
    #[inline(always)]
    pub(crate) fn turn(self) -> i32 {
        if self.place & 1 == 1 { -1 } else { 1 }
    }
}

impl<'a, T: Triangles> Scan<'a, T> {
    /// Of the lines along `axis`. Every axis of the lattice rises or falls, repeats allowed, and has fewer than 2^30
    /// coordinates.
    pub(crate) fn new(triangles: &'a T, axes: [&[f64]; 3], axis: usize, room: f64, run: &Run) -> Result<Scan<'a, T>> {
        let (across, along) = if axis == 2 { (1, 0) } else { (2, 1 - axis) };
        let axes = [Axis::new(axes[0])?, Axis::new(axes[1])?, Axis::new(axes[2])?];
        let rows = (LINES / axes[along].len().max(1)).clamp(ROWS[0], ROWS[1]);
        let mut scan = Scan {
            triangles,
            axes,
            axis,
            across,
            along,
            rows,
            room,
            start: vec![],
            members: vec![],
            unsettled: vec![],
        };
        if scan.axes.iter().all(|axis| axis.len() > 0) {
            scan.put_into_slabs(run)?;
            scan.find_unsettled([0, 1, 2].map(|k| 0..scan.axes[k].len()))?;
        }
        Ok(scan)
    }

    /// The region that a triangle must meet to tell anything.
    fn region(&self) -> Aabb {
        let mut region = Aabb::EMPTY;
        for (k, axis) in self.axes.iter().enumerate() {
            region.lo[k] = axis.at(0) - self.room;
            // What lies above the lattice has all its points below.
            region.hi[k] = if k == self.axis { f64::INFINITY } else { axis.at(axis.len() - 1) + self.room };
        }
        region
    }

    fn put_into_slabs(&mut self, run: &Run) -> Result<()> {
        // Of the candidates the first and the last slab; the first is beyond the last where there is none.
        let run = &run.silent();
        let region = self.region();
        let bounds = self.triangles.bounds();
        let is_whole = region.intersection(bounds) == bounds;
        let mut some = Vec::new();
        if !is_whole {
            let mut full = false;
            self.triangles.each_in(region, &mut |t| {
                full |= some.try_reserve(1).is_err();
                if !full {
                    some.push(t);
                }
            });
            if full {
                return Err(Error::memory("triangles", some.len() + 1));
            }
        }
        let count = if is_whole { self.triangles.count() } else { some.len() };
        let candidate = |k: usize| if is_whole { k as u32 } else { some[k] };
        let mut slabs = filled("triangles", count, [0u32; 2])?;
        run.for_each_piece(&mut slabs, PIECE, &|from, slabs| {
            for (k, slabs) in (from..).zip(slabs) {
                *slabs = self.slabs_of(self.triangles.corners(candidate(k)), &region);
            }
            Ok(())
        })?;
        let mut start = filled("slabs", self.slab_count() + 1, 0u32)?;
        let mut total = 0usize;
        for &[first, last] in &slabs {
            for k in first..last {
                start[k as usize] += 1;
            }
            total += last.saturating_sub(first) as usize;
        }
        if total > u32::MAX as usize {
            return Err(Error::memory("triangles", total));
        }
        // Counts become ends, and ends become starts as they are filled from behind.
        let mut sum = 0;
        for count in &mut start {
            sum += *count;
            *count = sum;
        }
        let mut members = filled("triangles", total, 0u32)?;
        for (k, &[first, last]) in slabs.iter().enumerate().rev() {
            for slab in first..last {
                let end = &mut start[slab as usize];
                *end -= 1;
                members[*end as usize] = candidate(k);
            }
        }
        (self.start, self.members) = (start, members);
        Ok(())
    }

    /// Halves a cube of points until its pieces are settled or small.
    fn find_unsettled(&mut self, cube: [Range<usize>; 3]) -> Result<()> {
        let end = |k: usize, at: usize| self.axes[k].at(at);
        let corner = |last: bool| [0, 1, 2].map(|k| end(k, if last { cube[k].end - 1 } else { cube[k].start }));
        let region = Aabb::new(Vec3::from_array(corner(false)), Vec3::from_array(corner(true)));
        if self.triangles.is_settled(region) {
            return Ok(());
        }
        let longest = (0..3).fold(0, |most, k| if cube[k].len() > cube[most].len() { k } else { most });
        if cube[longest].len() <= UNSETTLED {
            return push(&mut self.unsettled, cube).map_err(|_| Error::memory("cubes", self.unsettled.len() + 1));
        }
        let Range { start, end } = cube[longest];
        for half in [start..start.midpoint(end), start.midpoint(end)..end] {
            let mut piece = cube.clone();
            piece[longest] = half;
            self.find_unsettled(piece)?;
        }
        Ok(())
    }

    #[inline(always)]
    fn slabs_of(&self, t: [Vec3; 3], region: &Aabb) -> [u32; 2] {
        let (lo, hi) = ends(t);
        if lo.cmpgt(region.hi).any() || hi.cmplt(region.lo).any() {
            return [0, 0];
        }
        let rows = self.axes[self.across].within(lo[self.across] - self.room, hi[self.across] + self.room);
        let others = self.axes[self.along].within(lo[self.along] - self.room, hi[self.along] + self.room);
        if rows.is_empty() || others.is_empty() {
            return [0, 0];
        }
        [(rows.start / self.rows) as u32, ((rows.end - 1) / self.rows + 1) as u32]
    }

    pub(crate) fn slab_count(&self) -> usize {
        self.axes[self.across].len().div_ceil(self.rows)
    }

    /// Rows of a slab; the last may have fewer.
    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    /// The axes, in rising order.
    pub(crate) fn axis(&self, axis: usize) -> &Axis {
        &self.axes[axis]
    }

    /// Fills `slab` with what is found in slab `k`.
    pub(crate) fn scan(&self, k: usize, slab: &mut Slab) -> Result<()> {
        let rows = k * self.rows..self.axes[self.across].len().min((k + 1) * self.rows);
        let width = self.axes[self.along].len();
        slab.found.clear();
        slab.near.clear();
        let (a, b) = ((self.axis + 1) % 3, (self.axis + 2) % 3);
        let lines = Lines { axis: self.axis, u: &self.axes[a], v: &self.axes[b], w: &self.axes[self.axis] };
        let across_is_v = self.across == b;
        let (mut full, mut most) = (false, 4096);
        for &triangle in &self.members[self.start[k] as usize..self.start[k + 1] as usize] {
            let corners = self.triangles.corners(triangle);
            let (lo, hi) = ends(corners);
            let range = |k: usize| self.axes[k].within(lo[k] - self.room, hi[k] + self.room);
            let mut around = [range(0), range(1), range(2)];
            around[self.across] = common(&around[self.across], &rows);
            if around[a].is_empty() || around[b].is_empty() {
                continue;
            }
            lines.meetings(corners, (lo, hi), &around, &mut |Meeting { u, v, below, turned }| {
                let (row, column) = if across_is_v { (v, u) } else { (u, v) };
                let line = ((row - rows.start) * width + column) as u32;
                let place = 2 * below as u32 + u32::from(turned);
                full |= push(&mut slab.found, (line, Met { place, triangle })).is_err();
            });
            if around[self.axis].is_empty() {
                continue;
            }
            near(&self.axes, corners, (lo, hi), self.room, &around, &mut |at| {
                let line = ((at[self.across] - rows.start) * width + at[self.along]) as u32;
                full |= push(&mut slab.near, [line, at[self.axis] as u32]).is_err();
            });
            // Many triangles may be near one point.
            if slab.near.len() > most {
                slab.near.sort_unstable();
                slab.near.dedup();
                most = 2 * slab.near.len() + 4096;
            }
        }
        for cube in &self.unsettled {
            let across = common(&cube[self.across], &rows);
            for (row, column) in across.flat_map(|row| cube[self.along].clone().map(move |column| (row, column))) {
                let line = ((row - rows.start) * width + column) as u32;
                cube[self.axis].clone().for_each(|k| full |= push(&mut slab.near, [line, k as u32]).is_err());
            }
        }
        if full {
            return Err(Error::memory("crossings", slab.found.len() + slab.near.len() + 1));
        }
        slab.near.sort_unstable();
        slab.near.dedup();
        slab.sort(rows, width)
    }
}

#[inline(always)]
fn ends(t: [Vec3; 3]) -> (Vec3, Vec3) {
    (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]))
}

#[inline(always)]
fn push<T>(to: &mut Vec<T>, item: T) -> std::result::Result<(), ()> {
    if to.len() == to.capacity() {
        to.try_reserve(to.len().max(64)).map_err(|_| ())?;
    }
    to.push(item);
    Ok(())
}

impl Slab {
    /// Sorts what was found by line, and along each line.
    fn sort(&mut self, rows: Range<usize>, width: usize) -> Result<()> {
        let lines = rows.len() * width;
        self.start.clear();
        self.start.try_reserve(lines + 1).map_err(|_| Error::memory("lines", lines))?;
        self.start.resize(lines + 1, 0);
        for (line, _) in &self.found {
            self.start[*line as usize] += 1;
        }
        let mut sum = 0;
        for count in &mut self.start {
            sum += *count;
            *count = sum;
        }
        self.met.clear();
        self.met.try_reserve(self.found.len()).map_err(|_| Error::memory("crossings", self.found.len()))?;
        self.met.resize(self.found.len(), Met { place: 0, triangle: 0 });
        for (line, met) in self.found.iter().rev() {
            let end = &mut self.start[*line as usize];
            *end -= 1;
            self.met[*end as usize] = *met;
        }
        for line in 0..lines {
            let met = &mut self.met[self.start[line] as usize..self.start[line + 1] as usize];
            if met.len() > 1 {
                met.sort_unstable();
            }
        }
        (self.rows, self.width) = (rows, width);
        Ok(())
    }

    /// The rows of the slab, counted across the slabs.
    pub(crate) fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// Lines of a row.
    pub(crate) fn width(&self) -> usize {
        self.width
    }

    /// The triangles that a line meets above its first point, in order along it. Lines are counted row by row.
    pub(crate) fn met(&self, line: usize) -> &[Met] {
        &self.met[self.start[line] as usize..self.start[line + 1] as usize]
    }

    /// The points near triangles, in order: their lines, and which they are of the line.
    pub(crate) fn near(&self) -> &[[u32; 2]] {
        &self.near
    }
}
