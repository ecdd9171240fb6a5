// SPDX-License-Identifier: MIT OR Apache-2.0
// A bed of balls, as of a packed column or a porous medium: packed_spheres [count]
#include "packing.hpp"

#include "grid.hpp"
#include "progress.hpp"
#include "random.hpp"
#include "render.hpp"
#include "report.hpp"
#include "slice.hpp"
#include "vector.hpp"
#include "volume.hpp"

#include <embound.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numeric>

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double solid_fraction = 0.4;
constexpr std::size_t nodes_per_side = 128;
constexpr std::size_t compared_points = 1000;
constexpr std::size_t timed_points = 1000000;
constexpr double fraction_tolerance = 0.01;
constexpr embound::Box cube{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};

// Every ball carries its index as the label that hits report.
embound::Geometry bed_of(const std::vector<Ball> &balls) {
    std::vector<embound::Geometry> parts;
    parts.reserve(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        parts.push_back(embound::part(embound::sphere(balls[i].centre, balls[i].radius), static_cast<std::int32_t>(i)));
    }
    return embound::unite(parts);
}

// The same questions without embound: every ball is looked at.
struct Nearest {
    double value;
    std::size_t ball;
};
Nearest nearest_ball(const std::vector<Ball> &balls, const embound::Point &p) {
    Nearest nearest{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const double value = distance(p, balls[i].centre) - balls[i].radius;
        if (value < nearest.value) {
            nearest = {value, i};
        }
    }
    return nearest;
}

void compare_with_brute_force(const embound::Geometry &bed, const std::vector<Ball> &balls, Random &random) {
    const std::vector<embound::Point> points = random.points_in({{-0.2, -0.2, -0.2}, {1.2, 1.2, 1.2}}, compared_points);
    const std::vector<double> values = bed.values(points);
    const std::vector<std::int32_t> parts = bed.closest(points).part;
    std::size_t values_differ = 0, parts_differ = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Nearest nearest = nearest_ball(balls, points[i]);
        values_differ += std::memcmp(&values[i], &nearest.value, sizeof(double)) == 0 ? 0 : 1;
        parts_differ += parts[i] == static_cast<std::int32_t>(nearest.ball) ? 0 : 1;
    }
    std::printf(
        "agreement     with the least of all balls to the last bit at %zu of %zu points; the part is the nearest ball at %zu\n",
        points.size() - values_differ, points.size(), points.size() - parts_differ);
    require(values_differ == 0, std::to_string(values_differ) + " values differ from brute force");
    require(parts_differ == 0, std::to_string(parts_differ) + " parts are not the nearest ball");
}

void time_queries(const embound::Geometry &bed, Random &random, const embound::Pool &pool) {
    const std::vector<embound::Point> points = random.points_in(cube, timed_points);
    std::vector<double> values(points.size());
    const double alone = seconds([&] { bed.values(points, values); });
    const double together = seconds([&] { bed.values(points, values, pool); });
    std::printf("values        %.0f ns a random point on one thread, %.0f ns on %zu\n", 1e9 * alone / timed_points,
                1e9 * together / timed_points, pool.width());
}

