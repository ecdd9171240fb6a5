// SPDX-License-Identifier: MIT OR Apache-2.0
//! Rays to be asked, and what they are aimed at.

use super::Soup;
use super::random::Random;
use embound::geometry::Geometry;
use embound::parallel::Run;
use embound::query::{self, RayHit, Rays};
use std::sync::Mutex;

/// Rays to be asked.
#[derive(Default)]
pub struct Asked {
    pub origin: Vec<f64>,
    pub direction: Vec<f64>,
    pub t_min: Vec<f64>,
    pub t_max: Vec<f64>,
}

impl Asked {
    pub fn push(&mut self, origin: [f64; 3], direction: [f64; 3]) {
        self.origin.extend(origin);
        self.direction.extend(direction);
    }

    pub fn of(origin: [f64; 3], direction: [f64; 3]) -> Asked {
        Asked { origin: origin.to_vec(), direction: direction.to_vec(), ..Asked::default() }
    }

    pub fn within(self, t_min: f64, t_max: f64) -> Asked {
        Asked { t_min: vec![t_min], t_max: vec![t_max], ..self }
    }

    pub fn count(&self) -> usize {
        self.origin.len() / 3
    }

    pub fn rays(&self) -> Rays<'_> {
        Rays::new(&self.origin, &self.direction, &self.t_min, &self.t_max).unwrap()
    }

    pub fn first(&self, g: &Geometry, run: &Run) -> Vec<RayHit> {
        let out = Mutex::new(vec![RayHit::NONE; self.count()]);
        query::first_hits(g, &self.rays(), run, &|start, hits| {
            out.lock().unwrap()[start..start + hits.len()].copy_from_slice(hits);
        })
        .unwrap();
        out.into_inner().unwrap()
    }

    pub fn all(&self, g: &Geometry, run: &Run) -> Vec<Vec<RayHit>> {
        let counts = Mutex::new(vec![0; self.count()]);
        query::count_hits(g, &self.rays(), run, &|start, found| {
            counts.lock().unwrap()[start..start + found.len()].copy_from_slice(found);
        })
        .unwrap();
        let mut offsets = vec![0];
        counts.into_inner().unwrap().iter().for_each(|n| offsets.push(offsets[offsets.len() - 1] + n));
        let out = Mutex::new(vec![RayHit::NONE; offsets[offsets.len() - 1]]);
        query::all_hits(g, &self.rays(), &offsets, run, &|start, hits| {
            out.lock().unwrap()[start..start + hits.len()].copy_from_slice(hits);
        })
        .unwrap();
        let all = out.into_inner().unwrap();
        offsets.windows(2).map(|w| all[w[0]..w[1]].to_vec()).collect()
    }
}

/// NaN compares as it should.
pub fn bits(hit: &RayHit) -> ([u64; 4], i64, [i32; 3]) {
    let n = hit.normal;
    ([hit.t, n.x, n.y, n.z].map(f64::to_bits), hit.primitive, [hit.tag, hit.part, hit.side])
}

/// A point outside a body's bounds, from which rays may begin.
pub fn outside(random: &mut Random, (lo, hi): ([f64; 3], [f64; 3])) -> [f64; 3] {
    let size = (0..3).map(|k| hi[k] - lo[k]).fold(0.0, f64::max);
    loop {
        let p = random.point(lo.map(|c| c - size), hi.map(|c| c + size));
        if (0..3).any(|k| p[k] < lo[k] || p[k] > hi[k]) {
            return p;
        }
    }
}

pub fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

/// Something of a body's that is easily missed or met twice: a corner, a point of an edge, the middle of one.
pub fn feature(random: &mut Random, soup: &Soup) -> [f64; 3] {
    let corners = soup.corners(random.below(soup.triangles.len()));
    let (a, b) = (corners[random.below(3)], corners[random.below(3)]);
    let along = [0.5, random.unit()][random.below(2)];
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * along)
}

/// A ray from outside that is aimed at a feature, sometimes along an axis, along an edge, or through two corners.
pub fn aimed(random: &mut Random, soup: &Soup, (lo, hi): ([f64; 3], [f64; 3])) -> ([f64; 3], [f64; 3]) {
    let size = (0..3).map(|k| hi[k] - lo[k]).fold(0.0, f64::max);
    let target = feature(random, soup);
    match random.below(4) {
        0 => {
            let origin = outside(random, (lo, hi));
            (origin, minus(target, origin))
        }
        1 => {
            let axis = random.below(3);
            let mut origin = target;
            origin[axis] = lo[axis] - size;
            (origin, [0, 1, 2].map(|k| if k == axis { 0.7 } else { 0.0 }))
        }
        2 => {
            let other = feature(random, soup);
            let direction = minus(other, target);
            // Far enough to be outside, on the line but for rounding.
            ([0, 1, 2].map(|k| target[k] - 64.0 * size * direction[k] / length(direction).max(1e-9 * size)), direction)
        }
        _ => {
            // A plane of the corner's, diagonally.
            let axis = random.below(3);
            let mut origin = target;
            let mut direction = [0.0; 3];
            for k in [axis, (axis + 1) % 3] {
                origin[k] -= 8.0 * size;
                direction[k] = 1.0;
            }
            (origin, direction)
        }
    }
}

pub fn length(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}
