// SPDX-License-Identifier: MIT OR Apache-2.0
#include "city.hpp"

#include "random.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace embound;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::size_t plots = 21;   // along each side, one building each
constexpr std::size_t survey = 101; // heights along each side
constexpr double relief = 45.0;     // of the hills

// Noise read on a grid becomes a height field, as a survey of real ground would.
Geometry make_terrain(std::uint64_t seed) {
    const Geometry noise = perlin(relief, {1.9 / side, 1.9 / side, 1.0 / side}, 0.35, 4, seed);
    std::vector<double> x(survey);
    for (std::size_t i = 0; i < survey; ++i) {
        x[i] = side * static_cast<double>(i) / static_cast<double>(survey - 1);
    }
    std::vector<Point> places;
    for (const double v : x) {
        for (const double u : x) {
            places.push_back({u, v, 0.5 * side});
        }
    }
    return height_field(Lattice(x, x), noise.values(places));
}

// The height of the ground: where a vertical line leaves it.
double ground_at(const Geometry &terrain, double x, double y) {
    const Point above[]{{x, y, sky}}, below[]{{x, y, bottom}};
    return sky + (bottom - sky) * terrain.intercepts(above, below).t[0];
}

Matrix turned(double degrees) {
    const double c = std::cos(degrees * pi / 180.0), s = std::sin(degrees * pi / 180.0);
    return {c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0};
}

// Of one kind, `half` wide about (x, y), from `foot` to `roof`.
Geometry building(Part kind, double x, double y, double half, double foot, double roof, Random &random) {
    const double tall = roof - foot, middle = 0.5 * (foot + roof);
    const double narrow = half * random.uniform(0.55, 1.0), angle = random.uniform(-12.0, 12.0);
    switch (kind) {
    case block: return rounded_box({x, y, middle}, {half, narrow, 0.5 * tall}, 0.0, turned(angle));
    case rounded: return rounded_box({x, y, middle}, {half, narrow, 0.5 * tall}, 0.35 * narrow, turned(angle));
    case drum: return cylinder({x, y, foot}, {x, y, roof}, 0.9 * half);
    case prismatic:
        return prism({x, y, foot}, {x, y, roof}, {1.0, angle, 0.0}, 3 + static_cast<std::int32_t>(random.below(6)), half);
    default: return cone({x, y, roof}, {0.0, 0.0, -1.0}, tall, 2.0 * std::atan(half / tall) * 180.0 / pi);
    }
}

} // namespace

City make_city(std::uint64_t seed) {
    Random random(seed);
    City city;
    const Geometry hills = make_terrain(seed);
    // Hills go on without end. Bodies may well leave the domain of a solver, so the box that ends them is larger.
    const Geometry tray = part(box({-margin, -margin, bottom - margin}, {side + margin, side + margin, sky}), soil);
    city.terrain = intersection(part(hills, ground), tray);
    std::vector<Geometry> parts{city.terrain};
    city.count[ground] = 1;

    const double pitch = side / plots;
    for (std::size_t j = 0; j < plots; ++j) {
        for (std::size_t i = 0; i < plots; ++i) {
            if (random.uniform() < 0.09) {
                continue; // a park
            }
            const double x = pitch * (static_cast<double>(i) + random.uniform(0.45, 0.55));
            const double y = pitch * (static_cast<double>(j) + random.uniform(0.45, 0.55));
            const double off_centre = std::hypot(x - 0.5 * side, y - 0.5 * side) / (0.5 * side);
            const double tall =
                10.0 + 110.0 * std::exp(-4.0 * off_centre * off_centre) * random.uniform(0.15, 1.0) + 16.0 * random.uniform();
            const double half = pitch * random.uniform(0.24, 0.36);
            const double floor = ground_at(hills, x, y);
            const double draw = random.uniform();
            const Part kind = draw < 0.5 ? block : draw < 0.68 ? rounded : draw < 0.8 ? drum : draw < 0.93 ? prismatic : conical;
            // Walls go well into the slope they stand on.
            parts.push_back(part(building(kind, x, y, half, floor - 12.0, floor + tall, random), kind));
            ++city.count[kind];
        }
    }
    city.body = unite(parts);
    return city;
}
