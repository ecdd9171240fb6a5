// SPDX-License-Identifier: MIT OR Apache-2.0
//! What a node knows of itself without being asked for a value.

use super::Geometry;
use super::node::Node;
use super::properties::{FunctionOptions, Kind, Properties, SignMethod};
use super::surface::Surface;
use crate::math::Aabb;
use std::collections::HashSet;
use std::sync::Arc;

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
            depth: 1,
        }
    }

    fn surface(surface: &Surface) -> Summary {
        let (mut bounds, mut rest) = (surface.bounds(), Aabb::ALL);
        if surface.is_inverted() {
            std::mem::swap(&mut bounds, &mut rest);
        }
        Summary { bounds, rest, sign_method: surface.sign_method(), surfaces: true, ..Summary::shape(bounds) }
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
        let mut all = Summary { depth: 0, ..Summary::shape(Aabb::EMPTY) };
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
            Node::Sphere { center, radius } => Summary::shape(Aabb::new(center - *radius, center + *radius)),
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
                g.summary().moved(|b| if b.is_empty() { b } else { Aabb::new(b.lo + *shift, b.hi + *shift) }).deeper()
            }
            Node::Place(g, placement) => g.summary().moved(|b| placement.box_to_space(b)).deeper(),
            Node::Part(g, _) => g.summary().deeper(),
        }
    }
}

impl Geometry {
    /// Kind, sign method, Lipschitz constant, primitives, bytes. O(nodes).
    pub fn properties(&self) -> Properties {
        let s = self.summary();
        let mut seen = HashSet::new();
        let (primitives, bytes) = self.count(&mut seen);
        Properties { kind: s.kind, sign_method: s.sign_method, lipschitz: s.lipschitz, primitives, bytes }
    }

    /// Primitives (a shared part as often as it is used) and bytes (shared parts once).
    fn count(&self, seen: &mut HashSet<usize>) -> (u64, u64) {
        let mut bytes = if seen.insert(Arc::as_ptr(&self.inner) as usize) { self.own_bytes() } else { 0 };
        let mut primitives = 0;
        match self.node() {
            Node::Sphere { .. } | Node::Cuboid(_) | Node::Function { .. } => primitives = 1,
            Node::Surface(surface) => primitives = surface.triangle_count() as u64,
            Node::Union(parts) | Node::Intersection(parts) => {
                for part in parts {
                    let (p, b) = part.count(seen);
                    primitives += p;
                    bytes += b;
                }
            }
            Node::Complement(g) | Node::Translate(g, _) | Node::Place(g, _) | Node::Part(g, _) => {
                let (p, b) = g.count(seen);
                primitives += p;
                bytes += b;
            }
        }
        (primitives, bytes)
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
