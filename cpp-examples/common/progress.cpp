// SPDX-License-Identifier: MIT OR Apache-2.0
// Progress on a terminal, and in a log.
#include "progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

Progress::Progress(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
    if (shown_) {
        std::fputs(terminal_ ? "\r\x1b[K" : "\n", stderr);
    }
}

void Progress::tell(double fraction) {
    using namespace std::chrono_literals;
    const Clock::time_point now = Clock::now();
    if (terminal_) {
        if (now - last_ > 100ms) {
            last_ = now;
            shown_ = true;
            std::fprintf(stderr, "\r%s: %3.0f%%", what_.c_str(), 100.0 * fraction);
            std::fflush(stderr);
        }
        return;
    }
    const int tenths = static_cast<int>(10.0 * fraction);
    if (now - start_ > 1s && tenths > tenths_) {
        if (!shown_) {
            std::fprintf(stderr, "%s:", what_.c_str());
        }
        std::fprintf(stderr, " %d%%", 10 * tenths);
        shown_ = true;
        tenths_ = tenths;
    }
}
