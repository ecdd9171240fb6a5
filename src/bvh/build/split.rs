// SPDX-License-Identifier: MIT OR Apache-2.0
//! Splitting a run of boxes where the surface area heuristic puts the least cost, in f32: boxes are already rounded
//! outward and scaled. Four numbers stand side by side, for the compiler to take at once.

use crate::bvh::Node;
use crate::simd::lanes::WIDTH;

const BINS: usize = 16;

/// Runs shorter than this are sorted into fewer bins: there are many of them, and looking at bins costs more there than
/// at items.
const FEW: usize = 128;
const FEW_BINS: usize = 8;

/// Runs shorter than this are small.
const SMALL: usize = 64;

/// Deeper than this, splits are by halves: the depth, and with it the stack of a traversal, stays bounded whatever the
/// input.
const SAH_DEPTH: usize = 16;

/// Added to a number between 0 and 2^22, it leaves that number, rounded, in the last bits.
const TO_BITS: f32 = 8_388_608.0;

/// A box; the fourth numbers mean nothing.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(super) struct Box4 {
    lo: [f32; 4],
    hi: [f32; 4],
}

impl Box4 {
    const EMPTY: Box4 = Box4 { lo: [f32::INFINITY; 4], hi: [f32::NEG_INFINITY; 4] };

    #[inline(always)]
    fn add(&mut self, other: &Box4) {
        for k in 0..4 {
            self.lo[k] = if other.lo[k] < self.lo[k] { other.lo[k] } else { self.lo[k] };
            self.hi[k] = if other.hi[k] > self.hi[k] { other.hi[k] } else { self.hi[k] };
        }
    }

    /// Half the surface area.
    fn area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|k| self.hi[k] - self.lo[k]);
        x * y + y * z + z * x
    }

    pub(super) fn put(&self, node: &mut Node, lane: usize, child: u32) {
        for axis in 0..3 {
            (node.lo[axis][lane], node.hi[axis][lane]) = (self.lo[axis], self.hi[axis]);
        }
        node.child[lane] = child;
    }
}

/// A box and which one it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    bounds: Box4,
}

impl Item {
    pub(super) const NONE: Item = Item { bounds: Box4::EMPTY };

    pub(super) fn new((lo, hi): ([f32; 3], [f32; 3]), index: usize) -> Item {
        // As a number: of the fourth numbers only this one is looked at, and only as bits.
        let index = f32::from_bits(index as u32);
        Item { bounds: Box4 { lo: [lo[0], lo[1], lo[2], index], hi: [hi[0], hi[1], hi[2], 0.0] } }
    }

    pub(super) fn index(&self) -> u32 {
        self.bounds.lo[3].to_bits()
    }

    /// Twice its centre.
    #[inline(always)]
    fn center(&self) -> [f32; 4] {
        let mut sum = [0.0; 4];
        for k in 0..3 {
            sum[k] = self.bounds.lo[k] + self.bounds.hi[k];
        }
        sum
    }
}

/// The box of all.
pub(super) fn hull(items: &[Item]) -> Box4 {
    items.iter().fold(Box4::EMPTY, |mut all, item| {
        all.add(&item.bounds);
        all
    })
}

/// Some of the items one after another, and their box.
#[derive(Clone, Copy)]
struct Run {
    from: usize,
    to: usize,
    bounds: Box4,
}

impl Run {
    fn count(&self) -> usize {
        self.to - self.from
    }
}

/// Up to eight runs of items, by how many each has and their box.
pub(super) struct Runs {
    runs: [Run; WIDTH],
    count: usize,
}

impl Runs {
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, Box4)> + '_ {
        self.runs[..self.count].iter().map(|run| (run.count(), run.bounds))
    }
}

/// The numbers of bins of a point, along three axes.
#[derive(Clone, Copy)]
struct Scale {
    lo: [f32; 4],
    bins_a_unit: [f32; 4],
    last: f32,
}

impl Scale {
    /// (Each loop is one instruction.)
    #[inline(always)]
    fn bins(&self, center: [f32; 4]) -> [u32; 4] {
        let (mut at, mut bins) = ([0.0; 4], [0; 4]);
        for k in 0..4 {
            at[k] = center[k] - self.lo[k];
        }
        for k in 0..4 {
            at[k] *= self.bins_a_unit[k];
        }
        for k in 0..4 {
            at[k] -= 0.5;
        }
        for k in 0..4 {
            at[k] = if at[k] > 0.0 { at[k] } else { 0.0 };
        }
        for k in 0..4 {
            at[k] = if at[k] < self.last { at[k] } else { self.last };
        }
        for k in 0..4 {
            at[k] += TO_BITS;
        }
        for k in 0..4 {
            bins[k] = at[k].to_bits() & (BINS as u32 - 1);
        }
        bins
    }
}

/// Items below bin `bin` along `axis` come first.
struct Plane {
    scale: Scale,
    axis: usize,
    bin: usize,
    /// The boxes of the two sides.
    bounds: [Box4; 2],
}

/// Splits items.
pub(super) struct Splitter<'a> {
    pub(super) items: &'a mut [Item],
    /// Most items of a leaf.
    pub(super) leaf_size: usize,
}

