// SPDX-License-Identifier: MIT OR Apache-2.0
//! Holes filled by triangles over their rims (Liepa 2003, "Filling holes in meshes", without refinement).

use super::edge_set::EdgeSet;
use super::rims::{Rims, Step};
use super::work::{Work, fits};
use super::{RepairOptions, Repairs, push};
use crate::error::{Error, Result, filled, try_with_capacity};
use crate::math::{Aabb, Vec3};
use crate::mesh::Mesh;
use crate::mesh::clean::Corner;
use crate::mesh::edges::Edges;
use crate::mesh::faces::Sets;
use crate::parallel::Run;
use crate::primitive::least_area::{Stretch, least_area};

/// Fills the holes that the options mean. Between 0.3 and 0.6 of the whole is told.
pub(super) fn fill(
    work: &mut Work,
    mesh: &Mesh,
    options: &RepairOptions,
    repairs: &mut Repairs,
    run: &Run,
) -> Result<()> {
    let edges = Edges::of(work.positions.len(), work.faces.half_edges())?;
    if edges.iter().all(|edge| edge.len() != 1) {
        return Ok(());
    }
    let of_half_edge = work.faces.of_half_edges()?;
    let rims = Rims::of(work, &edges, &of_half_edge)?;
    repairs.holes_left = rims.broken;
    let mut filler = Filler {
        diagonals: diagonals(work, &edges, &of_half_edge)?,
        taken: edges_between(work, &edges, &of_half_edge, &rims)?,
        rim: Vec::new(),
        points: Vec::new(),
        table: Vec::new(),
        triangles: Vec::new(),
    };
    let face_of = |step: &Step| of_half_edge[step.half_edge as usize];
    let count = rims.iter().count();
    for (k, rim) in rims.iter().enumerate() {
        if k.is_multiple_of(64) {
            run.tell(0.3 + 0.3 * k as f64 / count as f64)?;
        }
        let small = rim.len() <= options.hole_edges && {
            filler.rim.clear();
            for &step in rim {
                push(&mut filler.rim, "corners", corner(work, &of_half_edge, step))?;
            }
            let diagonal = filler.diagonals[face_of(&rim[0]) as usize];
            // Three edges are a missing triangle, unless they are those of a triangle alone.
            match rim {
                [a, b, c] => [b, c].iter().any(|s| face_of(s) != face_of(a)),
                _ => length(work, &filler.rim) <= options.hole_length * diagonal,
            }
        };
        if small && filler.cut(work, rim)? {
            let tag = match options.fill_tag {
                Some(tag) => tag,
                None => most_frequent_tag(rim.iter().map(|s| face_tag(work, mesh, face_of(s))))?,
            };
            filler.add(work, mesh, tag, repairs)?;
            repairs.holes_filled += 1;
        } else {
            repairs.holes_left += 1;
        }
    }
    work.changed |= repairs.faces_added > 0;
    Ok(())
}

/// The corner that a step leaves.
fn corner(work: &Work, of_half_edge: &[u32], step: Step) -> Corner {
    let h = step.half_edge;
    work.corner(if step.along { h } else { work.next(of_half_edge[h as usize] as usize, h) })
}

fn length(work: &Work, rim: &[Corner]) -> f64 {
    let next = rim.iter().skip(1).chain(&rim[..1]);
    rim.iter().zip(next).map(|(a, b)| work.length(a.0, b.0)).sum()
}

fn face_tag(work: &Work, mesh: &Mesh, f: u32) -> i32 {
    mesh.tag(work.faces.input[f as usize])
}

fn most_frequent_tag(tags: impl ExactSizeIterator<Item = i32>) -> Result<i32> {
    let mut all = try_with_capacity("tags", tags.len())?;
    all.extend(tags);
    all.sort_unstable();
    let most = all.chunk_by(|a, b| a == b).min_by_key(|same| std::cmp::Reverse(same.len()));
    Ok(most.map_or(0, |same| same[0]))
}

