// SPDX-License-Identifier: MIT OR Apache-2.0
//! Simple polygons in the plane: checked exactly, made counter-clockwise, kept as edges.

use crate::error::{Error, Result, try_with_capacity};
use crate::primitive::outline::{Edge, folds_back, segments_meet, signed};
use crate::primitive::polygon::turn;
use crate::store::{Packer, Unpacker, wrong};

/// Most corners: every pair of edges is tested, and each value looks at all of them.
pub(super) const MAX_CORNERS: usize = 10_000;

pub(in crate::geometry) struct Outline {
    edges: Vec<Edge>,
    lo: [f64; 2],
    hi: [f64; 2],
    convex: bool,
    /// Of a half plane: the lower and upper end of the edges on its axis, which are no surface.
    axis: Option<(f64, f64)>,
}

impl Outline {
    /// A polygon in either order. It must not touch itself.
    pub(super) fn new(points: &[[f64; 2]]) -> Result<Outline> {
        let points = checked(points)?;
        Outline::of(&points, |_, _| true)
    }

    /// A polygon in the half plane x >= 0 whose edges on x = 0 are no surface.
    pub(super) fn revolved(points: &[[f64; 2]]) -> Result<Outline> {
        if let Some(k) = points.iter().position(|p| p[0] < 0.0) {
            return Err(Error::invalid(format!("points[{k}][0]: {} is not >= 0", points[k][0])));
        }
        let points = checked(points)?;
        let mut outline = Outline::of(&points, |a, b| a[0] > 0.0 || b[0] > 0.0)?;
        let on_axis = |k: usize| points[k][0] == 0.0 && points[(k + 1) % points.len()][0] == 0.0;
        let ends = (0..points.len()).filter(|&k| on_axis(k)).map(|k| (points[k][1], points[(k + 1) % points.len()][1]));
        outline.axis = ends.fold(None, |sofar, (a, b)| {
            let (lo, hi) = sofar.unwrap_or((a, a));
            Some((lo.min(a).min(b), hi.max(a).max(b)))
        });
        Ok(outline)
    }

    /// A polygon known to be simple, counter-clockwise.
    pub(super) fn of(points: &[[f64; 2]], is_surface: impl Fn([f64; 2], [f64; 2]) -> bool) -> Result<Outline> {
        let n = points.len();
        let mut edges = try_with_capacity("edges", n)?;
        let pairs = (0..n).map(|k| (points[k], points[(k + 1) % n]));
        edges.extend(pairs.filter(|&(a, b)| is_surface(a, b)).map(|(a, b)| Edge::new(a, b)));
        let extreme = |k: usize, pick: fn(f64, f64) -> f64| points.iter().map(|p| p[k]).fold(points[0][k], pick);
        Ok(Outline {
            edges,
            lo: [extreme(0, f64::min), extreme(1, f64::min)],
            hi: [extreme(0, f64::max), extreme(1, f64::max)],
            convex: (0..n).all(|k| turn(points[k], points[(k + 1) % n], points[(k + 2) % n]) >= 0.0),
            axis: None,
        })
    }

    pub(super) fn pack(&self, out: &mut Packer) {
        out.word(self.edges.len() as u64);
        out.numbers(self.corners().flatten());
        out.numbers([self.lo, self.hi].concat());
        out.word(u64::from(self.convex));
        out.word(u64::from(self.axis.is_some()));
        let (lo, hi) = self.axis.unwrap_or_default();
        out.numbers([lo, hi]);
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Outline> {
        let count = from.count(4, "edges")?;
        let mut edges = try_with_capacity("edges", count)?;
        for _ in 0..count {
            edges.push(Edge::new(from.numbers()?, from.numbers()?));
        }
        let (lo, hi, convex, has_axis) = (from.numbers()?, from.numbers()?, from.flag()?, from.flag()?);
        let [below, above] = from.numbers()?;
        match edges.len() {
            1..=MAX_CORNERS => Ok(Outline { edges, lo, hi, convex, axis: has_axis.then_some((below, above)) }),
            n => Err(wrong(&format!("a polygon has {n} edges"))),
        }
    }

    /// Signed distance and its gradient.
    pub(super) fn signed(&self, p: [f64; 2]) -> (f64, [f64; 2]) {
        signed(&self.edges, self.lo, self.hi, p)
    }

    /// The ends of all edges, some twice: enough to tell the polygon.
    pub(super) fn corners(&self) -> impl Iterator<Item = [f64; 2]> {
        self.edges.iter().flat_map(|edge| [edge.a, edge.b])
    }

    pub(super) fn lo(&self) -> [f64; 2] {
        self.lo
    }

    pub(super) fn hi(&self) -> [f64; 2] {
        self.hi
    }

    pub(super) fn is_convex(&self) -> bool {
        self.convex
    }

    /// Whether the solid of revolution is convex: the polygon is, and so is it with its mirror image.
    pub(super) fn is_convex_around_axis(&self) -> bool {
        self.convex && self.axis == Some((self.lo[1], self.hi[1]))
    }

    pub(super) fn heap(&self) -> usize {
        size_of_val(&self.edges[..])
    }
}

/// The points, counter-clockwise and without -0.0, where they are a simple polygon. Quadratic time.
fn checked(points: &[[f64; 2]]) -> Result<Vec<[f64; 2]>> {
    let n = points.len();
    if n < 3 {
        return Err(Error::invalid(format!("points: {n} are fewer than 3")));
    }
    if n > MAX_CORNERS {
        return Err(Error::unsupported(format!("points: {n} are more than {MAX_CORNERS}")));
    }
    let coordinates = points.iter().enumerate().flat_map(|(k, p)| [(k, 0, p[0]), (k, 1, p[1])]);
    if let Some((k, axis, x)) = coordinates.into_iter().find(|(_, _, x)| !x.is_finite()) {
        return Err(Error::invalid(format!("points[{k}][{axis}]: {x} is not finite")));
    }
    let mut ring = try_with_capacity("points", n)?;
    ring.extend(points.iter().map(|p| p.map(|x| x + 0.0)));
    if let Some(k) = (0..n).find(|&k| ring[k] == ring[(k + 1) % n]) {
        let [x, y] = ring[k];
        return Err(Error::invalid(format!("points[{}]: ({x}, {y}) repeats points[{k}]", (k + 1) % n)));
    }
    if ring.iter().all(|&p| turn(ring[0], ring[1], p) == 0.0) {
        return Err(Error::invalid(format!("points: all {n} are on one line")));
    }
    if let Some((i, j)) = clash(&ring) {
        return Err(Error::invalid(format!("points: edges {i} and {j} meet")));
    }
    // The corner of least x, then least y, is convex and not straight.
    let least = (0..n).fold(0, |least, k| if ring[k] < ring[least] { k } else { least });
    if turn(ring[(least + n - 1) % n], ring[least], ring[(least + 1) % n]) < 0.0 {
        ring.reverse();
    }
    Ok(ring)
}

/// Two edges that meet other than at a common end; edge k starts at point k.
fn clash(ring: &[[f64; 2]]) -> Option<(usize, usize)> {
    let n = ring.len();
    let at = |k: usize| ring[k % n];
    for i in 0..n {
        if folds_back(at(i), at(i + 1), at(i + 2)) {
            return Some((i, (i + 1) % n));
        }
        // The last edge is a neighbour of the first.
        let end = if i == 0 { n - 1 } else { n };
        for j in i + 2..end {
            if segments_meet(at(i), at(i + 1), at(j), at(j + 1)) {
                return Some((i, j));
            }
        }
    }
    None
}
