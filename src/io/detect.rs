// SPDX-License-Identifier: MIT OR Apache-2.0
//! Which format a file has, by its first bytes.

use super::Format;
use super::stl;
use super::words::Words;
use crate::error::Result;

/// The format of the content. What is none of the others is read as STL, whose reader then says what it
/// misses.
pub(super) fn format(bytes: &[u8]) -> Result<Format> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = text.trim_ascii_start();
    let begins = |with: &[u8]| text.get(..with.len()).is_some_and(|b| b.eq_ignore_ascii_case(with));
    Ok(if begins(b"ply\n") || begins(b"ply\r") {
        Format::Ply
    } else if begins(b"# vtk") {
        Format::Vtk
    } else if begins(b"<?xml") || begins(b"<VTKFile") || begins(b"<!--") {
        Format::Vtp
    } else if !stl::is_binary(bytes) && is_obj(text) {
        Format::Obj
    } else {
        Format::Stl
    })
}

/// After comments and lines that begin with other words of OBJ comes a vertex.
fn is_obj(text: &[u8]) -> bool {
    const OTHERS: [&[u8]; 13] =
        [b"vt", b"vn", b"vp", b"f", b"fo", b"l", b"p", b"g", b"o", b"s", b"mg", b"usemtl", b"mtllib"];
    let mut words = Words::new(text);
    loop {
        let word = words.next();
        if word.eq_ignore_ascii_case(b"v") {
            return words.coordinate().is_ok();
        }
        if !word.starts_with(b"#") && !OTHERS.iter().any(|k| word.eq_ignore_ascii_case(k)) {
            return false;
        }
        words.rest_of_line();
    }
}
