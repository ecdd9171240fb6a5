// SPDX-License-Identifier: MIT OR Apache-2.0
//! A k-d tree (Bentley 1975) over points of the plane that loses them one by one, and tells whether any is left in a
//! triangle, by exact predicates (Shewchuk 1997).

use crate::error::{Result, filled, try_with_capacity};
use crate::primitive::polygon::{blocks, turn};

/// Points in a leaf at most.
const LEAF: usize = 8;

/// A box around what is left; `lo` beyond `hi` where nothing is.
#[derive(Clone, Copy)]
struct Bounds {
    lo: [f64; 2],
    hi: [f64; 2],
}

impl Bounds {
    const EMPTY: Bounds = Bounds { lo: [f64::INFINITY; 2], hi: [f64::NEG_INFINITY; 2] };

    fn of(points: impl Iterator<Item = [f64; 2]>) -> Bounds {
        points.fold(Bounds::EMPTY, |b, p| b.with(Bounds { lo: p, hi: p }))
    }

    fn with(self, other: Bounds) -> Bounds {
        let each = |of: fn(f64, f64) -> f64, a: [f64; 2], b: [f64; 2]| [of(a[0], b[0]), of(a[1], b[1])];
        Bounds { lo: each(f64::min, self.lo, other.lo), hi: each(f64::max, self.hi, other.hi) }
    }

    fn is_apart(&self, other: &Bounds) -> bool {
        (0..2).any(|k| self.lo[k] > other.hi[k] || self.hi[k] < other.lo[k])
    }

    /// Whether all of it lies right of the line from `a` to `b`: whether the corner farthest to the left does.
    fn is_right_of(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        let x = if b[1] > a[1] { self.lo[0] } else { self.hi[0] };
        let y = if b[0] > a[0] { self.hi[1] } else { self.lo[1] };
        turn(a, b, [x, y]) < 0.0
    }
}

/// The tree: a complete binary one, the children of node i are 2 i + 1 and 2 i + 2.
pub(super) struct Tree<'a> {
    points: &'a [[f64; 2]],
    bounds: Vec<Bounds>,
    /// The points, leaf by leaf.
    order: Vec<u32>,
    /// Where each leaf begins in `order`; one more for the end.
    start: Vec<u32>,
    /// How many of each leaf are left: the first ones.
    left: Vec<u32>,
    leaf_of: Vec<u32>,
}

impl<'a> Tree<'a> {
    pub(super) fn new(points: &'a [[f64; 2]]) -> Result<Tree<'a>> {
        let n = points.len();
        let leaves = n.div_ceil(LEAF).next_power_of_two();
        let mut order = try_with_capacity("corners", n)?;
        order.extend(0..n as u32);
        let mut start = try_with_capacity("leaves", leaves + 1)?;
        start.push(0);
        split(points, &mut order, leaves, &mut start);
        let mut left = try_with_capacity("leaves", leaves)?;
        left.extend(start.windows(2).map(|w| w[1] - w[0]));
        let mut leaf_of = filled("corners", n, 0)?;
        for (leaf, w) in start.windows(2).enumerate() {
            order[w[0] as usize..w[1] as usize].iter().for_each(|&k| leaf_of[k as usize] = leaf as u32);
        }
        let bounds = filled("nodes", 2 * leaves - 1, Bounds::EMPTY)?;
        let mut tree = Tree { points, bounds, order, start, left, leaf_of };
        for node in (0..2 * leaves - 1).rev() {
            tree.bounds[node] = tree.bounds_of(node);
        }
        Ok(tree)
    }

    /// What is left of a leaf.
    fn leaf(&self, leaf: usize) -> &[u32] {
        let start = self.start[leaf] as usize;
        &self.order[start..start + self.left[leaf] as usize]
    }

    /// The leaf that a node is.
    fn as_leaf(&self, node: usize) -> Option<usize> {
        (node + 1).checked_sub(self.left.len())
    }

    fn bounds_of(&self, node: usize) -> Bounds {
        match self.as_leaf(node) {
            Some(leaf) => Bounds::of(self.leaf(leaf).iter().map(|&k| self.points[k as usize])),
            None => self.bounds[2 * node + 1].with(self.bounds[2 * node + 2]),
        }
    }

    /// Takes out a point that is left.
    pub(super) fn remove(&mut self, k: u32) {
        let leaf = self.leaf_of[k as usize] as usize;
        let Some(place) = self.leaf(leaf).iter().position(|&other| other == k) else { return };
        let start = self.start[leaf] as usize;
        self.left[leaf] -= 1;
        self.order.swap(start + place, start + self.left[leaf] as usize);
        let mut node = leaf + self.left.len() - 1;
        loop {
            self.bounds[node] = self.bounds_of(node);
            if node == 0 {
                return;
            }
            node = (node - 1) / 2;
        }
    }

    /// A point that is left in a counter-clockwise triangle or on it, other than where its corners are.
    pub(super) fn within(&self, triangle: [[f64; 2]; 3]) -> Option<u32> {
        let around = Bounds::of(triangle.into_iter());
        let [a, b, c] = triangle;
        // A path down leaves one node at each level, and there are no more than 32.
        let mut stack = [0u32; 64];
        let mut open = 1;
        while open > 0 {
            open -= 1;
            let node = stack[open] as usize;
            let bounds = &self.bounds[node];
            // Many corners may be at one point, where a face comes to it again and again.
            let is_corner = bounds.lo == bounds.hi && triangle.contains(&bounds.lo);
            let is_beside = || [(a, b), (b, c), (c, a)].iter().any(|(p, q)| bounds.is_right_of(*p, *q));
            if bounds.is_apart(&around) || is_corner || is_beside() {
                continue;
            }
            match self.as_leaf(node) {
                Some(leaf) => {
                    let inner = |k: &u32| blocks(self.points[*k as usize], triangle);
                    if let Some(k) = self.leaf(leaf).iter().copied().find(inner) {
                        return Some(k);
                    }
                }
                None => {
                    stack[open..open + 2].copy_from_slice(&[2 * node as u32 + 1, 2 * node as u32 + 2]);
                    open += 2;
                }
            }
        }
        None
    }
}

/// Sorts the points of a node into its leaves, halving them across the longer side of their box.
fn split(points: &[[f64; 2]], order: &mut [u32], leaves: usize, start: &mut Vec<u32>) {
    if leaves == 1 {
        let last = start.last().copied().unwrap_or(0);
        start.push(last + order.len() as u32);
        return;
    }
    let Bounds { lo, hi } = Bounds::of(order.iter().map(|&k| points[k as usize]));
    let axis = usize::from(hi[1] - lo[1] > hi[0] - lo[0]);
    let middle = order.len() / 2;
    if middle > 0 {
        order.select_nth_unstable_by(middle, |&j, &k| points[j as usize][axis].total_cmp(&points[k as usize][axis]));
    }
    let (low, high) = order.split_at_mut(middle);
    split(points, low, leaves / 2, start);
    split(points, high, leaves / 2, start);
}
