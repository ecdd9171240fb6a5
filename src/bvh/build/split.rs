// SPDX-License-Identifier: MIT OR Apache-2.0
//! Splitting a run of boxes where the surface area heuristic puts the least cost, in f32: boxes are already rounded
//! outward and scaled. Four numbers stand side by side, for the compiler to take at once.

use crate::bvh::Node;
use crate::simd::float8::{Float8, Simd};
use crate::simd::lanes::WIDTH;
use crate::simd::{Kernel, dispatch};

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

/// A box: its lower corner, and its upper one negated, so that one instruction makes the hull of two. The fourth
/// numbers mean nothing.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct Box4([f32; WIDTH]);

impl Box4 {
    const EMPTY: Box4 = Box4([f32::INFINITY; WIDTH]);

    pub(super) fn put(&self, node: &mut Node, lane: usize, child: u32) {
        for axis in 0..3 {
            (node.lo[axis][lane], node.hi[axis][lane]) = (self.0[axis], -self.0[axis + 4]);
        }
        node.child[lane] = child;
    }
}

/// A box, which one it is, and how many it stands for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    bounds: Box4,
}

impl Item {
    pub(super) const NONE: Item = Item { bounds: Box4::EMPTY };

    pub(super) fn new((lo, hi): ([f32; 3], [f32; 3]), index: usize) -> Item {
        let bounds = Box4([lo[0], lo[1], lo[2], 0.0, -hi[0], -hi[1], -hi[2], 0.0]);
        Item { bounds }.numbered(index, 1)
    }

    /// As numbers: the fourth ones are only looked at as bits.
    fn numbered(mut self, index: usize, weight: usize) -> Item {
        (self.bounds.0[3], self.bounds.0[7]) = (f32::from_bits(index as u32), f32::from_bits(weight as u32));
        self
    }

    /// What stands for some others.
    pub(super) fn around(items: &[Item], index: usize) -> Item {
        let mut bounds = Box4::EMPTY;
        for item in items {
            for k in 0..WIDTH {
                bounds.0[k] = if item.bounds.0[k] < bounds.0[k] { item.bounds.0[k] } else { bounds.0[k] };
            }
        }
        Item { bounds }.numbered(index, items.len())
    }

    pub(super) fn index(&self) -> u32 {
        self.bounds.0[3].to_bits()
    }

    #[inline(always)]
    pub(super) fn weight(&self) -> u32 {
        self.bounds.0[7].to_bits()
    }

    /// Where its centre is in a cube of so many places along each axis; what the hierarchy is over lies within.
    pub(super) fn place(&self, places: u32) -> [u32; 3] {
        let [x, y, z, _] = self.center();
        [x, y, z].map(|c| ((0.5 * c + 0.5) * places as f32).clamp(0.0, places as f32 - 1.0) as u32)
    }

    /// Twice its centre.
    #[inline(always)]
    fn center(&self) -> [f32; 4] {
        let mut sum = [0.0; 4];
        for k in 0..4 {
            sum[k] = self.bounds.0[k] - self.bounds.0[k + 4];
        }
        sum
    }
}

/// The box of all.
#[inline(always)]
fn hull<S: Simd>(simd: S, items: &[Item]) -> Box4 {
    let all = items.iter().fold(S::Float::splat(simd, f32::INFINITY), |all, item| load(simd, &item.bounds).min(all));
    Box4(all.lanes())
}

/// What they weigh together.
#[inline(always)]
fn weight(items: &[Item]) -> u32 {
    items.iter().map(Item::weight).sum()
}

#[inline(always)]
fn load<S: Simd>(simd: S, b: &Box4) -> S::Float {
    S::Float::load(simd, &b.0)
}

/// Some of the items one after another, and their box.
#[derive(Clone, Copy)]
struct Run {
    from: usize,
    to: usize,
    weight: u32,
    bounds: Box4,
}

impl Run {
    fn count(&self) -> usize {
        self.to - self.from
    }
}

/// Up to eight runs of items.
pub(super) struct Runs {
    runs: [Run; WIDTH],
    count: usize,
}

impl Runs {
    /// How many each has, what they weigh together, and their box.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, usize, Box4)> + '_ {
        self.runs[..self.count].iter().map(|run| (run.count(), run.weight as usize, run.bounds))
    }
}

