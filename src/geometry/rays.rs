// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where rays meet the meshes of a tree: every face of each, whatever lies around it, since where a solid ends is what
//! [`Geometry::events`] says.

use super::Geometry;
use super::node::Node;
use super::placement::Placement;
use super::segment::NO_PART;
use super::surface::{Met, Surface};
use crate::bvh::Ahead;
use crate::error::{Error, Result};
use crate::math::{Aabb, Vec3, positive_zero};
use crate::primitive::ray::Ray;

/// Meshes of one tree, those met again through shared nodes counted again.
const MOST: usize = 1 << 20;

/// One meeting of a ray with a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// Where; NaN where nothing is met.
    pub t: f64,
    /// Unit normal of the face, outward; NaN where nothing is met.
    pub normal: Vec3,
    /// Input face; -1 where nothing is met.
    pub primitive: i64,
    /// Tag of the face; -1 where nothing is met.
    pub tag: i32,
    /// Innermost label; -1 where there is none.
    pub part: i32,
    /// -1: the ray comes in, +1: it goes out, 0: nothing is met.
    pub side: i32,
}

impl RayHit {
    /// Nothing.
    pub const NONE: RayHit = RayHit { t: f64::NAN, normal: Vec3::NAN, primitive: -1, tag: -1, part: NO_PART, side: 0 };
}

/// From the space of a tree to that of a part.
#[derive(Clone, Copy)]
pub(super) enum Step {
    Shift(Vec3),
    Place(Placement),
}

impl Step {
    pub(super) fn to_body(self, p: Vec3) -> Vec3 {
        match self {
            Step::Shift(shift) => p - shift,
            Step::Place(placement) => placement.to_body(p),
        }
    }

    pub(super) fn to_space(self, q: Vec3) -> Vec3 {
        match self {
            Step::Shift(shift) => q + shift,
            Step::Place(placement) => placement.to_space(q),
        }
    }

    fn placement(self) -> Placement {
        match self {
            Step::Shift(shift) => Placement::translation(shift),
            Step::Place(placement) => placement,
        }
    }

    /// A box with all that comes from a box.
    pub(super) fn box_to_body(self, b: Aabb) -> Aabb {
        self.placement().box_to_body(b)
    }

    pub(super) fn box_to_space(self, b: Aabb) -> Aabb {
        self.placement().box_to_space(b)
    }

    /// What distances of the part are multiplied by.
    pub(super) fn scale(self) -> f64 {
        self.placement().scale()
    }

    /// The largest coordinate that it moves by, as the part sees it.
    pub(super) fn offset(self) -> f64 {
        self.placement().shift().abs().max_element() / self.scale()
    }
}

/// A mesh of a tree.
pub(super) struct Target<'a> {
    pub(super) surface: &'a Surface,
    pub(super) steps: Vec<Step>,
    /// Whether inside and outside are exchanged.
    is_turned: bool,
    part: i32,
}

/// The meshes of a tree.
pub(crate) struct Targets<'a>(Vec<Target<'a>>);

/// What a search of rays needs again and again.
#[derive(Default)]
pub(crate) struct RayScratch {
    ahead: Ahead,
    found: Vec<Found>,
}

/// A meeting, in the order of which they are told.
#[derive(Clone, Copy)]
struct Found {
    t: f64,
    face: i64,
    target: usize,
    met: Met,
}

impl Found {
    fn order(&self, other: &Found) -> std::cmp::Ordering {
        let rest = |f: &Found| (f.face as u64, f.target, f.met.triangle);
        self.t.total_cmp(&other.t).then(rest(self).cmp(&rest(other)))
    }
}

impl Geometry {
    /// The meshes that rays meet.
    pub(crate) fn ray_targets(&self) -> Result<Targets<'_>> {
        let mut targets = Targets(Vec::new());
        targets.collect(self, &mut Vec::new(), false, NO_PART)?;
        Ok(targets)
    }
}

impl<'a> Targets<'a> {
    fn collect(&mut self, g: &'a Geometry, steps: &mut Vec<Step>, is_turned: bool, part: i32) -> Result<()> {
        match g.node() {
            Node::Surface(surface) => {
                if self.0.len() >= MOST {
                    return Err(Error::unsupported(format!("g: more than {MOST} meshes")));
                }
                self.0.try_reserve(1).map_err(|_| Error::memory("meshes", self.0.len() + 1))?;
                self.0.push(Target { surface, steps: steps.clone(), is_turned, part });
                Ok(())
            }
            Node::Union(parts) | Node::Intersection(parts) => {
                parts.list().iter().try_for_each(|g| self.collect(g, steps, is_turned, part))
            }
            Node::Complement(g) => self.collect(g, steps, !is_turned, part),
            Node::Translate(g, shift) => self.moved(g, Step::Shift(*shift), steps, is_turned, part),
            Node::Place(g, placement) => self.moved(g, Step::Place(*placement), steps, is_turned, part),
            // The innermost label wins.
            Node::Part(g, label) => self.collect(g, steps, is_turned, *label),
            node => Err(Error::unsupported(format!("g: only meshes have faces, and there is {} in it", node.kind()))),
        }
    }

