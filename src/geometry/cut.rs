// SPDX-License-Identifier: MIT OR Apache-2.0
//! A tree cut down to what matters in a box, piece by piece: a tile of a lattice cuts what the larger tile around it
//! has left (Barbier et al. 2025; Duff 1992). Nothing is made but lists of the parts that are left.

use super::Geometry;
use super::classify::scaled;
use super::level::Level;
use super::node::Node;
use super::parts::{Near, Parts};
use super::points::Place;
use super::shape::Shape;
use crate::error::Result;
use crate::math::{Aabb, Interval, Vec3, positive_zero};

/// Trees of more levels are asked point by point: the way down needs stack.
const DEEPEST: usize = 64;

/// Of more parts, those near a box are looked up.
const FEW: usize = 32;

/// With more parts near a box than this, and one for each so many points in it, a union is left whole, and its hierarchy asked.
const MOST_PARTS: usize = 32;
const POINTS_A_PART: usize = 16;

/// Copies of a pattern that are told apart.
const MOST_COPIES: u64 = 64;

/// Nodes that one box looks into: the same part may be in a tree any number of times.
const MOST_NODES: usize = 1 << 14;

/// A node, and what is left below it.
pub(crate) struct Cut<'a> {
    pub(super) g: &'a Geometry,
    pub(super) below: Below<'a>,
    /// Leaves that are left; of what is whole, all.
    leaves: u64,
    whole: Uncut,
}

/// Whether something is left whole that has many parts.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Uncut {
    Nothing,
    /// In smaller boxes there are too many, too.
    Crowd,
    /// Smaller boxes may cut it.
    Open,
}

