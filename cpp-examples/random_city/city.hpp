// SPDX-License-Identifier: MIT OR Apache-2.0
// A city on hilly ground, in metres.
#ifndef RANDOM_CITY_CITY_HPP
#define RANDOM_CITY_CITY_HPP

#include <embound.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

constexpr double side = 1000.0;  // of the square it covers
constexpr double margin = 25.0;  // of ground around and below that
constexpr double bottom = -50.0; // below every valley
constexpr double sky = 200.0;    // above every roof

enum Part : std::int32_t { ground, block, rounded, drum, prismatic, conical, soil, part_count };
constexpr std::array<const char *, part_count> part_names{"ground", "box", "rounded box", "cylinder", "prism", "cone", "soil"};

struct City {
    embound::Geometry body;    // all of it, labelled by Part
    embound::Geometry terrain; // the ground alone
    std::array<std::size_t, part_count> count{};
};

// The same city for the same seed, on every machine.
City make_city(std::uint64_t seed);

#endif
