// SPDX-License-Identifier: MIT OR Apache-2.0
// A body with what is known of it without asking embound.
#ifndef SHAPES_TILE_HPP
#define SHAPES_TILE_HPP

#include <embound.hpp>

#include <limits>
#include <string>
#include <vector>

// Labels that the picture colours: the two bodies of a set operation, and where a tile was cut open.
enum Label : std::int32_t { first_body = 0, second_body = 1, cut_face = 2 };

struct Probe {
    embound::Point at;
    double value;
};

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Bodies fit into the cube from -1 to 1, or fill it where they have no end.
struct Tile {
    std::string name; // of the function in embound:: that makes it
    embound::Geometry body;
    embound::Kind kind;        // that it must have
    double volume;             // of what is in the cube; unknown where there is no closed form
    std::vector<Probe> probes; // values that it must have
    bool opened = false;       // drawn with the front corner taken out
};

std::vector<Tile> solids();     // meshes, closed forms, samples, functions
std::vector<Tile> transforms(); // of one body
std::vector<Tile> sets();       // of two

#endif
