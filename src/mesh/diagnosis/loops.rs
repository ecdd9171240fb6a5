// SPDX-License-Identifier: MIT OR Apache-2.0
//! Boundary loops: the edges of one face, walked from vertex to vertex along the fans of faces at them. A walk
//! that comes back to a vertex it has passed has closed a loop, which is taken out of it, so that loops are
//! simple and every edge is in one (Hierholzer 1873, without joining).

use super::{Diagnosis, Lists, Subject, push};
use crate::error::{Result, filled, try_with_capacity};
use crate::math::{Aabb, Vec3, length};
use crate::mesh::HalfEdges;
use crate::mesh::edges::NONE;
use crate::mesh::faces::starts_from_counts;
use crate::mesh::measure::Sum;

/// A chain of boundary edges that passes no vertex twice. It runs the way the faces at it ran when read, where
/// these agree: as seen from outside, clockwise round a hole. It begins with its lowest vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundaryLoop {
    /// Its edges: as many as vertices, or, where it is not closed, one fewer.
    pub edges: usize,
    /// Whether it comes back to where it begins. Chains end where an odd number of faces meets in an edge.
    pub closed: bool,
    /// The component that the face at its first edge belongs to: all its faces, unless edges of more than two
    /// faces end on it.
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
                component: self.component_of_face[subject.input_face(found.first[k]) as usize],
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
    /// The half-edge between the first two vertices of each.
    first: Vec<u32>,
}

/// The boundary edges, by the vertices they join.
struct Borders {
    half_edge: Vec<u32>,
    ends: Vec<[u32; 2]>,
    /// For each end the edge at the other end of the fan of faces there; [`NONE`] where an edge of more than two
    /// faces is.
    across: Vec<[u32; 2]>,
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
            across: across_fans(subject, &half_edge)?,
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
        for v in 0..self.place.len() {
            // One that has been the end of a chain since has an even number left.
            let unused = |at: &ByVertex| at.of(v).iter().filter(|e| !self.used[**e as usize]).count();
            if (unused(&self.leaving) + unused(&self.entering)) % 2 == 1 {
                self.walk(v as u32, false)?;
            }
        }
        for e in 0..self.ends.len() {
            if !self.used[e] {
                self.walk(self.ends[e][0], true)?;
            }
        }
        Ok(())
    }

    /// Walks from a vertex until no edge leads on, or, where it `returns`, until it has come back.
    fn walk(&mut self, from: u32, returns: bool) -> Result<()> {
        self.step(from, NONE);
        let mut last = NONE;
        while let Some(edge) = self.next_edge(last) {
            let [a, b] = self.ends[edge as usize];
            let to = if self.path.last() == Some(&a) { b } else { a };
            self.used[edge as usize] = true;
            last = edge;
            match self.place[to as usize] {
                NONE => self.step(to, edge),
                place => {
                    self.take(place as usize, Some(edge))?;
                    self.path.truncate(place as usize + 1);
                    self.over.truncate(place as usize + 1);
                    if returns && place == 0 {
                        break;
                    }
                }
            }
        }
        if self.path.len() > 1 {
            self.take(0, None)?;
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

    /// The unused edge to take from the end of the walk: across the fan of faces from the last one, else the
    /// lowest that leaves, else the lowest that enters.
    fn next_edge(&mut self, last: u32) -> Option<u32> {
        let v = self.path.last().copied()?;
        if let (Some(across), Some(ends)) = (self.across.get(last as usize), self.ends.get(last as usize)) {
            let across = across[usize::from(ends[1] == v)];
            if self.used.get(across as usize) == Some(&false) {
                return Some(across);
            }
        }
        self.leaving.next(v, &self.used).or_else(|| self.entering.next(v, &self.used))
    }

    /// Hands over the walk from `place` on, `closing` being the edge that leads back there, and forgets that its
    /// vertices, but the first, are on it.
    fn take(&mut self, place: usize, closing: Option<u32>) -> Result<()> {
        let chain = &self.path[place..];
        let n = chain.len();
        let lowest = if closing.is_some() { (0..n).min_by_key(|&k| chain[k]).unwrap_or(0) } else { 0 };
        let reversed = closing.is_none() && chain.last() < chain.first();
        let at = |k: usize| if reversed { chain[n - 1 - k] } else { chain[(lowest + k) % n] };
        let over = if reversed { n - 1 } else { lowest + 1 };
        let first = self.over.get(place + over).copied().or(closing).unwrap_or(NONE);
        self.found.vertices.push((0..n).map(at))?;
        push(&mut self.found.closed, "loops", closing.is_some())?;
        push(&mut self.found.first, "loops", self.half_edge[first as usize])?;
        for &v in &chain[1..] {
            self.place[v as usize] = NONE;
        }
        Ok(())
    }
}

/// For each end of each boundary half-edge, as the faces ran when read, the boundary edge at the other end of the
/// fan of faces there.
fn across_fans(subject: &Subject, half_edges: &[u32]) -> Result<Vec<[u32; 2]>> {
    let topology = &subject.mesh.half_edges;
    let mates = subject.edges.mates()?;
    let mut across = try_with_capacity("boundary edges", half_edges.len())?;
    for &h in half_edges {
        let far = |over_leaving: bool, corner: u32| {
            let end = fan_end(topology, &mates, corner, over_leaving);
            half_edges.binary_search(&end).map_or(NONE, |k| k as u32)
        };
        // Away from the edge: at its origin over what enters there, at its target over what leaves.
        let ends = [far(false, h), far(true, topology.next(h))];
        let turned = subject.turned[subject.of_half_edge[h as usize] as usize];
        across.push(if turned { [ends[1], ends[0]] } else { ends });
    }
    Ok(across)
}

/// The half-edge at which the fan of a corner ends.
fn fan_end(topology: &HalfEdges, mates: &[u32], mut corner: u32, mut over_leaving: bool) -> u32 {
    let vertex = topology.origin(corner);
    loop {
        let crossed = if over_leaving { corner } else { topology.previous(corner) };
        let mate = mates[crossed as usize];
        if mate == NONE {
            return crossed;
        }
        let leaves = topology.origin(mate) == vertex;
        corner = if leaves { mate } else { topology.next(mate) };
        over_leaving = !leaves;
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
