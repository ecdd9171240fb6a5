// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lists and texts whose length the caller does not know: portions of long ones, and the pattern of two
//! calls, of which the first, with a capacity of 0, asks for the size alone.

use super::handle::writable;
use super::writer::Writer;
use crate::error::{Error, Result, try_with_capacity};
use std::ffi::c_char;
use std::ops::Range;

/// `first..first + count`, where there are so many.
pub(super) fn portion(what: &str, first: usize, count: usize, total: usize) -> Result<Range<usize>> {
    match first.checked_add(count).filter(|end| *end <= total) {
        Some(end) => Ok(first..end),
        None => Err(Error::invalid(format!("first, count: {first} and {count} reach beyond {total} {what}"))),
    }
}

/// Writes to an array that may be left out.
pub(super) fn put_portion<T: Copy>(out: Option<Writer<T>>, values: impl ExactSizeIterator<Item = T>) {
    if let Some(out) = out {
        out.put([0; 3], values);
    }
}

/// Writes the length of a list to `out_count` after `put`, called where `capacity` is not 0, has written the list:
/// to several arrays side by side, say, which it checks before it writes to the first.
///
/// # Safety
/// `out_count` may be written where it is not NULL.
pub(super) unsafe fn give_columns(
    count: usize,
    capacity: usize,
    out_count: *mut usize,
    put: impl FnOnce() -> Result<()>,
) -> Result<()> {
    writable("out_count", out_count)?;
    if capacity > 0 {
        if capacity < count {
            return Err(Error::invalid(format!("capacity: {capacity} is less than {count}")));
        }
        put()?;
    }
    // SAFETY: checked above.
    unsafe { out_count.write(count) };
    Ok(())
}

/// Writes the length of a list to `out_count`, and the list itself where `capacity` is not 0.
///
/// # Safety
/// `out` holds `capacity` elements; `out_count` may be written where it is not NULL.
pub(super) unsafe fn give_list<T: Copy>(
    name: &str,
    values: &[T],
    capacity: usize,
    out: *mut T,
    out_count: *mut usize,
) -> Result<()> {
    // SAFETY: the caller's promise.
    unsafe {
        give_columns(values.len(), capacity, out_count, || {
            Writer::required(name, out, values.len())?.put([0; 3], values.iter().copied());
            Ok(())
        })
    }
}

/// The same for a text: the size counts the zero byte at its end.
///
/// # Safety
/// As [`give_list`].
pub(super) unsafe fn give_text(
    name: &str,
    text: &str,
    capacity: usize,
    out: *mut c_char,
    out_size: *mut usize,
) -> Result<()> {
    let mut bytes: Vec<c_char> = try_with_capacity("characters", text.len() + 1)?;
    bytes.extend(text.bytes().map(|b| if b == 0 { b' ' as c_char } else { b as c_char }));
    bytes.push(0);
    writable("out_size", out_size)?;
    // SAFETY: the caller's promise.
    unsafe { give_list(name, &bytes, capacity, out, out_size) }
}
