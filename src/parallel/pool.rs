// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pools: own workers, or the caller's executor behind a trait.

use crate::error::{Error, Result, Status};

/// The caller's own way of running tasks in parallel: OpenMP, TBB, a task runtime.
pub trait Executor: Send + Sync {
    /// Calls `task(index)` for the indices below `tasks`, on any threads, and returns when every call
    /// it started has returned.
    fn run(&self, tasks: usize, task: &(dyn Fn(usize) + Sync));
}

/// Threads that calls may share. One pool may serve many calling threads at once.
pub struct Pool {
    width: usize,
    kind: Kind,
}

enum Kind {
    Alone,
    Own(rayon::ThreadPool),
    Caller(Box<dyn Executor>),
}

impl Pool {
    /// `threads` threads work on a call, the calling thread included: the pool owns `threads - 1`
    /// workers, none of them in rayon's global pool. `on_start` runs once on each worker.
    pub fn new(threads: usize, on_start: impl Fn() + Send + Sync + 'static) -> Result<Pool> {
        if threads == 0 || threads > 1 << 16 {
            return Err(Error::invalid(format!("threads: {threads} is not between 1 and 65536")));
        }
        if threads == 1 {
            return Ok(Pool { width: 1, kind: Kind::Alone });
        }
        let workers = rayon::ThreadPoolBuilder::new()
            .num_threads(threads - 1)
            .thread_name(|i| format!("embound-{i}"))
            .start_handler(move |_| on_start())
            .build()
            .map_err(|e| Error::new(Status::Memory, format!("threads: cannot start {} workers: {e}", threads - 1)))?;
        Ok(Pool { width: threads, kind: Kind::Own(workers) })
    }

    /// A pool over the caller's executor; `width` is how many tasks a call hands to it.
    pub fn from_executor(width: usize, executor: Box<dyn Executor>) -> Result<Pool> {
        if width == 0 || width > 1 << 16 {
            return Err(Error::invalid(format!("width: {width} is not between 1 and 65536")));
        }
        Ok(Pool { width, kind: Kind::Caller(executor) })
    }

    /// How many threads work on a call.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Runs `task` on up to `tasks` threads; returns when all have returned. The calling thread takes
    /// part, so progress does not hang on a worker being free.
    pub(super) fn run(&self, tasks: usize, task: &(dyn Fn(usize) + Sync)) {
        match &self.kind {
            Kind::Alone => task(0),
            Kind::Own(workers) => workers.in_place_scope(|scope| {
                for k in 1..tasks {
                    scope.spawn(move |_| task(k));
                }
                task(0);
            }),
            Kind::Caller(executor) => executor.run(tasks, task),
        }
    }
}
