// SPDX-License-Identifier: MIT OR Apache-2.0
// A picture of the distance in a plane.
#ifndef EXAMPLES_SLICE_HPP
#define EXAMPLES_SLICE_HPP

#include "grid.hpp"

#include <string>

// A plane across an axis.
struct Slice {
    std::size_t axis;
    double at;
};

// Across the grid's shortest side, the layer of nodes that lies deepest in the body: where the sum of
// the distances of its inner nodes is largest.
Slice best_slice(const Grid &grid);

// What a picture shows.
struct Legend {
    std::size_t width, height; // in pixels
    double line_spacing;       // between iso-lines, in the unit of length
};

// Writes a PNG of the distance over the grid's extent, asked of the geometry at each pixel: blue
// inside, orange outside, stronger with distance (each side by its own largest), iso-lines of the
// distance, every fifth stronger, and the surface in black. Throws std::runtime_error where the
// file cannot be written.
Legend write_slice(const std::string &path, const embound::Geometry &g, const Grid &grid, const Slice &slice,
                   const embound::Run &run);

#endif
