// SPDX-License-Identifier: MIT OR Apache-2.0
// The colours in which data of a mesh are shown.
#ifndef PAINT_COLOURS_HPP
#define PAINT_COLOURS_HPP

#include "image.hpp"

#include <embound.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

// A field of a mesh by a scale from its least to its largest value, of vectors the length; or, where no field is
// named and the vertices have red, green and blue, those. Where nothing is named otherwise, the first field there is.
class FieldColours {
  public:
    FieldColours(const embound::Mesh &mesh, const std::string &name);

    const std::string &name() const { return name_; } // empty where the mesh has no fields
    double least() const { return least_; }
    double most() const { return most_; }

    // At points of the mesh's surface.
    std::vector<Colour> at(const embound::Closest &closest, const embound::Run &run) const;

  private:
    void measure();

    embound::Mesh mesh_;
    std::string name_;
    std::vector<embound::Field> fields_; // one, or red, green and blue
    double least_ = 0.0, most_ = 0.0;
};

// One for each tag of a mesh, told apart as long as there are not more than eight.
std::vector<Colour> tag_colours(const std::vector<std::int32_t> &all_tags, const std::vector<std::int32_t> &tags);

#endif
