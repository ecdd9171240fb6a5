// SPDX-License-Identifier: MIT OR Apache-2.0
//! Legacy VTK PolyData.

use crate::error::{Error, Result};
use crate::mesh::{Input, Mesh};

/// Reads a file.
pub(super) fn read(_bytes: &[u8]) -> Result<Input> {
    Err(Error::unsupported("not in this version"))
}

/// The bytes of a file with the surface as it stands.
pub(super) fn write(_mesh: &Mesh) -> Result<Vec<u8>> {
    Err(Error::unsupported("not in this version"))
}
