// SPDX-License-Identifier: MIT OR Apache-2.0
//! ASCII STL, as files in the wild have it: words in any case, any white space, LF, CRLF or CR, several solids,
//! `endsolid` optional, normals of any content. A solid's name is the rest of its line.

use super::Triangles;
use crate::error::{Error, Result};
use crate::io::words::Words;
use crate::math::Vec3;

/// Reads all solids.
pub(super) fn read(bytes: &[u8]) -> Result<Triangles> {
    let mut words = Words::new(bytes);
    let mut triangles = Triangles::default();
    let mut within = false;
    loop {
        let word = words.next();
        if word.is_empty() {
            break;
        } else if word.eq_ignore_ascii_case(b"solid") {
            triangles.names.push(words.rest_of_line());
            within = true;
        } else if within && word.eq_ignore_ascii_case(b"endsolid") {
            words.rest_of_line();
            within = false;
        } else if within && word.eq_ignore_ascii_case(b"facet") {
            facet(&mut words, &mut triangles.corners)?;
            triangles.solids.try_reserve(1).map_err(|_| Error::memory("triangles", triangles.solids.len() + 1))?;
            triangles.solids.push(triangles.names.len() as i32 - 1);
        } else {
            let wanted = match (within, !triangles.names.is_empty()) {
                (true, _) => "facet or endsolid",
                (false, true) => "solid",
                (false, false) => "solid, and no PLY, OBJ, VTK or VTP begins so",
            };
            return Err(words.unexpected(word, wanted));
        }
    }
    if triangles.corners.is_empty() {
        return Err(Error::parse(format!("line {}: the file ends without a triangle", words.line())));
    }
    if triangles.names.len() == 1 {
        triangles.solids = Vec::new();
    }
    Ok(triangles)
}

/// What follows the word "facet".
fn facet(words: &mut Words, corners: &mut Vec<Vec3>) -> Result<()> {
    // The word "normal" and up to three numbers, or what stands in for them.
    let mut word = words.next();
    for _ in 0..4 {
        if !word.eq_ignore_ascii_case(b"outer") {
            word = words.next();
        }
    }
    words.require(word, "outer")?;
    let word = words.next();
    words.require(word, "loop")?;
    corners.try_reserve(3).map_err(|_| Error::memory("corners", corners.len() + 3))?;
    for _ in 0..3 {
        let word = words.next();
        words.require(word, "vertex")?;
        corners.push(words.position()?);
    }
    let word = words.next();
    words.require(word, "endloop")?;
    let word = words.next();
    words.require(word, "endfacet")
}
