// SPDX-License-Identifier: MIT OR Apache-2.0
// Where parallel rays first meet a body.
#ifndef EXAMPLES_MARCH_HPP
#define EXAMPLES_MARCH_HPP

#include <embound.hpp>

#include <cstddef>
#include <vector>

// The stretch of a ray in which it enters the body: outside at `from`, inside or on the surface at
// `to`, in lengths along the ray.
struct Entry {
    std::size_t ray;
    double from, to;
};

// Rays go from each start in one direction, of length 1, no further than `reach`. Parts of the body
// that are thinner along the ray than `least_step` may be missed. A ray that starts inside gets none.
std::vector<Entry> march(const embound::Geometry &g, const std::vector<embound::Point> &starts, const embound::Point &direction,
                         double reach, double least_step, const embound::Run &run);

#endif
