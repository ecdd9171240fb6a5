// SPDX-License-Identifier: MIT OR Apache-2.0
//! Binned surface area heuristic (Wald 2007), binary splits gathered eight to a node. Serial and
//! deterministic.

use super::{EMPTY_NODE, LEAF, Leaves, Node, Tree, scale_of};
use crate::error::{Error, Result, try_with_capacity};
use crate::math::{Aabb, Vec3};
use crate::simd::lanes::WIDTH;

const BINS: usize = 16;

/// Runs shorter than this are small.
const SMALL: usize = 64;

/// Deeper than this, splits are by halves: the depth, and with it the stack of a traversal, stays
/// bounded whatever the input.
const SAH_DEPTH: usize = 16;

/// A run of primitives that becomes a node or a leaf.
#[derive(Clone, Copy)]
struct Run {
    from: usize,
    to: usize,
    bounds: Aabb,
}

/// Where a run is split: below bin `bin` of those from `lo` on.
struct Plane {
    axis: usize,
    lo: f64,
    bins_a_unit: f64,
    bin: usize,
}

impl Run {
    fn count(&self) -> usize {
        self.to - self.from
    }
}

struct Builder<'a> {
    boxes: &'a [Aabb],
    order: Vec<u32>,
    tree: Tree,
    start: Vec<u32>,
    /// Room for a partition, as long as `order`.
    upper: Vec<u32>,
    /// Most primitives of a leaf.
    leaf_size: usize,
}

impl Tree {
    /// Builds over `boxes`, none of them empty, at least one. `leaf_size` is at most [`super::LEAF_SIZE`].
    pub(crate) fn build(boxes: &[Aabb], leaf_size: usize) -> Result<(Tree, Leaves)> {
        if boxes.len() >= LEAF as usize {
            return Err(Error::unsupported(format!("{} primitives are too many for one hierarchy", boxes.len())));
        }
        let bounds = boxes.iter().fold(Aabb::EMPTY, |all, b| all.hull(*b));
        let mut order: Vec<u32> = try_with_capacity("primitives", boxes.len())?;
        order.extend(0..boxes.len() as u32);
        let tree = Tree { nodes: Vec::new(), center: bounds.center(), scale: scale_of(bounds.diagonal()), depth: 0 };
        let upper = try_with_capacity("primitives", boxes.len())?;
        let mut builder = Builder { boxes, order, tree, start: vec![0], upper, leaf_size };
        builder.node(Run { from: 0, to: boxes.len(), bounds }, 0)?;
        Ok((builder.tree, Leaves { order: builder.order, start: builder.start }))
    }
}

