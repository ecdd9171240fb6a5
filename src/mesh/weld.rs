// SPDX-License-Identifier: MIT OR Apache-2.0
//! Vertices with equal positions become one, and by choice those nearer than a tolerance.
//!
//! Equal positions meet in a hash table with a fixed hash. Near ones are found by the cells of a grid
//! whose side is about half the tolerance: all of one cell are near, and the rest are within two cells. Whether any
//! two of two cells are near is asked of trees where the cells hold many.

mod spots;

use super::faces::Sets;
use crate::error::{Error, Result, filled, try_with_capacity};
use crate::math::{Aabb, Vec3};
use spots::Spots;

/// Not used by any face.
pub(super) const UNUSED: u32 = u32::MAX;

/// The vertices that are left, ordered by the lowest input vertex of each, where they lie.
pub(super) struct Welded {
    pub vertices: Vec<Vec3>,
    /// The vertex that each input vertex became, or [`UNUSED`].
    pub of: Vec<u32>,
}

/// Every used vertex for itself, but those that are known to be one (`same_as` as in [`super::Input`]).
pub(super) fn keep_all(positions: &[Vec3], same_as: &[u32], used: &[bool]) -> Result<Welded> {
    let mut welded = Welded { vertices: Vec::new(), of: filled("vertices", positions.len(), UNUSED)? };
    welded.vertices.try_reserve_exact(positions.len()).map_err(|_| Error::memory("vertices", positions.len()))?;
    for i in (0..positions.len()).filter(|i| used[*i]) {
        let first = same_as.get(i).map_or(i, |&s| s as usize);
        if welded.of[first] == UNUSED {
            welded.of[first] = welded.vertices.len() as u32;
            welded.vertices.push(positions[first]);
        }
        welded.of[i] = welded.of[first];
    }
    Ok(welded)
}

/// Welds the used vertices with equal positions. `positions` hold no -0.0.
pub(super) fn weld_equal(positions: &[Vec3], used: &[bool]) -> Result<Welded> {
    let mut welded = Welded { vertices: Vec::new(), of: filled("vertices", positions.len(), UNUSED)? };
    let mut table = filled("hash slots", 1 << 10, UNUSED)?;
    for (i, &p) in positions.iter().enumerate().filter(|(i, _)| used[*i]) {
        let slot = find(&table, &welded.vertices, p);
        if table[slot] == UNUSED {
            table[slot] = welded.vertices.len() as u32;
            welded.vertices.try_reserve(1).map_err(|_| Error::memory("vertices", positions.len()))?;
            welded.vertices.push(p);
        }
        welded.of[i] = table[slot];
        // Growing with what is found, not with what is given, keeps the table small enough for a cache.
        if 2 * welded.vertices.len() > table.len() {
            table = filled("hash slots", 4 * table.len(), UNUSED)?;
            for (v, &q) in welded.vertices.iter().enumerate() {
                let slot = find(&table, &welded.vertices, q);
                table[slot] = v as u32;
            }
        }
    }
    Ok(welded)
}

/// The slot of the vertex at `p`, or the free one where it belongs. The size is a power of two.
fn find(table: &[u32], vertices: &[Vec3], p: Vec3) -> usize {
    let mask = table.len() - 1;
    let mut slot = hash(p) as usize & mask;
    while table[slot] != UNUSED && vertices[table[slot] as usize] != p {
        slot = (slot + 1) & mask;
    }
    slot
}

