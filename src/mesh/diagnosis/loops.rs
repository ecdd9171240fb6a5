// SPDX-License-Identifier: MIT OR Apache-2.0
//! Boundary loops: the edges of one face, walked from vertex to vertex. A walk that comes back to a vertex it
//! has passed has closed a loop, which is taken out of it, so that loops are simple and every edge is in one
//! (Hierholzer 1873, without joining).

use super::{Diagnosis, Lists, Subject, push};
use crate::error::{Result, try_with_capacity};
use crate::math::{Aabb, Vec3, length};
use crate::mesh::edges::NONE;
use crate::mesh::faces::{filled, starts_from_counts};
use crate::mesh::measure::Sum;

/// A chain of boundary edges that passes no vertex twice. It runs the way the faces at it ran when read, where
/// these agree: as seen from outside, clockwise round a hole. It begins with its lowest vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundaryLoop {
    /// Its edges: as many as vertices, or, where it is not closed, one fewer.
    pub edges: usize,
    /// Whether it comes back to where it begins. Chains end where an odd number of faces meets in an edge.
    pub closed: bool,
    /// The component that its faces belong to.
    pub component: u32,
    /// Sum of the lengths of its edges.
    pub length: f64,
    /// Lower corner of the box around it.
    pub lo: [f64; 3],
    /// Upper corner.
    pub hi: [f64; 3],
}

impl BoundaryLoop {
    /// Length of the diagonal of the box around it.
    pub fn diagonal(&self) -> f64 {
        Aabb::new(Vec3::from_array(self.lo), Vec3::from_array(self.hi)).diagonal()
    }
}

impl Diagnosis {
    pub(super) fn list_loops(&mut self, subject: &Subject) -> Result<()> {
        let mut borders = Borders::new(subject)?;
        if borders.ends.is_empty() {
            return Ok(());
        }
        borders.walk_all()?;
        let Borders { found, .. } = &borders;
        let mut order: Vec<usize> = try_with_capacity("loops", found.vertices.len())?;
        order.extend(0..found.vertices.len());
        let vertices = |k: usize| found.vertices.get(k).unwrap_or_default();
        order.sort_unstable_by(|&a, &b| vertices(a).cmp(vertices(b)).then(a.cmp(&b)));
        for k in order {
            self.loop_vertices.push(vertices(k).iter().copied())?;
            let position = |v: &u32| subject.vertices[*v as usize];
            let closed = found.closed[k];
            let mut sum = Sum::default();
            for pair in vertices(k).windows(2) {
                sum.add(length(position(&pair[1]) - position(&pair[0])));
            }
            if let (true, [first, .., last]) = (closed, vertices(k)) {
                sum.add(length(position(first) - position(last)));
            }
            let bounds = Aabb::of(vertices(k).iter().map(position));
            let chain = BoundaryLoop {
                edges: vertices(k).len() - usize::from(!closed),
                closed,
                component: self.component_of_face[subject.input_face(found.half_edge[k]) as usize],
                length: sum.value(),
                lo: bounds.lo.to_array(),
                hi: bounds.hi.to_array(),
            };
            push(&mut self.loops, "loops", chain)?;
        }
        Ok(())
    }
}

/// Loops in the order in which they were found.
#[derive(Default)]
struct Found {
    vertices: Lists,
    closed: Vec<bool>,
    /// One of the half-edges of each.
    half_edge: Vec<u32>,
}

/// The boundary edges, by the vertices they join.
struct Borders {
    half_edge: Vec<u32>,
    ends: Vec<[u32; 2]>,
    used: Vec<bool>,
    leaving: ByVertex,
    entering: ByVertex,
    /// The walk: its vertices, the edge that led to each, and where on it a vertex is.
    path: Vec<u32>,
    over: Vec<u32>,
    place: Vec<u32>,
    found: Found,
}

impl Borders {
    fn new(subject: &Subject) -> Result<Borders> {
        let mut half_edge = Vec::new();
        for edge in subject.edges.iter() {
            if let &[h] = edge {
                push(&mut half_edge, "boundary edges", h)?;
            }
        }
        half_edge.sort_unstable();
        let mut ends = try_with_capacity("boundary edges", half_edge.len())?;
        ends.extend(half_edge.iter().map(|&h| subject.ends_as_read(h)));
        let vertices = if ends.is_empty() { 0 } else { subject.vertices.len() };
        Ok(Borders {
            leaving: ByVertex::new(vertices, &ends, 0)?,
            entering: ByVertex::new(vertices, &ends, 1)?,
            used: filled("boundary edges", ends.len(), false)?,
            path: try_with_capacity("vertices", ends.len() + 1)?,
            over: try_with_capacity("vertices", ends.len() + 1)?,
            place: filled("vertices", vertices, NONE)?,
            half_edge,
            ends,
            found: Found::default(),
        })
    }

