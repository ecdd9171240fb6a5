// SPDX-License-Identifier: MIT OR Apache-2.0
// Random numbers that are the same on every machine: the standard fixes the engine, not its distributions.
#ifndef EXAMPLES_RANDOM_HPP
#define EXAMPLES_RANDOM_HPP

#include <embound.hpp>

#include <cstdint>
#include <random>
#include <vector>

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    // In [lo, hi).
    double uniform(double lo = 0.0, double hi = 1.0) { return lo + (hi - lo) * (static_cast<double>(engine_() >> 11) * 0x1p-53); }
    // 0 to count - 1.
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }

    embound::Point in(const embound::Box &box) {
        embound::Point p{};
        for (std::size_t d = 0; d < 3; ++d) {
            p[d] = uniform(box.lo[d], box.hi[d]);
        }
        return p;
    }
    std::vector<embound::Point> points_in(const embound::Box &box, std::size_t count) {
        std::vector<embound::Point> points(count);
        for (embound::Point &p : points) {
            p = in(box);
        }
        return points;
    }

  private:
    std::mt19937_64 engine_;
};

#endif
