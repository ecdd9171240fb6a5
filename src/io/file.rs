// SPDX-License-Identifier: MIT OR Apache-2.0
//! Whole files, and errors that name them.

use crate::error::{Error, Result, Status};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

/// The bytes of a file.
pub(super) fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).map_err(|e| failure("read", path, &e))
}

/// Writes bytes as [`write_with`] does.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    write_with(path, |file| file.write_all(bytes))
}

/// Writes beside `path` and renames, so that a file of this name is always a whole one. Of a link the file that it leads to
/// is written; one that is there keeps its permissions; what is no file (a device, a pipe) is an error.
pub(crate) fn write_with(path: &Path, fill: impl FnOnce(&mut File) -> io::Result<()>) -> Result<()> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let before = fs::metadata(&target).ok();
    if before.as_ref().is_some_and(|before| !before.is_file()) {
        return Err(Error::new(Status::Io, format!("{}: cannot write: it is not a regular file", path.display())));
    }
    let temporary = beside(&target);
    let written = File::create_new(&temporary).and_then(|mut file| {
        before.map_or(Ok(()), |before| file.set_permissions(before.permissions()))?;
        fill(&mut file)?;
        fs::rename(&temporary, &target)
    });
    written.map_err(|e| {
        // The first failure is the one to tell of.
        let _ = fs::remove_file(&temporary);
        failure("write", path, &e)
    })
}

/// A name in the same folder that no other thread or process uses.
fn beside(path: &Path) -> PathBuf {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    path.with_file_name(format!(".{}.{}.partial", process::id(), NEXT.fetch_add(1, Ordering::Relaxed)))
}

fn failure(verb: &str, path: &Path, reason: &io::Error) -> Error {
    let status = if reason.kind() == io::ErrorKind::OutOfMemory { Status::Memory } else { Status::Io };
    Error::new(status, format!("{}: cannot {verb}: {reason}", path.display()))
}
