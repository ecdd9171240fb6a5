// SPDX-License-Identifier: MIT OR Apache-2.0
//! Caps in relocatable blocks.

use super::{Closing, DEEPEST};
use crate::error::Result;
use crate::mesh::LARGEST_COORDINATE;
use crate::store::{Packer, Unpacker, wrong};

impl Closing {
    pub(in super::super) fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.array(&self.corners);
        out.array(&self.clusters);
        out.word(self.loops as u64);
    }

    pub(in super::super) fn unpack(from: &mut Unpacker) -> Result<Closing> {
        let closing =
            Closing { corners: from.array("caps")?, clusters: from.array("clusters")?, loops: from.word()? as usize };
        if closing.corners.is_empty() || closing.clusters.is_empty() {
            return Err(wrong("an open surface has no caps"));
        }
        if from.checks() {
            closing.check()?;
        }
        Ok(closing)
    }

    /// Makes sure that every index leads to something, and that the way down comes to an end.
    fn check(&self) -> Result<()> {
        let is_fit = |c: &crate::math::Vec3| c.is_finite() && c.abs().max_element() <= LARGEST_COORDINATE;
        if !self.corners.iter().flatten().all(is_fit) {
            return Err(wrong("a cap is not finite or too far away"));
        }
        // Clusters that are yet to come, with the caps they must hold and their depth.
        let mut waiting = vec![(0usize, 0u32, self.corners.len() as u32, 1usize)];
        let mut next = 0;
        while let Some((at, first, count, depth)) = waiting.pop() {
            let cluster = self.clusters.get(at).filter(|_| at == next && depth < DEEPEST - 1);
            let Some(cluster) = cluster.filter(|c| c.first == first && c.count == count && count > 0) else {
                return Err(wrong("the clusters of caps are damaged"));
            };
            next += 1;
            if cluster.second != 0 {
                let low = count / 2;
                waiting.push((cluster.second as usize, first + low, count - low, depth + 1));
                waiting.push((at + 1, first, low, depth + 1));
            }
        }
        if next == self.clusters.len() { Ok(()) } else { Err(wrong("there are clusters of no caps")) }
    }
}