/// For each face the diagonal of the box around the faces that edges connect with it; only those with a rim are told.
fn diagonals(work: &Work, edges: &Edges, of_half_edge: &[u32]) -> Result<Vec<f64>> {
    let mut components = Sets::new(work.faces.len())?;
    for edge in edges.iter() {
        edge[1..].iter().for_each(|&h| components.join(of_half_edge[edge[0] as usize], of_half_edge[h as usize]));
    }
    let mut number = filled("faces", work.faces.len(), u32::MAX)?;
    let mut bounds = Vec::new();
    for f in 0..work.faces.len() {
        let first = components.find(f as u32) as usize;
        if first == f {
            number[f] = bounds.len() as u32;
            push(&mut bounds, "components", Aabb::EMPTY)?;
        }
        number[f] = number[first];
        let b = &mut bounds[number[f] as usize];
        *b = b.hull(Aabb::of(work.faces.face(f).iter().map(|&v| work.positions[v as usize])));
    }
    let mut diagonals = try_with_capacity("faces", number.len())?;
    diagonals.extend(number.iter().map(|&c| bounds[c as usize].diagonal()));
    Ok(diagonals)
}

/// The edges whose ends are both on rims.
fn edges_between(work: &Work, edges: &Edges, of_half_edge: &[u32], rims: &Rims) -> Result<EdgeSet> {
    let mut on_rim = filled("vertices", work.positions.len(), false)?;
    for &step in rims.iter().flatten() {
        on_rim[corner(work, of_half_edge, step).0 as usize] = true;
    }
    let mut between = EdgeSet::new()?;
    for edge in edges.iter() {
        let h = edge[0];
        let ends = [h, work.next(of_half_edge[h as usize] as usize, h)].map(|c| work.corner(c).0);
        if ends.iter().all(|&v| on_rim[v as usize]) {
            between.insert(ends[0], ends[1])?;
        }
    }
    Ok(between)
}

/// What serves one hole after another.
struct Filler {
    diagonals: Vec<f64>,
    /// Edges that no diagonal may repeat.
    taken: EdgeSet,
    rim: Vec<Corner>,
    points: Vec<Vec3>,
    table: Vec<Stretch>,
    triangles: Vec<[u32; 3]>,
}

impl Filler {
    /// Finds the triangles for the rim, running against the faces at it; false where there are none.
    fn cut(&mut self, work: &Work, steps: &[Step]) -> Result<bool> {
        let n = self.rim.len();
        if n < 3 {
            return Ok(false);
        }
        let along = steps.iter().filter(|step| step.along).count();
        if 2 * along >= n {
            self.rim.reverse();
        }
        self.points.clear();
        self.points.try_reserve(n).map_err(|_| Error::memory("points", n))?;
        self.points.extend(self.rim.iter().map(|c| work.positions[c.0 as usize]));
        if self.table.len() < n * n {
            self.table = filled("stretches", n * n, Stretch::default())?;
        }
        self.triangles = filled("triangles", n - 2, [0; 3])?;
        let forbidden = |i: usize, k: usize| self.taken.contains(self.rim[i].0, self.rim[k].0);
        Ok(least_area(&self.points, forbidden, &mut self.table[..n * n], &mut self.triangles))
    }

    /// Adds them as faces.
    fn add(&mut self, work: &mut Work, mesh: &Mesh, tag: i32, repairs: &mut Repairs) -> Result<()> {
        let more = self.triangles.len();
        fits("corners", work.faces.corners.len() + 3 * more)?;
        fits("faces", mesh.face_count + work.new_tags.len() + more)?;
        work.faces.reserve(more, 3 * more)?;
        work.new_tags.try_reserve(more).map_err(|_| Error::memory("tags", more))?;
        for t in &self.triangles {
            let ring = t.map(|k| self.rim[k as usize]);
            let number = (mesh.face_count + work.new_tags.len()) as u32;
            work.faces.push(&ring.map(|c| c.0), number);
            if !work.rows.is_empty() {
                work.rows.try_reserve(3).map_err(|_| Error::memory("corners", 3))?;
                work.rows.extend(ring.map(|c| c.1));
            }
            work.new_tags.push(tag);
            for (a, b) in [(ring[0], ring[1]), (ring[1], ring[2]), (ring[2], ring[0])] {
                self.taken.insert(a.0, b.0)?;
            }
        }
        repairs.faces_added += more;
        Ok(())
    }
}
