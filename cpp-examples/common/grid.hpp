// SPDX-License-Identifier: MIT OR Apache-2.0
// The solver's side of a level set: node coordinates, computed once, and a value at each node.
#ifndef EXAMPLES_GRID_HPP
#define EXAMPLES_GRID_HPP

#include <embound.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

struct Grid {
    std::array<std::vector<double>, 3> nodes; // coordinates along each axis
    std::vector<double> values;               // at the nodes, x fastest

    embound::Lattice lattice() const { return {nodes[0], nodes[1], nodes[2]}; }
    std::size_t n(std::size_t axis) const { return nodes[axis].size(); }
    double spacing(std::size_t axis) const;
    std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return i + n(0) * (j + n(1) * k); }
};

// `n` nodes a side over `factor` times the box, about its centre.
Grid make_grid(const embound::Box &box, double factor, std::size_t n);

// The values of a body at the nodes. A fill refuses a body of which only the sign is known, since others
// would take the magnitude for a distance; between neighbouring nodes it still says where the surface is.
void sample(Grid &grid, const embound::Geometry &g, const embound::Run &run);

// Closed boxes of nodes that cover the grid, `blocks` a side; neighbours share a layer of nodes.
struct Blocks {
    std::vector<embound::Point> lo, hi;
    std::vector<std::array<std::size_t, 6>> nodes; // first and last node along x, y, z
};
Blocks make_blocks(const Grid &grid, std::size_t blocks);

// How many blocks are said to be inside or outside while a node's value says otherwise: 0, always.
std::size_t count_contradictions(const Grid &grid, const Blocks &blocks, const std::vector<std::int32_t> &sides);

#endif
