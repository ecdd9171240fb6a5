// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// How a call runs: on which threads, telling whom how far it is.
#ifndef EMBOUND_RUN_HPP
#define EMBOUND_RUN_HPP

#include "error.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <type_traits>

namespace embound {

/// What an executor is given to run: call it once for each index below the number of tasks, on any
/// threads, and return when all have returned. It throws nothing.
class Task {
public:
    /// As embound hands it over.
    Task(void (*task)(void *context, std::size_t index), void *context) noexcept
        : task_(task), context_(context), frame_(detail::Frame::current()) {}

    /// Runs task `index`.
    void operator()(std::size_t index) const noexcept {
        detail::Frame *&current = detail::Frame::current();
        detail::Frame *const before = current;
        current = frame_;
        task_(context_, index);
        current = before;
    }

private:
    void (*task_)(void *, std::size_t);
    void *context_;
    detail::Frame *frame_;
};

/// Threads that calls may share. A copy is another handle on the same threads; they end with the
/// last. One pool may serve many calling threads at once, and calls from within its own tasks.
class Pool {
public:
    /// `threads` threads, the calling one included, in the process's CPU affinity; 0: as many as
    /// the process may use.
    explicit Pool(std::size_t threads = 0)
        : Pool(detail::created<emb_pool>([&](emb_pool **out) { return emb_pool_new(threads, out); })) {}

    /// Adopts a handle.
    explicit Pool(emb_pool *pool) : handle_(pool, emb_pool_free) {}

    /// The caller's own threads: `executor(std::size_t tasks, embound::Task task)` calls task(0) to
    /// task(tasks - 1) in whatever way and order and returns when all have returned, or throws
    /// after they have; `width` is how many tasks a call hands over at most. It is called from
    /// whichever threads use the pool, at once if they do.
    template <class Executor> static Pool from_executor(std::size_t width, Executor executor) {
        auto kept = std::make_unique<Executor>(std::move(executor));
        emb_pool *pool = detail::created<emb_pool>(
            [&](emb_pool **out) { return emb_pool_from_callback(width, run<Executor>, kept.get(), drop<Executor>, out); });
        static_cast<void>(kept.release());
        return Pool(pool);
    }

    /// How many threads or tasks a call is shared between.
    std::size_t width() const noexcept { return emb_pool_width(handle_.get()); }

    /// Lends the handle: valid as long as a copy of this pool is.
    const emb_pool *get() const noexcept { return handle_.get(); }

private:
    friend class Run;

    template <class Executor>
    static void run(void *user, std::size_t tasks, void (*task)(void *, std::size_t), void *context) {
        try {
            (*static_cast<Executor *>(user))(tasks, Task(task, context));
        } catch (...) {
            detail::Frame::keep_exception();
        }
    }

    template <class Executor> static void drop(void *user) { delete static_cast<Executor *>(user); }

    std::shared_ptr<emb_pool> handle_;
};

/// How a call runs. By default on the calling thread, silently.
class Run {
public:
    /// On the calling thread, silently.
    Run() = default;
    /// On a pool.
    Run(const Pool &pool) : pool_(pool.handle_) {}

    /// Tells `callback(double fraction)` how far the call is, from 0 to 1, on the calling thread
    /// only. It may return bool: true stops the call, which then throws Error with
    /// EMB_ERROR_CANCELLED; what it throws reaches the caller.
    template <class Callback> Run &progress(Callback callback) & {
        progress_ = [callback = std::move(callback)](double fraction) mutable -> bool {
            if constexpr (std::is_void_v<decltype(callback(fraction))>) {
                callback(fraction);
                return false;
            } else {
                return callback(fraction);
            }
        };
        return *this;
    }
    /// The same, for `Run(pool).progress(...)`.
    template <class Callback> Run &&progress(Callback callback) && {
        progress(std::move(callback));
        return std::move(*this);
    }

    /// Whether the work is shared with other threads.
    bool pooled() const noexcept { return pool_ != nullptr; }

    /// As the C functions take it; valid as long as this object is and stays where it is.
    emb_run c() const noexcept {
        emb_run run{};
        run.struct_size = sizeof run;
        run.pool = pool_.get();
        if (progress_) {
            run.progress = tell;
            run.user = const_cast<void *>(static_cast<const void *>(&progress_));
        }
        return run;
    }

private:
    static std::int32_t tell(void *user, double fraction) {
        try {
            return (*static_cast<const std::function<bool(double)> *>(user))(fraction) ? 1 : 0;
        } catch (...) {
            detail::Frame::keep_exception();
            return 1;
        }
    }

    std::shared_ptr<const emb_pool> pool_;
    std::function<bool(double)> progress_;
};

namespace detail {

/// Runs `work(const emb_run *)`, which returns an emb_status and may call back.
template <class Work> void call(const Run &run, Work &&work) {
    const emb_run c = run.c();
    call(run.pooled(), [&] { return std::forward<Work>(work)(&c); });
}

} // namespace detail
} // namespace embound

#endif
