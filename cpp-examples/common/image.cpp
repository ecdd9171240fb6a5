// SPDX-License-Identifier: MIT OR Apache-2.0
// Pictures become files by libpng.
#include "image.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

Colour mix(const Colour &a, const Colour &b, double t) {
    return {a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t};
}

void Image::paste(const Image &other, std::size_t row, std::size_t column) {
    for (std::size_t r = 0; r < other.height && row + r < height; ++r) {
        for (std::size_t c = 0; c < other.width && column + c < width; ++c) {
            at(row + r, column + c) = other.at(r, c);
        }
    }
}

void write_png(const std::string &path, const Image &image) {
    std::vector<unsigned char> rgb;
    rgb.reserve(3 * image.pixels.size());
    for (const Colour &colour : image.pixels) {
        for (const double channel : colour) {
            rgb.push_back(static_cast<unsigned char>(std::lround(255.0 * std::clamp(channel, 0.0, 1.0))));
        }
    }
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&png, path.c_str(), 0, rgb.data(), 0, nullptr) == 0) {
        throw std::runtime_error(path + ": " + png.message);
    }
}
