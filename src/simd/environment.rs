// SPDX-License-Identifier: MIT OR Apache-2.0
//! The floating-point environment: results do not depend on the caller's rounding mode, flush-to-zero
//! flags or traps, and the caller finds its environment, sticky flags included, as it left it. The
//! user's callbacks run in the environment of the thread that made the call, on whatever thread they run.

use std::cell::Cell;

/// A saved control and status word.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Environment(u64);

thread_local! {
    /// The environment of the caller that this thread works for: that of the user's callbacks.
    static CALLER: Cell<Option<Environment>> = const { Cell::new(None) };
}

/// Restores the environment that it saved when dropped, so a panic restores it too. Writing the word
/// costs several times what reading it does, and it rarely differs.
struct Restore(Environment);

impl Drop for Restore {
    #[inline]
    fn drop(&mut self) {
        if current() != self.0 {
            set(self.0);
        }
    }
}

/// Restores the caller that it saved when dropped.
struct RestoreCaller(Option<Environment>);

impl Drop for RestoreCaller {
    fn drop(&mut self) {
        CALLER.set(self.0);
    }
}

/// Runs the work of an entry from outside: in the default environment, for a caller in the present one.
#[inline]
pub(crate) fn enter<R>(work: impl FnOnce() -> R) -> R {
    on_behalf_of(Some(current()), work)
}

/// The caller that this thread works for, to be handed to the threads that share its work.
pub(crate) fn caller() -> Option<Environment> {
    CALLER.get()
}

/// Runs `work` in the default environment, for `caller`.
#[inline]
pub(crate) fn on_behalf_of<R>(caller: Option<Environment>, work: impl FnOnce() -> R) -> R {
    let _restore = RestoreCaller(CALLER.replace(caller));
    with_default(work)
}

/// Runs a user's callback, in the environment of the caller that this thread works for.
pub(crate) fn as_caller<R>(work: impl FnOnce() -> R) -> R {
    match CALLER.get() {
        Some(environment) => with(environment, work),
        None => work(),
    }
}

/// Runs `work` in the default environment (round to nearest, denormals kept, traps masked) and
/// restores the present one.
#[inline]
pub(crate) fn with_default<R>(work: impl FnOnce() -> R) -> R {
    let present = current();
    let _restore = Restore(present);
    if present.control() != DEFAULT.control() {
        set(DEFAULT);
    }
    apart(work)
}

/// Runs `work` in `environment` and restores the present one.
pub(crate) fn with<R>(environment: Environment, work: impl FnOnce() -> R) -> R {
    let _restore = Restore(current());
    set(environment);
    apart(work)
}

/// Not inlined: the compiler must not move arithmetic across the change of environment.
#[inline(never)]
fn apart<R>(work: impl FnOnce() -> R) -> R {
    work()
}

impl Environment {
    /// All but the sticky flags.
    #[inline]
    fn control(self) -> u64 {
        self.0 & !STICKY
    }
}

#[cfg(target_arch = "x86_64")]
const DEFAULT: Environment = Environment(0x1F80);

#[cfg(target_arch = "x86_64")]
const STICKY: u64 = 0x3F;

/// The environment of this thread.
#[cfg(target_arch = "x86_64")]
#[inline]
pub(crate) fn current() -> Environment {
    let mut word: u32 = 0;
    // SAFETY: stmxcsr stores 32 bits to the place given.
    unsafe { std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut word, options(nostack)) };
    Environment(u64::from(word))
}

#[cfg(target_arch = "x86_64")]
fn set(environment: Environment) {
    let word = environment.0 as u32;
    // SAFETY: the word is the default one or one that stmxcsr stored, so no reserved bit is set.
    unsafe { std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const word, options(nostack)) };
}

#[cfg(target_arch = "aarch64")]
const DEFAULT: Environment = Environment(0);

#[cfg(target_arch = "aarch64")]
const STICKY: u64 = 0xFFFF_FFFF << 32;

/// The environment of this thread: FPCR below, FPSR above.
#[cfg(target_arch = "aarch64")]
pub(crate) fn current() -> Environment {
    let (control, status): (u64, u64);
    // SAFETY: reads two registers that every thread may read.
    unsafe { std::arch::asm!("mrs {}, fpcr", "mrs {}, fpsr", out(reg) control, out(reg) status, options(nostack)) };
    Environment(control & 0xFFFF_FFFF | status << 32)
}

#[cfg(target_arch = "aarch64")]
fn set(environment: Environment) {
    let (control, status) = (environment.0 & 0xFFFF_FFFF, environment.0 >> 32);
    // SAFETY: the words are the default ones or were read from the same registers.
    unsafe { std::arch::asm!("msr fpcr, {}", "msr fpsr, {}", in(reg) control, in(reg) status, options(nostack)) };
}
