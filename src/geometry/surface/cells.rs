// SPDX-License-Identifier: MIT OR Apache-2.0
//! Values at points that are asked for one after another and lie close together, as callbacks of solvers ask: space is
//! cut into cells of about four points a side, and what may be nearest in a cell is found when it is visited for the
//! second time. The values are those of single points to the bit; what is remembered only saves work.

use super::few::{self, Cell, FIRST, Few};
use super::{Leaf, Nearest, Surface};
use crate::bvh::{LeafList, Tree};
use crate::error::{Result, filled};
use crate::math::Vec3;
use crate::simd::float8::Simd;
use crate::simd::{Kernel, dispatch};

/// Cells that are remembered; a power of two. Each takes some 5 kB.
const CELLS: usize = 1024;

/// With more leaves than these for a cell its points ask the hierarchy.
const MOST_LEAVES: usize = 512;

/// Points after which the size of the cells is thought over.
const SPAN: u32 = 256;

/// Steps to a side of a cell.
const STEPS: f64 = 4.0;

/// What a cell is known to hold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum State {
    #[default]
    Unknown,
    /// It was visited once.
    Seen,
    /// Its triangles are there.
    Few,
    /// They are too many.
    Many,
}

#[derive(Clone, Debug, Default)]
struct Slot {
    key: [i64; 3],
    state: State,
    triangles: Vec<Leaf>,
}

/// What is remembered of one surface.
#[derive(Default)]
pub(crate) struct Cells {
    /// Side of a cell; 0 as long as there were no two points.
    side: f64,
    last: Option<Vec3>,
    slots: Vec<Slot>,
    /// Points of this span, those among them that came to a cell for the first time, and to one of too many triangles.
    asked: u32,
    new: u32,
    crowded: u32,
    /// Points of the surface that were nearest lately.
    witnesses: Option<[Vec3; FIRST]>,
    turn: usize,
    scratch: Scratch,
}

#[derive(Default)]
struct Scratch {
    stack: Vec<u32>,
    leaves: LeafList,
    few: Few,
    distances: Vec<f32>,
}

impl Cells {
    /// The signed distance at a finite point; `surface` is the same each time.
    pub(crate) fn value(&mut self, surface: &Surface, p: Vec3) -> f64 {
        let tree = surface.tree.as_ref().filter(|_| surface.compact.is_none());
        if let Some(tree) = tree
            && let Some((key, slot)) = self.slot(p)
            && let Some(value) = self.in_cell(surface, tree, key, slot, p)
        {
            return value;
        }
        surface.value(p)
    }

    /// The cell of a point.
    fn slot(&mut self, p: Vec3) -> Option<([i64; 3], usize)> {
        let step = self.last.replace(p).map_or(0.0, |last| (p - last).abs().max_element());
        self.asked += 1;
        if self.asked > SPAN || self.side == 0.0 {
            self.think_over(step);
        }
        let at = p / self.side;
        // Beyond, coordinates are no finer than cells; and what is no number is not below.
        if !(at.abs().max_element() < 1e12) {
            return None;
        }
        let key = [at.x.floor() as i64, at.y.floor() as i64, at.z.floor() as i64];
        let mixed = key.iter().fold(0u64, |h, k| (h ^ *k as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29));
        Some((key, (mixed >> 32) as usize % CELLS))
    }

    /// Cells grow or shrink where few points come to the same, or too many triangles.
    fn think_over(&mut self, step: f64) {
        let side = match () {
            () if self.side == 0.0 || self.new > SPAN / 2 => coarse(STEPS * step),
            () if self.crowded > SPAN / 2 => 0.5 * self.side,
            () => self.side,
        };
        (self.asked, self.new, self.crowded) = (0, 0, 0);
        if side == self.side || !(side > 0.0 && side.is_finite()) {
            return;
        }
        self.side = side;
        match self.slots.is_empty() {
            true => self.slots = filled("cells", CELLS, Slot::default()).unwrap_or_default(),
            false => self.slots.iter_mut().for_each(|slot| slot.state = State::Unknown),
        }
    }

    /// The value by what is known of the cell; none where that is nothing.
    fn in_cell(&mut self, surface: &Surface, tree: &Tree, key: [i64; 3], at: usize, p: Vec3) -> Option<f64> {
        let slot = self.slots.get_mut(at)?;
        if slot.key != key || slot.state == State::Unknown {
            (slot.key, slot.state) = (key, State::Seen);
            self.new += 1;
            let nearest = surface.nearest(p);
            self.turn = (self.turn + 1) % FIRST;
            self.witnesses.get_or_insert([nearest.point; FIRST])[self.turn] = nearest.point;
            return Some(surface.signed(p, &nearest));
        }
        if slot.state == State::Seen {
            let lo = Vec3::new(key[0] as f64, key[1] as f64, key[2] as f64) * self.side;
            let cell = Cell::new(tree, lo, lo + Vec3::splat(self.side));
            let (witnesses, scratch) = (self.witnesses?, &mut self.scratch);
            let found = dispatch(Find { surface, tree, cell, witnesses, scratch, triangles: &mut slot.triangles });
            slot.state = if matches!(found, Ok(true)) { State::Few } else { State::Many };
        }
        if slot.state == State::Many {
            self.crowded += 1;
            return None;
        }
        let (triangles, distances) = (&slot.triangles[..], &mut self.scratch.distances);
        let nearest = dispatch(Ask { surface, tree, triangles, p, distances });
        nearest.ok().map(|nearest| surface.signed(p, &nearest))
    }
}

/// A length with few digits, so that its multiples have no rounding.
fn coarse(length: f64) -> f64 {
    f64::from_bits(length.to_bits() & !0 << 44)
}

/// Lays the triangles of a cell side by side; false where they are too many.
struct Find<'a> {
    surface: &'a Surface,
    tree: &'a Tree,
    cell: Cell,
    witnesses: [Vec3; FIRST],
    scratch: &'a mut Scratch,
    triangles: &'a mut Vec<Leaf>,
}

impl Kernel for Find<'_> {
    type Output = Result<bool>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Result<bool> {
        let Find { surface, tree, cell, mut witnesses, scratch, triangles } = self;
        if !cell.is_near() {
            return Ok(false);
        }
        let nearest = surface.nearest(cell.middle());
        witnesses[0] = nearest.point;
        let corners = cell.with(surface, tree, witnesses);
        let Scratch { stack, leaves, few, .. } = scratch;
        let found = tree.surviving_leaves(simd, &corners, MOST_LEAVES, stack, leaves)?
            && few.find(simd, (surface, tree), leaves, &cell, &nearest, witnesses)?;
        if found {
            few.lay(surface, triangles)?;
        }
        Ok(found)
    }
}

/// The nearest of the triangles of a cell.
struct Ask<'a> {
    surface: &'a Surface,
    tree: &'a Tree,
    triangles: &'a [Leaf],
    p: Vec3,
    distances: &'a mut Vec<f32>,
}

impl Kernel for Ask<'_> {
    type Output = Result<Nearest>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Result<Nearest> {
        few::nearest_of(simd, (self.surface, self.tree), self.triangles, self.p, self.distances)
    }
}
