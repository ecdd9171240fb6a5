// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a node knows of itself without being asked for a value.

use super::Geometry;
use super::node::Node;
use super::properties::{FunctionOptions, Kind, Properties, SignMethod};
use super::surface::Surface;
use crate::math::{Aabb, Vec3};
use std::collections::HashSet;
use std::sync::Arc;

/// Bounds are widened by this much of what was added, twice over what rounding can do: a point whose value
/// comes out as zero lies within.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

#[derive(Clone, Copy, Debug)]
pub(super) struct Summary {
    /// Around the body.
    pub(super) bounds: Aabb,
    /// Around the rest of space (and the surface).
    pub(super) rest: Aabb,
    pub(super) kind: Kind,
    pub(super) lipschitz: f64,
    /// The one method of all meshes below; Auto where there is none or several.
    pub(super) sign_method: SignMethod,
    pub(super) surfaces: bool,
    pub(super) functions: bool,
    pub(super) thread_safe: bool,
    /// Triangles and shapes; a shared part as often as it is used.
    pub(super) primitives: u64,
    /// Levels of nodes below and including this one.
    pub(super) depth: usize,
}

impl Summary {
    fn shape(bounds: Aabb) -> Summary {
        Summary {
            bounds,
            rest: Aabb::ALL,
            kind: Kind::Exact,
            lipschitz: 1.0,
            sign_method: SignMethod::Auto,
            surfaces: false,
            functions: false,
            thread_safe: true,
            primitives: 1,
            depth: 1,
        }
    }

    fn surface(surface: &Surface) -> Summary {
        let (mut bounds, mut rest) = (surface.bounds(), Aabb::ALL);
        if surface.is_inverted() {
            std::mem::swap(&mut bounds, &mut rest);
        }
        Summary {
            bounds,
            rest,
            sign_method: surface.sign_method(),
            surfaces: true,
            primitives: surface.triangle_count() as u64,
            ..Summary::shape(bounds)
        }
    }

    fn function(options: &FunctionOptions) -> Summary {
        let lipschitz = match options.kind {
            _ if options.lipschitz > 0.0 => options.lipschitz,
            Kind::Exact => 1.0,
            _ => f64::INFINITY,
        };
        Summary {
            kind: options.kind,
            lipschitz,
            functions: true,
            thread_safe: options.thread_safe,
            ..Summary::shape(options.bounds)
        }
    }

    /// Of a union; the empty one is nowhere, and exactly so.
    fn union(parts: &[Geometry]) -> Summary {
        let mut all = Summary { depth: 0, primitives: 0, ..Summary::shape(Aabb::EMPTY) };
        for part in parts {
            let s = part.summary();
            all.sign_method = match (all.surfaces, s.surfaces) {
                (true, true) if all.sign_method != s.sign_method => SignMethod::Auto,
                (_, true) => s.sign_method,
                _ => all.sign_method,
            };
            all.bounds = all.bounds.hull(s.bounds);
            all.rest = all.rest.intersection(s.rest);
            all.kind = all.kind.max(s.kind);
            all.lipschitz = all.lipschitz.max(s.lipschitz);
            all.surfaces |= s.surfaces;
            all.functions |= s.functions;
            all.thread_safe &= s.thread_safe;
            all.primitives = all.primitives.saturating_add(s.primitives);
            all.depth = all.depth.max(s.depth);
        }
        if parts.len() > 1 {
            all.kind = all.kind.max(Kind::LowerBound);
        }
        all.depth += 1;
        all
    }

    fn deeper(self) -> Summary {
        Summary { depth: self.depth + 1, ..self }
    }

    fn complement(self) -> Summary {
        Summary { bounds: self.rest, rest: self.bounds, ..self }
    }

    fn moved(self, by: impl Fn(Aabb) -> Aabb) -> Summary {
        Summary { bounds: by(self.bounds), rest: by(self.rest), ..self }
    }

    pub(super) fn of(node: &Node) -> Summary {
        match node {
            Node::Sphere { center, radius } => Summary::shape(grown(Aabb::new(*center, *center), Vec3::splat(*radius))),
            Node::Cuboid(b) => Summary::shape(*b),
            Node::Surface(surface) => Summary::surface(surface),
            Node::Function { options, .. } => Summary::function(options),
            Node::Union(parts) => Summary::union(parts),
            Node::Intersection(parts) => {
                let turned = Summary::union(parts);
                let bounds = parts.iter().fold(Aabb::ALL, |b, p| b.intersection(p.summary().bounds));
                let rest = parts.iter().fold(Aabb::EMPTY, |b, p| b.hull(p.summary().rest));
                Summary { bounds, rest, ..turned }
            }
            Node::Complement(g) => g.summary().complement().deeper(),
            Node::Translate(g, shift) => {
                let by = |b: Aabb| {
                    let moved = Aabb::new(b.lo + *shift, b.hi + *shift);
                    let rounding = |corner: Vec3| (corner.abs() + shift.abs()) * ROUNDING;
                    Aabb::new(moved.lo - rounding(b.lo), moved.hi + rounding(b.hi))
                };
                g.summary().moved(|b| if b.is_empty() { b } else { by(b) }).deeper()
            }
            Node::Place(g, placement) => g.summary().moved(|b| placement.box_to_space(b)).deeper(),
            Node::Part(g, _) => g.summary().deeper(),
        }
    }
}

/// The box with `reach` added on all sides, rounded outward.
fn grown(b: Aabb, reach: Vec3) -> Aabb {
    let rounding = |corner: Vec3| (corner.abs() + reach) * ROUNDING;
    Aabb::new(b.lo - reach - rounding(b.lo), b.hi + reach + rounding(b.hi))
}

impl Geometry {
    /// Kind, sign method, Lipschitz constant, primitives, bytes. O(nodes).
    pub fn properties(&self) -> Properties {
        let s = self.summary();
        Properties {
            kind: s.kind,
            sign_method: s.sign_method,
            lipschitz: s.lipschitz,
            primitives: s.primitives,
            bytes: self.bytes(&mut HashSet::new()),
        }
    }

    /// Bytes of the nodes not seen before; shared parts are walked once.
    fn bytes(&self, seen: &mut HashSet<usize>) -> u64 {
        if !seen.insert(Arc::as_ptr(&self.inner) as usize) {
            return 0;
        }
        let below = match self.node() {
            Node::Sphere { .. } | Node::Cuboid(_) | Node::Function { .. } | Node::Surface(_) => 0,
            Node::Union(parts) | Node::Intersection(parts) => parts.iter().map(|g| g.bytes(seen)).sum(),
            Node::Complement(g) | Node::Translate(g, _) | Node::Place(g, _) | Node::Part(g, _) => g.bytes(seen),
        };
        self.own_bytes() + below
    }

    fn own_bytes(&self) -> u64 {
        let arrays = match self.node() {
            Node::Surface(surface) => surface.bytes(),
            Node::Union(parts) | Node::Intersection(parts) => size_of_val(&parts[..]),
            _ => 0,
        };
        (arrays + size_of_val(&*self.inner)) as u64
    }
}
