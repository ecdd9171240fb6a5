// SPDX-License-Identifier: MIT OR Apache-2.0
//! Handles: what C holds is a counted reference. The opaque C type names the Rust type behind it, so
//! that a handle lent, cloned or freed as something else does not compile.

use crate::error::{Error, Result, Status};
use std::sync::Arc;

/// An opaque C type.
pub(super) trait Handle: Sized {
    /// What the handle refers to.
    type Target: Send + Sync;
}

/// Writes a new handle to `out`, which was checked.
///
/// # Safety
/// `out` may be written.
pub(super) unsafe fn give<H: Handle>(out: *mut *mut H, target: H::Target) {
    // SAFETY: the caller's promise.
    unsafe { out.write(Arc::into_raw(Arc::new(target)).cast_mut().cast()) }
}

/// The thing behind a handle, if there is one.
///
/// # Safety
/// `handle` is NULL or a handle that outlives `'a`.
pub(super) unsafe fn peek<'a, H: Handle>(handle: *const H) -> Option<&'a H::Target> {
    // SAFETY: a handle points to the target that `give` allocated.
    unsafe { handle.cast::<H::Target>().as_ref() }
}

/// The thing behind a handle, or [`Status::NullArgument`] naming the argument.
///
/// # Safety
/// `handle` is NULL or a handle that outlives `'a`.
pub(super) unsafe fn lend<'a, H: Handle>(name: &str, handle: *const H) -> Result<&'a H::Target> {
    // SAFETY: the caller's promise.
    unsafe { peek(handle) }.ok_or_else(|| null(name))
}

/// One more reference to the same thing; NULL for NULL.
///
/// # Safety
/// `handle` is NULL or a handle.
pub(super) unsafe fn share<H: Handle>(handle: *const H) -> *mut H {
    if !handle.is_null() {
        // SAFETY: a handle came from `Arc::into_raw` and still counts.
        unsafe { Arc::increment_strong_count(handle.cast::<H::Target>()) };
    }
    handle.cast_mut()
}

/// Gives up a reference; nothing for NULL.
///
/// # Safety
/// `handle` is NULL or a handle that is not used again.
pub(super) unsafe fn release<H: Handle>(handle: *mut H) {
    if !handle.is_null() {
        // SAFETY: a handle came from `Arc::into_raw` and still counts.
        drop(unsafe { Arc::from_raw(handle.cast::<H::Target>()) });
    }
}

/// [`Status::NullArgument`] naming the argument.
pub(super) fn null(name: &str) -> Error {
    Error::new(Status::NullArgument, format!("{name}: NULL"))
}

/// Checks a pointer that a result is written through.
pub(super) fn writable<T>(name: &str, out: *mut T) -> Result<()> {
    if out.is_null() {
        return Err(null(name));
    }
    aligned(name, out)
}

/// Checks that a pointer is fit for its type.
pub(super) fn aligned<T>(name: &str, data: *const T) -> Result<()> {
    if !data.is_aligned() {
        return Err(Error::invalid(format!("{name}: {data:p} is not aligned to {} bytes", align_of::<T>())));
    }
    Ok(())
}
