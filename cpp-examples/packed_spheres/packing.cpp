// SPDX-License-Identifier: MIT OR Apache-2.0
// Random sequential addition, the largest first: a ball is put down anywhere, and again where it meets one
// that lies there already. Cells as wide as the largest ball say which those may be.
#include "packing.hpp"

#include "random.hpp"
#include "vector.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::size_t most_tries = 1000000;
constexpr double gap = 1e-9; // left between balls, so that rounding brings none together

class Cells {
  public:
    explicit Cells(double widest) : n_(std::max<std::size_t>(1, static_cast<std::size_t>(1.0 / widest))), balls_(n_ * n_ * n_) {}

    bool is_free(const Ball &ball) const {
        const auto range = [&](std::size_t d) {
            const std::size_t at = cell(ball.centre[d]);
            return std::pair{at == 0 ? at : at - 1, std::min(at + 1, n_ - 1)};
        };
        const auto [x0, x1] = range(0);
        const auto [y0, y1] = range(1);
        const auto [z0, z1] = range(2);
        for (std::size_t z = z0; z <= z1; ++z) {
            for (std::size_t y = y0; y <= y1; ++y) {
                for (std::size_t x = x0; x <= x1; ++x) {
                    for (const Ball &other : balls_[x + n_ * (y + n_ * z)]) {
                        if (distance(ball.centre, other.centre) < ball.radius + other.radius + gap) {
                            return false;
                        }
                    }
                }
            }
        }
        return true;
    }
    void add(const Ball &ball) {
        balls_[cell(ball.centre[0]) + n_ * (cell(ball.centre[1]) + n_ * cell(ball.centre[2]))].push_back(ball);
    }

  private:
    std::size_t cell(double x) const { return std::min(static_cast<std::size_t>(x * static_cast<double>(n_)), n_ - 1); }

    std::size_t n_;
    std::vector<std::vector<Ball>> balls_;
};

} // namespace

std::vector<Ball> pack(std::size_t count, double fraction, std::uint64_t seed) {
    Random random(seed);
    std::vector<double> radii(count);
    double volume = 0.0;
    for (double &radius : radii) {
        radius = std::pow(3.0, -random.uniform());
        volume += 4.0 / 3.0 * pi * radius * radius * radius;
    }
    const double scale = std::cbrt(fraction / volume);
    std::sort(radii.begin(), radii.end(), std::greater<>());

    std::vector<Ball> balls;
    if (count == 0) {
        return balls;
    }
    Cells cells(2.0 * scale * radii.front() + gap);
    for (const double relative : radii) {
        const double r = scale * relative;
        Ball ball{{}, r};
        std::size_t tries = 0;
        do {
            if (++tries > most_tries) {
                throw std::runtime_error("no room was found for ball " + std::to_string(balls.size() + 1) + " of " +
                                         std::to_string(count));
            }
            ball.centre = random.in({{r, r, r}, {1.0 - r, 1.0 - r, 1.0 - r}});
        } while (!cells.is_free(ball));
        cells.add(ball);
        balls.push_back(ball);
    }
    return balls;
}
