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

/// Writes beside `path` and renames, so that a file of this name is always a whole one.
pub(crate) fn write_with(path: &Path, fill: impl FnOnce(&mut File) -> io::Result<()>) -> Result<()> {
    let temporary = beside(path);
    let written =
        File::create_new(&temporary).and_then(|mut file| fill(&mut file)).and_then(|()| fs::rename(&temporary, path));
    written.map_err(|e| {
        // The first failure is the one to tell of.
        let _ = fs::remove_file(&temporary);
        failure("write", path, &e)
    })
}

/// A name in the same folder that no other thread or process uses.
fn beside(path: &Path) -> PathBuf {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.{}.partial", process::id(), NEXT.fetch_add(1, Ordering::Relaxed)));
    path.with_file_name(name)
}

fn failure(verb: &str, path: &Path, reason: &io::Error) -> Error {
    let status = if reason.kind() == io::ErrorKind::OutOfMemory { Status::Memory } else { Status::Io };
    Error::new(status, format!("{}: cannot {verb}: {reason}", path.display()))
}
