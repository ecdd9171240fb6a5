// SPDX-License-Identifier: MIT OR Apache-2.0
// One line on stderr that says how far a long call is.
#ifndef EXAMPLES_PROGRESS_HPP
#define EXAMPLES_PROGRESS_HPP

#include <chrono>
#include <string>

// On a terminal the line is rewritten at most ten times a second and removed at the end. Elsewhere
// it appears once the call has taken a second, and grows by the tenths that are done.
class Progress {
public:
    explicit Progress(std::string what);
    ~Progress();
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    void tell(double fraction);

private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    bool terminal_;
    bool shown_ = false;
    int tenths_ = 0;
    Clock::time_point start_;
    Clock::time_point last_;
};

#endif
