// SPDX-License-Identifier: MIT OR Apache-2.0
//! Relocatable blocks: arrays that are either owned or views into a block that others share, and how such blocks are
//! written, checked, mapped and read. What the numbers mean is the business of those who put them in.
//!
//! A block is a header of 128 bytes; a front, which is a directory of the arrays and the words of the nodes; and the
//! arrays, each at a multiple of 64 bytes. It holds no addresses and no padding that is not zero, so equal content
//! gives equal bytes. Numbers stand as the machine has them: the header says in which order.

mod array;
mod block;
mod checksum;
mod header;
mod map;
mod pack;
mod plain;
mod unpack;

pub(crate) use array::Array;
pub(crate) use block::Block;
pub(crate) use pack::{Packed, Packer, Sealed};
pub(crate) use plain::{Plain, plain};
pub(crate) use unpack::{Unpacker, wrong};
