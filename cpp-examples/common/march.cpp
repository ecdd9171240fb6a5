// SPDX-License-Identifier: MIT OR Apache-2.0
// Sphere tracing (Hart 1996), all rays a step at a time: |value| / Lipschitz constant is a step that cannot
// jump over the surface, whatever the kind of the body. Where there is no constant, steps are short and even.
#include "march.hpp"

#include "vector.hpp"

#include <algorithm>
#include <cmath>

namespace {

struct Stretch {
    double from, to;
};

// Leaves of a ray what lies in the box, and `margin` on either side.
void clip(Stretch &stretch, const embound::Box &box, const embound::Point &start, const embound::Point &direction, double margin) {
    for (std::size_t d = 0; d < 3; ++d) {
        const double lo = box.lo[d] - margin - start[d], hi = box.hi[d] + margin - start[d];
        if (direction[d] == 0.0) {
            stretch.to = lo <= 0.0 && hi >= 0.0 ? stretch.to : stretch.from;
        } else {
            const auto [near, far] = std::minmax({lo / direction[d], hi / direction[d]});
            stretch = {std::max(stretch.from, near), std::min(stretch.to, far)};
        }
    }
}

} // namespace

std::vector<Entry> march(const embound::Geometry &g, const std::vector<embound::Point> &starts, const embound::Point &direction,
                         double reach, double least_step, const embound::Run &run) {
    const double lipschitz = g.properties().lipschitz;
    const auto step = [&](double value) { return std::isfinite(lipschitz) ? std::max(value / lipschitz, least_step) : least_step; };

    const embound::Box bounds = g.bounds();
    std::vector<Entry> going, entries;
    std::vector<double> ends(starts.size());
    for (std::size_t i = 0; i < starts.size(); ++i) {
        Stretch within{0.0, reach};
        clip(within, bounds, starts[i], direction, least_step);
        if (within.from < within.to) {
            going.push_back({i, within.from, within.from});
            ends[i] = within.to;
        }
    }
    std::vector<embound::Point> points;
    std::vector<double> values;
    for (bool first = true; !going.empty(); first = false) {
        points.resize(going.size());
        values.resize(going.size());
        for (std::size_t k = 0; k < going.size(); ++k) {
            points[k] = along(starts[going[k].ray], going[k].to, direction);
        }
        g.values(points, values, run);
        std::size_t kept = 0;
        for (std::size_t k = 0; k < going.size(); ++k) {
            const Entry at = going[k];
            if (values[k] <= 0.0) {
                if (!first) {
                    entries.push_back(at);
                }
            } else if (at.to < ends[at.ray]) {
                going[kept++] = {at.ray, at.to, std::min(at.to + step(values[k]), ends[at.ray])};
            }
        }
        going.resize(kept);
    }
    return entries;
}
