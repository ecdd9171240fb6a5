// SPDX-License-Identifier: MIT OR Apache-2.0
//! The leaves along a ray, the nearest first. Its line is counted from where it is nearest to the middle of the tree,
//! so that f32 does with room for its rounding; where the ray begins so far away that this place is not known well
//! enough, in f64.

use super::nearest::LEVELS;
use super::{LEAF, Node, Tree};
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::simd::float8::{Float8, Keys8, LANE, Simd};
use crate::simd::lanes::WIDTH;
use crate::simd::prefetch;

/// What boxes are widened by, relative to the distance from the middle: far above the roundings here and those of where
/// a ray meets what is in them.
const ROOM: f64 = 1e-13;

/// Rays that begin farther away, as the tree places them, are followed in f64: from here on, what that is off by is no
/// more than a hundredth of a rounding of f32.
const FAR: f64 = 1e6;

/// A rounding of f32.
const ROUNDING: f32 = f32::EPSILON / 2.0;

/// What boxes are widened by, and places along the line: coordinates of the line's middle are below 2, so that its
/// rounding and that of what it is widened by are 4 of f32 at most; where it comes into a box is off by 3, relative, that
/// is by 12 where anything can be.
const WIDENED: f32 = 32.0 * ROUNDING;

/// Nothing of the tree is farther along the line from its middle.
const ALONG: f32 = 4.0;

/// Room for the deepest tree; indices are masked by it.
const STACK: usize = (LEVELS * WIDTH).next_power_of_two();

/// A ray as a tree sees it: the points `middle + s * direction`, the direction of unit length.
#[derive(Clone, Copy)]
pub(crate) struct Line {
    pub(crate) middle: [f32; 3],
    pub(crate) direction: [f32; 3],
    inverse: [f32; 3],
    from: f32,
    /// s is t times this, less `start`.
    scale: f64,
    start: f64,
}

/// What waits while a line goes down a tree.
pub(crate) struct Ahead {
    keys: [i32; STACK],
    child: [u32; STACK],
    /// The same in f64.
    far: Vec<(f64, u32)>,
}

impl Default for Ahead {
    fn default() -> Ahead {
        Ahead { keys: [0; STACK], child: [0; STACK], far: Vec::new() }
    }
}

/// What is asked about each leaf on the way.
pub(crate) trait LeafOnLine<S: Simd> {
    /// Looks at a leaf; the limit of t from here on.
    fn visit(&mut self, simd: S, leaf: usize, line: &Line) -> f64;
    /// Asks for the memory of a leaf that may be visited next.
    fn fetch(&self, leaf: usize);
}

/// A line from a tree's middle, or none where the ray misses the tree; and whether it is that far away.
pub(crate) enum Seen {
    Far,
    Missed,
    Line(Line),
}

/// A ray as the tree places it.
struct Placed {
    origin: Vec3,
    inverse: Vec3,
    room: f64,
    from: f64,
}

impl Tree {
    /// A ray, whose direction's largest coordinate is at least 1 and below 2, from `from` on.
    pub(crate) fn see(&self, origin: Vec3, direction: Vec3, from: f64) -> Seen {
        let at = self.place(origin);
        let is_near = at.abs().max_element() <= FAR;
        if !is_near {
            return Seen::Far;
        }
        let length = direction.dot(direction).sqrt();
        let along = direction / length;
        let start = -at.dot(along);
        let middle = at + along * start;
        if middle.dot(middle) > 4.0 {
            return Seen::Missed;
        }
        let (middle, along) = (middle.to_array(), along.to_array());
        let mut line = Line {
            middle: [middle[0] as f32, middle[1] as f32, middle[2] as f32],
            direction: [along[0] as f32, along[1] as f32, along[2] as f32],
            inverse: [0.0; 3],
            from: 0.0,
            scale: self.scale * length,
            start,
        };
        for axis in 0..3 {
            // Of a coordinate that stays, so large that it is either always or never between two others.
            line.inverse[axis] = ((1.0 / along[axis]) as f32).clamp(-f32::MAX, f32::MAX);
        }
        line.from = (line.place(from) - WIDENED).max(-ALONG);
        Seen::Line(line)
    }

    /// Visits the leaves that may hold something where a line meets it at its beginning or later, and no later than the
    /// limit: `to`, then what `visit` says.
    #[inline(always)]
    pub(crate) fn along_line<S: Simd>(
        &self,
        simd: S,
        line: &Line,
        to: f64,
        ahead: &mut Ahead,
        leaves: &mut impl LeafOnLine<S>,
    ) {
        let (mut top, mut child, mut bound) = (0, 0, line.bound(to));
        loop {
            let mut goes_on = false;
            if child & LEAF == 0 {
                let node = &self.nodes[child as usize];
                let keys = line.keys(simd, node);
                let least = keys.least();
                if least <= bound {
                    if let (Some(keys_ahead), Some(child_ahead)) =
                        (ahead.keys[top..].first_chunk_mut(), ahead.child[top..].first_chunk_mut())
                    {
                        top += keys.others(keys.at_most(bound), &node.child, keys_ahead, child_ahead);
                    }
                    child = node.child[(least & LANE) as usize];
                    goes_on = true;
                }
            } else {
                bound = line.bound(leaves.visit(simd, (child & !LEAF) as usize, line));
            }
            while !goes_on {
                if top == 0 {
                    return;
                }
                top -= 1;
                if ahead.keys[top & (STACK - 1)] <= bound {
                    child = ahead.child[top & (STACK - 1)];
                    goes_on = true;
                }
            }
            if let Some(next) = top.checked_sub(1) {
                match ahead.child[next & (STACK - 1)] {
                    next if next & LEAF == 0 => prefetch(&self.nodes[next as usize]),
                    next => leaves.fetch((next & !LEAF) as usize),
                }
            }
        }
    }

