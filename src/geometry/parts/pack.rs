// SPDX-License-Identifier: MIT OR Apache-2.0
//! Many parts in relocatable blocks, with their hierarchies: building those anew would take as long as it took.

use super::hierarchy::{Hierarchy, as_sphere};
use super::spheres::Block;
use super::{DEEP, Parts};
use crate::bvh::{Tree, each_once};
use crate::error::{Result, try_with_capacity};
use crate::geometry::Geometry;
use crate::simd::lanes::WIDTH;
use crate::store::{Packer, Unpacker, wrong};
use std::sync::OnceLock;

impl Parts {
    /// `numbers` are those of the parts.
    pub(in crate::geometry) fn pack<'a>(&'a self, numbers: &[u64], out: &mut Packer<'a>) {
        out.word(numbers.len() as u64);
        numbers.iter().for_each(|&number| out.word(number));
        out.word(self.apart.get().map_or(2, |&apart| u64::from(apart)));
        out.word(u64::from(self.hierarchy.is_some()));
        if let Some(hierarchy) = &self.hierarchy {
            hierarchy.pack(out);
        }
    }

    /// Of some of the nodes there are.
    pub(in crate::geometry) fn unpack(from: &mut Unpacker, nodes: &[Geometry], turned: bool) -> Result<Parts> {
        let count = from.count(1, "parts")?;
        let mut list = try_with_capacity("parts", count)?;
        for _ in 0..count {
            list.push(nodes[from.index(nodes.len(), "part")?].clone());
        }
        let apart = match from.index(3, "flag")? {
            2 => OnceLock::new(),
            known => OnceLock::from(known == 1),
        };
        let hierarchy = match from.flag()? {
            true => Some(Box::new(Hierarchy::unpack(from, &list)?)),
            false => None,
        };
        Ok(Parts { list, turned, hierarchy, apart })
    }
}

impl Hierarchy {
    fn pack<'a>(&'a self, out: &mut Packer<'a>) {
        out.array(&self.beside);
        out.numbers([self.spread, self.steepness, self.rounding.0, self.rounding.1]);
        out.word(u64::from(self.spheres.is_some()));
        if let Some((tree, blocks)) = &self.spheres {
            out.array(blocks);
            tree.pack(out);
        }
        out.word(u64::from(self.others.is_some()));
        if let Some((tree, parts)) = &self.others {
            out.array(parts);
            tree.pack(out);
        }
    }

    fn unpack(from: &mut Unpacker, list: &[Geometry]) -> Result<Hierarchy> {
        if list.iter().any(|part| part.summary().depth >= DEEP) {
            return Err(wrong("a hierarchy stands over parts too deep for its search"));
        }
        let beside = from.array::<u32>("parts")?;
        let (spread, steepness, rounding) = (from.number()?, from.number()?, (from.finite()?, from.finite()?));
        let mut hierarchy = Hierarchy { spheres: None, others: None, beside, spread, steepness, rounding };
        if from.flag()? {
            let blocks = from.array::<Block>("balls")?;
            hierarchy.spheres = Some((Tree::unpack(from, blocks.len())?, blocks));
        }
        if from.flag()? {
            let parts = from.array::<u32>("parts")?;
            hierarchy.others = Some((Tree::unpack(from, parts.len())?, parts));
        }
        let is_rising = hierarchy.beside.windows(2).all(|pair| pair[0] < pair[1]);
        // What rises with the distance, and by how much.
        let has_bounds = hierarchy.spread >= 1.0 && hierarchy.steepness >= 1.0 && rounding.0.min(rounding.1) >= 0.0;
        if !is_rising || !has_bounds {
            return Err(wrong("a hierarchy of parts is damaged"));
        }
        if from.checks() {
            hierarchy.check(list)?;
        }
        Ok(hierarchy)
    }

    /// Makes sure that every part is in one place, and that balls are those of their parts.
    fn check(&self, list: &[Geometry]) -> Result<()> {
        let blocks = self.spheres.iter().flat_map(|(_, blocks)| blocks);
        let others = self.others.iter().flat_map(|(_, parts)| parts).copied();
        each_once(blocks.clone().flat_map(Block::parts).chain(others).chain(self.beside.iter().copied()), list.len())?;
        for block in blocks {
            let used = block.parts().count();
            let mut spheres = try_with_capacity("balls", WIDTH)?;
            spheres.extend(block.parts().filter_map(|k| as_sphere(&list[k as usize]).map(|sphere| (k, sphere))));
            if used == 0 || spheres.len() != used || !block.is(&Block::new(&spheres)) {
                return Err(wrong("balls of a hierarchy are not those of its parts"));
            }
        }
        Ok(())
    }
}
