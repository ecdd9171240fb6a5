// SPDX-License-Identifier: MIT OR Apache-2.0
// What a function of the caller's throws reaches the C++ caller as it was thrown; a C caller gets
// NaN or EMB_ERROR_CALLBACK.
#include "support/check.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

namespace {

// Not a std::exception, on purpose.
struct Boom {
    int number;
};

// What `work` throws as a Boom; -1 where it throws nothing.
template <class Work> int boom(Work &&work) { return check::thrown<Boom>(work, Boom{-1}).number; }

embound::FunctionOptions exact_and_thread_safe() {
    embound::FunctionOptions options;
    options.kind = embound::Kind::Exact;
    options.lipschitz = 1.0;
    options.thread_safe = true;
    return options;
}

// A half space that throws where x > 0.5.
embound::Geometry throwing(int number = 7) {
    return embound::function(
        [number](double x, double, double) {
            if (x > 0.5) {
                throw Boom{number};
            }
            return x;
        },
        exact_and_thread_safe());
}

// Tasks on threads of this program, one each.
void run_on_threads(std::size_t tasks, embound::Task task) {
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < tasks; ++i) {
        threads.emplace_back([task, i] { task(i); });
    }
    task(0);
    for (std::thread &thread : threads) {
        thread.join();
    }
}

const std::vector<double> many = check::axis(-1.0, 1.0, 64);

} // namespace

TEST(a_throwing_function_throws_from_value) {
    const embound::Geometry g = throwing();
    CHECK(g(0.25, 0.0, 0.0) == 0.25);
    CHECK(boom([&] { g(0.75, 0.0, 0.0); }) == 7);
    CHECK(g(0.25, 0.0, 0.0) == 0.25);
}

TEST(a_throwing_function_throws_through_a_tree) {
    const embound::Geometry moved = embound::translate(throwing(9), {10.0, 0.0, 0.0});
    const embound::Geometry g = embound::unite(embound::sphere({0.0, 0.0, 0.0}, 1.0), embound::complement(moved));
    CHECK(boom([&] { g(10.75, 0.0, 0.0); }) == 9);
    const embound::Geometry copy = g;
    CHECK(boom([&] { copy(10.75, 0.0, 0.0); }) == 9);
}

TEST(a_throwing_function_throws_from_every_question) {
    const embound::Geometry g = throwing();
    const std::vector<embound::Point> inside{{0.0, 0.0, 0.0}}, outside{{0.9, 0.0, 0.0}};
    const std::vector<double> axis = check::axis(-1.0, 1.0, 9);
    const embound::Lattice lattice(axis, axis, axis);
    CHECK(boom([&] { g.values(outside); }) == 7);
    CHECK(boom([&] { g.closest(outside); }) == 7);
    CHECK(boom([&] { g.fill(lattice); }) == 7);
    CHECK(boom([&] { g.fill(lattice, embound::FillMode::Sign); }) == 7);
    CHECK(boom([&] { g.crossings(lattice, 0); }) == 7);
    CHECK(boom([&] { g.intercepts(inside, outside); }) == 7);
    CHECK(boom([&] { g.values(std::vector<float>{0.9f, 0.0f, 0.0f}); }) == 7);
    CHECK(g.values(inside)[0] == 0.0);
}

