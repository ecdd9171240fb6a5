// SPDX-License-Identifier: MIT OR Apache-2.0
// The surface that a solver sees: where a level set vanishes that is linear between nodes.
#ifndef PAINT_CUT_SURFACE_HPP
#define PAINT_CUT_SURFACE_HPP

#include "grid.hpp"

#include <embound.hpp>

// Triangles, counterclockwise from outside; closed where the body does not reach the edge of the grid. Fails
// where no cell is cut.
embound::Mesh cut_surface(const Grid &grid);

#endif
