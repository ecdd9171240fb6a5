// SPDX-License-Identifier: MIT OR Apache-2.0
//! Structs that begin with `struct_size` and only ever grow at the end: a caller built against any
//! release and a library of any release understand each other.

use super::handle::null;
use crate::error::{Error, Result};
use std::mem::{MaybeUninit, size_of};
use std::ptr;

/// No release has a struct larger than this, so a larger size is not a size.
const LARGEST: usize = 4096;

/// A struct of the C ABI that carries its size.
///
/// A member added later must not lie where an earlier release had padding: old callers leave garbage there.
///
/// # Safety
/// `repr(C)`, `struct_size: usize` first, and any bytes are a value of every other member.
pub(super) unsafe trait Versioned: Copy {
    /// Where the members of the first release end.
    const FIRST_SIZE: usize;

    /// Every member's default, `struct_size` that of this release.
    const DEFAULT: Self;
}

/// The size a caller states, checked.
///
/// # Safety
/// `given` points to a struct of the size that it states.
unsafe fn stated_size<T: Versioned>(name: &str, given: *const T) -> Result<usize> {
    if given.is_null() {
        return Err(null(name));
    }
    // SAFETY: the first member of the struct.
    let size = unsafe { given.cast::<usize>().read_unaligned() };
    check_size::<T>(&format!("{name}.struct_size"), size)?;
    for at in size_of::<T>()..size {
        // SAFETY: within the size that the caller states.
        let byte = unsafe { given.cast::<u8>().add(at).read() };
        if byte != 0 {
            return Err(Error::invalid(format!(
                "{name}.struct_size: {size} is more than the {} bytes this version knows, and byte {at} is {byte}, not 0",
                size_of::<T>()
            )));
        }
    }
    Ok(size)
}

fn check_size<T: Versioned>(name: &str, size: usize) -> Result<()> {
    if size < T::FIRST_SIZE || size > LARGEST {
        return Err(Error::invalid(format!("{name}: {size} is not between {} and {LARGEST}", T::FIRST_SIZE)));
    }
    Ok(())
}

/// Reads a struct; members that the caller does not know have their defaults.
///
/// # Safety
/// `given` is NULL or points to a struct of the size that it states.
pub(super) unsafe fn read<T: Versioned>(name: &str, given: *const T) -> Result<T> {
    // SAFETY: the caller's promise.
    let size = unsafe { stated_size(name, given) }?;
    let mut value = MaybeUninit::new(T::DEFAULT);
    // SAFETY: both hold that many bytes, and any bytes are a value.
    unsafe {
        ptr::copy_nonoverlapping(given.cast::<u8>(), value.as_mut_ptr().cast(), size.min(size_of::<T>()));
        Ok(value.assume_init())
    }
}

/// [`read`], with NULL for the defaults.
///
/// # Safety
/// As [`read`].
pub(super) unsafe fn read_or_default<T: Versioned>(name: &str, given: *const T) -> Result<T> {
    if given.is_null() {
        return Ok(T::DEFAULT);
    }
    // SAFETY: the caller's promise.
    unsafe { read(name, given) }
}

/// Checks a struct that a result is written to and returns its size.
///
/// # Safety
/// As [`read`].
pub(super) unsafe fn result_size<T: Versioned>(name: &str, given: *const T) -> Result<usize> {
    // SAFETY: the caller's promise.
    unsafe { stated_size(name, given) }
}

/// Writes the part of `value` that a caller who states `size` knows; `struct_size` stays.
///
/// # Safety
/// `size` came from [`result_size`] of `out`, which may be written.
pub(super) unsafe fn write_result<T: Versioned>(out: *mut T, size: usize, value: T) {
    let skip = size_of::<usize>();
    let length = size.min(size_of::<T>()) - skip;
    // SAFETY: both hold that many bytes; padding is copied as it is.
    unsafe {
        ptr::copy_nonoverlapping((&raw const value).cast::<u8>().add(skip), out.cast::<u8>().add(skip), length);
    }
}

/// Fills a struct of `size` bytes with defaults: those members that fit, zero beyond those known.
///
/// # Safety
/// `out` is NULL or `size` bytes may be written there.
pub(super) unsafe fn init<T: Versioned>(name: &str, out: *mut T, size: usize) -> Result<()> {
    if out.is_null() {
        return Err(null(name));
    }
    check_size::<T>("size", size)?;
    // SAFETY: the caller's promise; `value` holds `size_of::<T>()` bytes.
    unsafe {
        ptr::write_bytes(out.cast::<u8>(), 0, size);
        let value = T::DEFAULT;
        ptr::copy_nonoverlapping((&raw const value).cast::<u8>(), out.cast(), size.min(size_of::<T>()));
        out.cast::<usize>().write_unaligned(size);
    }
    Ok(())
}