void compare_volumes(const embound::Geometry &bed, const std::vector<Ball> &balls, const embound::Pool &pool) {
    Grid grid = make_grid(cube, 1.0, nodes_per_side);
    const double time = seconds([&] { grid.values = bed.fill(grid.lattice(), embound::FillMode::Exact, pool); });
    const double exact = std::accumulate(balls.begin(), balls.end(), 0.0, [](double sum, const Ball &ball) {
        return sum + 4.0 / 3.0 * pi * ball.radius * ball.radius * ball.radius;
    });
    // Two estimates. Planes through the nodes cut the caps off round bodies: with balls of a few cells the enclosed
    // volume is short by some percent, as a solver's own cut cells will be. Cells whose centre is inside have no
    // such bias; a fill of signs is all they need.
    const Grid centres = make_grid(cube, static_cast<double>(nodes_per_side - 2) / (nodes_per_side - 1), nodes_per_side - 1);
    const std::vector<std::int8_t> signs = bed.fill<std::int8_t>(centres.lattice(), embound::FillMode::Sign, pool);
    const auto inside = std::count_if(signs.begin(), signs.end(), [](std::int8_t sign) { return sign <= 0; });
    const double enclosed = enclosed_volume(grid), counted = static_cast<double>(inside) / static_cast<double>(signs.size());
    std::printf("level set     %zu^3 nodes in %s: %.2f million a second\n", nodes_per_side, in_words(time).c_str(),
                1e-6 * static_cast<double>(grid.values.size()) / time);
    std::printf("solid         fraction %.6f from the radii; %.6f of the cells have their centre inside (%+.3f%%), cut cells "
                "hold %.6f (%+.3f%%)\n",
                exact, counted, 100.0 * (counted - exact) / exact, enclosed, 100.0 * (enclosed - exact) / exact);
    require(std::abs(counted - exact) <= fraction_tolerance * exact, "the solid fraction is off by more than 1%");
}

// The cube seen from a corner, with a block taken out: what is cut shows pale.
void draw(const embound::Geometry &bed, const std::vector<Ball> &balls, const embound::Pool &pool) {
    const double time = seconds([&] {
        const embound::Geometry corner =
            embound::part(embound::box({0.5, -1.0, 0.5}, {2.0, 0.5, 2.0}), static_cast<std::int32_t>(balls.size()));
        const Colour cut{0.93, 0.90, 0.82}, blue{0.20, 0.44, 0.74}, grey{0.68, 0.72, 0.74}, orange{0.97, 0.62, 0.28};
        Look look{{cut}};
        for (std::size_t i = 0; i < balls.size(); ++i) { // the largest blue, the smallest orange
            const double t = static_cast<double>(i) / static_cast<double>(balls.size());
            look.colours.push_back(t < 0.5 ? mix(blue, grey, 2.0 * t) : mix(grey, orange, 2.0 * t - 1.0));
        }
        look.colours.push_back(cut);
        write_png(in_demo_out("packed_spheres.png"),
                  render(embound::difference(bed, corner), {{0.5, 0.5, 0.5}, {1.0, -1.3, 0.9}, 0.84, 1.2}, look, 460, 430, pool));
    });
    std::printf("written       %s, in %s\n", in_demo_out("packed_spheres.png").c_str(), in_words(time).c_str());
}

void packed_spheres(int argc, char **argv) {
    const std::size_t count = argc > 1 ? whole_number(argv[1]) : 20000;
    require(count > 0, "the count must be a positive number");
    const embound::Pool pool;
    print_library(pool);
    Random random(1);

    std::vector<Ball> balls;
    const double packing_time = seconds([&] { balls = pack(count, solid_fraction, 2026); });
    std::printf("packing       %zu balls without an overlap in %s, radii %.4f to %.4f in a cube of side 1\n", count,
                in_words(packing_time).c_str(), balls.back().radius, balls.front().radius);

    embound::Geometry bed;
    const double build_time = seconds([&] { bed = bed_of(balls); });
    const embound::Properties properties = bed.properties();
    std::printf("union         built in %s, %.1f MB, %s\n", in_words(build_time).c_str(),
                1e-6 * static_cast<double>(properties.bytes), in_words(properties.kind));
    // No two balls have a point in common, so the least distance is the distance, inside and outside.
    require(properties.kind == embound::Kind::Exact, "the union of disjoint balls is not exact");

    compare_with_brute_force(bed, balls, random);
    time_queries(bed, random, pool);
    compare_volumes(bed, balls, pool);
    draw(bed, balls, pool);
}

} // namespace

int main(int argc, char **argv) {
    if (argc > 2) {
        std::fprintf(stderr, "usage: packed_spheres [count]\n");
        return 2;
    }
    return run_example("packed_spheres", packed_spheres, argc, argv);
}
