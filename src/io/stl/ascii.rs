// SPDX-License-Identifier: MIT OR Apache-2.0
//! ASCII STL, as files in the wild have it: words in any case, any white space, LF, CRLF or CR, several solids,
//! `endsolid` optional, normals of any content. A solid's name is the rest of its line.

use super::Triangles;
use crate::error::{Error, Result};
use crate::math::Vec3;
use crate::mesh::LARGEST_COORDINATE;

/// Reads all solids.
pub(super) fn read(bytes: &[u8]) -> Result<Triangles> {
    let mut words = Words { bytes: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), at: 0, line: 1 };
    let mut triangles = Triangles { corners: Vec::new(), solids: Vec::new() };
    let (mut solids, mut within) = (0, false);
    loop {
        let word = words.next();
        if word.is_empty() {
            break;
        } else if word.eq_ignore_ascii_case(b"solid") {
            words.skip_line();
            within = true;
            solids += 1;
        } else if within && word.eq_ignore_ascii_case(b"endsolid") {
            words.skip_line();
            within = false;
        } else if within && word.eq_ignore_ascii_case(b"facet") {
            facet(&mut words, &mut triangles.corners)?;
            triangles.solids.try_reserve(1).map_err(|_| Error::memory("triangles", triangles.solids.len() + 1))?;
            triangles.solids.push(solids - 1);
        } else {
            return Err(words.unexpected(word, if within { "facet or endsolid" } else { "solid" }));
        }
    }
    if triangles.corners.is_empty() {
        return Err(Error::parse(format!("line {}: the file ends without a triangle", words.line)));
    }
    if solids == 1 {
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
        corners.push(Vec3::new(words.number()?, words.number()?, words.number()?));
    }
    let word = words.next();
    words.require(word, "endloop")?;
    let word = words.next();
    words.require(word, "endfacet")
}

/// The words of a text, and the line they are in.
struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl<'a> Words<'a> {
    /// The next word; empty at the end.
    fn next(&mut self) -> &'a [u8] {
        while let Some(&b) = self.bytes.get(self.at) {
            if !is_space(b) {
                break;
            }
            self.pass(b);
        }
        let start = self.at;
        while self.bytes.get(self.at).is_some_and(|&b| !is_space(b)) {
            self.at += 1;
        }
        &self.bytes[start..self.at]
    }

    fn skip_line(&mut self) {
        while let Some(&b) = self.bytes.get(self.at)
            && b != b'\n'
            && b != b'\r'
        {
            self.at += 1;
        }
    }

    /// Steps over white space. CRLF counts once.
    fn pass(&mut self, b: u8) {
        let ends_line = b == b'\n' || (b == b'\r' && self.bytes.get(self.at + 1) != Some(&b'\n'));
        self.line += usize::from(ends_line);
        self.at += 1;
    }

    fn number(&mut self) -> Result<f64> {
        let word = self.next();
        let Some(x) = std::str::from_utf8(word).ok().and_then(|w| w.parse::<f64>().ok()) else {
            return Err(self.unexpected(word, "a number"));
        };
        if !x.is_finite() || x.abs() > LARGEST_COORDINATE {
            return Err(self.unexpected(word, "a finite coordinate"));
        }
        Ok(x)
    }

    fn require(&self, word: &[u8], wanted: &str) -> Result<()> {
        if word.eq_ignore_ascii_case(wanted.as_bytes()) { Ok(()) } else { Err(self.unexpected(word, wanted)) }
    }

    fn unexpected(&self, word: &[u8], wanted: &str) -> Error {
        if word.is_empty() {
            return Error::parse(format!("line {}: the file ends where {wanted} should be", self.line));
        }
        let shown = String::from_utf8_lossy(&word[..word.len().min(40)]);
        Error::parse(format!("line {}: \"{shown}\" is not {wanted}", self.line))
    }
}

fn is_space(b: u8) -> bool {
    b == b' ' || (b'\t'..=b'\r').contains(&b)
}
