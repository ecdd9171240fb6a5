// SPDX-License-Identifier: MIT OR Apache-2.0
//! OBJ files of generated meshes, made here and not by embound's writer.

use super::Soup;
use std::fmt::Write;

/// The vertices and faces of a file, `v` as the first index of each corner and what `rest` makes of it.
pub fn with_corners(soup: &Soup, rest: impl Fn(u32) -> String) -> String {
    let mut out = String::new();
    for [x, y, z] in &soup.vertices {
        writeln!(out, "v {x:e} {y:e} {z:e}").expect("a string takes everything");
    }
    for t in &soup.triangles {
        let [a, b, c] = t.map(|v| format!("{}{}", v + 1, rest(v + 1)));
        writeln!(out, "f {a} {b} {c}").expect("a string takes everything");
    }
    out
}

/// A plain file.
pub fn plain(soup: &Soup) -> String {
    with_corners(soup, |_| String::new())
}

/// A file with all that the format is used for: comments, groups, objects, materials, normals, texture
/// coordinates, colours, polygons, relative indices and lines in two parts.
pub fn rich() -> String {
    "\
# exported\nmtllib part.mtl\no part\n\
v 0 0 0 1 0 0\nv 2 0 0 1 0 0.5\nv 2 2 0 1 0 0\nv 0 2 0 0 1 0\nv 0 0 1 0 1 0\nv 2 0 1 0 0 1\nv 2 2 1 1 1 1\nv 0 2 1 0 0 0\n\
vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nvn 0 0 -1\n\
g floor\nusemtl steel\ns off\nf 4//2 3//2 2//2 1//2\n\
g lid\nusemtl glass\nf 5/1/1 6/2/1 7/3/1 8/1/1\n\
g sides\nf 1 2 6 5\nf -7 -6 -2 -3\nf 3 4 \\\n 8 7\nusemtl steel\nf 4/1 1/2 5/3 8/1\nl 1 2\np 3\n"
        .to_owned()
}
