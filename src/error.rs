// SPDX-License-Identifier: MIT OR Apache-2.0
//! The one error type: a status, and one line that names the argument and the offending value.

use std::any::Any;
use std::cell::Cell;
use std::fmt;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

/// What went wrong, as the C ABI numbers it. Values are never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Status {
    /// A required argument was NULL.
    NullArgument = -1,
    /// An argument's value is outside what the function takes.
    InvalidArgument = -2,
    /// A file could not be read or written.
    Io = -3,
    /// A file's content is not what its format asks for.
    Parse = -4,
    /// The request is understood but this version or this geometry cannot do it.
    Unsupported = -5,
    /// The mesh is unfit for the sign asked for.
    Topology = -6,
    /// The progress callback asked to stop.
    Cancelled = -7,
    /// A user's callback failed.
    Callback = -8,
    /// Memory could not be had.
    Memory = -9,
    /// A defect in embound itself.
    Internal = -99,
}

/// A [`Status`] with its message: one line, naming the argument and the value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    status: Status,
    message: String,
}

/// The result of every fallible function of the crate.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// An error of this status. Control characters (a path may hold a line feed) become spaces, so
    /// the message stays one line.
    pub fn new(status: Status, message: impl Into<String>) -> Error {
        let mut message: String = message.into();
        if message.chars().any(char::is_control) {
            message = message.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        }
        Error { status, message }
    }

    /// [`Status::InvalidArgument`].
    pub fn invalid(message: impl Into<String>) -> Error {
        Error::new(Status::InvalidArgument, message)
    }

    /// [`Status::Parse`].
    pub fn parse(message: impl Into<String>) -> Error {
        Error::new(Status::Parse, message)
    }

    /// [`Status::Unsupported`].
    pub fn unsupported(message: impl Into<String>) -> Error {
        Error::new(Status::Unsupported, message)
    }

    /// [`Status::Memory`], naming what was being allocated and how large it was.
    pub fn memory(what: &str, count: usize) -> Error {
        Error::new(Status::Memory, format!("cannot allocate {count} {what}"))
    }

    /// The status.
    pub fn status(&self) -> Status {
        self.status
    }

    /// The message: one line.
    pub fn message(&self) -> &str {
        &self.message
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

/// An empty vector with room for `count` elements, or [`Status::Memory`]. Every size that comes
/// from input is reserved through here.
pub fn try_with_capacity<T>(what: &str, count: usize) -> Result<Vec<T>> {
    let mut v = Vec::new();
    v.try_reserve_exact(count).map_err(|_| Error::memory(what, count))?;
    Ok(v)
}

/// `count` copies of `value`, or [`Status::Memory`].
pub(crate) fn filled<T: Clone>(what: &str, count: usize, value: T) -> Result<Vec<T>> {
    let mut v = try_with_capacity(what, count)?;
    v.resize(count, value);
    Ok(v)
}

/// A copy, or [`Status::Memory`].
pub(crate) fn try_copy<T: Copy>(what: &str, values: &[T]) -> Result<Vec<T>> {
    let mut copy = try_with_capacity(what, values.len())?;
    copy.extend_from_slice(values);
    Ok(copy)
}

thread_local!(static GUARDED: Cell<usize> = const { Cell::new(0) });

/// Runs `work`; a panic in it, which is a defect in embound, becomes [`Status::Internal`] and prints
/// nothing. Panics of the rest of the process reach the hook that was there before.
pub(crate) fn catch<R>(work: impl FnOnce() -> Result<R>) -> Result<R> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if GUARDED.with(Cell::get) == 0 {
                before(info);
            }
        }));
    });
    GUARDED.with(|depth| depth.set(depth.get() + 1));
    let outcome = panic::catch_unwind(AssertUnwindSafe(work));
    GUARDED.with(|depth| depth.set(depth.get() - 1));
    outcome.unwrap_or_else(|payload| Err(Error::new(Status::Internal, describe(payload.as_ref()))))
}

fn describe(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied().or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    format!("a defect in embound: {}", text.unwrap_or("panic without a message"))
}
