// SPDX-License-Identifier: MIT OR Apache-2.0
//! Numbers of the kinds of node, in fingerprints and in blocks. Those of shapes (1, 2 and from 20 on) stand with the
//! shapes.

pub(super) const SURFACE: u64 = 3;
pub(super) const UNION: u64 = 4;
pub(super) const INTERSECTION: u64 = 5;
pub(super) const COMPLEMENT: u64 = 6;
pub(super) const TRANSLATE: u64 = 7;
pub(super) const PLACE: u64 = 8;
pub(super) const PART: u64 = 9;
pub(super) const MAP: u64 = 10;
/// In fingerprints that of offsets; shells and quotients are 12 and 13 there.
pub(super) const LEVEL: u64 = 11;
pub(super) const STENCIL: u64 = 14;
pub(super) const REPEAT: u64 = 15;
pub(super) const SMOOTH: u64 = 16;
