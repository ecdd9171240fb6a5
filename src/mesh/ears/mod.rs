// SPDX-License-Identifier: MIT OR Apache-2.0
//! Polygons of many corners cut into triangles by clipping ears (Meisters 1975): the ears that
//! [`crate::primitive::polygon::clip_ears`] finds, in the same order, without looking at every corner for each.
//!
//! A k-d tree (Bentley 1975) tells whether a corner lies in an ear. A corner that is no ear is not looked at again
//! before its neighbours change or the corner that lies in it is gone.

mod marks;
mod tree;

use crate::error::{Result, filled, try_with_capacity};
use crate::primitive::polygon::{is_flat, turn};
use marks::Marks;
use tree::Tree;

/// No corner.
const NONE: u32 = u32::MAX;

/// The same as [`crate::primitive::polygon::clip_ears`], for at least three points. About n log n where corners lie in
/// few ears that are not theirs; quadratic at worst, but for shapes that make a search of the tree long.
pub(super) fn clip_ears(points: &[[f64; 2]], out: &mut [[u32; 3]]) -> Result<bool> {
    let mut ring = Ring::new(points)?;
    let mut at = 0;
    for triangle in out {
        let Some(tip) = ring.next_ear(at).or_else(|| ring.flat.next(at)) else { return Ok(false) };
        *triangle = ring.corner(tip);
        // Going on past the neighbour keeps the triangles from fanning out of one corner.
        at = ring.after[triangle[2] as usize];
        ring.clip(tip);
    }
    Ok(true)
}

/// The corners that are left.
struct Ring<'a> {
    points: &'a [[f64; 2]],
    before: Vec<u32>,
    after: Vec<u32>,
    tree: Tree<'a>,
    /// Corners that may be ears.
    open: Marks,
    /// Corners on a line with their neighbours, all three different; those of [`Ring::open`] are yet to be found.
    flat: Marks,
    blocked: Blocked,
}

impl<'a> Ring<'a> {
    fn new(points: &'a [[f64; 2]]) -> Result<Ring<'a>> {
        let n = points.len() as u32;
        let (mut before, mut after) =
            (try_with_capacity("corners", points.len())?, try_with_capacity("corners", points.len())?);
        before.extend((0..n).map(|k| if k == 0 { n - 1 } else { k - 1 }));
        after.extend((0..n).map(|k| if k + 1 == n { 0 } else { k + 1 }));
        let (open, flat) = (Marks::new(points.len(), true)?, Marks::new(points.len(), false)?);
        let (tree, blocked) = (Tree::new(points)?, Blocked::new(points.len())?);
        Ok(Ring { points, before, after, tree, open, flat, blocked })
    }

    fn corner(&self, k: u32) -> [u32; 3] {
        [self.before[k as usize], k, self.after[k as usize]]
    }

    /// The first ear from `at` on, all the way round.
    fn next_ear(&mut self, at: u32) -> Option<u32> {
        loop {
            let k = self.open.next(at)?;
            let corner = self.corner(k);
            let [a, b, c] = corner.map(|k| self.points[k as usize]);
            if turn(a, b, c) > 0.0 {
                let Some(inner) = self.tree.within([a, b, c]) else { return Some(k) };
                self.blocked.add(k, inner);
            } else if is_flat(self.points, corner) {
                self.flat.set(k);
            }
            self.open.clear(k);
        }
    }

    /// Takes a corner out.
    fn clip(&mut self, tip: u32) {
        let [a, _, c] = self.corner(tip);
        (self.after[a as usize], self.before[c as usize]) = (c, a);
        self.tree.remove(tip);
        while let Some(freed) = self.blocked.first_by(tip) {
            self.blocked.remove(freed);
            self.open.set(freed);
        }
        for k in [a, tip, c] {
            self.blocked.remove(k);
            self.flat.clear(k);
            self.open.set(k);
        }
        self.open.clear(tip);
    }
}

/// For each corner the convex ones that it lies in, in doubly linked lists.
struct Blocked {
    /// By the corner that lies within.
    first: Vec<u32>,
    by: Vec<u32>,
    before: Vec<u32>,
    after: Vec<u32>,
}

impl Blocked {
    fn new(count: usize) -> Result<Blocked> {
        let none = || filled("corners", count, NONE);
        Ok(Blocked { first: none()?, by: none()?, before: none()?, after: none()? })
    }

    /// One of those that `inner` lies in.
    fn first_by(&self, inner: u32) -> Option<u32> {
        Some(self.first[inner as usize]).filter(|k| *k != NONE)
    }

    /// Notes that `inner` lies in the corner `k`, which is in no list.
    fn add(&mut self, k: u32, inner: u32) {
        let first = self.first[inner as usize];
        (self.by[k as usize], self.before[k as usize], self.after[k as usize]) = (inner, NONE, first);
        if first != NONE {
            self.before[first as usize] = k;
        }
        self.first[inner as usize] = k;
    }

    /// Takes a corner out of its list, if it is in one.
    fn remove(&mut self, k: u32) {
        let inner = std::mem::replace(&mut self.by[k as usize], NONE);
        if inner == NONE {
            return;
        }
        let (before, after) = (self.before[k as usize], self.after[k as usize]);
        if before == NONE {
            self.first[inner as usize] = after;
        } else {
            self.after[before as usize] = after;
        }
        if after != NONE {
            self.before[after as usize] = before;
        }
    }
}

#[cfg(test)]
mod tests;
