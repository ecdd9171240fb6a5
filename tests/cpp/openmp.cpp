// SPDX-License-Identifier: MIT OR Apache-2.0
// Pools over the program's OpenMP threads. Only this file of the program is compiled with OpenMP.
#include "support/check.hpp"

#ifdef _OPENMP

#include <array>
#include <atomic>
#include <chrono>
#include <thread>

namespace {

const std::vector<double> axis = check::axis(-1.0, 1.0, 48);
const embound::Lattice lattice(axis, axis, axis);

embound::Geometry body() {
    return embound::difference(embound::box({-0.6, -0.5, -0.4}, {0.6, 0.5, 0.4}), embound::sphere({0.3, 0.0, 0.1}, 0.45));
}

} // namespace

TEST(openmp_has_the_bits_of_one_thread) {
    const std::vector<double> serial = body().fill(lattice);
    for (const int threads : {1, 2, 3, 8}) {
        const embound::Pool pool = embound::openmp_pool(threads);
        CHECK(pool.width() == static_cast<std::size_t>(threads));
        CHECK(check::same_bits(serial, body().fill(lattice, embound::FillMode::Exact, pool)));
    }
    CHECK(check::same_bits(serial, body().fill(lattice, embound::FillMode::Exact, embound::openmp_pool())));
    CHECK(check::status_of([] { embound::openmp_pool(0); }, "threads") == EMB_ERROR_INVALID_ARGUMENT);
}

TEST(openmp_pools_work_within_parallel_regions) {
    const embound::Geometry g = body();
    const std::vector<double> serial = g.fill(lattice);
    const embound::Pool pool = embound::openmp_pool(2);
    std::array<std::vector<double>, 4> filled;
#pragma omp parallel for num_threads(4)
    for (std::size_t i = 0; i < filled.size(); ++i) {
        filled[i] = g.fill(lattice, embound::FillMode::Exact, pool);
    }
    for (const std::vector<double> &values : filled) {
        CHECK(check::same_bits(serial, values));
    }
}

TEST(openmp_works_from_several_threads_at_once) {
    const embound::Geometry g = body();
    const std::vector<double> serial = g.fill(lattice);
    const embound::Pool pool = embound::openmp_pool(2);
    std::array<std::vector<double>, 3> filled;
    std::vector<std::thread> callers;
    for (std::vector<double> &values : filled) {
        callers.emplace_back([&] { values = g.fill(lattice, embound::FillMode::Exact, pool); });
    }
    for (std::thread &caller : callers) {
        caller.join();
    }
    for (const std::vector<double> &values : filled) {
        CHECK(check::same_bits(serial, values));
    }
}

TEST(exceptions_cross_openmp) {
    std::atomic<bool> on_worker{false};
    const std::thread::id caller = std::this_thread::get_id();
    embound::FunctionOptions options;
    options.thread_safe = true;
    // The calling thread waits for the other, so that the throw happens there.
    const embound::Geometry g = embound::function(
        [&](double, double, double) -> double {
            if (std::this_thread::get_id() != caller) {
                on_worker = true;
                throw 31;
            }
            for (int i = 0; i < 5000 && !on_worker; ++i) {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            return 1.0;
        },
        options);
    CHECK(check::thrown<int>([&] { g.fill(lattice, embound::FillMode::Sign, embound::openmp_pool(2)); }, 0) == 31);
    CHECK(on_worker);
}

#else

TEST(without_openmp_there_is_no_openmp_pool) {
#ifdef EMBOUND_OPENMP_HPP
    CHECK(false);
#endif
    std::printf("this compiler has no OpenMP: its pools are not tested\n");
}

#endif