/// The numbers of the bins that a box's centre is in, along three axes.
#[derive(Clone, Copy)]
struct Scale {
    /// Half of twice the least centre, and negated.
    from: Box4,
    /// And negated.
    bins_a_unit: Box4,
    last: i32,
}

impl Scale {
    #[inline(always)]
    fn bins<S: Simd>(&self, simd: S, item: &Item) -> [i32; 4] {
        load(simd, &item.bounds).sub(load(simd, &self.from)).mul(load(simd, &self.bins_a_unit)).bins(self.last)
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

/// The kernel of [`Splitter::in_eight`].
struct InEight<'a, 'b> {
    splitter: &'b mut Splitter<'a>,
    depth: usize,
}

impl Kernel for InEight<'_, '_> {
    type Output = Runs;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Runs {
        let Splitter { items, leaf_size } = self.splitter;
        let whole = Run { from: 0, to: items.len(), weight: weight(items), bounds: hull(simd, items) };
        let mut all = Runs { runs: [whole; WIDTH], count: 1 };
        if *leaf_size == 1 && whole.count() <= WIDTH {
            all.count = whole.count();
            for (k, item) in items.iter().enumerate() {
                all.runs[k] = Run { from: k, to: k + 1, weight: 1, bounds: item.bounds };
            }
            return all;
        }
        while all.count < WIDTH {
            let runs = &all.runs[..all.count];
            // A single one cannot be split, whatever it stands for.
            let size = |run: &Run| if run.count() > 1 { run.weight } else { 0 };
            let largest = (1..runs.len()).fold(0, |a, b| if size(&runs[b]) > size(&runs[a]) { b } else { a });
            if size(&runs[largest]) as usize <= *leaf_size {
                break;
            }
            let Run { from, to, weight, .. } = runs[largest];
            let (count, [left, right]) = split(simd, &mut items[from..to], *leaf_size, self.depth);
            let middle = from + count;
            let of_left = if weight as usize == to - from { count as u32 } else { self::weight(&items[from..middle]) };
            all.runs.copy_within(largest + 1..all.count, largest + 2);
            all.runs[largest] = Run { from, to: middle, weight: of_left, bounds: left };
            all.runs[largest + 1] = Run { from: middle, to, weight: weight - of_left, bounds: right };
            all.count += 1;
        }
        all
    }
}

impl Splitter<'_> {
    /// Orders the items into up to eight runs: the largest one is split while there is room and need.
    pub(super) fn in_eight(&mut self, depth: usize) -> Runs {
        dispatch(InEight { splitter: self, depth })
    }
}

/// How many items come first, and the boxes of both sides.
#[inline(always)]
fn split<S: Simd>(simd: S, items: &mut [Item], leaf_size: usize, depth: usize) -> (usize, [Box4; 2]) {
    let centers = extent_of_centers(simd, items);
    let plane = if depth < SAH_DEPTH { best_plane(simd, items, leaf_size, centers) } else { None };
    match plane {
        Some(plane) => (partition(simd, items, &plane), plane.bounds),
        None => {
            let middle = halve(items, leaf_size, centers);
            (middle, [hull(simd, &items[..middle]), hull(simd, &items[middle..])])
        }
    }
}

/// As a box: the least, and the greatest negated.
#[inline(always)]
fn extent_of_centers<S: Simd>(simd: S, items: &[Item]) -> Box4 {
    let mut all = S::Float::splat(simd, f32::INFINITY);
    for item in items {
        let bounds = load(simd, &item.bounds);
        all = bounds.sub(bounds.swapped()).min(all);
    }
    Box4(all.lanes())
}

/// The axis and plane of least cost; none where the centres coincide.
#[inline(always)]
fn best_plane<S: Simd>(simd: S, items: &[Item], leaf_size: usize, centers: Box4) -> Option<Plane> {
    let extent = [0, 1, 2].map(|k| -centers.0[k + 4] - centers.0[k]);
    let bins = if items.len() < FEW { FEW_BINS } else { BINS };
    let mut scale = Scale { from: Box4([0.0; WIDTH]), bins_a_unit: Box4([0.0; WIDTH]), last: bins as i32 - 1 };
    for k in 0..3 {
        let bins_a_unit = bins as f32 / extent[k];
        let bins_a_unit = if bins_a_unit.is_finite() { bins_a_unit } else { 0.0 };
        (scale.from.0[k], scale.from.0[k + 4]) = (0.5 * centers.0[k], -0.5 * centers.0[k]);
        (scale.bins_a_unit.0[k], scale.bins_a_unit.0[k + 4]) = (bins_a_unit, -bins_a_unit);
    }
    // Where every item has a box of its own at the end, small runs are worth one look.
    let widest = (0..3).fold(0, |a, b| if extent[b] > extent[a] { b } else { a });
    let is_small = leaf_size == 1 && items.len() < SMALL;
    let mut boxes = [[Box4::EMPTY; BINS]; 3];
    let mut counts = [[0u32; BINS]; 3];
    let put = |item: &Item, bin: usize, boxes: &mut [Box4; BINS], counts: &mut [u32; BINS]| {
        boxes[bin & (BINS - 1)].0 = load(simd, &item.bounds).min(load(simd, &boxes[bin & (BINS - 1)])).lanes();
        counts[bin & (BINS - 1)] += item.weight();
    };
    if is_small {
        for item in items {
            put(item, scale.bins(simd, item)[widest] as usize, &mut boxes[widest], &mut counts[widest]);
        }
    } else {
        for item in items {
            let place = scale.bins(simd, item);
            for axis in 0..3 {
                put(item, place[axis] as usize, &mut boxes[axis], &mut counts[axis]);
            }
        }
    }
    let per_leaf = 1.0 / leaf_size as f32;
    let cost =
        |count: u32, hull: S::Float| ((count + leaf_size as u32 - 1) as f32 * per_leaf) as u32 as f32 * area(hull);
    let (mut least, mut at) = (f32::INFINITY, None);
    for axis in if is_small { widest..widest + 1 } else { 0..3 } {
        if scale.bins_a_unit.0[axis] == 0.0 {
            continue;
        }
        let (boxes, counts) = (&boxes[axis], &counts[axis]);
        let mut below = [0.0; BINS];
        let (mut count, mut hull) = (0, S::Float::splat(simd, f32::INFINITY));
        for i in 1..bins {
            count += counts[i - 1];
            hull = load(simd, &boxes[i - 1]).min(hull);
            below[i] = cost(count, hull);
        }
        let all = count + counts[bins - 1];
        (count, hull) = (0, S::Float::splat(simd, f32::INFINITY));
        for i in (1..bins).rev() {
            count += counts[i];
            hull = load(simd, &boxes[i]).min(hull);
            let sum = below[i] + cost(count, hull);
            // A side without items has an infinite cost, or none that is a number.
            if sum < least && count < all {
                (least, at) = (sum, Some((axis, i)));
            }
        }
    }
    let (axis, bin) = at?;
    let side = |bins: &[Box4]| {
        let none = S::Float::splat(simd, f32::INFINITY);
        Box4(bins.iter().fold(none, |all, one| load(simd, one).min(all)).lanes())
    };
    let bounds = [side(&boxes[axis][..bin]), side(&boxes[axis][bin..bins])];
    Some(Plane { scale, axis, bin, bounds })
}

/// Half the surface area of a box.
#[inline(always)]
fn area<S: Simd, F: Float8<S>>(hull: F) -> f32 {
    // Negated, all of them.
    let [x, y, z, ..] = hull.add(hull.swapped()).lanes();
    x * y + y * z + z * x
}

/// Moves the items of the lower bins to the front; where the upper ones begin. Without branches: which side an item is
/// on cannot be foretold.
#[inline(always)]
fn partition<S: Simd>(simd: S, items: &mut [Item], plane: &Plane) -> usize {
    let mut low = 0;
    for k in 0..items.len() {
        let item = items[k];
        items.swap(low, k);
        low += usize::from(plane.scale.bins(simd, &item)[plane.axis] < plane.bin as i32);
    }
    low
}

/// Two halves along the longest extent of the centres, cut at a multiple of the leaf size.
fn halve(items: &mut [Item], leaf_size: usize, centers: Box4) -> usize {
    let extent = [0, 1, 2].map(|k| -centers.0[k + 4] - centers.0[k]);
    let axis = (0..3).fold(0, |a, b| if extent[b] > extent[a] { b } else { a });
    let key = |item: &Item| item.center()[axis];
    items.sort_unstable_by(|a, b| key(a).total_cmp(&key(b)).then(a.index().cmp(&b.index())));
    (items.len() / 2).next_multiple_of(leaf_size).min(items.len() - 1)
}
