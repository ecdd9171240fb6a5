// SPDX-License-Identifier: MIT OR Apache-2.0
// Wind over a city: what a solver asks of terrain with buildings on it. random_city [seed]
#include "city.hpp"
#include "hierarchy.hpp"

#include "grid.hpp"
#include "random.hpp"
#include "render.hpp"
#include "report.hpp"
#include "slice.hpp"
#include "vector.hpp"

#include <embound.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

constexpr embound::Box air{{0.0, 0.0, bottom}, {side, side, sky}};
constexpr double coarsest = 125.0; // width of a box
constexpr std::size_t levels = 4;
constexpr std::size_t cells_per_box = 6;
constexpr double volume_tolerance = 0.01;
constexpr std::size_t lines_per_side = 400;

const Look look{{{0.80, 0.78, 0.72},
                 {0.56, 0.66, 0.42},
                 {0.82, 0.80, 0.76},
                 {0.90, 0.68, 0.42},
                 {0.42, 0.62, 0.80},
                 {0.79, 0.45, 0.40},
                 {0.62, 0.50, 0.72},
                 {0.66, 0.54, 0.42}}};

// Whatever a box says must hold at points within it.
void check_boxes(const embound::Geometry &city, const Level &level, Random &random) {
    std::vector<embound::Point> points;
    for (std::size_t b = 0; b < level.side.size(); ++b) {
        points.push_back(random.in({level.lo[b], level.hi[b]}));
    }
    const std::vector<double> values = city.values(points);
    for (std::size_t b = 0; b < values.size(); ++b) {
        require(values[b] * level.side[b] >= 0.0, "a box is not on the side it is said to be");
    }
}

void refine(const embound::Geometry &city, Random &random, const embound::Pool &pool) {
    std::vector<Level> hierarchy;
    const double time = seconds([&] { hierarchy = make_hierarchy(city, air, coarsest, levels, pool); });
    std::size_t boxes = 0;
    std::printf("hierarchy     %8s %8s %8s %8s %8s\n", "width", "boxes", "inside", "outside", "cut");
    for (const Level &level : hierarchy) {
        std::printf("              %8g %8zu %8zu %8zu %8zu\n", level.width, level.side.size(), level.count(-1), level.count(1),
                    level.count(0));
        boxes += level.side.size();
        check_boxes(city, level, random);
    }
    std::printf("              %zu boxes classified in %s\n", boxes, in_words(time).c_str());

    // Only boxes that may be cut are filled: once where the hierarchy ends, once a level above.
    Filled coarse{}, fine{};
    const double fill_time = seconds([&] {
        fine = fill(city, hierarchy, cells_per_box, pool);
        hierarchy.pop_back();
        coarse = fill(city, hierarchy, cells_per_box, pool);
    });
    const double spacing = 0.5 * hierarchy.back().width / cells_per_box,
                 all = side / spacing * (side / spacing) * ((sky - bottom) / spacing);
    std::printf("level set     %.1f million nodes in %s, %.1f%% of a uniform grid of spacing %g\n",
                1e-6 * static_cast<double>(fine.nodes + coarse.nodes), in_words(fill_time).c_str(),
                100.0 * static_cast<double>(fine.nodes) / all, spacing);
    const double off = (coarse.volume - fine.volume) / fine.volume;
    std::printf("volume        %.6g with spacing %g, %.6g with %g: %+.3f%%\n", fine.volume, spacing, coarse.volume, 2.0 * spacing,
                100.0 * off);
    require(std::abs(off) <= volume_tolerance, "the volumes of the two levels are too far apart");
}

