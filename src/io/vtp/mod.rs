// SPDX-License-Identifier: MIT OR Apache-2.0
//! XML VTK PolyData.

use crate::error::{Error, Result};
use crate::mesh::Input;

/// Reads a file.
pub(super) fn read(_bytes: &[u8]) -> Result<Input> {
    Err(Error::unsupported("not in this version"))
}
