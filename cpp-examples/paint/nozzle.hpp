// SPDX-License-Identifier: MIT OR Apache-2.0
// The body that is painted where no mesh is given: a nozzle with boundary conditions on its surface.
#ifndef PAINT_NOZZLE_HPP
#define PAINT_NOZZLE_HPP

#include <embound.hpp>

#include <cstdint>

enum Boundary : std::int32_t { inlet = 1, outlet = 2, wall = 3, jacket = 4 };

// Linear in space, so that linear interpolation over a flat face must give it to rounding.
double temperature(const embound::Point &p);

// Stripes that wind along the nozzle, from 0 to 1.
double heating(const embound::Point &p);

// A closed body of revolution along x, of plane quadrilaterals and triangles, tagged by Boundary. The vertices
// carry "heating" and "temperature", the faces "panel", their own number.
embound::Mesh make_nozzle();

#endif
