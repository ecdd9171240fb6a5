// SPDX-License-Identifier: MIT OR Apache-2.0
// Set operations of a block and a ball whose centre is in the middle of one of its faces, so that half of it
// is in the block. Labels tell them apart in the result.
#include "tile.hpp"

#include "volumes.hpp"

#include <algorithm>
#include <cmath>

using namespace embound;

namespace {

// Three steps instead of one inner edge.
double stairs(double a, double b) {
    const double width = 0.3, step = width / 3.0;
    const double ahead = b - width - a + step;
    const double saw = std::abs(ahead - 2.0 * step * std::floor(ahead / (2.0 * step)) - step);
    return std::min(a, 0.5 * (b - width + a + saw));
}

} // namespace

std::vector<Tile> sets() {
    const double r = 0.5, half_ball = 0.5 * volume_of::ball(r), block_volume = 1.4 * 1.1 * 0.85;
    const Geometry block = part(box({-0.7, -0.55, -0.6}, {0.7, 0.55, 0.25}), first_body);
    const Geometry ball = part(sphere({0.0, 0.0, 0.25}, r), second_body);
    const Blend quadratic = Blend::smooth(0.4), exponential = Blend::exponential(0.1);
    std::vector<Geometry> holes;
    for (const double x : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
        holes.push_back(infinite_cylinder({x, 0.0, -0.15}, {0.0, 1.0, 0.0}, 0.1));
    }
    BlendOptions known;
    known.depth = 0.15;
    known.lipschitz = 1.0;
    known.thread_safe = true;

    return {
        {"unite", unite(block, ball), Kind::LowerBound, block_volume + half_ball, {{{0.0, 0.0, 1.25}, 0.5}}},
        {"intersection", intersection(block, ball), Kind::LowerBound, half_ball, {{{0.0, 0.0, 0.25}, 0.0}}},
        {"difference", difference(block, ball), Kind::LowerBound, block_volume - half_ball, {{{0.0, 0.0, 0.25}, r}}},
        {"difference (span)", difference(unite(block, ball), holes), Kind::LowerBound, unknown, {}},
        {"smooth_union", smooth_union({block, ball}, quadratic), Kind::LowerBound, unknown, {{{0.0, 0.0, 1.25}, 0.5}}},
        {"smooth_intersection", smooth_intersection({block, ball}, quadratic), Kind::LowerBound, unknown, {}},
        {"smooth_difference", smooth_difference(block, ball, quadratic), Kind::LowerBound, unknown, {}},
        {"Blend::exponential", smooth_union({block, ball}, exponential), Kind::LowerBound, unknown, {}},
        {"Blend::custom", smooth_union({block, ball}, Blend::custom(stairs, known)), Kind::LowerBound, unknown, {}},
    };
}