/// Multiplies each coordinate, then mixes as MurmurHash3 does. Coordinates read from f32 end in zeros, so
/// their upper halves are folded down first.
fn hash(p: Vec3) -> u64 {
    let fold = |x: f64| x.to_bits() ^ (x.to_bits() >> 32);
    let h = fold(p.x)
        .wrapping_mul(0x9e37_79b9_7f4a_7c15)
        .wrapping_add(fold(p.y).wrapping_mul(0xff51_afd7_ed55_8ccd))
        .wrapping_add(fold(p.z).wrapping_mul(0xc4ce_b9fe_1a85_ec53));
    let h = (h ^ (h >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    h ^ (h >> 32)
}

/// Welds those nearer than `distance`, and chains of them; the lowest of each keeps its place.
pub(super) fn weld_near(welded: &mut Welded, bounds: Aabb, distance: f64) -> Result<()> {
    let mut grid = Grid::new(&welded.vertices, bounds, distance)?;
    let mut sets = Sets::new(welded.vertices.len())?;
    for c in 0..grid.cells.len() {
        let members = grid.members(c);
        for &v in &members[1..] {
            sets.join(members[0], v);
        }
    }
    let spots = Spots::new(&welded.vertices, &mut grid, distance)?;
    for dx in 0..=2 {
        for dy in -2..=2 {
            if dx > 0 || dy >= 0 {
                grid.join_neighbours(dx, dy, &spots, &mut sets);
            }
        }
    }
    let mut new = filled("vertices", welded.vertices.len(), UNUSED)?;
    let mut left = 0;
    for v in 0..welded.vertices.len() {
        let representative = sets.find(v as u32) as usize;
        if representative == v {
            new[v] = left as u32;
            welded.vertices[left] = welded.vertices[v];
            left += 1;
        } else {
            new[v] = new[representative];
        }
    }
    welded.vertices.truncate(left);
    for v in welded.of.iter_mut().filter(|v| **v != UNUSED) {
        *v = new[*v as usize];
    }
    Ok(())
}

/// Occupied cells, sorted, with the vertices in each.
struct Grid {
    cells: Vec<[i64; 3]>,
    start: Vec<u32>,
    vertices: Vec<u32>,
}

impl Grid {
    fn new(positions: &[Vec3], bounds: Aabb, distance: f64) -> Result<Grid> {
        // The diagonal of a cell is 0.883 distances and two cells are 1.02: rounding cannot bring a
        // coordinate, at most 2e12 cells from the corner, out of these margins.
        let side = 0.51 * distance;
        let cell = |p: Vec3| {
            let q = ((p - bounds.lo) / side).floor();
            [q.x as i64, q.y as i64, q.z as i64]
        };
        let mut order = try_with_capacity("vertices", positions.len())?;
        order.extend((0..positions.len() as u32).map(|v| (cell(positions[v as usize]), v)));
        order.sort_unstable();
        let mut grid = Grid {
            cells: try_with_capacity("cells", order.len())?,
            start: try_with_capacity("cells", order.len() + 1)?,
            vertices: try_with_capacity("vertices", order.len())?,
        };
        for (cell, v) in order {
            if grid.cells.last() != Some(&cell) {
                grid.cells.push(cell);
                grid.start.push(grid.vertices.len() as u32);
            }
            grid.vertices.push(v);
        }
        grid.start.push(grid.vertices.len() as u32);
        Ok(grid)
    }

    fn members(&self, c: usize) -> &[u32] {
        &self.vertices[self.start[c] as usize..self.start[c + 1] as usize]
    }

    /// Joins each cell with those whose offset is (dx, dy, -2..=2). Cells are sorted, so the first
    /// neighbour moves forward with the cell.
    fn join_neighbours(&self, dx: i64, dy: i64, spots: &Spots, sets: &mut Sets) {
        let mut first = 0;
        for (c, &[x, y, z]) in self.cells.iter().enumerate() {
            while first < self.cells.len() && self.cells[first] < [x + dx, y + dy, z - 2] {
                first += 1;
            }
            for d in first..self.cells.len() {
                if self.cells[d] > [x + dx, y + dy, z + 2] {
                    break;
                }
                let (ours, theirs) = (self.members(c)[0], self.members(d)[0]);
                if sets.find(ours) != sets.find(theirs) && spots.are_near(self, c, d) {
                    sets.join(ours, theirs);
                }
            }
        }
    }
}
