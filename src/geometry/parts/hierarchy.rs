// SPDX-License-Identifier: MIT OR Apache-2.0
//! Hierarchies over the parts' own bounds: one of balls, eight to a leaf and evaluated side by side, one of
//! everything else, one part to a leaf.

use super::around;
use super::spheres::Block;
use crate::bvh::{LEAF_SIZE, Tree};
use crate::error::{Result, try_with_capacity};
use crate::geometry::Geometry;
use crate::geometry::Kind;
use crate::geometry::node::Node;
use crate::geometry::shape::Sphere;
use crate::math::Aabb;
use crate::parallel;
use crate::store::Array;

/// Parts whose values rise slower than this stand beside: they would spoil the bounds of all others.
const MOST_SPREAD: f64 = 16.0;

/// Fewer balls than this are parts like all others.
const MANY_SPHERES: usize = 8;

pub(super) struct Hierarchy {
    pub(super) spheres: Option<(Tree, Array<Block>)>,
    /// Leaf k is the part `.1[k]`.
    pub(super) others: Option<(Tree, Array<u32>)>,
    /// In order.
    pub(super) beside: Array<u32>,
    /// Largest of the parts in the trees.
    pub(super) spread: f64,
    /// Largest Lipschitz constant of the parts in the trees, at least 1: how fast a value falls inside a box.
    pub(super) steepness: f64,
    /// Largest rounding of the parts in the trees, and of distances to boxes.
    pub(super) rounding: (f64, f64),
}

impl Hierarchy {
    /// None where no two parts have bounds.
    pub(super) fn new(list: &[Geometry], turned: bool) -> Result<Option<Hierarchy>> {
        let mut spheres = try_with_capacity("parts", list.len())?;
        let mut others = try_with_capacity("parts", list.len())?;
        let mut beside = try_with_capacity("parts", list.len())?;
        for (k, part) in list.iter().enumerate() {
            let of = if !fits(part, turned) {
                &mut beside
            } else if !turned && as_sphere(part).is_some() {
                &mut spheres
            } else {
                &mut others
            };
            of.push(k as u32);
        }
        if spheres.len() < MANY_SPHERES {
            others.append(&mut spheres);
            others.sort_unstable();
        }
        if spheres.len() + others.len() < 2 {
            return Ok(None);
        }
        let mut hierarchy = Hierarchy {
            spheres: None,
            others: None,
            beside: beside.into(),
            spread: 1.0,
            steepness: 1.0,
            rounding: (0.0, 0.0),
        };
        let mut size = 0.0f64;
        for &k in spheres.iter().chain(&others) {
            let (s, b) = (list[k as usize].summary(), around(&list[k as usize], turned));
            hierarchy.spread = hierarchy.spread.max(if turned { s.spread_rest } else { s.spread });
            hierarchy.steepness = hierarchy.steepness.max(s.lipschitz);
            hierarchy.rounding.0 = hierarchy.rounding.0.max(s.rounding.0);
            hierarchy.rounding.1 = hierarchy.rounding.1.max(s.rounding.1);
            size = size.max(b.lo.abs().max(b.hi.abs()).max_element());
        }
        // Distances to boxes are taken from the middle of all of them.
        hierarchy.rounding.0 += 8.0 * f64::EPSILON;
        hierarchy.rounding.1 += 16.0 * f64::EPSILON * size;
        if !spheres.is_empty() {
            let (tree, order, start) = build(list, &spheres, turned, LEAF_SIZE)?;
            let sphere = |k: u32| as_sphere(&list[k as usize]).map(|s| (k, s));
            let mut blocks = try_with_capacity("blocks", start.len())?;
            for leaf in start.windows(2) {
                let members = order[leaf[0] as usize..leaf[1] as usize].iter();
                blocks.push(Block::new(&members.filter_map(|&k| sphere(k)).collect::<Vec<_>>()));
            }
            hierarchy.spheres = Some((tree, blocks.into()));
        }
        if !others.is_empty() {
            let (tree, order, _) = build(list, &others, turned, 1)?;
            hierarchy.others = Some((tree, order));
        }
        Ok(Some(hierarchy))
    }