impl Builder<'_> {
    /// Appends the node of a run and everything below it; its index.
    fn node(&mut self, run: Run, depth: usize) -> Result<u32> {
        let at = self.tree.nodes.len();
        self.tree.depth = self.tree.depth.max(depth + 1);
        self.tree.nodes.try_reserve(1).map_err(|_| Error::memory("nodes", at + 1))?;
        self.tree.nodes.push(EMPTY_NODE);
        let mut node: Node = EMPTY_NODE;
        for (k, part) in self.split_in_eight(run, depth).into_iter().enumerate() {
            let (lo, hi) = self.tree.relative(part.bounds);
            for axis in 0..3 {
                node.lo[axis][k] = lo[axis];
                node.hi[axis][k] = hi[axis];
            }
            node.child[k] =
                if part.count() <= self.leaf_size { self.leaf(part)? | LEAF } else { self.node(part, depth + 1)? };
        }
        self.tree.nodes[at] = node;
        Ok(at as u32)
    }

    fn leaf(&mut self, run: Run) -> Result<u32> {
        self.start.try_reserve(1).map_err(|_| Error::memory("leaves", self.start.len()))?;
        self.start.push(run.to as u32);
        Ok((self.start.len() - 2) as u32)
    }

    /// Up to eight runs, in order: the largest one is split while there is room and need.
    fn split_in_eight(&mut self, run: Run, depth: usize) -> Vec<Run> {
        if self.leaf_size == 1 && run.count() <= WIDTH {
            return (run.from..run.to).map(|k| self.run(k, k + 1)).collect();
        }
        let mut parts = vec![run];
        while parts.len() < WIDTH {
            let largest = (0..parts.len()).max_by_key(|&k| (parts[k].count(), WIDTH - k)).unwrap_or(0);
            if parts[largest].count() <= self.leaf_size {
                break;
            }
            let (left, right) = self.split(parts[largest], depth);
            parts[largest] = left;
            parts.insert(largest + 1, right);
        }
        parts
    }

    fn split(&mut self, run: Run, depth: usize) -> (Run, Run) {
        let middle = match self.best_plane(run, depth) {
            Some(plane) => self.partition(run, plane),
            None => self.halve(run),
        };
        (self.run(run.from, middle), self.run(middle, run.to))
    }

    fn run(&self, from: usize, to: usize) -> Run {
        let bounds = self.order[from..to].iter().fold(Aabb::EMPTY, |all, &k| all.hull(self.boxes[k as usize]));
        Run { from, to, bounds }
    }

    fn centroid_bounds(&self, run: Run) -> Aabb {
        Aabb::of(self.order[run.from..run.to].iter().map(|&k| self.boxes[k as usize].center()))
    }

    /// The axis and plane of least cost; none where the centroids coincide or the tree is too deep.
    fn best_plane(&self, run: Run, depth: usize) -> Option<Plane> {
        if depth >= SAH_DEPTH {
            return None;
        }
        let centroids = self.centroid_bounds(run);
        let extent = centroids.hi - centroids.lo;
        // Where every primitive has a box of its own at the end, small runs are worth one look.
        let widest = if extent.x >= extent.y.max(extent.z) { 0 } else { 1 + usize::from(extent.z > extent.y) };
        let is_small = self.leaf_size == 1 && run.count() < SMALL;
        let axes = if is_small { widest..widest + 1 } else { 0..3 };
        let bins_a_unit = extent.to_array().map(|e| if e > 0.0 { BINS as f64 / e } else { 0.0 });
        let mut all_bins = [[(0usize, Aabb::EMPTY); BINS]; 3];
        for &k in &self.order[run.from..run.to] {
            let b = self.boxes[k as usize];
            let center = b.center();
            for axis in axes.clone() {
                let bin = &mut all_bins[axis][bin_of(center[axis], centroids.lo[axis], bins_a_unit[axis])];
                bin.0 += 1;
                bin.1 = bin.1.hull(b);
            }
        }
        let mut best: Option<(f64, Plane)> = None;
        for axis in axes {
            let (lo, bins_a_unit, bins) = (centroids.lo[axis], bins_a_unit[axis], &all_bins[axis]);
            if !(bins_a_unit > 0.0 && bins_a_unit.is_finite()) {
                continue;
            }
            let mut above = [(0usize, Aabb::EMPTY); BINS];
            for i in (0..BINS - 1).rev() {
                above[i] = (above[i + 1].0 + bins[i + 1].0, above[i + 1].1.hull(bins[i + 1].1));
            }
            let mut below = (0usize, Aabb::EMPTY);
            for i in 0..BINS - 1 {
                below = (below.0 + bins[i].0, below.1.hull(bins[i].1));
                if below.0 == 0 || above[i].0 == 0 {
                    continue;
                }
                let cost = self.leaves(below.0) * area(below.1) + self.leaves(above[i].0) * area(above[i].1);
                if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    best = Some((cost, Plane { axis, lo, bins_a_unit, bin: i + 1 }));
                }
            }
        }
        best.map(|(_, plane)| plane)
    }

    /// Leaves that so many primitives fill.
    fn leaves(&self, count: usize) -> f64 {
        count.div_ceil(self.leaf_size) as f64
    }

    /// Moves the primitives of the lower bins to the front, in their order; where the upper ones begin.
    fn partition(&mut self, run: Run, plane: Plane) -> usize {
        let Plane { axis, lo, bins_a_unit, bin } = plane;
        let is_lower = |k: u32| bin_of(self.boxes[k as usize].center()[axis], lo, bins_a_unit) < bin;
        let mut middle = run.from;
        self.upper.clear();
        for at in run.from..run.to {
            let k = self.order[at];
            if is_lower(k) {
                self.order[middle] = k;
                middle += 1;
            } else {
                self.upper.push(k);
            }
        }
        self.order[middle..run.to].copy_from_slice(&self.upper);
        middle
    }

    /// Two halves along the longest extent of the centroids, cut at a multiple of the leaf size.
    fn halve(&mut self, run: Run) -> usize {
        let extent = {
            let c = self.centroid_bounds(run);
            c.hi - c.lo
        };
        let axis = (0..3).fold(0, |a, b| if extent[b] > extent[a] { b } else { a });
        let boxes = self.boxes;
        let key = |k: u32| boxes[k as usize].center()[axis];
        self.order[run.from..run.to].sort_unstable_by(|&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
        run.from + (run.count() / 2).next_multiple_of(self.leaf_size).min(run.count() - 1)
    }
}

fn bin_of(center: f64, lo: f64, bins_a_unit: f64) -> usize {
    (((center - lo) * bins_a_unit) as usize).min(BINS - 1)
}

/// Half the surface area.
fn area(b: Aabb) -> f64 {
    let d: Vec3 = b.hi - b.lo;
    d.x * d.y + d.y * d.z + d.z * d.x
}
