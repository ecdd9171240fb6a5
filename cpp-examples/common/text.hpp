// SPDX-License-Identifier: MIT OR Apache-2.0
// Words in a picture, in a small alphabet of dots: a to z, digits, B, space and _ ( ) - . : only.
#ifndef EXAMPLES_TEXT_HPP
#define EXAMPLES_TEXT_HPP

#include "image.hpp"

#include <string>

// How many pixels wide a text is; a dot is `scale` pixels a side.
std::size_t text_width(const std::string &text, std::size_t scale);

// Nine dots high, the foot of the letters seven dots below `row`.
void write_text(Image &image, std::size_t row, std::size_t column, const std::string &text, std::size_t scale,
                const Colour &colour);

#endif
