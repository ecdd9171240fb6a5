// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which closed shells lie inside which: parity of crossings along z, with exact predicates (Shewchuk
//! 1997) and a half-open rule for edges, which amounts to moving the point by an infinitesimal.

use crate::error::{Result, filled, try_with_capacity};
use crate::math::{Aabb, Vec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Triangles by shell.
pub(super) struct Grouped {
    pub start: Vec<u32>,
    pub triangles: Vec<[u32; 3]>,
}

impl Grouped {
    fn of(&self, shell: u32) -> &[[u32; 3]] {
        &self.triangles[self.start[shell as usize] as usize..self.start[shell as usize + 1] as usize]
    }
}

/// Points of a shell to try one after another until one is not on the surface of the other shell.
const WITNESSES: usize = 64;

/// For each shell the shells of `closed` around it, ascending. A shell lies in another where its box and a
/// point of it do.
pub(super) fn shells_around(
    vertices: &[Vec3],
    grouped: &Grouped,
    bounds: &[Aabb],
    closed: &[u32],
) -> Result<Vec<Vec<u32>>> {
    let mut around = filled("shells", bounds.len(), Vec::new())?;
    for (outer, inner) in boxes_within(bounds, closed)? {
        for shell in inside(vertices, grouped, outer, inner)? {
            around[shell as usize].push(outer);
        }
    }
    for list in &mut around {
        list.sort_unstable();
    }
    Ok(around)
}

/// For each shell whose box holds the boxes of others: those others.
fn boxes_within(bounds: &[Aabb], closed: &[u32]) -> Result<Vec<(u32, Vec<u32>)>> {
    let of = |s: u32| bounds[s as usize];
    let mut order = try_with_capacity("shells", closed.len())?;
    order.extend_from_slice(closed);
    order.sort_unstable_by(|&s, &t| of(s).lo.x.total_cmp(&of(t).lo.x).then(s.cmp(&t)));
    let mut within = filled("shells", bounds.len(), Vec::new())?;
    let mut open: Vec<u32> = Vec::new();
    let mut begin = 0;
    for k in 0..order.len() {
        // Equal lower ends may hold each other, so all of them open before any is looked up.
        if begin == k {
            let same = order[k..].iter().take_while(|&&s| of(s).lo.x == of(order[k]).lo.x).count();
            open.retain(|&s| of(s).hi.x >= of(order[k]).lo.x);
            open.extend_from_slice(&order[k..k + same]);
            begin = k + same;
        }
        let s = order[k];
        for &t in open.iter().filter(|&&t| t != s && of(t).contains(of(s).lo) && of(t).contains(of(s).hi)) {
            within[t as usize].push(s);
        }
    }
    Ok(within.into_iter().enumerate().map(|(t, inner)| (t as u32, inner)).filter(|(_, i)| !i.is_empty()).collect())
}

/// A point of an inner shell that is being looked up in an outer one.
struct Witness {
    point: Vec3,
    shell: u32,
    crossings: u32,
    touches: bool,
}

/// Which of the candidates lie inside `outer`.
fn inside(vertices: &[Vec3], grouped: &Grouped, outer: u32, candidates: Vec<u32>) -> Result<Vec<u32>> {
    let mut found = Vec::new();
    let mut left = candidates;
    for attempt in 0..WITNESSES {
        let mut witnesses = try_with_capacity("shells", left.len())?;
        witnesses.extend(left.drain(..).map(|shell| Witness {
            point: witness(vertices, grouped.of(shell), attempt),
            shell,
            crossings: 0,
            touches: false,
        }));
        witnesses.sort_unstable_by(|p, q| p.point.x.total_cmp(&q.point.x).then(p.shell.cmp(&q.shell)));
        for t in grouped.of(outer) {
            cross(t.map(|v| vertices[v as usize]), &mut witnesses);
        }
        for w in witnesses {
            if w.touches {
                left.push(w.shell);
            } else if w.crossings % 2 == 1 {
                found.push(w.shell);
            }
        }
        if left.is_empty() {
            break;
        }
    }
    Ok(found)
}

/// Corners first, then the middles of triangles, spread over the shell.
fn witness(vertices: &[Vec3], triangles: &[[u32; 3]], attempt: usize) -> Vec3 {
    let half = WITNESSES / 2;
    // The same point of a triangle whichever way it is turned.
    let mut triangle = triangles[attempt % half * triangles.len() / half];
    triangle.sort_unstable();
    let corners = triangle.map(|v| vertices[v as usize]);
    if attempt < half { corners[attempt % 3] } else { (corners[0] + corners[1] + corners[2]) / 3.0 }
}

/// Counts the triangle for the witnesses, which are sorted by x, below it.
fn cross(corners: [Vec3; 3], witnesses: &mut [Witness]) {
    let bounds = Aabb::of(corners);
    let first = witnesses.partition_point(|w| w.point.x < bounds.lo.x);
    for w in &mut witnesses[first..] {
        let p = w.point;
        if p.x > bounds.hi.x {
            break;
        }
        if p.y < bounds.lo.y || p.y > bounds.hi.y || p.z > bounds.hi.z {
            continue;
        }
        w.touches |= bounds.contains(p) && height(corners, p) == 0.0;
        w.crossings += u32::from(is_above(corners, p));
    }
}

/// Positive where `p` is below the plane of a triangle that is counter-clockwise seen from above.
fn height([a, b, c]: [Vec3; 3], p: Vec3) -> f64 {
    let [a, b, c, p] = [a, b, c, p].map(|q| Coord3D { x: q.x, y: q.y, z: q.z });
    orient3d(a, b, c, p)
}

fn turn(a: Vec3, b: Vec3, c: Vec3) -> f64 {
    let [a, b, c] = [a, b, c].map(|q| Coord { x: q.x, y: q.y });
    orient2d(a, b, c)
}

/// Whether the triangle is above `p`. Each edge is on one side of `p` for both of its triangles.
fn is_above(corners: [Vec3; 3], p: Vec3) -> bool {
    let [a, b, c] = corners;
    let is_right = |u: Vec3, v: Vec3| {
        let (low, high) = if u.y <= p.y { (u, v) } else { (v, u) };
        (u.y <= p.y) != (v.y <= p.y) && turn(low, high, p) > 0.0
    };
    (is_right(a, b) ^ is_right(b, c) ^ is_right(c, a)) && height(corners, p) * turn(a, b, c).signum() > 0.0
}
