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

/// After comments and lines that begin with other words, which OBJ's reader passes over, comes a vertex; but what begins
/// as STL is none.
fn is_obj(text: &[u8]) -> bool {
    const OF_STL: [&[u8]; 2] = [b"solid", b"facet"];
    let mut words = Words::new(text);
    loop {
        let word = words.next();
        if word.eq_ignore_ascii_case(b"v") {
            return words.coordinate().is_ok();
        }
        let is_statement = word.first().is_some_and(|b| *b == b'#' || b.is_ascii_alphabetic());
        if !is_statement || OF_STL.iter().any(|k| word.eq_ignore_ascii_case(k)) {
            return false;
        }
        if word[0] == b'#' {
            words.rest_of_line();
        } else {
            // A backslash at its end joins the next line to a statement.
            while !words.next_on_line().is_empty() {}
        }
    }
}
