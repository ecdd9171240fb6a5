// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a node knows of itself without being asked for a value.

use super::Geometry;
use super::blend::Blend;
use super::node::Node;
use super::parts::Parts;
use super::placement::Placement;
use super::properties::{Function, FunctionOptions, Kind, Properties, SignMethod};
use super::shape::{Facts, Shape};
use super::surface::Surface;
use crate::math::{Aabb, Vec3, length};
use crate::primitive::triangle::RELATIVE_ERROR;
use std::collections::HashSet;
use std::sync::Arc;

/// Bounds are widened by this much of what was added, twice over what rounding can do: a point whose value
/// comes out as zero lies within.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A point is at most so many times as far as its largest coordinate; rounded up.
pub(super) const ROOT_OF_THREE: f64 = 1.732050807568878;

#[derive(Clone, Copy, Debug)]
pub(super) struct Summary {
    /// Around the body: where its value is <= 0 as computed. Parts that miss each other leave lo > hi.
    pub(super) bounds: Aabb,
    /// Around the rest of space (and the surface).
    pub(super) rest: Aabb,
    pub(super) kind: Kind,
    pub(super) lipschitz: f64,
    /// Whether the sign may change where the value does not pass zero: across a hole of a mesh below. The Lipschitz
    /// constant holds apart from that.
    pub(super) jumps: bool,
    /// Every point of value <= d, d > 0, is within d * spread of `bounds`; infinite where nothing is known.
    pub(super) spread: f64,
    /// Every point of value >= -d is within d * spread_rest of `rest`.
    pub(super) spread_rest: f64,
    /// The same for both, along each axis.
    pub(super) spread_axis: f64,
    /// How far the surface can be offset outward, and inward, and the value stay exact.
    pub(super) reach_outward: f64,
    pub(super) reach_inward: f64,
    /// Bound on |computed value - true value| up to E from the origin: `rounding.0 * E + rounding.1`. Of lengths
    /// rather than coordinates, for turning leaves them: the bound grows with the levels, not with their powers.
    pub(super) rounding: (f64, f64),
    /// The value there is at most E times the Lipschitz constant plus this; what is added to it rounds by so much.
    pub(super) magnitude: f64,
    /// The one method of all meshes below; Auto where there is none or several.
    pub(super) sign_method: SignMethod,
    pub(super) surfaces: bool,
    /// Whether there are functions of the user's below.
    pub(super) functions: bool,
    /// Whether a leaf below may have no value (NaN) at a finite point.
    pub(super) may_fail: bool,
    /// Whether something below gains by many points at once.
    pub(super) batched: bool,
    pub(super) thread_safe: bool,
    /// Triangles and shapes; a shared part as often as it is used.
    pub(super) primitives: u64,
    /// Levels of nodes below and including this one.
    pub(super) depth: usize,
}

impl Summary {
    fn leaf(facts: Facts) -> Summary {
        let kind = match facts.exact {
            true => Kind::Exact,
            false if facts.lipschitz <= 1.0 => Kind::LowerBound,
            false => Kind::SignOnly,
        };
        Summary {
            bounds: facts.bounds,
            rest: facts.rest,
            kind,
            lipschitz: facts.lipschitz,
            jumps: false,
            spread: facts.spread,
            spread_rest: facts.spread,
            spread_axis: facts.spread,
            reach_outward: facts.reach_outward,
            reach_inward: facts.reach_inward,
            rounding: facts.rounding,
            // Its rounding is at least so much of the numbers that the value is made of.
            magnitude: facts.rounding.1 / (4.0 * f64::EPSILON),
            sign_method: SignMethod::Auto,
            surfaces: false,
            functions: false,
            may_fail: false,
            batched: false,
            thread_safe: true,
            primitives: 1,
            depth: 1,
        }
    }

    fn surface(surface: &Surface) -> Summary {
        let (mut bounds, mut rest) = (surface.body_bounds(), Aabb::ALL);
        if surface.is_inverted() {
            std::mem::swap(&mut bounds, &mut rest);
        }
        let unit = 2.0 * RELATIVE_ERROR;
        Summary {
            rest,
            rounding: (unit, unit * (surface.reach() + surface.diagonal())),
            magnitude: surface.reach() + surface.diagonal(),
            jumps: surface.has_jumps(),
            sign_method: surface.sign_method(),
            surfaces: true,
            batched: true,
            primitives: surface.triangle_count() as u64,
            ..Summary::leaf(Facts::exact(bounds, 0.0))
        }
    }

    /// Of what the user says; of its rounding nothing is known: a thousand roundings of the coordinates are
    /// allowed.
    fn function(function: &dyn Function, options: &FunctionOptions) -> Summary {
        let lipschitz = match options.kind {
            _ if options.lipschitz > 0.0 => options.lipschitz,
            Kind::Exact => 1.0,
            _ => f64::INFINITY,
        };
        let spread = if options.kind == Kind::Exact { 1.0 } else { f64::INFINITY };
        Summary {
            kind: options.kind,
            lipschitz,
            spread,
            spread_rest: spread,
            spread_axis: spread,
            rounding: (1000.0 * f64::EPSILON, 0.0),
            functions: true,
            may_fail: true,
            batched: function.is_batched(),
            thread_safe: options.thread_safe,
            ..Summary::leaf(Facts::exact(options.bounds, 0.0))
        }
    }

