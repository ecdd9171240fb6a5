// SPDX-License-Identifier: MIT OR Apache-2.0
//! How the sign of a surface is decided, and why so.

use super::{Sign, Surface};
use crate::error::Result;
use crate::geometry::SignMethod;
use crate::store::{Packer, Unpacker};

/// What there is to say beside what the surface itself tells.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Why {
    /// Pairs of triangles that meet where they share no edge or vertex: these, or more.
    pub(super) pairs: usize,
    pub(super) more_pairs: bool,
    /// Edges of more than two faces.
    pub(super) nonmanifold: usize,
    /// Loops of the boundary, and their edges.
    pub(super) loops: usize,
    pub(super) edges: usize,
}

impl Why {
    pub(super) fn pack(&self, out: &mut Packer) {
        for number in [self.pairs, usize::from(self.more_pairs), self.nonmanifold, self.loops, self.edges] {
            out.word(number as u64);
        }
    }

    pub(super) fn unpack(from: &mut Unpacker) -> Result<Why> {
        let mut number = || from.word().map(|word| word as usize);
        Ok(Why {
            pairs: number()?,
            more_pairs: number()? != 0,
            nonmanifold: number()?,
            loops: number()?,
            edges: number()?,
        })
    }
}

impl Surface {
    /// One line: the method, and the reason for it.
    pub(crate) fn sign_text(&self) -> String {
        let Why { pairs, more_pairs, nonmanifold, loops, edges } = self.why;
        let chosen = self.asked.0 == SignMethod::Auto;
        let asked = if chosen { "" } else { ", as asked" };
        let boundary = format!("{edges} boundary edges in {loops} loops");
        let meeting = || format!("{pairs}{} pairs of triangles meet", if more_pairs { " or more" } else { "" });
        let of = self.triangles.len();
        match (self.sign_method(), self.sign) {
            (SignMethod::None, _) => format!("NONE{asked}: nothing is inside"),
            (SignMethod::Axis, _) => format!("AXIS{asked}: inside is below the highest face ({boundary})"),
            (_, Sign::Votes) => format!("RAY{asked}: inside is where four of six rays say so ({boundary})"),
            (SignMethod::Winding, _) if self.closing.is_some() => {
                let small = if chosen { ", all of them small holes" } else { "" };
                format!("WINDING{asked}: there are {boundary}{small}")
            }
            (SignMethod::Winding, _) => format!("WINDING{asked}: the surface is closed, so crossings count it exactly"),
            (_, Sign::Crossings) if !chosen => format!("RAY{asked}: the surface is closed, so one ray is enough"),
            (_, Sign::Crossings) if nonmanifold > 0 => format!("RAY: {nonmanifold} edges have more than two faces"),
            (_, Sign::Crossings) => format!("RAY: {} of {of}", meeting()),
            (SignMethod::Pseudonormal, _) => {
                format!("PSEUDONORMAL{asked}: the surface is closed and meets itself in its edges and vertices alone")
            }
            _ => {
                let near: u32 = self.doubts.bits.iter().map(|bits| bits.count_ones()).sum();
                format!(
                    "RAY near {near} of {of} triangles, PSEUDONORMAL elsewhere: {}, or pieces lie within others or inside out",
                    meeting()
                )
            }
        }
    }
}
