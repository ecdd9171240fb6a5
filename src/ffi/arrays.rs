// SPDX-License-Identifier: MIT OR Apache-2.0
//! Arrays that callers lend.

use super::handle::{aligned, null};
use crate::error::{Error, Result};
use crate::query::Strided;
use std::ffi::{CStr, c_char};
use std::path::Path;
use std::slice;

/// Whether an array of this many elements can exist.
fn exists<T>(count: usize) -> bool {
    count <= isize::MAX as usize / size_of::<T>().max(1)
}

/// `count * each` elements, where so many can exist.
pub(super) fn elements<T>(name: &str, count: usize, each: usize) -> Result<usize> {
    count
        .checked_mul(each)
        .filter(|n| exists::<T>(*n))
        .ok_or_else(|| Error::invalid(format!("{name}: {count} times {each} is more than memory can hold")))
}

/// The array at `data`, which may be NULL where `count` is 0. `count` came through [`elements`].
///
/// # Safety
/// `data` is NULL or holds `count` elements that nobody writes during `'a`.
pub(super) unsafe fn slice<'a, T>(name: &str, data: *const T, count: usize) -> Result<&'a [T]> {
    if count == 0 {
        return Ok(&[]);
    }
    if data.is_null() {
        return Err(null(name));
    }
    aligned(name, data)?;
    // SAFETY: not NULL, aligned, and the caller vouches for the elements.
    Ok(unsafe { slice::from_raw_parts(data, count) })
}

/// How many elements `count` of them reach over, `stride` apart, where so many can exist.
pub(super) fn strided<T>(count: usize, stride: usize) -> Result<usize> {
    if stride == 0 {
        return Err(Error::invalid("stride: 0 is not at least 1"));
    }
    let Some(last) = count.checked_sub(1) else { return Ok(0) };
    last.checked_mul(stride).and_then(|n| n.checked_add(1)).filter(|n| exists::<T>(*n)).ok_or_else(|| {
        Error::invalid(format!("count, stride: {count} points {stride} apart are more than memory can hold"))
    })
}

/// `count` points in three arrays with one stride.
///
/// # Safety
/// As [`slice`], for [`strided`] elements of each.
pub(super) unsafe fn points<'a, T: Copy + Into<f64> + Sync>(
    count: usize,
    [x, y, z]: [*const T; 3],
    stride: usize,
) -> Result<Strided<'a, T>> {
    let needed = strided::<T>(count, stride)?;
    // SAFETY: the caller's promise.
    let axes = unsafe { [slice("x", x, needed)?, slice("y", y, needed)?, slice("z", z, needed)?] };
    Strided::new(count, axes, stride)
}

/// A copy of `N` numbers.
///
/// # Safety
/// `data` is NULL or holds `N` numbers.
pub(super) unsafe fn numbers<const N: usize>(name: &str, data: *const f64) -> Result<[f64; N]> {
    // SAFETY: the caller's promise.
    let given = unsafe { slice(name, data, N) }?;
    let mut copy = [0.0; N];
    copy.copy_from_slice(given);
    Ok(copy)
}

/// A path.
///
/// # Safety
/// `path` is NULL or a text that ends with a zero byte and stays during `'a`.
pub(super) unsafe fn path<'a>(name: &str, path: *const c_char) -> Result<&'a Path> {
    if path.is_null() {
        return Err(null(name));
    }
    // SAFETY: the caller's promise.
    let text = unsafe { CStr::from_ptr(path) };
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        Ok(Path::new(std::ffi::OsStr::from_bytes(text.to_bytes())))
    }
    #[cfg(not(unix))]
    {
        text.to_str().map(Path::new).map_err(|_| Error::invalid(format!("{name}: {text:?} is not UTF-8")))
    }
}
