// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// Statuses become exceptions, and exceptions thrown in callbacks are carried across the C functions.
#ifndef EMBOUND_ERROR_HPP
#define EMBOUND_ERROR_HPP

#include "../embound.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// One type and one state for the process, also where a project compiles with hidden visibility.
#if defined(__GNUC__)
#define EMBOUND_VISIBLE __attribute__((visibility("default")))
#else
#define EMBOUND_VISIBLE
#endif

namespace embound {

/// What every function of this layer throws when embound refuses: the status, and as what() one
/// line that names the argument and the offending value or index.
class EMBOUND_VISIBLE Error : public std::runtime_error {
public:
    /// An error of this status.
    Error(emb_status status, const std::string &message) : std::runtime_error(message), status_(status) {}

    /// One of EMB_ERROR_NULL_ARGUMENT ... EMB_ERROR_INTERNAL.
    emb_status status() const noexcept { return status_; }

private:
    emb_status status_;
};

/// Throws Error with emb_last_error() unless `status` is EMB_OK. For code that calls C functions itself.
inline void check(emb_status status) {
    if (status != EMB_OK) {
        throw Error(status, emb_last_error());
    }
}

namespace detail {

/// A call into the library that may call back. It keeps the first exception that a callback throws
/// on behalf of this call, on whatever thread, until the library has returned.
///
/// Which call a callback serves is known exactly on the calling thread and in the tasks of a C++
/// executor, where `current()` says so. The library's own workers cannot tell: what is thrown there
/// is offered to every call that shares its work with a pool of threads at that moment, and a call
/// rethrows it only if the library says that a callback of its own failed.
class EMBOUND_VISIBLE Frame {
public:
    explicit Frame(bool pooled) : outer_(current()), pooled_(pooled) {
        if (pooled_) {
            const std::lock_guard<std::mutex> lock(registry().mutex);
            registry().frames.push_back(this);
        }
        current() = this;
    }

    ~Frame() {
        current() = outer_;
        withdraw();
    }

    Frame(const Frame &) = delete;
    Frame &operator=(const Frame &) = delete;

    /// The innermost call of this thread; null outside of calls and on the library's workers.
    static Frame *&current() noexcept {
        static thread_local Frame *frame = nullptr;
        return frame;
    }

    /// Keeps the exception being handled for the call it belongs to. Called from plain C, there is
    /// none: the callback's failure is then told by its result alone.
    static void keep_exception() noexcept {
        if (Frame *frame = current()) {
            frame->thrown_.offer(std::current_exception());
            return;
        }
        const std::lock_guard<std::mutex> lock(registry().mutex);
        for (Frame *frame : registry().frames) {
            frame->from_worker_.offer(std::current_exception());
        }
    }

    /// After the library returned `status`: rethrows what a callback threw, throws Error otherwise.
    void finish(emb_status status) {
        withdraw();
        rethrow();
        if (status == EMB_ERROR_CALLBACK && from_worker_.exception) {
            std::rethrow_exception(from_worker_.exception);
        }
        check(status);
    }

    /// Rethrows what a callback threw on this thread or in a task of this call.
    void rethrow() {
        if (thrown_.exception) {
            std::rethrow_exception(thrown_.exception);
        }
    }

private:
    struct Slot {
        std::atomic<bool> taken{false};
        std::exception_ptr exception;

        void offer(std::exception_ptr thrown) noexcept {
            if (!taken.exchange(true)) {
                exception = std::move(thrown);
            }
        }
    };

    struct Registry {
        std::mutex mutex;
        std::vector<Frame *> frames;
    };

    static Registry &registry() noexcept {
        static Registry instance;
        return instance;
    }

    void withdraw() noexcept {
        if (pooled_) {
            pooled_ = false;
            Registry &all = registry();
            const std::lock_guard<std::mutex> lock(all.mutex);
            all.frames.erase(std::remove(all.frames.begin(), all.frames.end(), this), all.frames.end());
        }
    }

    Frame *outer_;
    bool pooled_;
    Slot thrown_;
    Slot from_worker_;
};

/// Runs `work`, which returns an emb_status and may call back.
template <class Work> void call(bool pooled, Work &&work) {
    Frame frame(pooled);
    frame.finish(std::forward<Work>(work)());
}

/// Runs `allocate`; memory that cannot be had becomes EMB_ERROR_MEMORY, as in the C functions.
template <class Allocate> auto allocated(const char *what, Allocate &&allocate) {
    try {
        return std::forward<Allocate>(allocate)();
    } catch (const std::bad_alloc &) {
    } catch (const std::length_error &) {
    }
    throw Error(EMB_ERROR_MEMORY, std::string(what) + ": cannot be allocated");
}

/// `count` values, or EMB_ERROR_MEMORY.
template <class T> std::vector<T> vector_of(std::size_t count) {
    return allocated(("result: " + std::to_string(count) + " values").c_str(), [&] { return std::vector<T>(count); });
}

/// Asks `create(&handle)` for a handle.
template <class Handle, class Create> Handle *created(Create &&create) {
    Handle *handle = nullptr;
    check(std::forward<Create>(create)(&handle));
    return handle;
}

} // namespace detail
} // namespace embound

#endif