    /// First the chains, which end where an odd number of edges meets; what is left then are loops.
    fn walk_all(&mut self) -> Result<()> {
        let count = |at: &ByVertex, v: usize| at.start[v + 1] - at.start[v];
        for v in 0..self.place.len() {
            // A vertex can be the end of one chain, the other ends of which was a vertex before it.
            let unused = |b: &Borders| {
                let all = |at: &ByVertex| at.of(v).iter().filter(|e| !b.used[**e as usize]).count();
                all(&b.leaving) + all(&b.entering)
            };
            if (count(&self.leaving, v) + count(&self.entering, v)) % 2 == 1 && unused(self) % 2 == 1 {
                self.walk(v as u32)?;
            }
        }
        for e in 0..self.ends.len() {
            if !self.used[e] {
                self.walk(self.ends[e][0])?;
            }
        }
        Ok(())
    }

    /// Walks from a vertex until no edge leads on.
    fn walk(&mut self, from: u32) -> Result<()> {
        self.step(from, NONE);
        while let Some((edge, to)) = self.path.last().copied().and_then(|v| self.next_edge(v)) {
            self.used[edge as usize] = true;
            match self.place[to as usize] {
                NONE => self.step(to, edge),
                place => {
                    self.take(place as usize, true, edge)?;
                    self.path.truncate(place as usize + 1);
                    self.over.truncate(place as usize + 1);
                }
            }
        }
        if self.path.len() > 1 {
            self.take(0, false, self.over[1])?;
        }
        for v in self.path.drain(..) {
            self.place[v as usize] = NONE;
        }
        self.over.clear();
        Ok(())
    }

    fn step(&mut self, to: u32, edge: u32) {
        self.place[to as usize] = self.path.len() as u32;
        self.path.push(to);
        self.over.push(edge);
    }

    /// The lowest unused edge that leaves a vertex, else the lowest that enters it, and where it leads.
    fn next_edge(&mut self, v: u32) -> Option<(u32, u32)> {
        let leaving = self.leaving.next(v, &self.used).map(|e| (e, self.ends[e as usize][1]));
        leaving.or_else(|| self.entering.next(v, &self.used).map(|e| (e, self.ends[e as usize][0])))
    }

    /// Hands over the walk from `place` on, and forgets that its vertices, but the first, are on it.
    fn take(&mut self, place: usize, closed: bool, edge: u32) -> Result<()> {
        let chain = &self.path[place..];
        let lowest = if closed { (0..chain.len()).min_by_key(|&k| chain[k]).unwrap_or(0) } else { 0 };
        let reversed = !closed && chain.last() < chain.first();
        let at = |k: usize| match reversed {
            true => chain[chain.len() - 1 - k],
            false => chain[(lowest + k) % chain.len()],
        };
        self.found.vertices.push((0..chain.len()).map(at))?;
        push(&mut self.found.closed, "loops", closed)?;
        push(&mut self.found.half_edge, "loops", self.half_edge[edge as usize])?;
        for &v in &chain[1..] {
            self.place[v as usize] = NONE;
        }
        Ok(())
    }
}

/// Edges by the vertex at one of their ends, ascending.
struct ByVertex {
    start: Vec<u32>,
    edges: Vec<u32>,
    /// Where the unused ones may begin.
    next: Vec<u32>,
}

impl ByVertex {
    fn new(vertices: usize, ends: &[[u32; 2]], end: usize) -> Result<ByVertex> {
        let mut start = filled("vertices", vertices + 1, 0u32)?;
        for e in ends {
            start[e[end] as usize] += 1;
        }
        starts_from_counts(&mut start);
        let mut next = filled("vertices", vertices + 1, 0u32)?;
        next.copy_from_slice(&start);
        let mut edges = filled("boundary edges", ends.len(), 0u32)?;
        for (k, e) in ends.iter().enumerate() {
            let slot = &mut next[e[end] as usize];
            edges[*slot as usize] = k as u32;
            *slot += 1;
        }
        next.copy_from_slice(&start);
        Ok(ByVertex { start, edges, next })
    }

    fn of(&self, v: usize) -> &[u32] {
        &self.edges[self.start[v] as usize..self.start[v + 1] as usize]
    }

    fn next(&mut self, v: u32, used: &[bool]) -> Option<u32> {
        let (next, end) = (&mut self.next[v as usize], self.start[v as usize + 1]);
        while *next < end && used[self.edges[*next as usize] as usize] {
            *next += 1;
        }
        (*next < end).then(|| self.edges[*next as usize])
    }
}
