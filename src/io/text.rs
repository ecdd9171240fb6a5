// SPDX-License-Identifier: MIT OR Apache-2.0
//! Text files being written: memory that cannot be had is an error.

use crate::error::{Error, Result};
use std::fmt::{self, Write};

/// Text that `write!` adds to.
#[derive(Default)]
pub(super) struct Text(Vec<u8>);

impl Text {
    /// Adds text.
    pub fn add(&mut self, text: fmt::Arguments<'_>) -> Result<()> {
        self.write_fmt(text).map_err(|_| Error::memory("bytes", self.0.len()))
    }

    /// All of it.
    pub fn into_bytes(self) -> Vec<u8> {
        self.0
    }
}

impl Write for Text {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.try_reserve(text.len()).map_err(|_| fmt::Error)?;
        self.0.extend_from_slice(text.as_bytes());
        Ok(())
    }
}

/// A name as one line: control characters become spaces, and there are none around it.
pub(super) fn one_line(name: &str) -> String {
    let line: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    line.trim().to_owned()
}

/// A text as the value of an attribute of XML.
pub(super) fn attribute(text: &str) -> String {
    let mut out = String::new();
    for c in one_line(text).chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            _ => out.push(c),
        }
    }
    out
}

/// What to do with a VTK data set of another kind than a surface, to follow the refusal.
pub(super) fn way_out(kind: &[u8]) -> &'static str {
    let cells = [&b"UNSTRUCTURED_GRID"[..], b"UnstructuredGrid"];
    match cells.iter().any(|k| kind.eq_ignore_ascii_case(k)) {
        true => "; extract its surface first (vtkGeometryFilter, in ParaView Extract Surface)",
        false => "",
    }
}
