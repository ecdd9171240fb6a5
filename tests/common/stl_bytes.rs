// SPDX-License-Identifier: MIT OR Apache-2.0
//! STL files of generated meshes, made here and not by embound's writer.

use super::Soup;
use std::fmt::Write;

/// A binary file with this header (cut to or padded to 80 bytes) and attribute word.
pub fn binary_with(soup: &Soup, header: &[u8], attribute: u16) -> Vec<u8> {
    let mut out = header.to_vec();
    out.resize(80, b' ');
    out.extend((soup.triangles.len() as u32).to_le_bytes());
    for t in 0..soup.triangles.len() {
        out.extend([0; 12]);
        for c in soup.corners(t).as_flattened() {
            out.extend((*c as f32).to_le_bytes());
        }
        out.extend(attribute.to_le_bytes());
    }
    out
}

/// A plain binary file.
pub fn binary(soup: &Soup) -> Vec<u8> {
    binary_with(soup, b"generated", 0)
}

/// The lines of one solid. Coordinates are printed so that they read back as the same f64.
pub fn ascii_solid(soup: &Soup, name: &str) -> String {
    let mut out = format!("solid {name}\n");
    for t in 0..soup.triangles.len() {
        out.push_str("  facet normal 0 0 0\n    outer loop\n");
        for [x, y, z] in soup.corners(t) {
            writeln!(out, "      vertex {x:e} {y:e} {z:e}").expect("a string takes everything");
        }
        out.push_str("    endloop\n  endfacet\n");
    }
    writeln!(out, "endsolid {name}").expect("a string takes everything");
    out
}

/// An ASCII file of one solid.
pub fn ascii(soup: &Soup) -> Vec<u8> {
    ascii_solid(soup, "generated").into_bytes()
}
