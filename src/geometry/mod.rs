// SPDX-License-Identifier: MIT OR Apache-2.0
//! The implicit-function tree: shapes, transforms, CSG, mesh distance and user functions. Each node
//! knows its bounds, its Lipschitz constant and whether its value is exact.

mod blend;
mod block;
mod build;
mod classify;
mod closest;
pub(crate) mod contacts;
mod cut;
mod faces;
mod fingerprint;
mod kinds;
mod level;
mod linear;
mod map;
mod node;
mod pack;
mod parts;
mod placement;
mod points;
mod properties;
mod rays;
mod repeat;
mod scanned;
mod segment;
mod shape;
mod simplify;
mod smooth;
mod stencil;
mod summary;
mod surface;
mod trace;
mod twist;
mod value;

pub use blend::{Blend, BlendFunction, CustomBlend};
pub use closest::Closest;
pub(crate) use cut::Cut;
pub use properties::{
    Accelerator, Function, FunctionOptions, Kind, Open, Properties, RefitCheck, SdfOptions, SignMethod, UnpackCheck,
};
pub use rays::RayHit;
pub(crate) use rays::RayScratch;
pub(crate) use scanned::{Buffers, Scanned};
pub(crate) use segment::{Change, Event, NO_PART};
pub use shape::ExpressionOptions;
pub(crate) use surface::BandWork;

use crate::math::{Aabb, Vec3};
use crate::store::Block;
use node::Node;
use std::sync::Arc;
use summary::Summary;

/// An implicit function: negative inside the body, positive outside, zero on the surface and counted
/// as inside. Immutable; a clone is O(1) and shares everything.
#[derive(Clone)]
pub struct Geometry {
    inner: Arc<Inner>,
}

struct Inner {
    node: Node,
    summary: Summary,
    /// The block that it was unpacked from, where it was: held to the end of the geometry, whatever of it is a view.
    _block: Option<Arc<Block>>,
}

impl Geometry {
    fn node(&self) -> &Node {
        &self.inner.node
    }

    fn summary(&self) -> &Summary {
        &self.inner.summary
    }

    /// A box around the body: infinite where unbounded, [`Aabb::EMPTY`] where there is none.
    pub fn bounds(&self) -> Aabb {
        let b = self.summary().bounds;
        if b.is_empty() { Aabb::EMPTY } else { b }
    }

    /// What the magnitude of a value means. O(1), unlike [`Geometry::properties`].
    pub fn kind(&self) -> Kind {
        self.summary().kind
    }

    /// |f(p) - f(q)| <= lipschitz |p - q|; infinite where unknown. O(1).
    pub fn lipschitz(&self) -> f64 {
        let s = self.summary();
        if s.jumps { f64::INFINITY } else { s.lipschitz }
    }

    /// Whether several threads may ask at once: false where a user's function forbids it.
    pub fn is_thread_safe(&self) -> bool {
        self.summary().thread_safe
    }

    /// Whether a leaf may fail, so that NaN at a finite point means that it did.
    pub fn may_fail(&self) -> bool {
        self.summary().may_fail
    }

    /// Whether a function of the user's takes part.
    pub fn has_functions(&self) -> bool {
        self.summary().functions
    }
    /// Leaves of a mesh's hierarchy that the search for the triangle nearest to a point looks at, and leaves in all, for
    /// benchmarks; None where there is no such search.
    #[doc(hidden)]
    pub fn leaves_visited(&self, p: Vec3) -> Option<(usize, usize)> {
        match self.node() {
            Node::Surface(surface) if p.is_finite() => surface.leaves_visited(p),
            _ => None,
        }
    }

    /// Whether points that are near each other are best asked one after another: where there is more than a
    /// processor's second cache has room for. The user's functions are asked in the user's order.
    pub(crate) fn gains_by_order(&self) -> bool {
        let s = self.summary();
        s.batched && s.primitives > 4096 && !s.functions
    }
}