    /// Of a union, or, turned, of an intersection; the empty one is nowhere, and exactly so.
    fn combined(parts: &Parts) -> Summary {
        let turned = parts.is_turned();
        let mut all = Summary {
            batched: parts.is_batched(),
            depth: 0,
            primitives: 0,
            rounding: (0.0, 0.0),
            magnitude: 0.0,
            ..Summary::leaf(Facts::exact(Aabb::EMPTY, 0.0))
        };
        let one = parts.list().len() == 1;
        for part in parts.list() {
            let s = part.summary().turned(turned);
            all.sign_method = match (all.surfaces, s.surfaces) {
                (true, true) if all.sign_method != s.sign_method => SignMethod::Auto,
                (_, true) => s.sign_method,
                _ => all.sign_method,
            };
            all.bounds = all.bounds.hull(s.bounds);
            // Not the canonical empty box where there is none: what has come near may meet when offset.
            all.rest = Aabb::new(all.rest.lo.max(s.rest.lo), all.rest.hi.min(s.rest.hi));
            all.kind = all.kind.max(s.kind);
            all.lipschitz = all.lipschitz.max(s.lipschitz);
            all.jumps |= s.jumps;
            all.spread = all.spread.max(s.spread);
            all.spread_rest = if one { s.spread_rest } else { all.spread_rest.max(s.spread_axis) };
            all.spread_axis = all.spread_axis.max(s.spread_axis);
            all.rounding = (all.rounding.0.max(s.rounding.0), all.rounding.1.max(s.rounding.1));
            all.magnitude = all.magnitude.max(s.magnitude);
            all.surfaces |= s.surfaces;
            all.functions |= s.functions;
            all.may_fail |= s.may_fail;
            all.batched |= s.batched;
            all.thread_safe &= s.thread_safe;
            all.primitives = all.primitives.saturating_add(s.primitives);
            all.depth = all.depth.max(s.depth);
            (all.reach_outward, all.reach_inward) = if one { (s.reach_outward, s.reach_inward) } else { (0.0, 0.0) };
        }
        if parts.list().len() > 1 {
            // Boxes that are all near along each axis are within the root of three.
            all.spread_rest *= ROOT_OF_THREE;
            if all.kind == Kind::Exact && !parts.are_disjoint() {
                all.kind = Kind::LowerBound;
            }
        }
        Summary { depth: all.depth + 1, ..all }.turned(turned)
    }

    fn deeper(self) -> Summary {
        Summary { depth: self.depth + 1, ..self }
    }

    /// Of the complement, if so asked.
    fn turned(self, turned: bool) -> Summary {
        if !turned {
            return self;
        }
        Summary {
            bounds: self.rest,
            rest: self.bounds,
            spread: self.spread_rest,
            spread_rest: self.spread,
            reach_outward: self.reach_inward,
            reach_inward: self.reach_outward,
            ..self
        }
    }

    fn translated(self, shift: Vec3) -> Summary {
        let moved = |b: Aabb| {
            let rounding = |corner: Vec3| (corner.abs() + shift.abs()) * ROUNDING;
            let finite = |moved: Vec3, by: Vec3| Vec3::select(by.cmplt(Vec3::INFINITY), moved + by, moved);
            let (lo, hi) = (b.lo + shift, b.hi + shift);
            Aabb::new(-finite(-lo, rounding(b.lo)), finite(hi, rounding(b.hi)))
        };
        let unit = 2.0 * f64::EPSILON * self.steepness();
        let far = length(shift);
        let rounding = (self.rounding.0 + unit, self.rounding.1 + (self.rounding.0 + unit) * far);
        let magnitude = self.magnitude + self.steepness() * far;
        Summary { bounds: moved(self.bounds), rest: moved(self.rest), rounding, magnitude, ..self }
    }

    fn placed(self, placement: &Placement) -> Summary {
        let scale = placement.scale();
        let unit = 32.0 * f64::EPSILON * self.steepness();
        let far = length(placement.shift());
        let own = scale * (self.rounding.1 + 2.0 * f64::EPSILON * self.magnitude);
        let rounding = (self.rounding.0 + unit, own + (self.rounding.0 + unit) * far);
        Summary {
            bounds: placement.box_to_space(self.bounds),
            rest: placement.box_to_space(self.rest),
            // A turned box is as far along its new axes as it was in all.
            spread_axis: self.spread_axis.max(self.spread).max(self.spread_rest),
            reach_outward: self.reach_outward * scale,
            reach_inward: self.reach_inward * scale,
            rounding,
            magnitude: scale * self.magnitude + self.steepness() * far,
            ..self
        }
    }

    /// By how much rounding of a point grows in the value; where that is unknown only the sign of the value
    /// is used.
    pub(super) fn steepness(&self) -> f64 {
        if self.lipschitz.is_finite() { self.lipschitz.max(1.0) } else { 1.0 }
    }