TEST(exceptions_cross_from_an_executors_threads) {
    std::atomic<int> on_worker{0};
    const std::thread::id caller = std::this_thread::get_id();
    // The calling thread waits for the other, so that the throw happens there.
    const embound::Geometry g = embound::function(
        [&](double, double, double) -> double {
            if (std::this_thread::get_id() != caller) {
                ++on_worker;
                throw Boom{3};
            }
            for (int i = 0; i < 5000 && on_worker == 0; ++i) {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            return 1.0;
        },
        exact_and_thread_safe());
    const embound::Lattice lattice(many, many, many);
    CHECK(boom([&] { g.fill(lattice, embound::FillMode::Exact, embound::Pool::from_executor(2, run_on_threads)); }) == 3);
    CHECK(on_worker > 0);
    on_worker = 0;
    CHECK(boom([&] { g.fill(lattice, embound::FillMode::Exact, embound::Pool(2)); }) == 3);
    CHECK(on_worker > 0);
}

TEST(calls_at_once_get_their_own_exceptions) {
    const embound::Pool pool = embound::Pool::from_executor(2, run_on_threads);
    const embound::Lattice lattice(many, many, many);
    std::atomic<int> wrong{0};
    std::vector<std::thread> callers;
    for (int number = 0; number < 4; ++number) {
        callers.emplace_back([&, number] {
            const embound::Geometry g = throwing(number);
            for (int i = 0; i < 20; ++i) {
                wrong += boom([&] { g.fill(lattice, embound::FillMode::Exact, pool); }) == number ? 0 : 1;
                wrong += boom([&] { g.fill(lattice); }) == number ? 0 : 1;
                wrong += boom([&] { g(0.75, 0.0, 0.0); }) == number ? 0 : 1;
            }
        });
    }
    for (std::thread &caller : callers) {
        caller.join();
    }
    CHECK(wrong == 0);
}

TEST(a_call_that_succeeds_gets_no_exception_of_another) {
    const embound::Pool pool(2);
    const embound::Lattice lattice(many, many, many);
    std::atomic<bool> done{false};
    std::thread thrower([&] {
        const embound::Geometry g = throwing();
        while (!done) {
            boom([&] { g.fill(lattice, embound::FillMode::Exact, pool); });
        }
    });
    const embound::Geometry calm = embound::sphere({0.0, 0.0, 0.0}, 0.5);
    const std::vector<double> expected = calm.fill(lattice);
    bool same = true;
    for (int i = 0; i < 20; ++i) {
        same = same && calm.fill(lattice, embound::FillMode::Exact, pool) == expected;
    }
    done = true;
    thrower.join();
    CHECK(same);
}

TEST(a_function_not_marked_thread_safe_stays_on_the_calling_thread) {
    const std::thread::id caller = std::this_thread::get_id();
    embound::FunctionOptions options = exact_and_thread_safe();
    options.thread_safe = false;
    const embound::Geometry g = embound::function(
        [caller](double x, double, double) {
            if (std::this_thread::get_id() != caller) {
                throw Boom{1};
            }
            return x;
        },
        options);
    const embound::Lattice lattice(many, many, many);
    CHECK(check::same_bits(g.fill(lattice, embound::FillMode::Exact, embound::Pool(2)), g.fill(lattice)));
}

TEST(plain_c_gets_nan_or_a_status) {
    const embound::Geometry g = throwing();
    CHECK(std::isnan(emb_geom_value(g.get(), 0.75, 0.0, 0.0)));
    const double p[3] = {0.75, 0.0, 0.0};
    double value = 0.0;
    CHECK(emb_geom_values(g.get(), 1, p, p + 1, p + 2, 3, nullptr, &value) == EMB_ERROR_CALLBACK);
    CHECK(std::strlen(emb_last_error()) > 0);
    CHECK(g(0.25, 0.0, 0.0) == 0.25); // nothing is left over
    const double nan = std::nan("");
    CHECK(std::isnan(g(nan, 0.0, 0.0)));
}

TEST(a_function_that_answers_nan_is_a_callback_error) {
    const embound::Geometry g = embound::function([](double, double, double) { return std::nan(""); });
    CHECK(std::isnan(g(0.0, 0.0, 0.0)));
    const std::vector<double> origin{0.0, 0.0, 0.0};
    CHECK(check::status_of([&] { g.values(origin); }) == EMB_ERROR_CALLBACK);
}

TEST(functions_may_ask_geometries) {
    const embound::Geometry inner = throwing(5);
    const embound::Geometry outer = embound::function([inner](double x, double y, double z) { return inner(x, y, z) - 1.0; });
    CHECK(outer(0.25, 0.0, 0.0) == -0.75);
    CHECK(boom([&] { outer(0.75, 0.0, 0.0); }) == 5);
    const embound::Geometry careful = embound::function([inner](double x, double y, double z) {
        try {
            return inner(x, y, z);
        } catch (const Boom &) {
            return 42.0;
        }
    });
    CHECK(careful(0.75, 0.0, 0.0) == 42.0);
    CHECK(careful.values(std::vector<double>{0.75, 0.0, 0.0})[0] == 42.0);
}

TEST(progress_tells_stops_and_throws) {
    const embound::Geometry g = embound::sphere({0.0, 0.0, 0.0}, 0.5);
    const embound::Lattice lattice(many, many, many);
    const std::thread::id caller = std::this_thread::get_id();
    for (const std::size_t threads : {std::size_t{1}, std::size_t{2}}) {
        const embound::Pool pool(threads);
        double last = 0.0;
        bool in_order = true, here = true;
        g.fill(lattice, embound::FillMode::Exact, embound::Run(pool).progress([&](double fraction) {
            in_order = in_order && fraction >= last;
            here = here && std::this_thread::get_id() == caller;
            last = fraction;
        }));
        CHECK(in_order && here && last == 1.0);
        const auto stop = embound::Run(pool).progress([](double) { return true; });
        CHECK(check::status_of([&] { g.fill(lattice, embound::FillMode::Exact, stop); }) == EMB_ERROR_CANCELLED);
        const auto fail = embound::Run(pool).progress([](double) -> bool { throw Boom{11}; });
        CHECK(boom([&] { g.fill(lattice, embound::FillMode::Exact, fail); }) == 11);
    }
}

TEST(what_an_executor_throws_reaches_the_caller) {
    const embound::Pool pool = embound::Pool::from_executor(2, [](std::size_t, const embound::Task &) { throw Boom{13}; });
    const embound::Geometry g = embound::sphere({0.0, 0.0, 0.0}, 0.5);
    const embound::Lattice lattice(many, many, many);
    std::vector<double> values(lattice.points());
    CHECK(boom([&] { g.fill(lattice, values, embound::FillMode::Exact, pool); }) == 13);
}
