// SPDX-License-Identifier: MIT OR Apache-2.0
//! Geometries in relocatable blocks: what comes out is what went in, to the bit, whatever way the block took; damage is
//! an error.

#[path = "../common/mod.rs"]
mod common;

mod crafted;
mod damage;
mod kinds;
mod processes;
mod same;
mod scenes;
