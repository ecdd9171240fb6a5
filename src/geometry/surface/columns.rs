// SPDX-License-Identifier: MIT OR Apache-2.0
//! Signs over a block of a lattice. Where crossings of the vertical line decide, its triangles are found once for all
//! points of a column; the predicates are those of single points.

use super::tile::Block;
use super::{Nearest, Surface};
use crate::error::{Error, Result, filled};
use crate::math::{Aabb, Vec3};
use crate::primitive::crossing::AxisLine;

/// The columns of a block.
pub(super) struct Columns<'a> {
    surface: &'a Surface,
    width: usize,
    /// The lowest and the highest z.
    ends: [f64; 2],
    /// For each column where its triangles are, once it was asked about.
    found: Vec<Option<[u32; 2]>>,
    /// Triangles that the line of a column meets, with their turns.
    met: Vec<(u32, i32)>,
}

impl<'a> Columns<'a> {
    pub(super) fn new(surface: &'a Surface, block: &Block) -> Result<Columns<'a>> {
        let [x, y, z] = block.axes;
        let (first, last) = (z.first().copied().unwrap_or(0.0), z.last().copied().unwrap_or(0.0));
        let found = filled("columns", x.len() * y.len(), None)?;
        Ok(Columns { surface, width: x.len(), ends: [first.min(last), first.max(last)], found, met: Vec::new() })
    }

    /// [`Surface::signed`] of a point of the block.
    pub(super) fn signed(&mut self, [i, j, _]: [usize; 3], p: Vec3, nearest: &Nearest) -> Result<f64> {
        match self.surface.sign_by_normal(p, nearest) {
            Some(is_inside) => Ok(if is_inside { -nearest.distance } else { nearest.distance }),
            None => {
                let has_jumps = self.surface.has_jumps();
                let is_inside =
                    if has_jumps { self.surface.is_inside(p) } else { self.winding(i + self.width * j, p)? >= 1 };
                Ok(if is_inside { -nearest.distance } else { nearest.distance })
            }
        }
    }

    /// [`Surface::winding`] of a point of a column.
    fn winding(&mut self, column: usize, p: Vec3) -> Result<i32> {
        let surface = self.surface;
        let line = AxisLine::new(2, p);
        let [from, to] = match self.found[column] {
            Some(range) => range,
            None => {
                let from = self.met.len() as u32;
                let mut full = false;
                let met = &mut self.met;
                // Above the lowest point: what lies below all of them crosses no ray.
                let above = Aabb::new(Vec3::new(p.x, p.y, self.ends[0]), Vec3::new(p.x, p.y, f64::INFINITY));
                surface.overlapping(above, |t| {
                    let turn = line.meets(surface.corners(t));
                    if turn != 0 {
                        full |= met.try_reserve(1).is_err();
                        if !full {
                            met.push((t, turn));
                        }
                    }
                });
                if full {
                    return Err(Error::memory("crossings", self.met.len() + 1));
                }
                let range = [from, self.met.len() as u32];
                self.found[column] = Some(range);
                range
            }
        };
        let crossed = self.met[from as usize..to as usize].iter();
        let crossed = crossed.filter(|(t, turn)| line.below(p.z, surface.corners(*t), *turn));
        Ok(crossed.fold(surface.far_winding, |winding, (_, turn)| winding + turn))
    }
}