impl Splitter<'_> {
    /// Orders the items into up to eight runs: the largest one is split while there is room and need.
    pub(super) fn in_eight(&mut self, depth: usize) -> Runs {
        let whole = Run { from: 0, to: self.items.len(), bounds: hull(self.items) };
        let mut all = Runs { runs: [whole; WIDTH], count: 1 };
        if self.leaf_size == 1 && whole.count() <= WIDTH {
            all.count = whole.count();
            for (k, item) in self.items.iter().enumerate() {
                all.runs[k] = Run { from: k, to: k + 1, bounds: item.bounds };
            }
            return all;
        }
        while all.count < WIDTH {
            let runs = &all.runs[..all.count];
            let largest = (1..runs.len()).fold(0, |a, b| if runs[b].count() > runs[a].count() { b } else { a });
            if runs[largest].count() <= self.leaf_size {
                break;
            }
            let [left, right] = self.split(runs[largest], depth);
            all.runs.copy_within(largest + 1..all.count, largest + 2);
            (all.runs[largest], all.runs[largest + 1]) = (left, right);
            all.count += 1;
        }
        all
    }

    fn split(&mut self, run: Run, depth: usize) -> [Run; 2] {
        let plane = if depth < SAH_DEPTH { self.best_plane(run) } else { None };
        let (middle, [left, right]) = match plane {
            Some(plane) => (self.partition(run, &plane), plane.bounds),
            None => {
                let middle = self.halve(run);
                (middle, [hull(&self.items[run.from..middle]), hull(&self.items[middle..run.to])])
            }
        };
        [Run { from: run.from, to: middle, bounds: left }, Run { from: middle, to: run.to, bounds: right }]
    }

    fn extent_of_centers(&self, run: Run) -> Box4 {
        let mut all = Box4::EMPTY;
        for item in &self.items[run.from..run.to] {
            let center = item.center();
            all.add(&Box4 { lo: center, hi: center });
        }
        all
    }

    /// The axis and plane of least cost; none where the centres coincide.
    fn best_plane(&self, run: Run) -> Option<Plane> {
        let centers = self.extent_of_centers(run);
        let extent = [0, 1, 2].map(|k| centers.hi[k] - centers.lo[k]);
        let bins = if run.count() < FEW { FEW_BINS } else { BINS };
        let mut scale = Scale { lo: centers.lo, bins_a_unit: [0.0; 4], last: (bins - 1) as f32 };
        for k in 0..3 {
            let bins_a_unit = bins as f32 / extent[k];
            scale.bins_a_unit[k] = if bins_a_unit.is_finite() { bins_a_unit } else { 0.0 };
        }
        // Where every item has a box of its own at the end, small runs are worth one look.
        let widest = (0..3).fold(0, |a, b| if extent[b] > extent[a] { b } else { a });
        let is_small = self.leaf_size == 1 && run.count() < SMALL;
        let axes = if is_small { widest..widest + 1 } else { 0..3 };
        let mut boxes = [[Box4::EMPTY; BINS]; 3];
        let mut counts = [[0u32; BINS]; 3];
        for item in &self.items[run.from..run.to] {
            let place = scale.bins(item.center());
            for axis in axes.clone() {
                let bin = place[axis] as usize & (BINS - 1);
                boxes[axis][bin].add(&item.bounds);
                counts[axis][bin] += 1;
            }
        }
        let mut best: Option<(f32, Plane)> = None;
        for axis in axes {
            if scale.bins_a_unit[axis] == 0.0 {
                continue;
            }
            let mut above = [(0, Box4::EMPTY); BINS];
            for i in (0..bins - 1).rev() {
                above[i] = (above[i + 1].0 + counts[axis][i + 1], above[i + 1].1);
                above[i].1.add(&boxes[axis][i + 1]);
            }
            let mut below = (0, Box4::EMPTY);
            for i in 0..bins - 1 {
                below.0 += counts[axis][i];
                below.1.add(&boxes[axis][i]);
                if below.0 == 0 || above[i].0 == 0 {
                    continue;
                }
                let cost = self.leaves(below.0) * below.1.area() + self.leaves(above[i].0) * above[i].1.area();
                if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                    best = Some((cost, Plane { scale, axis, bin: i + 1, bounds: [below.1, above[i].1] }));
                }
            }
        }
        best.map(|(_, plane)| plane)
    }

    /// Leaves that so many items fill.
    fn leaves(&self, count: u32) -> f32 {
        count.div_ceil(self.leaf_size as u32) as f32
    }

    /// Moves the items of the lower bins to the front; where the upper ones begin.
    fn partition(&mut self, run: Run, plane: &Plane) -> usize {
        let items = &mut self.items[run.from..run.to];
        let is_lower = |item: &Item| plane.scale.bins(item.center())[plane.axis] < plane.bin as u32;
        let (mut low, mut high) = (0, items.len());
        loop {
            while low < high && is_lower(&items[low]) {
                low += 1;
            }
            while low < high && !is_lower(&items[high - 1]) {
                high -= 1;
            }
            if low >= high {
                return run.from + low;
            }
            items.swap(low, high - 1);
            (low, high) = (low + 1, high - 1);
        }
    }

    /// Two halves along the longest extent of the centres, cut at a multiple of the leaf size.
    fn halve(&mut self, run: Run) -> usize {
        let centers = self.extent_of_centers(run);
        let extent = [0, 1, 2].map(|k| centers.hi[k] - centers.lo[k]);
        let axis = (0..3).fold(0, |a, b| if extent[b] > extent[a] { b } else { a });
        let key = |item: &Item| item.center()[axis];
        let items = &mut self.items[run.from..run.to];
        items.sort_unstable_by(|a, b| key(a).total_cmp(&key(b)).then(a.index().cmp(&b.index())));
        run.from + (run.count() / 2).next_multiple_of(self.leaf_size).min(run.count() - 1)
    }
}
