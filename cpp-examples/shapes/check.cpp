// SPDX-License-Identifier: MIT OR Apache-2.0
// A function is the distance to its surface if it is 1-Lipschitz (so its magnitude is no more than that) and
// a point that far away is on the surface (so it is no less).
#include "check.hpp"

#include "grid.hpp"
#include "random.hpp"
#include "report.hpp"
#include "vector.hpp"
#include "volume.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace {

constexpr std::size_t nodes_per_side = 64;
constexpr std::size_t blocks_per_side = 16;
constexpr std::size_t points = 2000;
constexpr double rounding = 1e-12;
constexpr double volume_tolerance = 0.02;
constexpr embound::Box cube{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}};

std::string text(const embound::Point &p) {
    return "(" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " + std::to_string(p[2]) + ")";
}

void check_probes(const Tile &tile) {
    for (const Probe &probe : tile.probes) {
        const double value = tile.body(probe.at[0], probe.at[1], probe.at[2]);
        require(std::abs(value - probe.value) <= rounding, tile.name + ": " + std::to_string(value) + " instead of " +
                                                               std::to_string(probe.value) + " at " + text(probe.at));
    }
}

void check_slope(const Tile &tile, const std::vector<embound::Point> &at, const std::vector<double> &values, double lipschitz) {
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        const double most = lipschitz * distance(at[i], at[i + 1]);
        require(!(std::abs(values[i] - values[i + 1]) > most + rounding),
                tile.name + ": steeper than its Lipschitz constant " + std::to_string(lipschitz) + " at " + text(at[i]));
    }
}

void check_closest(const Tile &tile, const std::vector<embound::Point> &at, const std::vector<double> &values,
                   const embound::Run &run) {
    const embound::Closest closest = tile.body.closest(at, std::numeric_limits<double>::infinity(), run);
    const std::vector<double> there = tile.body.values(closest.point, run);
    for (std::size_t i = 0; i < at.size(); ++i) {
        const bool right = std::abs(distance(at[i], closest.point[i]) - std::abs(values[i])) <= rounding &&
                           std::abs(there[i]) <= rounding && std::abs(length(closest.gradient[i]) - 1.0) <= rounding;
        require(right, tile.name + ": the closest point of " + text(at[i]) + " is not right");
    }
}

} // namespace

Measured check(const Tile &tile, const embound::Run &run) {
    const embound::Properties properties = tile.body.properties();
    require(properties.kind == tile.kind,
            tile.name + ": its values are " + in_words(properties.kind) + " instead of " + in_words(tile.kind));
    check_probes(tile);

    Random random(64);
    const std::vector<embound::Point> at = random.points_in({{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}}, points);
    const std::vector<double> values = tile.body.values(at, run);
    check_slope(tile, at, values, properties.lipschitz);
    if (properties.kind == embound::Kind::Exact) {
        check_closest(tile, at, values, run);
    }

    Grid grid = make_grid(cube, 1.0, nodes_per_side);
    sample(grid, tile.body, run);
    const Measured measured{enclosed_volume(grid), 0};
    require(!(std::abs(measured.volume - tile.volume) > volume_tolerance * tile.volume),
            tile.name + ": a volume of " + std::to_string(measured.volume) + " instead of " + std::to_string(tile.volume));

    const Blocks blocks = make_blocks(grid, blocks_per_side);
    const std::vector<std::int32_t> sides = tile.body.classify(blocks.lo, blocks.hi, run);
    require(count_contradictions(grid, blocks, sides) == 0, tile.name + ": a box is not on the side it is said to be");
    return {measured.volume, static_cast<std::size_t>(std::count(sides.begin(), sides.end(), 0))};
}
