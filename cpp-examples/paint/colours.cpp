// SPDX-License-Identifier: MIT OR Apache-2.0
#include "colours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using embound::On;

constexpr Colour grey{0.72, 0.72, 0.72};
const std::string own_colours = "red, green, blue";

// From blue through green to yellow, ever lighter.
Colour scale(double t) {
    constexpr std::array<Colour, 5> ramp{
        {{0.16, 0.17, 0.45}, {0.13, 0.42, 0.60}, {0.18, 0.64, 0.55}, {0.62, 0.82, 0.36}, {0.99, 0.91, 0.45}}};
    const double at = std::clamp(t, 0.0, 1.0) * (ramp.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), ramp.size() - 2);
    return mix(ramp[below], ramp[below + 1], at - static_cast<double>(below));
}

// Of one item.
double magnitude(const double *item, std::size_t components) {
    if (components == 1) {
        return *item;
    }
    double sum = 0.0;
    for (std::size_t c = 0; c < components; ++c) {
        sum += item[c] * item[c];
    }
    return std::sqrt(sum);
}

} // namespace

FieldColours::FieldColours(const embound::Mesh &mesh, const std::string &name) : mesh_(mesh), name_(name) {
    std::vector<embound::Field> all = fields(mesh, On::Vertices);
    const auto known = [&](const char *channel) {
        return std::any_of(all.begin(), all.end(), [&](const embound::Field &f) { return f.name == channel; });
    };
    if (name.empty() && known("red") && known("green") && known("blue")) {
        name_ = own_colours;
        for (const char *channel : {"red", "green", "blue"}) {
            fields_.push_back(field(mesh, On::Vertices, channel));
        }
    } else {
        for (embound::Field &f : fields(mesh, On::Faces)) {
            all.push_back(std::move(f));
        }
        const auto chosen = std::find_if(all.begin(), all.end(), [&](const embound::Field &f) { return name.empty() || f.name == name; });
        if (chosen != all.end()) {
            name_ = chosen->name;
            fields_.push_back(*chosen);
        } else if (!name.empty()) {
            throw embound::Error(EMB_ERROR_INVALID_ARGUMENT, "field: the mesh has none of the name \"" + name + "\"");
        }
    }
    measure();
}

void FieldColours::measure() {
    least_ = std::numeric_limits<double>::infinity();
    most_ = -least_;
    for (const embound::Field &f : fields_) {
        const std::vector<double> numbers = values(mesh_, f);
        for (std::size_t i = 0; i < f.count; ++i) {
            const double x = magnitude(&numbers[i * f.components], f.components);
            if (std::isfinite(x)) {
                least_ = std::min(least_, x);
                most_ = std::max(most_, x);
            }
        }
    }
}

std::vector<Colour> FieldColours::at(const embound::Closest &closest, const embound::Run &run) const {
    std::vector<Colour> colours(closest.value.size(), grey);
    for (std::size_t channel = 0; channel < fields_.size(); ++channel) {
        const embound::Field &f = fields_[channel];
        const std::vector<double> numbers = interpolate(mesh_, f, closest, run);
        for (std::size_t i = 0; i < colours.size(); ++i) {
            const double x = magnitude(&numbers[i * f.components], f.components);
            if (fields_.size() == 3) {
                colours[i][channel] = x / (most_ > 1.0 ? 255.0 : 1.0); // bytes, or from 0 to 1
            } else if (std::isfinite(x)) {
                colours[i] = scale((x - least_) / std::max(most_ - least_, std::numeric_limits<double>::min()));
            }
        }
    }
    return colours;
}

std::vector<Colour> tag_colours(const std::vector<std::int32_t> &all_tags, const std::vector<std::int32_t> &tags) {
    constexpr std::array<Colour, 8> known{{{0.25, 0.50, 0.80},
                                           {0.92, 0.52, 0.25},
                                           {0.74, 0.76, 0.78},
                                           {0.40, 0.68, 0.42},
                                           {0.78, 0.36, 0.40},
                                           {0.58, 0.46, 0.72},
                                           {0.88, 0.78, 0.36},
                                           {0.40, 0.68, 0.70}}};
    std::vector<Colour> colours;
    colours.reserve(tags.size());
    for (const std::int32_t tag : tags) {
        const auto place = std::lower_bound(all_tags.begin(), all_tags.end(), tag) - all_tags.begin();
        colours.push_back(known[static_cast<std::size_t>(place) % known.size()]);
    }
    return colours;
}
