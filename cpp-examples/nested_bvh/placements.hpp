// SPDX-License-Identifier: MIT OR Apache-2.0
// Many copies of a body, turned at random.
#ifndef NESTED_BVH_PLACEMENTS_HPP
#define NESTED_BVH_PLACEMENTS_HPP

#include <embound.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

// `count` copies of a bounded body, each turned about its middle by any angle about any axis and put near a
// node of a cubic grid, far enough apart that no two boxes meet. Copy i carries the label i.
std::vector<embound::Geometry> place_copies(const embound::Geometry &body, std::size_t count, std::uint64_t seed);

#endif
