// SPDX-License-Identifier: MIT OR Apache-2.0
// What every example says of itself: how long things took, what was found wrong, and what it ends with.
#ifndef EXAMPLES_REPORT_HPP
#define EXAMPLES_REPORT_HPP

#include <embound.hpp>

#include <chrono>
#include <cstdint>
#include <string>

// Seconds that `work` takes.
template <class Work> double seconds(Work &&work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// A time with three figures and its unit.
std::string in_words(double time);

// "exact", "lower bound" or "sign only".
const char *in_words(embound::Kind kind);

// Ends the example: throws std::runtime_error.
[[noreturn]] void fail(const std::string &message);

// The same where something does not hold.
inline void require(bool holds, const std::string &message) {
    if (!holds) {
        fail(message);
    }
}

// The whole number that an argument is; fails where it is none.
std::uint64_t whole_number(const std::string &argument);

// The first line: version, instruction set, threads.
void print_library(const embound::Pool &pool);

// Makes demo-out/ below the directory the program runs in, and gives the path of a file in it.
std::string in_demo_out(const std::string &file);

// Runs an example: what it throws is printed, and the exit code is then 1.
int run_example(const char *name, void (*example)(int argc, char **argv), int argc, char **argv);

#endif
