// SPDX-License-Identifier: MIT OR Apache-2.0
//! Files in memory without reading them: processes that map the same file share its pages. By the system's own mmap,
//! which takes fewer lines than a dependency does.

use crate::error::{Error, Result, Status};
use std::fs::File;
use std::ptr::NonNull;

/// The pages of a file, read-only.
pub(super) struct Map {
    at: NonNull<u8>,
    size: usize,
}

#[cfg(all(unix, target_pointer_width = "64"))]
mod system {
    use std::ffi::{c_int, c_void};

    pub(super) const PROT_READ: c_int = 1;
    pub(super) const MAP_SHARED: c_int = 1;

    unsafe extern "C" {
        pub(super) fn mmap(
            at: *mut c_void,
            size: usize,
            protection: c_int,
            flags: c_int,
            file: c_int,
            offset: i64,
        ) -> *mut c_void;
        pub(super) fn munmap(at: *mut c_void, size: usize) -> c_int;
    }
}

impl Map {
    /// The first `size` bytes of a file; none where this system has no such call, or no such file has any.
    #[cfg(all(unix, target_pointer_width = "64"))]
    pub(super) fn new(file: &File, size: usize) -> Result<Option<Map>> {
        use std::os::fd::AsRawFd;
        if size == 0 {
            return Ok(None);
        }
        let (read, shared) = (system::PROT_READ, system::MAP_SHARED);
        // SAFETY: the system chooses a place where nothing is; the file is open.
        let at = unsafe { system::mmap(std::ptr::null_mut(), size, read, shared, file.as_raw_fd(), 0) };
        match NonNull::new(at.cast::<u8>()) {
            Some(at) if at.as_ptr().addr() != usize::MAX => Ok(Some(Map { at, size })),
            _ => {
                let error = std::io::Error::last_os_error();
                Err(Error::new(Status::Io, format!("its {size} bytes cannot be mapped: {error}")))
            }
        }
    }

    /// This system has no call that is known here: files are read.
    #[cfg(not(all(unix, target_pointer_width = "64")))]
    pub(super) fn new(_: &File, _: usize) -> Result<Option<Map>> {
        Ok(None)
    }

    pub(super) fn at(&self) -> NonNull<u8> {
        self.at
    }
}

impl Drop for Map {
    fn drop(&mut self) {
        #[cfg(all(unix, target_pointer_width = "64"))]
        // SAFETY: what `new` mapped, and nothing points there any more.
        unsafe {
            system::munmap(self.at.as_ptr().cast(), self.size);
        }
    }
}
