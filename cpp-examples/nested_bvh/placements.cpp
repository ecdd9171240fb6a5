// SPDX-License-Identifier: MIT OR Apache-2.0
// However a body is turned, its box is no wider than the diagonal of the box that it had.
#include "placements.hpp"

#include "random.hpp"
#include "vector.hpp"

#include <cmath>

namespace {

constexpr double jitter = 0.1; // of the diagonal, either way
constexpr double gap = 0.02;   // of the diagonal, left between boxes

// Spread evenly over the unit sphere.
embound::Point any_direction(Random &random) {
    for (;;) {
        const embound::Point p = random.in({{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}});
        const double far = length(p);
        if (far > 0.1 && far < 1.0) {
            return unit(p);
        }
    }
}

} // namespace

std::vector<embound::Geometry> place_copies(const embound::Geometry &body, std::size_t count, std::uint64_t seed) {
    const embound::Box box = body.bounds();
    const embound::Point middle = along(box.lo, 0.5, along(box.hi, -1.0, box.lo));
    const double diagonal = distance(box.lo, box.hi), pitch = (1.0 + 2.0 * jitter + gap) * diagonal;
    std::size_t side = 1;
    while (side * side * side < count) {
        ++side;
    }
    Random random(seed);
    std::vector<embound::Geometry> copies;
    copies.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const embound::Point axis = any_direction(random);
        const embound::Geometry turned = embound::rotate(body, axis, random.uniform(-180.0, 180.0), middle);
        const std::size_t node[]{i % side, i / side % side, i / side / side};
        embound::Point shift{};
        for (std::size_t d = 0; d < 3; ++d) {
            shift[d] = pitch * static_cast<double>(node[d]) + jitter * diagonal * random.uniform(-1.0, 1.0) - middle[d];
        }
        copies.push_back(embound::part(embound::translate(turned, shift), static_cast<std::int32_t>(i)));
    }
    return copies;
}
