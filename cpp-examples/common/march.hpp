// SPDX-License-Identifier: MIT OR Apache-2.0
// Where parallel rays first meet a body.
#ifndef EXAMPLES_MARCH_HPP
#define EXAMPLES_MARCH_HPP

#include <embound.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

// The stretch of a ray in which it enters the body: outside at `from`, inside or on the surface at
// `to`, in lengths along the ray.
struct Entry {
    std::size_t ray;
    double from, to;
};

class Marcher {
  public:
    // Parts of the body that are thinner along a ray than `least_step` may be missed.
    Marcher(const embound::Geometry &g, double least_step, const embound::Run &run);

    // Rays go from each start in one direction, of length 1, no further than `reach`. One that starts
    // inside gets no entry.
    std::vector<Entry> march(const std::vector<embound::Point> &starts, const embound::Point &direction, double reach) const;

  private:
    struct Stretch {
        double from, to;
    };
    static Stretch within(const embound::Box &box, const embound::Point &start, const embound::Point &direction, Stretch stretch);
    double skip(const embound::Point &start, const embound::Point &direction, double at) const;

    const embound::Geometry &g_;
    double least_step_, nudge_;
    const embound::Run &run_;
    embound::Box bounds_;
    std::array<std::size_t, 3> n_;    // boxes in the bounds along each axis
    embound::Point width_;            // of one
    std::vector<std::int32_t> sides_; // of each, x fastest
};

#endif
