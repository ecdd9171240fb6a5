// SPDX-License-Identifier: MIT OR Apache-2.0
// Lines are drawn from the values alone: a pixel's distance from an iso-line is, to first order, the
// difference of the values over the gradient's length, so they are smooth at any angle.
#include "picture.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace {

constexpr std::size_t longest_side = 1200; // in pixels
constexpr double most_lines = 24.0;        // iso-lines between the surface and the farthest pixel

using Colour = std::array<double, 3>;
constexpr Colour black{0.05, 0.05, 0.06};

Colour mix(const Colour &a, const Colour &b, double t) {
    return {a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t};
}

// Pale at the surface, strong at t = 1.
Colour shade(bool inside, double t) {
    constexpr std::array<Colour, 3> cold{{{0.84, 0.91, 0.96}, {0.36, 0.62, 0.80}, {0.09, 0.29, 0.52}}};
    constexpr std::array<Colour, 3> warm{{{1.00, 0.96, 0.90}, {0.97, 0.72, 0.45}, {0.77, 0.30, 0.14}}};
    const auto &ramp = inside ? cold : warm;
    return t < 0.5 ? mix(ramp[0], ramp[1], 2.0 * t) : mix(ramp[1], ramp[2], 2.0 * t - 1.0);
}

struct Image {
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
Image sample(const embound::Geometry &g, const Grid &grid, const Slice &slice, const embound::Run &run) {
    std::size_t across = (slice.axis + 1) % 3, up = (slice.axis + 2) % 3;
    const auto extent = [&](std::size_t axis) { return grid.nodes[axis].back() - grid.nodes[axis].front(); };
    if (extent(across) < extent(up)) {
        std::swap(across, up);
    }
    Image image;
    image.pixel = extent(across) / static_cast<double>(longest_side);
    image.width = longest_side;
    image.height = static_cast<std::size_t>(std::max(1.0, std::round(extent(up) / image.pixel)));
    image.values.resize(image.width * image.height);

    std::array<std::vector<double>, 3> axes;
    axes[across] = pixel_centres(grid.nodes[across], image.pixel, image.width);
    axes[up] = pixel_centres(grid.nodes[up], image.pixel, image.height);
    axes[slice.axis] = {slice.at};

    const auto row = static_cast<std::ptrdiff_t>(image.width);
    std::array<std::ptrdiff_t, 3> stride{};
    stride[across] = 1;
    stride[up] = -row;
    stride[slice.axis] = row * static_cast<std::ptrdiff_t>(image.height);
    double *const last_row = image.values.data() + row * static_cast<std::ptrdiff_t>(image.height - 1);
    g.fill(embound::Lattice(axes[0], axes[1], axes[2]), embound::Array(last_row, stride), embound::FillMode::Exact, run);
    return image;
}

std::vector<unsigned char> paint(const Image &image, double line_spacing) {
    double deepest = 0.0, farthest = 0.0;
    for (const double value : image.values) {
        deepest = std::max(deepest, -value);
        farthest = std::max(farthest, value);
    }
    std::vector<unsigned char> rgb;
    rgb.reserve(3 * image.values.size());
    for (std::size_t row = 0; row < image.height; ++row) {
        for (std::size_t column = 0; column < image.width; ++column) {
            const double value = image.at(row, column);
            const double slope = image.slope(row, column);
            const bool inside = value <= 0.0;
            Colour colour = shade(inside, inside ? -value / std::max(deepest, slope) : value / std::max(farthest, slope));
            const double line = std::round(value / line_spacing);
            if (line != 0.0) {
                const bool strong = std::fmod(line, 5.0) == 0.0;
                const double off = (value - line * line_spacing) / slope;
                colour = mix(colour, black, (strong ? 0.5 : 0.25) * coverage(off, strong ? 1.6 : 1.0));
            }
            colour = mix(colour, black, coverage(value / slope, 3.0));
            for (const double channel : colour) {
                rgb.push_back(static_cast<unsigned char>(std::lround(255.0 * channel)));
            }
        }
    }
    return rgb;
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

Legend write_picture(const std::string &path, const embound::Geometry &g, const Grid &grid, const Slice &slice,
                     const embound::Run &run) {
    const Image image = sample(g, grid, slice, run);
    double farthest = 0.0;
    for (const double value : image.values) {
        farthest = std::max(farthest, std::abs(value));
    }
    const double line_spacing = nice_number(farthest / most_lines);
    const std::vector<unsigned char> rgb = paint(image, line_spacing);

    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&png, path.c_str(), 0, rgb.data(), 0, nullptr) == 0) {
        throw std::runtime_error(path + ": " + png.message);
    }
    return {image.width, image.height, line_spacing};
}