    /// Visits the leaves that may hold something where a ray, whose direction's largest coordinate is at least 1 and
    /// below 2, meets it at `from` or later and no later than the limit: `to`, then what `visit` says.
    pub(crate) fn along_ray(
        &self,
        origin: Vec3,
        direction: Vec3,
        [from, to]: [f64; 2],
        ahead: &mut Ahead,
        mut visit: impl FnMut(usize) -> f64,
    ) -> Result<()> {
        let at = self.place(origin);
        let room = ROOM * (1.0 + at.abs().max_element());
        // Of a coordinate that stays, so large that it is either always or never between two others.
        let inverse = direction.to_array().map(|d| (1.0 / d).clamp(-f64::MAX, f64::MAX));
        let ray = Placed { origin: at, inverse: Vec3::from_array(inverse), room, from: from * self.scale };
        let (mut limit, waiting) = (to * self.scale, &mut ahead.far);
        waiting.clear();
        waiting.try_reserve(WIDTH).map_err(|_| Error::memory("nodes", WIDTH))?;
        waiting.push((f64::NEG_INFINITY, 0));
        while let Some((near, child)) = waiting.pop() {
            if near > limit {
                continue;
            }
            if child & LEAF != 0 {
                limit = visit((child & !LEAF) as usize) * self.scale;
                continue;
            }
            let node = &self.nodes[child as usize];
            let [near, far] = ray.within(node);
            let first = waiting.len();
            waiting.try_reserve(WIDTH).map_err(|_| Error::memory("nodes", first + WIDTH))?;
            for k in 0..WIDTH {
                let is_met = near[k] <= far[k] && near[k] <= limit && far[k] >= ray.from;
                if is_met && node.child[k] != u32::MAX {
                    waiting.push((near[k], node.child[k]));
                }
            }
            // The nearest on top.
            waiting[first..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        }
        Ok(())
    }
}

impl Line {
    /// Where the ray's t is along the line, nearly.
    #[inline(always)]
    fn place(&self, t: f64) -> f32 {
        (t * self.scale - self.start) as f32
    }

    /// The greatest key within a limit of t.
    #[inline(always)]
    fn bound(&self, limit: f64) -> i32 {
        let limit = (self.place(limit) + WIDENED).min(ALONG);
        ((if limit > -ALONG { limit } else { -ALONG }) + ALONG).to_bits() as i32 | LANE
    }

    /// Where the line comes into the boxes of a node, in order; far beyond all bounds where it does not.
    #[inline(always)]
    fn keys<S: Simd>(&self, simd: S, node: &Node) -> <S::Float as Float8<S>>::Keys {
        let mut near = S::Float::splat(simd, self.from);
        let mut far = S::Float::splat(simd, ALONG);
        for axis in 0..3 {
            let inverse = self.inverse[axis];
            let (first, last, room) = if inverse < 0.0 {
                (&node.hi[axis], &node.lo[axis], -WIDENED)
            } else {
                (&node.lo[axis], &node.hi[axis], WIDENED)
            };
            let (enter, leave) = (self.middle[axis] + room, self.middle[axis] - room);
            let inverse = S::Float::splat(simd, inverse);
            near = S::Float::load(simd, first).sub(S::Float::splat(simd, enter)).mul(inverse).max(near);
            far = S::Float::load(simd, last).sub(S::Float::splat(simd, leave)).mul(inverse).min(far);
        }
        let missed = near.sub(far).max(S::Float::splat(simd, 0.0)).mul(S::Float::splat(simd, 1e30));
        near.add(S::Float::splat(simd, ALONG)).add(missed).keys(&node.child)
    }
}

impl Placed {
    /// Where the line comes into each box and leaves it.
    fn within(&self, node: &Node) -> [[f64; WIDTH]; 2] {
        let (mut near, mut far) = ([f64::NEG_INFINITY; WIDTH], [f64::INFINITY; WIDTH]);
        for axis in 0..3 {
            let (o, inverse) = (self.origin[axis], self.inverse[axis]);
            let (lo, hi) = (&node.lo[axis], &node.hi[axis]);
            let (first, last, room) = if inverse < 0.0 { (hi, lo, -self.room) } else { (lo, hi, self.room) };
            for k in 0..WIDTH {
                let enter = (f64::from(first[k]) - room - o) * inverse;
                let leave = (f64::from(last[k]) + room - o) * inverse;
                near[k] = if enter > near[k] { enter } else { near[k] };
                far[k] = if leave < far[k] { leave } else { far[k] };
            }
        }
        [near, far]
    }
}
