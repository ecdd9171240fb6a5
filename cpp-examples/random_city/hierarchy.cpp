// SPDX-License-Identifier: MIT OR Apache-2.0
#include "hierarchy.hpp"

#include "grid.hpp"
#include "volume.hpp"

#include <algorithm>
#include <cmath>

namespace {

void add(Level &level, const embound::Point &lo) {
    level.lo.push_back(lo);
    level.hi.push_back({lo[0] + level.width, lo[1] + level.width, lo[2] + level.width});
}

} // namespace

std::size_t Level::count(std::int32_t which) const {
    return static_cast<std::size_t>(std::count(side.begin(), side.end(), which));
}

std::vector<Level> make_hierarchy(const embound::Geometry &g, const embound::Box &domain, double width, std::size_t levels,
                                  const embound::Run &run) {
    std::vector<Level> made(1);
    made[0].width = width;
    const auto along = [&](std::size_t d) {
        return static_cast<std::size_t>(std::lround((domain.hi[d] - domain.lo[d]) / width));
    };
    for (std::size_t k = 0; k < along(2); ++k) {
        for (std::size_t j = 0; j < along(1); ++j) {
            for (std::size_t i = 0; i < along(0); ++i) {
                add(made[0], {domain.lo[0] + static_cast<double>(i) * width, domain.lo[1] + static_cast<double>(j) * width,
                              domain.lo[2] + static_cast<double>(k) * width});
            }
        }
    }
    for (std::size_t l = 0; l < levels; ++l) {
        made[l].side = g.classify(made[l].lo, made[l].hi, run);
        if (l + 1 < levels) {
            Level finer{0.5 * made[l].width, {}, {}, {}};
            for (std::size_t b = 0; b < made[l].side.size(); ++b) {
                for (std::size_t octant = 0; made[l].side[b] == 0 && octant < 8; ++octant) {
                    const embound::Point &lo = made[l].lo[b];
                    add(finer, {lo[0] + static_cast<double>(octant & 1) * finer.width,
                                lo[1] + static_cast<double>(octant >> 1 & 1) * finer.width,
                                lo[2] + static_cast<double>(octant >> 2) * finer.width});
                }
            }
            made.push_back(std::move(finer));
        }
    }
    return made;
}

Filled fill(const embound::Geometry &g, const std::vector<Level> &levels, std::size_t cells, const embound::Run &run) {
    Filled filled{0.0, 0};
    for (const Level &level : levels) {
        filled.volume += static_cast<double>(level.count(-1)) * std::pow(level.width, 3);
    }
    const Level &last = levels.back();
    for (std::size_t b = 0; b < last.side.size(); ++b) {
        if (last.side[b] == 0) {
            Grid grid = make_grid({last.lo[b], last.hi[b]}, 1.0, cells + 1);
            grid.values = g.fill(grid.lattice(), embound::FillMode::Exact, run);
            filled.volume += enclosed_volume(grid);
            filled.nodes += grid.values.size();
        }
    }
    return filled;
}
