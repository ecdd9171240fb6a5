// SPDX-License-Identifier: MIT OR Apache-2.0
// A random packing of balls.
#ifndef PACKED_SPHERES_PACKING_HPP
#define PACKED_SPHERES_PACKING_HPP

#include <embound.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

struct Ball {
    embound::Point centre;
    double radius;
};

// `count` balls in the unit cube, wholly inside it and apart from each other. Radii vary by a factor of
// three and together fill `fraction` of the cube: up to 0.4 or so of many balls is found in a moment.
// Throws std::runtime_error where no room is found for one.
std::vector<Ball> pack(std::size_t count, double fraction, std::uint64_t seed);

#endif
