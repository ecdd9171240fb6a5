// SPDX-License-Identifier: MIT OR Apache-2.0
// A level set for ParaView.
#ifndef EXAMPLES_VTI_HPP
#define EXAMPLES_VTI_HPP

#include "grid.hpp"

#include <string>

// Writes a VTK ImageData file: the values as point data "distance", doubles, appended raw. Throws
// std::runtime_error where the file cannot be written.
void write_vti(const std::string &path, const Grid &grid);

#endif
