// SPDX-License-Identifier: MIT OR Apache-2.0
// The volume that a level set encloses.
#ifndef EXAMPLES_VOLUME_HPP
#define EXAMPLES_VOLUME_HPP

#include "grid.hpp"

// Where the values, taken as linear in the tetrahedra of each cell, are negative.
double enclosed_volume(const Grid &grid);

#endif
