// SPDX-License-Identifier: MIT OR Apache-2.0
// The part that the quickstart makes when it is given no mesh.
#ifndef QUICKSTART_PART_HPP
#define QUICKSTART_PART_HPP

#include <cstdint>
#include <vector>

struct Part {
    std::vector<double> xyz;            // x y z of each vertex, in millimetres
    std::vector<std::uint32_t> indices; // three vertices a triangle, counterclockwise from outside
    double volume;                      // of the polyhedron, in closed form
};

// An angle bracket of two perforated plates: a floor of square cells with a round hole through each,
// and an upright wall, thinner, along one side with a row of holes of its own. The webs between the
// holes are a tenth of a cell wide.
Part make_bracket();

#endif
