// SPDX-License-Identifier: MIT OR Apache-2.0
//! Triangles over boundary loops, without vertices of their own.

use super::diagnosis::Lists;
use super::repair::EdgeSet;
use super::{Triangle, ears};
use crate::error::{Error, Result, filled, try_with_capacity};
use crate::math::Vec3;
use crate::primitive::least_area::{Stretch, least_area};
use crate::primitive::polygon;

/// The least area, which takes the cube of the edges and the square in memory, is looked for over loops of up to so many.
const MOST_EDGES: usize = 1000;

/// What serves one loop after another.
pub(crate) struct Caps {
    /// Edges between vertices of loops: a diagonal that repeats one would give it more than two faces.
    taken: EdgeSet,
    points: Vec<Vec3>,
    table: Vec<Stretch>,
}

impl Caps {
    pub fn new(vertices: usize, triangles: &[Triangle], loops: &Lists) -> Result<Caps> {
        let mut on_loop = filled("vertices", vertices, false)?;
        loops.iter().flatten().for_each(|&v| on_loop[v as usize] = true);
        let mut taken = EdgeSet::new()?;
        for t in triangles {
            let [a, b, c] = t.vertices;
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if on_loop[from as usize] && on_loop[to as usize] {
                    taken.insert(from, to)?;
                }
            }
        }
        Ok(Caps { taken, points: Vec::new(), table: Vec::new() })
    }

    /// Adds the triangles over a loop, which run along it the way it runs: those of the least area, and, over loops of more
    /// than [`MOST_EDGES`], the ears of the loop as seen along its area vector. False, with nothing added, where such a
    /// loop crosses itself so that no ears are left.
    pub fn cap(&mut self, vertices: &[Vec3], ring: &[u32], out: &mut Vec<[u32; 3]>) -> Result<bool> {
        let n = ring.len();
        self.points.clear();
        self.points.try_reserve(n).map_err(|_| Error::memory("points", n))?;
        self.points.extend(ring.iter().map(|&v| vertices[v as usize]));
        let mut triangles = filled("triangles", n.saturating_sub(2), [0; 3])?;
        if n > MOST_EDGES {
            if !clip_ears(&self.points, &mut triangles)? {
                return Ok(false);
            }
        } else {
            if self.table.len() < n * n {
                self.table = filled("stretches", n * n, Stretch::default())?;
            }
            let table = &mut self.table[..n * n];
            let forbidden = |i: usize, k: usize| self.taken.contains(ring[i], ring[k]);
            // Where no other triangles are left, edges of four faces are no harm to crossings.
            if !least_area(&self.points, forbidden, table, &mut triangles)
                && !least_area(&self.points, |_, _| false, table, &mut triangles)
            {
                return Ok(false);
            }
        }
        add(ring, &triangles, out)?;
        for [a, b, c] in triangles.into_iter().map(|t| t.map(|k| ring[k as usize])) {
            [(a, b), (b, c), (c, a)].into_iter().try_for_each(|(from, to)| self.taken.insert(from, to))?;
        }
        Ok(true)
    }
}

/// Adds the triangles over a loop in a plane: its ears where it does not cross itself, else a fan, some of whose triangles
/// lie on others.
pub(crate) fn cap_plane(vertices: &[Vec3], ring: &[u32], out: &mut Vec<[u32; 3]>) -> Result<()> {
    if ring.len() < 3 {
        return Ok(());
    }
    let mut points = try_with_capacity("points", ring.len())?;
    points.extend(ring.iter().map(|&v| vertices[v as usize]));
    let mut triangles = filled("triangles", ring.len() - 2, [0; 3])?;
    if !clip_ears(&points, &mut triangles)? {
        triangles.iter_mut().zip(1..).for_each(|(t, k)| *t = [0, k, k + 1]);
    }
    add(ring, &triangles, out)
}

fn clip_ears(points: &[Vec3], out: &mut [[u32; 3]]) -> Result<bool> {
    let normal = polygon::area_vector(points.iter().copied());
    if normal == Vec3::ZERO {
        return Ok(false);
    }
    let [u, v] = polygon::projection(normal);
    let mut plane = try_with_capacity("points", points.len())?;
    plane.extend(points.iter().map(|p| [p[u], p[v]]));
    ears::clip_ears(&plane, out)
}

fn add(ring: &[u32], triangles: &[[u32; 3]], out: &mut Vec<[u32; 3]>) -> Result<()> {
    out.try_reserve(triangles.len()).map_err(|_| Error::memory("triangles", out.len() + triangles.len()))?;
    out.extend(triangles.iter().map(|t| t.map(|k| ring[k as usize])));
    Ok(())
}