    pub(super) fn spread(&self) -> f64 {
        self.spread
    }

    pub(super) fn is_beside(&self, part: usize) -> bool {
        self.beside.binary_search(&(part as u32)).is_ok()
    }

    /// The distance to a box beyond which every part's value, as computed for a point up to
    /// `extent` from the origin, is above `value`.
    #[inline(always)]
    pub(super) fn bound(&self, value: f64, extent: f64) -> f64 {
        if value == f64::NEG_INFINITY {
            return value;
        }
        let margin = self.rounding.0 * extent + self.rounding.1;
        let reach = value + margin;
        // Outside, a value d says that the body may be spread * d away; inside, a value is no lower than the
        // depth in the box times the Lipschitz constant, for it is positive beyond.
        let reach = if reach > 0.0 { reach * self.spread } else { reach / self.steepness };
        reach + margin + reach.abs() * 1e-14
    }

    /// Calls `visit` for the parts in no order, of which some may not meet the box.
    pub(super) fn meeting(&self, b: Aabb, mut visit: impl FnMut(usize)) {
        self.beside.iter().for_each(|&k| visit(k as usize));
        if let Some((tree, blocks)) = &self.spheres {
            tree.overlapping(b, |leaf| blocks[leaf].parts().for_each(|k| visit(k as usize)));
        }
        if let Some((tree, parts)) = &self.others {
            tree.overlapping(b, |leaf| visit(parts[leaf] as usize));
        }
    }

    /// The same until `visit` says that it has seen enough; whether it did.
    pub(super) fn any_meeting(&self, b: Aabb, mut visit: impl FnMut(usize) -> bool) -> bool {
        if self.beside.iter().any(|&k| visit(k as usize)) {
            return true;
        }
        if let Some((tree, blocks)) = &self.spheres
            && tree.any_overlapping(b, |leaf| blocks[leaf].parts().any(|k| visit(k as usize)))
        {
            return true;
        }
        self.others.as_ref().is_some_and(|(tree, parts)| tree.any_overlapping(b, |leaf| visit(parts[leaf] as usize)))
    }

    pub(super) fn bytes(&self) -> usize {
        let spheres = self.spheres.as_ref().map_or(0, |(tree, blocks)| tree.bytes() + size_of_val(&blocks[..]));
        let others = self.others.as_ref().map_or(0, |(tree, parts)| tree.bytes() + size_of_val(&parts[..]));
        spheres + others + size_of_val(&self.beside[..]) + size_of::<Hierarchy>()
    }
}

/// Whether the part's own bounds say where its value is not small.
fn fits(part: &Geometry, turned: bool) -> bool {
    let (s, b) = (part.summary(), around(part, turned));
    let spread = if turned { s.spread_rest } else { s.spread };
    // One that may have no value is always asked, unless the user vouches for its distance.
    let is_vouched = !s.may_fail || s.kind == Kind::Exact;
    let is_bound = s.kind <= Kind::LowerBound;
    is_vouched
        && is_bound
        && b.is_finite()
        && spread <= MOST_SPREAD
        && s.rounding.0.is_finite()
        && s.rounding.1.is_finite()
}

/// The ball that a part is, under its labels.
pub(super) fn as_sphere(part: &Geometry) -> Option<Sphere> {
    let mut part = part;
    loop {
        match part.node() {
            Node::Sphere(sphere) => return Some(*sphere),
            Node::Part(g, _) => part = g,
            _ => return None,
        }
    }
}

/// A tree over some parts: the tree, the parts leaf after leaf, and where each leaf begins.
fn build(list: &[Geometry], members: &[u32], turned: bool, leaf: usize) -> Result<(Tree, Array<u32>, Array<u32>)> {
    let mut boxes = try_with_capacity("boxes", members.len())?;
    boxes.extend(members.iter().map(|&k| around(&list[k as usize], turned)));
    let (tree, mut leaves) = Tree::build(boxes.len(), &|k| boxes[k], leaf, &parallel::Run::SERIAL)?;
    leaves.order.edit("parts")?.iter_mut().for_each(|k| *k = members[*k as usize]);
    Ok((tree, leaves.order, leaves.start))
}
