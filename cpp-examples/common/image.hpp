// SPDX-License-Identifier: MIT OR Apache-2.0
// A picture in memory, and as a PNG.
#ifndef EXAMPLES_IMAGE_HPP
#define EXAMPLES_IMAGE_HPP

#include <array>
#include <cstddef>
#include <string>
#include <vector>

using Colour = std::array<double, 3>; // red, green, blue, 0 to 1 as a screen takes them

// From a at t = 0 to b at t = 1.
Colour mix(const Colour &a, const Colour &b, double t);

struct Image {
    std::size_t width, height;
    std::vector<Colour> pixels; // row by row from the top

    Image(std::size_t w, std::size_t h, const Colour &colour) : width(w), height(h), pixels(w * h, colour) {}
    Colour &at(std::size_t row, std::size_t column) { return pixels[row * width + column]; }
    const Colour &at(std::size_t row, std::size_t column) const { return pixels[row * width + column]; }

    // Puts another picture into this one; what does not fit is left out.
    void paste(const Image &other, std::size_t row, std::size_t column);
};

// Writes a PNG. Throws std::runtime_error where the file cannot be written.
void write_png(const std::string &path, const Image &image);

#endif