    pub(super) fn list(&self) -> &[Target<'a>] {
        &self.0
    }

    fn moved(&mut self, g: &'a Geometry, step: Step, steps: &mut Vec<Step>, is_turned: bool, part: i32) -> Result<()> {
        steps.push(step);
        let done = self.collect(g, steps, is_turned, part);
        steps.pop();
        done
    }

    /// The first meeting of a ray: of equal ones that with the lowest face.
    pub(crate) fn first(&self, ray: &Ray, scratch: &mut RayScratch) -> Result<RayHit> {
        let mut best: Option<Found> = None;
        for (k, target) in self.0.iter().enumerate() {
            let own = target.ray(ray)?;
            let limit =
                |best: &Option<Found>| best.as_ref().map_or(own.to, |b| own.scaled(ray.scaled(b.t)).min(own.to));
            target.surface.along_ray(&own, limit(&best), &mut scratch.ahead, |met| {
                let found = target.found(k, ray, &own, met);
                if best.as_ref().is_none_or(|b| found.order(b).is_lt()) {
                    best = Some(found);
                }
                limit(&best)
            })?;
        }
        Ok(best.map_or(RayHit::NONE, |found| self.0[found.target].hit(&found)))
    }

    /// How many meetings there are.
    pub(crate) fn count(&self, ray: &Ray, scratch: &mut RayScratch) -> Result<usize> {
        let mut count = 0;
        for target in &self.0 {
            let own = target.ray(ray)?;
            target.surface.along_ray(&own, own.to, &mut scratch.ahead, |_| {
                count += 1;
                own.to
            })?;
        }
        Ok(count)
    }

    /// Every meeting, in order.
    pub(crate) fn all<'s>(
        &'s self,
        ray: &Ray,
        scratch: &'s mut RayScratch,
    ) -> Result<impl ExactSizeIterator<Item = RayHit> + 's> {
        let RayScratch { ahead, found } = scratch;
        found.clear();
        let mut is_full = false;
        for (k, target) in self.0.iter().enumerate() {
            let own = target.ray(ray)?;
            target.surface.along_ray(&own, own.to, ahead, |met| {
                is_full |= found.try_reserve(1).is_err();
                if !is_full {
                    found.push(target.found(k, ray, &own, met));
                }
                own.to
            })?;
        }
        if is_full {
            return Err(Error::memory("hits", found.len() + 1));
        }
        found.sort_unstable_by(Found::order);
        Ok(found.iter().map(|found| self.0[found.target].hit(found)))
    }
}

impl Target<'_> {
    /// The ray as the mesh sees it, its t counted in the other's scale.
    fn ray(&self, ray: &Ray) -> Result<Ray> {
        let (mut origin, mut direction) = (ray.origin, ray.direction);
        for step in &self.steps {
            origin = step.to_body(origin);
            if let Step::Place(placement) = step {
                direction = placement.direction_to_body(direction);
            }
        }
        Ray::new(origin, direction, [ray.from, ray.to]).ok_or_else(|| {
            Error::unsupported(format!("g: a part that is moved or scaled so far sees no ray from {}", ray.origin))
        })
    }

    fn found(&self, target: usize, ray: &Ray, own: &Ray, met: Met) -> Found {
        let t = positive_zero(ray.unscaled(own.unscaled(self.surface.place_on(own, met))));
        Found { t, face: self.surface.face(met.triangle), target, met }
    }

    fn hit(&self, found: &Found) -> RayHit {
        let triangle = found.met.triangle;
        let mut normal = self.surface.outward(triangle);
        for step in self.steps.iter().rev() {
            if let Step::Place(placement) = step {
                normal = placement.direction(normal);
            }
        }
        let leaves = found.met.leaves != self.is_turned;
        RayHit {
            t: found.t,
            // Adding zero turns -0.0 into +0.0.
            normal: if self.is_turned { -normal } else { normal } + Vec3::ZERO,
            primitive: found.face,
            tag: self.surface.tag(triangle),
            part: self.part,
            side: if leaves { 1 } else { -1 },
        }
    }
}
