// SPDX-License-Identifier: MIT OR Apache-2.0
// Node coordinates and blocks of nodes.
#include "grid.hpp"

#include <algorithm>

double Grid::spacing(std::size_t axis) const {
    return (nodes[axis].back() - nodes[axis].front()) / static_cast<double>(n(axis) - 1);
}

Grid make_grid(const embound::Box &box, double factor, std::size_t n) {
    Grid grid;
    for (std::size_t d = 0; d < 3; ++d) {
        const double centre = 0.5 * (box.lo[d] + box.hi[d]);
        const double half = 0.5 * factor * (box.hi[d] - box.lo[d]);
        const double step = 2.0 * half / static_cast<double>(n - 1);
        for (std::size_t i = 0; i < n; ++i) {
            grid.nodes[d].push_back(centre - half + static_cast<double>(i) * step);
        }
    }
    return grid;
}

void sample(Grid &grid, const embound::Geometry &g, const embound::Run &run) {
    if (g.properties().kind != embound::Kind::SignOnly) {
        grid.values = g.fill(grid.lattice(), embound::FillMode::Exact, run);
        return;
    }
    std::vector<embound::Point> points;
    points.reserve(grid.n(0) * grid.n(1) * grid.n(2));
    for (const double z : grid.nodes[2]) {
        for (const double y : grid.nodes[1]) {
            for (const double x : grid.nodes[0]) {
                points.push_back({x, y, z});
            }
        }
    }
    grid.values = g.values(points, run);
}

Blocks make_blocks(const Grid &grid, std::size_t blocks) {
    Blocks made;
    const auto first = [&](std::size_t axis, std::size_t b) { return b * (grid.n(axis) - 1) / blocks; };
    for (std::size_t c = 0; c < blocks; ++c) {
        for (std::size_t b = 0; b < blocks; ++b) {
            for (std::size_t a = 0; a < blocks; ++a) {
                const std::array<std::size_t, 6> range{first(0, a),     first(1, b),     first(2, c),
                                                       first(0, a + 1), first(1, b + 1), first(2, c + 1)};
                made.nodes.push_back(range);
                made.lo.push_back({grid.nodes[0][range[0]], grid.nodes[1][range[1]], grid.nodes[2][range[2]]});
                made.hi.push_back({grid.nodes[0][range[3]], grid.nodes[1][range[4]], grid.nodes[2][range[5]]});
            }
        }
    }
    return made;
}

std::size_t count_contradictions(const Grid &grid, const Blocks &blocks, const std::vector<std::int32_t> &sides) {
    const auto contradicts = [&](const std::array<std::size_t, 6> &range, std::int32_t side) {
        for (std::size_t k = range[2]; k <= range[5]; ++k) {
            for (std::size_t j = range[1]; j <= range[4]; ++j) {
                for (std::size_t i = range[0]; i <= range[3]; ++i) {
                    if (!(grid.values[grid.index(i, j, k)] * side > 0.0)) {
                        return true;
                    }
                }
            }
        }
        return false;
    };
    std::size_t count = 0;
    for (std::size_t b = 0; b < sides.size(); ++b) {
        count += sides[b] != 0 && contradicts(blocks.nodes[b], sides[b]) ? 1 : 0;
    }
    return count;
}
