// SPDX-License-Identifier: MIT OR Apache-2.0
//! Where rays meet the faces of meshes.

use super::{CHUNK, in_chunks};
use crate::error::{Error, Result};
use crate::geometry::{Geometry, RayHit, RayScratch};
use crate::math::Vec3;
use crate::parallel::Run;
use crate::primitive::ray::Ray;

/// Rays: the points `origin + t * direction` with `t_min <= t <= t_max`. A segment from a to b has the direction b - a
/// and t from 0 to 1.
#[derive(Clone, Copy)]
pub struct Rays<'a> {
    origin: &'a [f64],
    direction: &'a [f64],
    t_min: &'a [f64],
    t_max: &'a [f64],
}

impl<'a> Rays<'a> {
    /// Three coordinates a ray. Of `t_min` and of `t_max` there are none (0, infinity), one for all rays, or one a ray.
    /// Origins and directions are finite, directions not zero, and `t_min <= t_max`.
    pub fn new(origin: &'a [f64], direction: &'a [f64], t_min: &'a [f64], t_max: &'a [f64]) -> Result<Rays<'a>> {
        let count = origin.len() / 3;
        if origin.len() != direction.len() || !origin.len().is_multiple_of(3) {
            let (a, b) = (origin.len(), direction.len());
            return Err(Error::invalid(format!("origin, direction: {a} and {b} numbers are not three a ray")));
        }
        for (name, t) in [("t_min", t_min), ("t_max", t_max)] {
            if t.len() > 1 && t.len() != count {
                return Err(Error::invalid(format!("{name}: {} numbers for {count} rays", t.len())));
            }
        }
        let rays = Rays { origin, direction, t_min, t_max };
        (0..count).try_for_each(|i| rays.get(i).map(|_| ()))?;
        Ok(rays)
    }

    /// How many.
    pub fn count(&self) -> usize {
        self.origin.len() / 3
    }

    fn get(&self, i: usize) -> Result<Ray> {
        let of = |x: &[f64]| Vec3::from_slice(&x[3 * i..3 * i + 3]);
        let (origin, direction) = (of(self.origin), of(self.direction));
        let t = |t: &[f64], none: f64| t.get(i).or(t.first()).copied().unwrap_or(none);
        let (from, to) = (t(self.t_min, 0.0), t(self.t_max, f64::INFINITY));
        if from.is_nan() || to.is_nan() || from > to {
            return Err(Error::invalid(format!("t_min, t_max: ray {i} from {from} to {to} is no range")));
        }
        if !origin.is_finite() {
            let [x, y, z] = origin.to_array();
            return Err(Error::invalid(format!("origin: ray {i} from ({x}, {y}, {z}) is not finite")));
        }
        Ray::new(origin, direction, [from, to]).ok_or_else(|| {
            let [x, y, z] = direction.to_array();
            Error::invalid(format!("direction: ray {i} along ({x}, {y}, {z}) is not finite, or zero"))
        })
    }
}

/// The first meeting of each ray. `g` is made of meshes, moved, labelled, complemented and combined as sets; every face
/// of each of them counts. Of equal `t` the lowest face is told of.
pub fn first_hits(g: &Geometry, rays: &Rays, run: &Run, emit: &(dyn Fn(usize, &[RayHit]) + Sync)) -> Result<()> {
    let targets = g.ray_targets()?;
    in_chunks(run, rays.count(), &|first, count| {
        let mut scratch = RayScratch::default();
        let mut hits = [RayHit::NONE; CHUNK];
        for (k, hit) in hits[..count].iter_mut().enumerate() {
            *hit = targets.first(&rays.get(first + k)?, &mut scratch)?;
        }
        emit(first, &hits[..count]);
        Ok(())
    })
}

/// How many meetings each ray has.
pub fn count_hits(g: &Geometry, rays: &Rays, run: &Run, emit: &(dyn Fn(usize, &[usize]) + Sync)) -> Result<()> {
    let targets = g.ray_targets()?;
    in_chunks(run, rays.count(), &|first, count| {
        let mut scratch = RayScratch::default();
        let mut counts = [0; CHUNK];
        for (k, number) in counts[..count].iter_mut().enumerate() {
            *number = targets.count(&rays.get(first + k)?, &mut scratch)?;
        }
        emit(first, &counts[..count]);
        Ok(())
    })
}

/// Every meeting of each ray, sorted by `t`, then by face: those of ray i are told of as `offsets[i]..offsets[i + 1]`,
/// which is how many [`count_hits`] says.
pub fn all_hits(
    g: &Geometry,
    rays: &Rays,
    offsets: &[usize],
    run: &Run,
    emit: &(dyn Fn(usize, &[RayHit]) + Sync),
) -> Result<()> {
    if offsets.len() != rays.count() + 1 || offsets[0] != 0 {
        return Err(Error::invalid(format!("offsets: {} do not begin {} lists at 0", offsets.len(), rays.count())));
    }
    if let Some(i) = offsets.windows(2).position(|w| w[0] > w[1]) {
        return Err(Error::invalid(format!("offsets[{}]: {} after {} falls", i + 1, offsets[i + 1], offsets[i])));
    }
    let targets = g.ray_targets()?;
    in_chunks(run, rays.count(), &|first, count| {
        let mut scratch = RayScratch::default();
        let mut hits = Vec::new();
        for i in first..first + count {
            let found = targets.all(&rays.get(i)?, &mut scratch)?;
            let (has, room) = (found.len(), offsets[i + 1] - offsets[i]);
            if has != room {
                return Err(Error::invalid(format!(
                    "offsets[{}]: room for {room} hits of ray {i}, which has {has}",
                    i + 1
                )));
            }
            hits.try_reserve(has).map_err(|_| Error::memory("hits", hits.len() + has))?;
            hits.extend(found);
        }
        emit(offsets[first], &hits);
        Ok(())
    })
}
