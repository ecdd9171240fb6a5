// SPDX-License-Identifier: MIT OR Apache-2.0
// A grid hierarchy over a body, as adaptive solvers keep it: boxes that the surface may cut are refined, all
// others are done with.
#ifndef RANDOM_CITY_HIERARCHY_HPP
#define RANDOM_CITY_HIERARCHY_HPP

#include <embound.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

struct Level {
    double width; // of its boxes, which are cubes
    std::vector<embound::Point> lo, hi;
    std::vector<std::int32_t> side; // -1 inside, 1 outside, 0 may be cut

    std::size_t count(std::int32_t which) const;
};

// Boxes of `width` cover the domain, whose sides are whole multiples of it; each further level holds the
// octants of the boxes before that may be cut.
std::vector<Level> make_hierarchy(const embound::Geometry &g, const embound::Box &domain, double width, std::size_t levels,
                                  const embound::Run &run);

struct Filled {
    double volume;     // inside the body
    std::size_t nodes; // that were asked for
};

// Fills the boxes of the levels' last that may be cut with cells^3 cells each, and takes the others whole.
Filled fill(const embound::Geometry &g, const std::vector<Level> &levels, std::size_t cells, const embound::Run &run);

#endif
