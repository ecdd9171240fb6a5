// SPDX-License-Identifier: MIT OR Apache-2.0
//! Set operations, sharp and smooth, and repetition.

use super::finite;
use crate::error::{Error, Result, try_with_capacity};
use crate::geometry::node::Node;
use crate::geometry::parts::Parts;
use crate::geometry::repeat::Repeat;
use crate::geometry::smooth::Smooth;
use crate::geometry::{Blend, Geometry};

impl Geometry {
    /// Points in any part; of none: +inf everywhere. The value is the least of the parts'. Exact where all
    /// parts are and no two of them are found to have a point in common; else a lower bound of the distance.
    /// Over many parts a hierarchy over their own bounds is built: O(n log n).
    pub fn union(parts: &[Geometry]) -> Result<Geometry> {
        Geometry::new(Node::Union(Parts::new(copied(parts)?, false)?))
    }

    /// Points in every part; of none: -inf everywhere. The value is the greatest of the parts'.
    pub fn intersection(parts: &[Geometry]) -> Result<Geometry> {
        Geometry::new(Node::Intersection(Parts::new(copied(parts)?, true)?))
    }

    /// Points of `self` that are not in `remove`.
    pub fn difference(&self, remove: &Geometry) -> Result<Geometry> {
        Geometry::intersection(&[self.clone(), remove.complement()?])
    }

    /// Points of `self` that are in none of `remove`.
    pub fn difference_of_many(&self, remove: &[Geometry]) -> Result<Geometry> {
        self.difference(&Geometry::union(remove)?)
    }

    /// The union with its inner edges filled: values that are close are blended. The parts may be given in
    /// any order: their values are blended in rising order, until the next is further behind the result than
    /// the blend's support. The labels of a point are those of its least part. 1-Lipschitz and a lower bound
    /// of the distance where the parts are 1-Lipschitz.
    pub fn smooth_union(parts: &[Geometry], blend: &Blend) -> Result<Geometry> {
        blend.check()?;
        Geometry::new(Node::Smooth(Smooth::new(Parts::new(copied(parts)?, false)?, blend.clone())))
    }

    /// The intersection with its edges rounded: the complement of the smooth union of the complements, so
    /// that values are blended in falling order by the blend's mirror image.
    pub fn smooth_intersection(parts: &[Geometry], blend: &Blend) -> Result<Geometry> {
        let mut turned = try_with_capacity("parts", parts.len())?;
        for part in parts {
            turned.push(part.complement()?);
        }
        Geometry::smooth_union(&turned, blend)?.complement()
    }

    /// Points of `self` that are in none of `remove`, with the edges between them rounded.
    pub fn smooth_difference(&self, remove: &[Geometry], blend: &Blend) -> Result<Geometry> {
        let mut parts = try_with_capacity("remove", remove.len().saturating_add(1))?;
        parts.push(self.complement()?);
        parts.extend_from_slice(remove);
        Geometry::smooth_union(&parts, blend)?.complement()
    }

    /// The rest of space: 0.0 - f.
    pub fn complement(&self) -> Result<Geometry> {
        Geometry::new(Node::Complement(self.clone()))
    }

    /// The union of copies at `(i * period[0], j * period[1], k * period[2])`, `0 <= i < counts[0]` and so on,
    /// at the cost of one body and a few queries of it. Exact where the body is and its bounds are smaller
    /// than the period.
    pub fn repeat(&self, period: [f64; 3], counts: [i32; 3]) -> Result<Geometry> {
        Geometry::new(Node::Repeat(self.repeat_node(period, counts)?))
    }

    pub(in crate::geometry) fn repeat_node(&self, period: [f64; 3], counts: [i32; 3]) -> Result<Repeat> {
        let period = finite("period", period)?;
        if let Some(k) = counts.iter().position(|&c| c < 1) {
            return Err(Error::invalid(format!("counts[{k}]: {} is not at least 1", counts[k])));
        }
        // Copies in one place are one.
        let counts: [u32; 3] = std::array::from_fn(|k| if period[k] == 0.0 { 1 } else { counts[k] as u32 });
        for k in 0..3 {
            let farthest = period[k] * f64::from(counts[k]);
            if !farthest.is_finite() {
                return Err(Error::invalid(format!("period[{k}]: {} times {} is not finite", period[k], counts[k])));
            }
        }
        if counts.iter().try_fold(1usize, |n, &c| n.checked_mul(c as usize)).is_none() {
            return Err(Error::invalid(format!("counts: {} x {} x {} overflow", counts[0], counts[1], counts[2])));
        }
        Repeat::new(self.clone(), period, counts)
    }
}

fn copied(parts: &[Geometry]) -> Result<Vec<Geometry>> {
    let mut copy = try_with_capacity("parts", parts.len())?;
    copy.extend_from_slice(parts);
    Ok(copy)
}
