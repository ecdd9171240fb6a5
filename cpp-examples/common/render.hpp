// SPDX-License-Identifier: MIT OR Apache-2.0
// A shaded picture of a body.
#ifndef EXAMPLES_RENDER_HPP
#define EXAMPLES_RENDER_HPP

#include "image.hpp"

#include <embound.hpp>

#include <functional>
#include <vector>

// Parallel projection; z points up in the picture, y where one looks along z.
struct View {
    embound::Point target; // in the middle of the picture
    embound::Point toward; // from the target to the eye, of any length
    double half_width;     // of what is seen
    double half_depth;     // seen before and behind the target
};

// How a body looks.
struct Look {
    std::vector<Colour> colours; // of part -1, 0, 1, ...; the last for all further ones
    Colour background{1.0, 1.0, 1.0};
    bool shadows = true;
    // The colour of each of several points of the surface, instead of their parts'.
    std::function<std::vector<Colour>(const std::vector<embound::Point> &)> paint{};
};

// A picture of width x height pixels. The body must not reach the plane half_depth before the target.
Image render(const embound::Geometry &g, const View &view, const Look &look, std::size_t width, std::size_t height,
             const embound::Run &run);

#endif
