// SPDX-License-Identifier: MIT OR Apache-2.0
/// @file
/// A pool over the OpenMP threads of the calling program. embound.hpp includes it where OpenMP is on.
#ifndef EMBOUND_OPENMP_HPP
#define EMBOUND_OPENMP_HPP

#ifndef _OPENMP
#error "embound/openmp.hpp needs a compiler that runs with OpenMP (-fopenmp)"
#endif

#include "run.hpp"

#include <omp.h>

namespace embound {

/// A pool whose calls run in an OpenMP parallel region of `threads` threads; by default as many as
/// a region would have where the pool is made. Within a parallel region a call runs on the thread
/// that makes it, unless the program allows nested regions.
inline Pool openmp_pool(int threads = omp_get_max_threads()) {
    if (threads < 1) {
        throw Error(EMB_ERROR_INVALID_ARGUMENT, "threads: " + std::to_string(threads) + " is not at least 1");
    }
    return Pool::from_executor(static_cast<std::size_t>(threads), [threads](std::size_t tasks, Task task) {
        const auto count = static_cast<std::ptrdiff_t>(tasks);
#pragma omp parallel for schedule(static, 1) num_threads(threads)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            task(static_cast<std::size_t>(i));
        }
    });
}

} // namespace embound

#endif
