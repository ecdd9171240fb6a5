// SPDX-License-Identifier: MIT OR Apache-2.0
// What a tile says against what is known.
#ifndef SHAPES_CHECK_HPP
#define SHAPES_CHECK_HPP

#include "tile.hpp"

// What was measured on the way.
struct Measured {
    double volume; // of the level set over 64^3 nodes
    std::size_t cut_boxes;
};

// Throws std::runtime_error where the tile is wrong in its kind, its values, its volume (by more than 2%),
// its closest points, its slope, or in one of 16^3 boxes.
Measured check(const Tile &tile, const embound::Run &run);

#endif