// Vertical lines from the sky into the ground: where they come to the surface, on which part, and its slope.
void map_roofs(const City &city, const embound::Pool &pool) {
    std::vector<embound::Point> above, below;
    for (std::size_t row = 0; row < lines_per_side; ++row) {
        for (std::size_t column = 0; column < lines_per_side; ++column) {
            const auto middle = [](std::size_t i) { return side * (static_cast<double>(i) + 0.5) / lines_per_side; };
            above.push_back({middle(column), middle(lines_per_side - 1 - row), sky});
            below.push_back({above.back()[0], above.back()[1], bottom});
        }
    }
    embound::Intercepts roof;
    const double time = seconds([&] { roof = city.body.intercepts(above, below, pool); });
    const embound::Intercepts bare = city.terrain.intercepts(above, below, pool);

    Image map(lines_per_side, lines_per_side, {});
    const embound::Point light = unit({-0.6, 0.5, 0.9});
    double highest = bottom;
    std::array<std::size_t, part_count> seen{};
    for (std::size_t i = 0; i < above.size(); ++i) {
        const auto height = [&](double t) { return above[i][2] + t * (below[i][2] - above[i][2]); };
        const double top = height(roof.t[i]), at_surface = city.body(above[i][0], above[i][1], top);
        require(std::abs(at_surface) <= 1e-9, "a roof is not on the surface");
        require(roof.part[i] == ground ? roof.t[i] == bare.t[i] : roof.t[i] < bare.t[i], "a roof carries the wrong part");
        highest = std::max(highest, top);
        ++seen[static_cast<std::size_t>(roof.part[i])];
        const double bright = 0.45 + 0.55 * std::max(0.0, dot(roof.normal[i], light));
        const double haze = std::clamp(top / 150.0, 0.0, 1.0); // what is high is light
        const Colour own = mix(look.colours[static_cast<std::size_t>(roof.part[i] + 1)], {1.0, 1.0, 1.0}, 0.6 * haze);
        map.pixels[i] = mix({0.02, 0.02, 0.05}, own, bright);
    }
    std::printf("roofs         %zu^2 vertical lines in %s: %.0f ns a line; highest %.1f m\n", lines_per_side,
                in_words(time).c_str(), 1e9 * time / static_cast<double>(above.size()), highest);
    for (std::size_t p = 0; p < soil; ++p) {
        std::printf("              %-12s %4zu, %5.1f%% of the area\n", part_names[p], city.count[p],
                    100.0 * static_cast<double>(seen[p]) / static_cast<double>(above.size()));
    }
    write_png(in_demo_out("random_city_map.png"), map);
}

void draw(const City &city, const embound::Pool &pool) {
    const double time = seconds([&] {
        const View view{{0.5 * side, 0.5 * side, -30.0}, {0.9, -1.5, 1.15}, 0.74 * side, side};
        write_png(in_demo_out("random_city.png"), render(city.body, view, look, 900, 560, pool));
        write_slice(in_demo_out("random_city_slice.png"), city.body, make_grid(air, 1.0, 2), {1, 0.5 * side}, pool);
    });
    std::printf("written       %s, random_city_map.png, random_city_slice.png, in %s\n", in_demo_out("random_city.png").c_str(),
                in_words(time).c_str());
}

void random_city(int argc, char **argv) {
    const std::uint64_t seed = argc > 1 ? whole_number(argv[1]) : 7;
    const embound::Pool pool;
    print_library(pool);
    City city;
    const double time = seconds([&] { city = make_city(seed); });
    const embound::Properties properties = city.body.properties();
    std::printf("city          seed %llu: %llu bodies in %s, %.1f kB; values are a %s\n", static_cast<unsigned long long>(seed),
                static_cast<unsigned long long>(properties.primitives), in_words(time).c_str(),
                1e-3 * static_cast<double>(properties.bytes), in_words(properties.kind));
    Random random(seed);
    refine(city.body, random, pool);
    map_roofs(city, pool);
    draw(city, pool);
}

} // namespace

int main(int argc, char **argv) {
    if (argc > 2) {
        std::fprintf(stderr, "usage: random_city [seed]\n");
        return 2;
    }
    return run_example("random_city", random_city, argc, argv);
}