    /// The largest finite coordinate of the bounds.
    pub(super) fn extent(&self) -> f64 {
        extent(self.bounds)
    }

    /// Bound on how far a computed value can be from the true one, for coordinates up to `extent`.
    pub(super) fn error(&self, extent: f64) -> f64 {
        self.rounding.0 * (ROOT_OF_THREE * extent) + self.rounding.1
    }

    pub(super) fn of(node: &Node) -> Summary {
        match node {
            Node::Sphere(sphere) => Summary::leaf(sphere.facts()),
            Node::Shape(shape) => Summary { may_fail: shape.may_fail(), ..Summary::leaf(shape.facts()) },
            Node::Surface(surface) => Summary::surface(surface),
            Node::Function { function, options } => Summary::function(&**function, options),
            Node::Union(parts) | Node::Intersection(parts) => Summary::combined(parts),
            Node::Smooth(smooth) => {
                let own = smooth.summary(Summary::combined(smooth.parts()));
                let custom = matches!(smooth.blend(), Blend::Custom(_));
                let safe = match smooth.blend() {
                    Blend::Custom(c) => c.thread_safe,
                    _ => true,
                };
                Summary {
                    functions: own.functions || custom,
                    may_fail: own.may_fail || custom,
                    thread_safe: own.thread_safe && safe,
                    ..own
                }
            }
            Node::Repeat(repeat) => repeat.summary().deeper(),
            Node::Complement(g) => g.summary().turned(true).deeper(),
            Node::Translate(g, shift) => g.summary().translated(*shift).deeper(),
            Node::Place(g, placement) => g.summary().placed(placement).deeper(),
            Node::Map(g, map) => map.summary(*g.summary()).deeper(),
            Node::Level(g, level) => level.summary(*g.summary()).deeper(),
            Node::Stencil(g, stencil) => stencil.summary(*g.summary()).deeper(),
            Node::Part(g, _) => g.summary().deeper(),
        }
    }
}

/// Largest magnitude of a finite coordinate. (Towards infinity a value grows faster than its rounding.)
pub(super) fn extent(b: Aabb) -> f64 {
    let coordinates = b.lo.to_array().into_iter().chain(b.hi.to_array());
    coordinates.filter(|c| c.is_finite()).fold(0.0, |m, c| m.max(c.abs()))
}

/// The box with `reach` added on all sides, rounded outward; all of space where that is infinite, even of none:
/// what is nowhere may be close to zero everywhere.
pub(super) fn grown(b: Aabb, reach: Vec3) -> Aabb {
    if b == Aabb::EMPTY && reach.is_finite() {
        return b;
    }
    let rounding = |corner: Vec3| (corner.abs() + reach) * ROUNDING;
    let out = |corner: f64, by: f64| if by.is_finite() { corner + by } else { f64::INFINITY };
    let outward = |corner: Vec3| {
        let by = reach + rounding(corner);
        Vec3::new(out(corner.x, by.x), out(corner.y, by.y), out(corner.z, by.z))
    };
    Aabb::new(-outward(-b.lo), outward(b.hi))
}

impl Geometry {
    /// Kind, sign method, Lipschitz constant, primitives, bytes. O(nodes).
    pub fn properties(&self) -> Properties {
        let s = self.summary();
        Properties {
            kind: s.kind,
            sign_method: s.sign_method,
            lipschitz: self.lipschitz(),
            primitives: s.primitives,
            bytes: self.bytes(&mut HashSet::new()),
        }
    }

    /// A line for each mesh: how its sign is decided, and why. A shared mesh is told of once.
    pub fn sign_text(&self) -> String {
        let (mut seen, mut lines) = (HashSet::new(), Vec::new());
        self.sign_lines(&mut seen, &mut lines);
        lines.join("\n")
    }

    fn sign_lines(&self, seen: &mut HashSet<usize>, lines: &mut Vec<String>) {
        if !seen.insert(Arc::as_ptr(&self.inner) as usize) {
            return;
        }
        if let Node::Surface(surface) = self.node() {
            lines.push(surface.sign_text());
        }
        self.node().children().iter().for_each(|g| g.sign_lines(seen, lines));
    }

    /// Bytes of the nodes not seen before; shared parts are walked once.
    fn bytes(&self, seen: &mut HashSet<usize>) -> u64 {
        if !seen.insert(Arc::as_ptr(&self.inner) as usize) {
            return 0;
        }
        self.own_bytes() + self.node().children().iter().map(|g| g.bytes(seen)).sum::<u64>()
    }

    fn own_bytes(&self) -> u64 {
        let beside = match self.node() {
            Node::Shape(shape) => shape.bytes(),
            Node::Surface(surface) => surface.bytes(),
            Node::Union(parts) | Node::Intersection(parts) => parts.bytes(),
            Node::Smooth(smooth) => smooth.parts().bytes(),
            Node::Stencil(_, stencil) => stencil.bytes(),
            _ => 0,
        };
        (beside + size_of_val(&*self.inner)) as u64
    }
}
