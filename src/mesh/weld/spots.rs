// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whether any two vertices of two cells are near, by k-d trees (Bentley 1975) over the cells that hold many, both
//! descended at once.

use super::Grid;
use crate::error::{Error, Result, filled};
use crate::math::{Aabb, Vec3, length};

/// Vertices that are looked at one by one at most.
const LEAF: usize = 8;

/// What is farther apart than so many distances along a line is so, whatever is rounded.
const BEYOND: f64 = 1.0 + 1e-12;

/// No tree.
const NONE: u32 = u32::MAX;

/// Some vertices, consecutive in the grid, in their box.
#[derive(Clone, Copy)]
struct Node {
    bounds: Aabb,
    mean: Vec3,
    from: u32,
    to: u32,
    /// [`NONE`] for a leaf.
    children: [u32; 2],
}

impl Node {
    fn leaf(vertices: &[Vec3], order: &[u32], from: u32, to: u32) -> Node {
        let members = order[from as usize..to as usize].iter().map(|&v| vertices[v as usize]);
        let bounds = Aabb::of(members.clone());
        let mean = bounds.lo + members.map(|p| p - bounds.lo).sum::<Vec3>() / f64::from(to - from);
        Node { bounds, mean, from, to, children: [NONE; 2] }
    }

    fn count(&self) -> u32 {
        self.to - self.from
    }

    fn is_leaf(&self) -> bool {
        self.children[0] == NONE
    }
}

/// The trees.
pub(super) struct Spots<'a> {
    vertices: &'a [Vec3],
    distance: f64,
    nodes: Vec<Node>,
    /// The tree of each cell, or [`NONE`]; empty where none has one.
    roots: Vec<u32>,
}

impl<'a> Spots<'a> {
    /// Sorts the vertices in the cells of the grid anew.
    pub(super) fn new(vertices: &'a [Vec3], grid: &mut Grid, distance: f64) -> Result<Spots<'a>> {
        let mut spots = Spots { vertices, distance, nodes: Vec::new(), roots: Vec::new() };
        let is_large = |w: &[u32]| (w[1] - w[0]) as usize > LEAF;
        if grid.start.windows(2).any(is_large) {
            spots.roots = filled("cells", grid.cells.len(), NONE)?;
            for (c, w) in grid.start.windows(2).enumerate().filter(|(_, w)| is_large(w)) {
                spots.roots[c] = spots.plant(&mut grid.vertices, w[0], w[1])?;
            }
        }
        Ok(spots)
    }

    /// Adds the node of a stretch of the grid's vertices and those below it; its number.
    fn plant(&mut self, order: &mut [u32], from: u32, to: u32) -> Result<u32> {
        let at = self.nodes.len();
        self.nodes.try_reserve(1).map_err(|_| Error::memory("cells", at + 1))?;
        let node = Node::leaf(self.vertices, order, from, to);
        self.nodes.push(node);
        if node.count() as usize > LEAF {
            let size = (node.bounds.hi - node.bounds.lo).to_array();
            let axis = (1..3).fold(0, |most, k| if size[k] > size[most] { k } else { most });
            let middle = node.count() / 2;
            let along = |v: &u32| self.vertices[*v as usize][axis];
            order[from as usize..to as usize]
                .select_nth_unstable_by(middle as usize, |a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
            let low = self.plant(order, from, from + middle)?;
            self.nodes[at].children = [low, self.plant(order, from + middle, to)?];
        }
        Ok(at as u32)
    }

    /// Whether any vertex of one cell is nearer than the distance to any of the other.
    pub(super) fn are_near(&self, grid: &Grid, c: usize, d: usize) -> bool {
        let root = |c: usize| match self.roots.get(c) {
            Some(&root) if root != NONE => self.nodes[root as usize],
            _ => Node::leaf(self.vertices, &grid.vertices, grid.start[c], grid.start[c + 1]),
        };
        self.any_near(&grid.vertices, &root(c), &root(d))
    }

    /// The length of the rounded differences grows with each of them, rounded or not, so what is told of boxes holds
    /// for the vertices in them to the bit. (Squares are in the range of f64: the distance is at least 1e-102.) Boxes
    /// overlap too much where two sheets run side by side askew; those are told apart by two planes.
    fn any_near(&self, order: &[u32], a: &Node, b: &Node) -> bool {
        if gap(&a.bounds, &b.bounds) >= self.distance {
            return false;
        }
        if span(&a.bounds, &b.bounds) < self.distance {
            return true;
        }
        let points = |n: &Node| order[n.from as usize..n.to as usize].iter().map(|&v| self.vertices[v as usize]);
        let apart = b.mean - a.mean;
        let (from, along) = (a.mean, apart / length(apart));
        let least = points(a).map(|p| (p - from).dot(along)).fold(0.0, f64::max) + self.distance * BEYOND;
        // False where the means are one.
        if points(b).all(|p| (p - from).dot(along) >= least) {
            return false;
        }
        if a.is_leaf() && b.is_leaf() {
            return points(a).any(|p| points(b).any(|q| length(p - q) < self.distance));
        }
        let (split, whole) = if !a.is_leaf() && (b.is_leaf() || a.count() >= b.count()) { (a, b) } else { (b, a) };
        let [mut near, mut far] = split.children.map(|child| &self.nodes[child as usize]);
        if gap(&far.bounds, &whole.bounds) < gap(&near.bounds, &whole.bounds) {
            (near, far) = (far, near);
        }
        self.any_near(order, near, whole) || self.any_near(order, far, whole)
    }
}

/// The least distance of points of two boxes.
fn gap(a: &Aabb, b: &Aabb) -> f64 {
    length((b.lo - a.hi).max(a.lo - b.hi).max(Vec3::ZERO))
}

/// The largest.
fn span(a: &Aabb, b: &Aabb) -> f64 {
    length((b.hi - a.lo).max(a.hi - b.lo))
}
