// SPDX-License-Identifier: MIT OR Apache-2.0
// Lines are drawn from the values alone: a pixel's distance from an iso-line is, to first order, the
// difference of the values over the gradient's length, so they are smooth at any angle.
#include "slice.hpp"

#include "image.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace {

constexpr std::size_t longest_side = 1200; // in pixels
constexpr double most_lines = 24.0;        // iso-lines between the surface and the farthest pixel

constexpr Colour black{0.05, 0.05, 0.06};

// Pale at the surface, strong at t = 1.
Colour shade(bool inside, double t) {
    constexpr std::array<Colour, 3> cold{{{0.84, 0.91, 0.96}, {0.36, 0.62, 0.80}, {0.09, 0.29, 0.52}}};
    constexpr std::array<Colour, 3> warm{{{1.00, 0.96, 0.90}, {0.97, 0.72, 0.45}, {0.77, 0.30, 0.14}}};
    const auto &ramp = inside ? cold : warm;
    return t < 0.5 ? mix(ramp[0], ramp[1], 2.0 * t) : mix(ramp[1], ramp[2], 2.0 * t - 1.0);
}

// The distance in a plane.
struct Sheet {
    std::size_t width = 0, height = 0;
    double pixel = 0.0;         // its side, in the unit of length
    std::vector<double> values; // row by row from the top

    double at(std::size_t row, std::size_t column) const { return values[row * width + column]; }

    // The change of the value across one pixel: the larger one-sided difference along each axis, so
    // that lines keep their width where the distance has a ridge.
    double slope(std::size_t row, std::size_t column) const {
        const double here = at(row, column);
        const double left = at(row, column - (column > 0)), right = at(row, column + (column + 1 < width));
        const double above = at(row - (row > 0), column), below = at(row + (row + 1 < height), column);
        const double across = std::max(std::abs(left - here), std::abs(right - here));
        const double down = std::max(std::abs(above - here), std::abs(below - here));
        return std::max(std::hypot(across, down), 0.05 * pixel);
    }
};

// How much of a pixel a line covers: `off` pixels from its middle, `width` pixels wide.
double coverage(double off, double width) { return std::clamp(0.5 * width + 0.5 - std::abs(off), 0.0, 1.0); }

// 1, 2 or 5 times a power of ten, at least `least`.
double nice_number(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double step : {1.0, 2.0, 5.0}) {
        if (step * power >= least) {
            return step * power;
        }
    }
    return 10.0 * power;
}

std::vector<double> pixel_centres(const std::vector<double> &nodes, double pixel, std::size_t count) {
    const double middle = 0.5 * (nodes.front() + nodes.back());
    std::vector<double> centres(count);
    for (std::size_t i = 0; i < count; ++i) {
        centres[i] = middle + (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1)) * pixel;
    }
    return centres;
}

// The distance at each pixel: one fill of a lattice that is one point thick, through strides that
// put the largest coordinate in the top row.
Sheet sample(const embound::Geometry &g, const Grid &grid, const Slice &slice, const embound::Run &run) {
    std::size_t across = (slice.axis + 1) % 3, up = (slice.axis + 2) % 3;
    const auto extent = [&](std::size_t axis) { return grid.nodes[axis].back() - grid.nodes[axis].front(); };
    if (extent(across) < extent(up)) {
        std::swap(across, up);
    }
    Sheet sheet;
    sheet.pixel = extent(across) / static_cast<double>(longest_side);
    sheet.width = longest_side;
    sheet.height = static_cast<std::size_t>(std::max(1.0, std::round(extent(up) / sheet.pixel)));
    sheet.values.resize(sheet.width * sheet.height);

    std::array<std::vector<double>, 3> axes;
    axes[across] = pixel_centres(grid.nodes[across], sheet.pixel, sheet.width);
    axes[up] = pixel_centres(grid.nodes[up], sheet.pixel, sheet.height);
    axes[slice.axis] = {slice.at};

    const auto row = static_cast<std::ptrdiff_t>(sheet.width);
    std::array<std::ptrdiff_t, 3> stride{};
    stride[across] = 1;
    stride[up] = -row;
    stride[slice.axis] = row * static_cast<std::ptrdiff_t>(sheet.height);
    double *const last_row = sheet.values.data() + row * static_cast<std::ptrdiff_t>(sheet.height - 1);
    g.fill(embound::Lattice(axes[0], axes[1], axes[2]), embound::Array(last_row, stride), embound::FillMode::Exact, run);
    return sheet;
}

Image paint(const Sheet &sheet, double line_spacing) {
    double deepest = 0.0, farthest = 0.0;
    for (const double value : sheet.values) {
        deepest = std::max(deepest, -value);
        farthest = std::max(farthest, value);
    }
    Image image(sheet.width, sheet.height, black);
    for (std::size_t row = 0; row < sheet.height; ++row) {
        for (std::size_t column = 0; column < sheet.width; ++column) {
            const double value = sheet.at(row, column);
            const double slope = sheet.slope(row, column);
            const bool inside = value <= 0.0;
            Colour colour = shade(inside, inside ? -value / std::max(deepest, slope) : value / std::max(farthest, slope));
            const double line = std::round(value / line_spacing);
            if (line != 0.0) {
                const bool strong = std::fmod(line, 5.0) == 0.0;
                const double off = (value - line * line_spacing) / slope;
                colour = mix(colour, black, (strong ? 0.5 : 0.25) * coverage(off, strong ? 1.6 : 1.0));
            }
            image.at(row, column) = mix(colour, black, coverage(value / slope, 3.0));
        }
    }
    return image;
}

} // namespace

Slice best_slice(const Grid &grid) {
    std::size_t axis = 0;
    for (const std::size_t other : {std::size_t{1}, std::size_t{2}}) {
        axis = grid.spacing(other) < grid.spacing(axis) ? other : axis;
    }
    std::vector<double> depth(grid.n(axis), 0.0);
    for (std::size_t k = 0; k < grid.n(2); ++k) {
        for (std::size_t j = 0; j < grid.n(1); ++j) {
            for (std::size_t i = 0; i < grid.n(0); ++i) {
                const std::array<std::size_t, 3> node{i, j, k};
                depth[node[axis]] += std::max(0.0, -grid.values[grid.index(i, j, k)]);
            }
        }
    }
    const auto deepest = std::max_element(depth.begin(), depth.end());
    return {axis, grid.nodes[axis][static_cast<std::size_t>(deepest - depth.begin())]};
}

Legend write_slice(const std::string &path, const embound::Geometry &g, const Grid &grid, const Slice &slice,
                   const embound::Run &run) {
    const Sheet sheet = sample(g, grid, slice, run);
    double farthest = 0.0;
    for (const double value : sheet.values) {
        farthest = std::max(farthest, std::abs(value));
    }
    const double line_spacing = nice_number(farthest / most_lines);
    write_png(path, paint(sheet, line_spacing));
    return {sheet.width, sheet.height, line_spacing};
}
