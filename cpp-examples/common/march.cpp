// SPDX-License-Identifier: MIT OR Apache-2.0
// Sphere tracing (Hart 1996), all rays a step at a time: |value| / Lipschitz constant is a step that cannot
// jump over the surface, whatever the kind of the body. Where there is no constant, steps are short and even.
// Either way rays pass in one step through boxes that are classified as outside.
#include "march.hpp"

#include "vector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

constexpr double steps_per_box = 8.0;
constexpr double most_boxes_per_side = 64.0;

} // namespace

Marcher::Marcher(const embound::Geometry &g, double least_step, const embound::Run &run)
    : g_(g), least_step_(least_step), nudge_(1e-3 * least_step), run_(run), bounds_(g.bounds()) {
    for (std::size_t d = 0; d < 3; ++d) {
        bounds_.lo[d] -= least_step;
        bounds_.hi[d] += least_step;
        const double extent = bounds_.hi[d] - bounds_.lo[d];
        n_[d] = static_cast<std::size_t>(std::clamp(extent / (steps_per_box * least_step), 1.0, most_boxes_per_side));
        width_[d] = extent / static_cast<double>(n_[d]);
    }
    std::vector<embound::Point> lo, hi;
    for (std::size_t i = 0; i < n_[0] * n_[1] * n_[2]; ++i) {
        const std::size_t at[]{i % n_[0], i / n_[0] % n_[1], i / n_[0] / n_[1]};
        embound::Point corner{}, opposite{};
        for (std::size_t d = 0; d < 3; ++d) {
            corner[d] = bounds_.lo[d] + width_[d] * static_cast<double>(at[d]);
            opposite[d] = corner[d] + width_[d];
        }
        lo.push_back(corner);
        hi.push_back(opposite);
    }
    sides_ = g.classify(lo, hi, run);
}

// What of a stretch lies in the box.
Marcher::Stretch Marcher::within(const embound::Box &box, const embound::Point &start, const embound::Point &direction,
                                 Stretch stretch) {
    for (std::size_t d = 0; d < 3; ++d) {
        const double lo = box.lo[d] - start[d], hi = box.hi[d] - start[d];
        if (direction[d] == 0.0) {
            stretch.to = lo <= 0.0 && hi >= 0.0 ? stretch.to : stretch.from;
        } else {
            const auto [near, far] = std::minmax({lo / direction[d], hi / direction[d]});
            stretch = {std::max(stretch.from, near), std::min(stretch.to, far)};
        }
    }
    return stretch;
}

// From `at` along a ray to where it has left all boxes that are outside.
double Marcher::skip(const embound::Point &start, const embound::Point &direction, double at) const {
    for (;;) {
        const embound::Point p = along(start, at, direction);
        embound::Box box{};
        std::size_t index = 0;
        for (std::size_t d = 3; d-- > 0;) {
            const double place = std::floor((p[d] - bounds_.lo[d]) / width_[d]);
            if (!(place >= 0.0 && place < static_cast<double>(n_[d]))) {
                return at;
            }
            index = index * n_[d] + static_cast<std::size_t>(place);
            box.lo[d] = bounds_.lo[d] + place * width_[d];
            box.hi[d] = box.lo[d] + width_[d];
        }
        if (sides_[index] != 1) {
            return at;
        }
        at = std::max(at, within(box, start, direction, {0.0, std::numeric_limits<double>::infinity()}).to) + nudge_;
    }
}

std::vector<Entry> Marcher::march(const std::vector<embound::Point> &starts, const embound::Point &direction,
                                  double reach) const {
    const double lipschitz = g_.properties().lipschitz;
    const auto step = [&](double value) {
        return std::isfinite(lipschitz) ? std::max(value / lipschitz, least_step_) : least_step_;
    };

    std::vector<Entry> going, entries;
    std::vector<double> ends(starts.size());
    const auto go_on = [&](std::size_t ray, double from, double to) {
        const double skipped = skip(starts[ray], direction, to);
        if (skipped < ends[ray]) {
            // Up to a nudge before its end the last box that was skipped is outside.
            going.push_back({ray, skipped > to ? skipped - 2.0 * nudge_ : from, skipped});
        }
    };
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const Stretch inside = within(bounds_, starts[i], direction, {0.0, reach});
        ends[i] = inside.to;
        go_on(i, inside.from, inside.from);
    }
    std::vector<Entry> at;
    std::vector<embound::Point> points;
    std::vector<double> values;
    while (!going.empty()) {
        at.swap(going);
        going.clear();
        points.resize(at.size());
        values.resize(at.size());
        for (std::size_t k = 0; k < at.size(); ++k) {
            points[k] = along(starts[at[k].ray], at[k].to, direction);
        }
        g_.values(points, values, run_);
        for (std::size_t k = 0; k < at.size(); ++k) {
            if (values[k] > 0.0) {
                go_on(at[k].ray, at[k].to, at[k].to + step(values[k]));
            } else if (at[k].from < at[k].to) {
                entries.push_back(at[k]);
            }
        }
    }
    return entries;
}
