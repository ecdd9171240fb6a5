// SPDX-License-Identifier: MIT OR Apache-2.0
//! The memory of a block: a copy of it, a part of a file, or what a caller lends.

use super::map::Map;
use crate::error::{Error, Result, Status, filled};
use std::any::Any;
use std::fs::File;
use std::ptr::NonNull;
use std::slice;
use std::sync::Arc;

/// Where arrays begin: a multiple of this, of a block that itself begins at one.
pub(super) const ALIGNMENT: usize = 64;

/// Memory that begins where arrays may.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Line([u8; ALIGNMENT]);

/// Bytes that stay where they are and do not change.
pub(crate) struct Block {
    at: NonNull<u8>,
    size: usize,
    _keep: Keep,
}

/// What keeps the bytes.
enum Keep {
    Own { _lines: Vec<Line> },
    Mapped { _map: Map },
    Lent { _lender: Arc<dyn Any + Send + Sync> },
}

// SAFETY: the bytes are only read.
unsafe impl Send for Block {}
// SAFETY: as above.
unsafe impl Sync for Block {}

impl Block {
    /// A copy, in its place.
    pub(crate) fn copy_of(bytes: &[u8]) -> Result<Arc<Block>> {
        let mut lines = filled("bytes", bytes.len().div_ceil(ALIGNMENT), Line([0; ALIGNMENT]))?;
        for (line, bytes) in lines.iter_mut().zip(bytes.chunks(ALIGNMENT)) {
            line.0[..bytes.len()].copy_from_slice(bytes);
        }
        let at = NonNull::new(lines.as_mut_ptr().cast()).unwrap_or(NonNull::dangling());
        Ok(Arc::new(Block { at, size: bytes.len(), _keep: Keep::Own { _lines: lines } }))
    }

    /// What a caller lends, until `lender` is dropped.
    ///
    /// # Safety
    /// `at` holds `size` bytes that nobody changes before `lender` is dropped.
    pub(crate) unsafe fn lent(at: NonNull<u8>, size: usize, lender: Arc<dyn Any + Send + Sync>) -> Result<Arc<Block>> {
        if !at.as_ptr().addr().is_multiple_of(ALIGNMENT) {
            return Err(Error::invalid(format!(
                "block: {at:p} is not a multiple of {ALIGNMENT}, where a block that is not copied must begin"
            )));
        }
        Ok(Arc::new(Block { at, size, _keep: Keep::Lent { _lender: lender } }))
    }

    /// The bytes of a file, which nobody may change meanwhile.
    pub(crate) fn of_file(file: &File, size: usize) -> Result<Arc<Block>> {
        match Map::new(file, size)? {
            Some(map) => Ok(Arc::new(Block { at: map.at(), size, _keep: Keep::Mapped { _map: map } })),
            None => {
                let mut bytes = filled("bytes", size, 0)?;
                std::io::Read::read_exact(&mut &*file, &mut bytes)
                    .map_err(|e| Error::new(Status::Io, format!("it cannot be read: {e}")))?;
                Block::copy_of(&bytes)
            }
        }
    }

    /// All of them.
    pub(crate) fn bytes(&self) -> &[u8] {
        // SAFETY: whatever keeps the block keeps so many bytes there.
        unsafe { slice::from_raw_parts(self.at.as_ptr(), self.size) }
    }
}
