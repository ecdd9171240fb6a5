// SPDX-License-Identifier: MIT OR Apache-2.0
// Meshes that are open.
#ifndef EXAMPLES_SHEETS_HPP
#define EXAMPLES_SHEETS_HPP

#include <embound.hpp>

#include <cstdint>
#include <functional>

// A surface over the unit square, cut into cells; where it goes round in u, its sides meet.
struct Cells {
    std::uint32_t along_u, along_v;
    bool round;
};
embound::Mesh make_sheet(const Cells &cells, const std::function<embound::Point(double, double)> &at);

// The pipe's wall, the height of the ground, and how far the ball's surface is from its centre.
constexpr double pipe_radius = 0.6, ball_radius = 0.9, plate_half_thickness = 0.05;
double ground(double x, double y);

embound::Mesh make_pipe();
embound::Mesh make_ground();
embound::Mesh make_plate();
embound::Mesh make_ball_without_a_triangle();

#endif