pub(super) enum Below<'a> {
    /// As it was built.
    Whole,
    /// One child, or the parts that are left, in order.
    Children(Vec<Cut<'a>>),
    /// The copies that are left, in order, each with its shift.
    Copies(Vec<(Vec3, Cut<'a>)>),
}

/// A node that is left, and numbers between which its values lie.
type Left<'a> = (Cut<'a>, Interval);

/// What is asked of a box.
struct Search {
    /// Nodes that may still be looked into.
    nodes: usize,
    /// Points that are to be asked.
    points: usize,
}

impl<'a> Cut<'a> {
    /// All of it.
    pub(crate) fn whole(g: &'a Geometry) -> Cut<'a> {
        Cut::uncut(g, Uncut::Nothing)
    }

    fn uncut(g: &'a Geometry, whole: Uncut) -> Cut<'a> {
        Cut { g, below: Below::Whole, leaves: g.summary().primitives, whole }
    }

    /// Whether a tree is one to cut: every function of the user's has to be asked.
    pub(crate) fn suits(g: &Geometry) -> bool {
        let s = g.summary();
        !s.functions && !s.may_fail && s.depth <= DEEPEST
    }

    pub(crate) fn leaves(&self) -> u64 {
        self.leaves
    }

    /// Whether a smaller box may leave less, though this one did not.
    pub(crate) fn is_open(&self) -> bool {
        self.whole == Uncut::Open
    }

    /// Whether a mesh is among them.
    pub(crate) fn has_meshes(&self) -> bool {
        match &self.below {
            Below::Whole => self.g.summary().surfaces,
            Below::Children(children) => children.iter().any(Cut::has_meshes),
            Below::Copies(copies) => copies.iter().any(|(_, copy)| copy.has_meshes()),
        }
    }

    /// What matters in the finite box `b`, and numbers between which its values lie there: the bits of this one up to
    /// a magnitude of `far`, beyond it any such magnitude with the right sign. So many points are to be asked.
    pub(crate) fn within(&self, b: Aabb, far: f64, points: usize) -> Left<'a> {
        self.left(b, far, &mut Search { nodes: MOST_NODES, points })
    }

    /// The values at scattered finite points.
    pub(crate) fn scattered_values(&self, points: &[Vec3], out: &mut [f64]) -> Result<()> {
        self.values(&Place::scattered(points.len(), points.iter().copied()), f64::INFINITY, out)
    }

    /// The values over a lattice within the box of the cut, x fastest.
    pub(crate) fn lattice_values(&self, axes: [&[f64]; 3], far: f64, out: &mut [f64]) -> Result<()> {
        self.values(&Place::lattice(axes.map(<[f64]>::to_vec)), far, out)?;
        out.iter_mut().for_each(|value| *value = positive_zero(*value));
        Ok(())
    }

    fn left(&self, b: Aabb, far: f64, search: &mut Search) -> Left<'a> {
        let g = self.g;
        if matches!(self.below, Below::Whole) {
            if search.nodes == 0 {
                return (Cut::uncut(g, Uncut::Open), g.range_from_middle(b));
            }
            search.nodes -= 1;
        }
        match g.node() {
            Node::Sphere(_) | Node::Shape(_) | Node::Surface(_) | Node::Function { .. } => {
                (Cut::whole(g), of_leaf(g, b))
            }
            Node::Union(parts) | Node::Intersection(parts) => self.united(parts, b, 0.0, far, search),
            Node::Smooth(smooth) => {
                let (cut, least) = self.united(smooth.parts(), b, smooth.blend().support(), f64::INFINITY, search);
                let is_blended = std::ptr::eq(cut.g, g);
                (cut, if is_blended { smooth.below(least) } else { least })
            }
            Node::Repeat(_) => self.copies(b, search),
            Node::Complement(_) => self.over(b, far, search, |f| -f),
            // Subtraction is monotone: the shifted box holds every shifted point, rounding included.
            Node::Translate(_, shift) => self.over(Aabb::new(b.lo - *shift, b.hi - *shift), far, search, |f| f),
            Node::Place(_, placement) => {
                let far = placement.before(far);
                self.over(placement.box_to_body(b), far, search, |f| scaled(f, placement.scale()))
            }
            Node::Map(_, map) => self.over(map.box_of(b), f64::INFINITY, search, |f| map.range(b, f)),
            Node::Level(_, level) => {
                let far = if let Level::Offset(d) = level { (far + d.abs()).next_up() } else { f64::INFINITY };
                self.over(b, far, search, |f| level.range(f))
            }
            Node::Stencil(_, stencil) => self.over(stencil.around(b), f64::INFINITY, search, |f| stencil.range_of(f)),
            Node::Part(..) => self.over(b, far, search, |f| f),
        }
    }

    /// The child, seen in a box of its own.
    #[inline(never)]
    fn over(&self, b: Aabb, far: f64, search: &mut Search, range: impl Fn(Interval) -> Interval) -> Left<'a> {
        let (child, f) = match (&self.below, self.g.node().children()) {
            (Below::Children(children), _) => children[0].left(b, far, search),
            (_, children) => Cut::whole(&children[0]).left(b, far, search),
        };
        (Cut { g: self.g, leaves: child.leaves, whole: child.whole, below: Below::Children(vec![child]) }, range(f))
    }

    /// The parts whose least value (signs turned where all are) may come within `support` of the least of all, and is
    /// not beyond `far`; the range is that of the least.
    #[inline(never)]
    fn united(&self, parts: &'a Parts, b: Aabb, support: f64, far: f64, search: &mut Search) -> Left<'a> {
        let signed = |range: Interval| if parts.is_turned() { -range } else { range };
        let mut left: Vec<Left> = match &self.below {
            Below::Children(children) => children.iter().map(|c| c.left(b, far, search)).collect(),
            _ if self.whole == Uncut::Crowd => return self.as_it_is(b, Uncut::Crowd),
            _ if parts.list().len() > FEW && parts.is_ordered() => {
                let most = MOST_PARTS + search.points / POINTS_A_PART;
                // Half the box has an eighth of the points and of the parts, or more.
                let crowd = 8 * MOST_PARTS + search.points / POINTS_A_PART;
                match parts.near_box(b, support, far, crowd) {
                    Near::All(near) if near.len() <= most => {
                        near.iter().map(|&k| Cut::whole(&parts.list()[k]).left(b, far, search)).collect()
                    }
                    Near::Crowd => return self.as_it_is(b, Uncut::Crowd),
                    _ => return self.as_it_is(b, Uncut::Open),
                }
            }
            _ => parts.list().iter().map(|g| Cut::whole(g).left(b, far, search)).collect(),
        };
        let highest = left.iter().fold(f64::INFINITY, |least, (_, range)| least.min(signed(*range).hi));
        let lowest = left.iter().fold(f64::INFINITY, |least, (_, range)| least.min(signed(*range).lo));
        left.retain(|(_, range)| {
            let lo = signed(*range).lo;
            // Where all are beyond, the lowest says so for them.
            lo <= highest + support && (lo < far || lo == lowest)
        });
        if left.len() == 1 {
            return left.swap_remove(0);
        }
        let all = left.iter().fold(Interval { lo: f64::INFINITY, hi: f64::INFINITY }, |all, l| all.min(signed(l.1)));
        let leaves = left.iter().fold(0u64, |sum, (cut, _)| sum.saturating_add(cut.leaves));
        let whole = left.iter().fold(Uncut::Nothing, |whole, (cut, _)| whole.max(cut.whole));
        let children = left.into_iter().map(|(cut, _)| cut).collect();
        (Cut { g: self.g, below: Below::Children(children), leaves, whole }, signed(all))
    }

    fn as_it_is(&self, b: Aabb, whole: Uncut) -> Left<'a> {
        (Cut::uncut(self.g, whole), self.g.range_from_middle(b))
    }

    #[inline(never)]
    fn copies(&self, b: Aabb, search: &mut Search) -> Left<'a> {
        let Node::Repeat(repeat) = self.g.node() else { return (Cut::whole(self.g), Interval::ALL) };
        let moved = |shift: Vec3| Aabb::new(b.lo - shift, b.hi - shift);
        let far = f64::INFINITY;
        let mut left: Vec<(Vec3, Left)> = match &self.below {
            Below::Copies(copies) => copies.iter().map(|(d, copy)| (*d, copy.left(moved(*d), far, search))).collect(),
            _ => {
                let range = self.g.range_from_middle(b);
                let Some(near) = repeat.near_box(b, range.hi, MOST_COPIES) else {
                    return (Cut::uncut(self.g, Uncut::Open), range);
                };
                near.into_iter().map(|d| (d, Cut::whole(repeat.child()).left(moved(d), far, search))).collect()
            }
        };
        if left.is_empty() {
            return (Cut::whole(self.g), self.g.range_from_middle(b));
        }
        let all = left.iter().fold(Interval { lo: f64::INFINITY, hi: f64::INFINITY }, |all, (_, l)| all.min(l.1));
        left.retain(|(_, (_, range))| range.lo <= all.hi);
        let leaves = left.iter().fold(0u64, |sum, (_, (cut, _))| sum.saturating_add(cut.leaves));
        let whole = left.iter().fold(Uncut::Nothing, |whole, (_, (cut, _))| whole.max(cut.whole));
        let copies = left.into_iter().map(|(d, (cut, _))| (d, cut)).collect();
        (Cut { g: self.g, below: Below::Copies(copies), leaves, whole }, all)
    }
}

/// Numbers between which the values of a leaf lie.
fn of_leaf(g: &Geometry, b: Aabb) -> Interval {
    match g.node() {
        Node::Sphere(sphere) => sphere.range(b),
        Node::Shape(shape) => {
            let range = shape.range(b).intersection(g.range_from_middle(b));
            if range.sign() == 0 { range.intersection(g.range_from_bounds(b)) } else { range }
        }
        _ => g.range_from_middle(b),
    }
}
