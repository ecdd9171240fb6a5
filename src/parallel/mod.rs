// SPDX-License-Identifier: MIT OR Apache-2.0
//! How a call runs: on the caller's thread, on a pool of own workers, or over the caller's executor.
//! The only place that names rayon.
//!
//! Work is a number of chunks. Every participating thread, the calling thread always among them,
//! takes the next chunk from one counter until none is left. So an executor that runs its tasks one
//! after another, runs some of them twice or only runs one is still answered correctly, calls from
//! within a pool's own tasks cannot deadlock, and results cannot depend on the number of threads.

mod pool;

pub use pool::{Executor, Pool};

use crate::error::{self, Error, Result, Status};
use crate::simd::environment::{self, Environment};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

/// Told the fraction done; `true` stops the call. Only ever called on the calling thread.
pub type Progress<'a> = &'a (dyn Fn(f64) -> bool + Sync);

/// How a call runs. The default: on the caller's thread, silently.
#[derive(Clone, Copy, Default)]
pub struct Run<'a> {
    /// Threads to share the work with.
    pub pool: Option<&'a Pool>,
    /// Progress and cancellation.
    pub progress: Option<Progress<'a>>,
}

impl<'a> Run<'a> {
    /// On the caller's thread, silently.
    pub const SERIAL: Run<'static> = Run { pool: None, progress: None };

    /// The same run without its pool: for work that must stay on the calling thread.
    pub fn on_this_thread(&self) -> Run<'a> {
        Run { pool: None, progress: self.progress }
    }

    /// The same run without its progress: for a part of the work that what comes after it tells of.
    pub(crate) fn silent(&self) -> Run<'a> {
        Run { pool: self.pool, progress: None }
    }

    /// Calls `work` once for each index below `chunks`. Of several failures the one of the lowest
    /// index that was reached is returned; a panic in `work` is [`Status::Internal`]. Progress is told
    /// after each chunk that the calling thread finishes, and 1 at the end.
    pub fn for_each_chunk(&self, chunks: usize, work: &(dyn Fn(usize) -> Result<()> + Sync)) -> Result<()> {
        if chunks == 0 {
            return Ok(());
        }
        let job = Job {
            chunks,
            work,
            run: self,
            caller: thread::current().id(),
            environment: environment::caller(),
            next: AtomicUsize::new(0),
            done: AtomicUsize::new(0),
            stop: AtomicBool::new(false),
            failure: Mutex::new(None),
        };
        match self.pool {
            Some(pool) if chunks > 1 && pool.width() > 1 => pool.run(pool.width().min(chunks), &|_| job.take_chunks()),
            _ => {}
        }
        job.take_chunks();
        job.finish()
    }

    /// Calls `work` with pieces of `all` of up to `size`, and where each begins.
    pub(crate) fn for_each_piece<T: Send>(
        &self,
        all: &mut [T],
        size: usize,
        work: &(dyn Fn(usize, &mut [T]) -> Result<()> + Sync),
    ) -> Result<()> {
        let mut pieces = error::try_with_capacity("pieces", all.len().div_ceil(size))?;
        pieces.extend(all.chunks_mut(size).map(Mutex::new));
        self.for_each_chunk(pieces.len(), &|k| {
            let mut piece = pieces[k].lock().unwrap_or_else(|poisoned| poisoned.into_inner());
            work(k * size, &mut piece)
        })
    }

    /// Tells the progress; [`Status::Cancelled`] where it asks to stop. Only from the calling thread.
    pub fn tell(&self, fraction: f64) -> Result<()> {
        match self.progress {
            Some(progress) if progress(fraction) => {
                Err(Error::new(Status::Cancelled, "progress: the callback asked to stop"))
            }
            _ => Ok(()),
        }
    }
}

struct Job<'a> {
    chunks: usize,
    work: &'a (dyn Fn(usize) -> Result<()> + Sync),
    run: &'a Run<'a>,
    caller: thread::ThreadId,
    environment: Option<Environment>,
    next: AtomicUsize,
    done: AtomicUsize,
    stop: AtomicBool,
    failure: Mutex<Option<(usize, Error)>>,
}

impl Job<'_> {
    fn take_chunks(&self) {
        environment::on_behalf_of(self.environment, || {
            while !self.stop.load(Ordering::Relaxed) {
                let k = self.next.fetch_add(1, Ordering::Relaxed);
                if k >= self.chunks {
                    // Keeps the counter from ever wrapping.
                    self.next.store(self.chunks, Ordering::Relaxed);
                    break;
                }
                self.run_chunk(k);
            }
        });
    }

    fn run_chunk(&self, k: usize) {
        if let Err(error) = error::catch(|| (self.work)(k)) {
            self.fail(k, error);
            return;
        }
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if done < self.chunks
            && thread::current().id() == self.caller
            && let Err(stop) = self.run.tell(done as f64 / self.chunks as f64)
        {
            self.fail(usize::MAX, stop);
        }
    }

    fn fail(&self, k: usize, error: Error) {
        self.stop.store(true, Ordering::Relaxed);
        if let Ok(mut slot) = self.failure.lock()
            && slot.as_ref().is_none_or(|(at, _)| k < *at)
        {
            *slot = Some((k, error));
        }
    }

    fn finish(self) -> Result<()> {
        let failure = self.failure.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        match failure {
            Some((_, error)) => Err(error),
            None => self.run.tell(1.0),
        }
    }
}
