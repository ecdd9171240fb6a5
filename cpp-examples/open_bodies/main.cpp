// SPDX-License-Identifier: MIT OR Apache-2.0
// Meshes that are open, and the bodies they stand for, in a domain from -1 to 1 along each axis.
#include "sheets.hpp"

#include "grid.hpp"
#include "report.hpp"

#include <embound.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace {

using embound::Geometry;
using embound::Point;

constexpr std::size_t nodes_per_side = 65, blocks_per_side = 16;
constexpr Point domain_lo{-1.0, -1.0, -1.0}, domain_hi{1.0, 1.0, 1.0};

// Nodes nearer to the surface than the mesh is to the closed form are left out.
constexpr double facet = 0.004;

void examine(const char *name, const Geometry &g, const embound::Run &run, const std::function<double(const Point &)> &wanted) {
    Grid grid = make_grid({domain_lo, domain_hi}, 1.0, nodes_per_side);
    const std::vector<std::int8_t> signs = g.fill<std::int8_t>(grid.lattice(), embound::FillMode::Sign, run);
    sample(grid, g, run);
    std::size_t inside = 0, wrong = 0, split = 0;
    for (std::size_t k = 0; k < nodes_per_side; ++k) {
        for (std::size_t j = 0; j < nodes_per_side; ++j) {
            for (std::size_t i = 0; i < nodes_per_side; ++i) {
                const Point p{grid.nodes[0][i], grid.nodes[1][j], grid.nodes[2][k]};
                const double value = grid.values[grid.index(i, j, k)], distance = wanted(p);
                inside += value <= 0.0 ? 1 : 0;
                wrong += std::fabs(distance) > facet && (value < 0.0) != (distance < 0.0) ? 1 : 0;
                split += signs[grid.index(i, j, k)] == (value > 0.0) - (value < 0.0) ? 0 : 1;
            }
        }
    }
    const Blocks blocks = make_blocks(grid, blocks_per_side);
    const std::vector<std::int32_t> sides = g.classify(blocks.lo, blocks.hi, run);
    const std::size_t lies = count_contradictions(grid, blocks, sides);
    const auto known = std::count_if(sides.begin(), sides.end(), [](std::int32_t side) { return side != 0; });
    std::printf("%-8s %s\n         %zu of %zu nodes inside, %zu wrong; %td of %zu boxes on one side\n", name,
                g.sign_text().c_str(), inside, grid.values.size(), wrong, known, sides.size());
    require(wrong == 0, std::string(name) + ": nodes on the wrong side");
    require(split == 0, std::string(name) + ": signs that are not those of the values");
    require(lies == 0, std::string(name) + ": boxes on another side than their nodes");
}

void open_bodies(int, char **) {
    const embound::Pool pool;
    print_library(pool);

    // The wall goes on beyond the domain, so that what is near its ends is as far from it as in between.
    embound::SdfOptions swept;
    swept.open = embound::Open::Sweep;
    swept.open_lo = domain_lo;
    swept.open_hi = domain_hi;
    examine("pipe", embound::from_mesh(make_pipe(), swept, pool), pool,
            [](const Point &p) { return std::hypot(p[1], p[2]) - pipe_radius; });

    embound::SdfOptions terrain;
    terrain.sign = embound::Sign::Axis;
    terrain.axis = 2;
    examine("terrain", embound::from_mesh(make_ground(), terrain, pool), pool,
            [](const Point &p) { return p[2] - ground(p[0], p[1]); });

    // No side of its own: a wall around it has one.
    embound::SdfOptions baffle;
    baffle.sign = embound::Sign::None;
    examine("baffle", embound::annular(embound::from_mesh(make_plate(), baffle, pool), plate_half_thickness), pool,
            [](const Point &p) {
                const double y = std::max(std::fabs(p[1]) - 0.5, 0.0), z = std::max(std::fabs(p[2]) - 0.5, 0.0);
                return std::sqrt((p[0] - 0.1) * (p[0] - 0.1) + y * y + z * z) - plate_half_thickness;
            });

    examine("ball", embound::from_mesh(make_ball_without_a_triangle(), {}, pool), pool,
            [](const Point &p) { return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - ball_radius; });
}

} // namespace

int main(int argc, char **argv) {
    if (argc > 1) {
        std::fprintf(stderr, "usage: open_bodies\n");
        return 2;
    }
    return run_example("open_bodies", open_bodies, argc, argv);
}
